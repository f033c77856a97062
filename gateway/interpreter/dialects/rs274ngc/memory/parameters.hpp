#pragma once

#include <array>
#include <cstdint>

/// The numbered parameters (NIST 3.2.1). Lengths stored by the control (home points, offsets,
/// origins) are in machine units.
namespace dripline::interpreter::rs274ngc {

inline constexpr int kNistParameters = 5400;
inline constexpr int kAllParameters = 5603;

inline constexpr int kProbeResult = 5061;  ///< X Y Z A B C U V W
inline constexpr int kProbeSuccess = 5070;
inline constexpr int kHome = 5161;        ///< G28
inline constexpr int kSecondHome = 5181;  ///< G30
inline constexpr int kG92Active = 5210;
inline constexpr int kG92Offsets = 5211;
inline constexpr int kSystemNumber = 5220;
inline constexpr int kFirstSystem = 5221;
inline constexpr int kParametersPerSystem = 20;
inline constexpr int kSystemRotation = 9;  ///< after the first of a system
inline constexpr int kInputResult = 5399;
inline constexpr int kFirstReadOnly = 5400;
inline constexpr int kCurrentPosition = 5420;
inline constexpr int kDebugSwitch = 5599;

constexpr int first_of_system(int system) {
  return kFirstSystem + kParametersPerSystem * (system - 1);
}

using Parameters = std::array<double, kAllParameters>;

}  // namespace dripline::interpreter::rs274ngc
