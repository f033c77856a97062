#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "gateway/interpreter/dialects/centurion/modal_state.hpp"

/// The parameters P0-P999 and the byte parameters PB0-PB639 (manual: parameters). The tables an
/// operator edits (work offsets, tools) live in P500 and up, in a numbering of our own because the
/// control's is not known:
///   P500-P511  work offsets: Z, X of G54, then G55 ... G59
///   P600-P839  offset n (1-24) from 600 + 10 (n - 1): Z length, X length, nose radius, type,
///              Z wear, X wear, radius wear
/// and of the axis parameters, Z first, then X:
///   P512 home position           P514-P521 reference points 1 to 4
///   P522 tool change position    P524, P526 corners of the safe zone, positive and negative
///   P528, P530 positive and negative software limit (both the same: none)
///   P532, P534 overrun of G60, of every G0
///   P536 maximum feed per minute (0: none)
/// and what only the machine itself uses: P850-P908, listed in machine_parameters.cpp.
/// All others keep what is written to them. X values are radii.
namespace dripline::interpreter::centurion {

inline constexpr int kParameterCount = 1000;
inline constexpr int kByteCount = 640;
inline constexpr int kFirstDataParameter = 499;  ///< from here on writable in data mode (G10) only
inline constexpr int kMaterialLength = 156;
inline constexpr int kMaterialDiameter = 157;
inline constexpr int kFirstStatus = 200;
inline constexpr int kLastStatus = 370;
inline constexpr int kWorkOffsets = 500;
inline constexpr int kHomePosition = 512;
inline constexpr int kReferencePoints = 514;
inline constexpr int kToolChangePoint = 522;
inline constexpr int kPositiveZone = 524;
inline constexpr int kNegativeZone = 526;
inline constexpr int kPositiveLimit = 528;
inline constexpr int kNegativeLimit = 530;
inline constexpr int kSingleOverrun = 532;
inline constexpr int kRapidOverrun = 534;
inline constexpr int kMaximumFeed = 536;
inline constexpr int kLastAxisParameter = 537;
inline constexpr int kToolOffsets = 600;
inline constexpr int kFieldsPerTool = 10;
inline constexpr int kSpindleRange = 50;  ///< PB50: 1 low, 2 medium, 3 high
inline constexpr int kSpecialFlags = 81;  ///< PB81: 2 Trig Help off, 4 compensation off

enum class ToolField : std::uint8_t { LengthZ, LengthX, Radius, Type, WearZ, WearX, WearRadius };

class Parameters {
 public:
  double operator[](int number) const { return value_[static_cast<std::size_t>(number)]; }
  double& operator[](int number) { return value_[static_cast<std::size_t>(number)]; }
  std::uint8_t byte(int number) const { return byte_[static_cast<std::size_t>(number)]; }
  std::uint8_t& byte(int number) { return byte_[static_cast<std::size_t>(number)]; }

  /// Z is in P`first`, X in the one after it.
  Point point(int first) const { return {(*this)[first + 1], (*this)[first]}; }
  Point work_offset(int system) const;
  /// 0 for offset 00. Lengths and radius include the wear.
  double tool(int offset, ToolField field) const;
  static int tool_parameter(int offset, ToolField field);
  /// G20/G21: lengths and feeds of the tables, of the cycles' data and of the transformations are
  /// converted, the program's own parameters are not.
  void convert_tables(double factor);

 private:
  std::array<double, kParameterCount> value_{};
  std::array<std::uint8_t, kByteCount> byte_{};
};

/// Whether P`number` from P100 to P199 (manual: CTRL parameters) is a length, or a length per
/// minute or per revolution.
bool is_length_parameter(int number);

/// Of the tool in force; none under G49.
Point tool_length(const ModalState& state, const Parameters& parameters);
/// Where the machine is, with the length that its last moves took in.
Point machine_position(const ModalState& state);

/// The value of status parameter `number` (200-370) as `state` implies it, or nullopt where nothing
/// does and the stored value applies.
std::optional<double> status_parameter(const ModalState& state, const Parameters& parameters,
                                       int number);

}  // namespace dripline::interpreter::centurion
