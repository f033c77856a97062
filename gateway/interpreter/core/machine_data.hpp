#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/interpreter.hpp"
#include "protocol/base/result.hpp"

namespace dripline::interpreter {

/// What the machine is, as far as the setup states it. A real machine that differs begins no
/// program; the simulated one takes it over. Linear axes in mm, rotary ones in degrees.
struct MachineData {
  /// Per second squared: no machine is as slow, and times with less mean nothing.
  static constexpr double kMinAcceleration = 0.1;

  struct AxisData {
    std::optional<double> min, max;  ///< travel, in machine coordinates: both or neither
    std::optional<double> max_rate;  ///< per minute
    /// Per second squared: for times and the simulated machine; a real one keeps its own.
    std::optional<double> acceleration = {};
  };
  std::array<std::optional<AxisData>, kAxisCount> axes;  ///< absent: not stated
  std::optional<double> max_rpm;
  std::optional<bool> homing;  ///< it has reference points, and is homed before programs
};

/// The table `machine` of a setup file, which parse_setup checks and no interpreter uses. Errors:
/// as parse_setup.
Result<MachineData> parse_machine_data(std::string_view toml, Units units = Units::Millimeter);

}  // namespace dripline::interpreter
