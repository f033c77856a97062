#pragma once

#include <array>
#include <bitset>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "gateway/machine/motion_backend.hpp"

namespace dripline::machine::streamed {

inline constexpr std::size_t kMaxAxes = interpreter::kAxisCount;

/// A point of the device by axis number: millimeters or, for A, B and C, degrees.
using Coordinates = std::array<double, kMaxAxes>;

/// Why an event cannot become lines: an alarm in its place.
struct Refusal {
  std::string_view id;  ///< static storage
  std::string text;
};

/// What a device can do and how it reads motion, as far as its text depends on it. Value type.
struct TextRules {
  struct Range {
    double low = 0, high = 0;
  };
  struct AxisRules {
    double steps = 1'000;         ///< per mm or degree: less than one of them is no motion
    double max_rate = 10'000;     ///< per minute, for the time that a move takes
    double tolerance = 0.001;     ///< where an axis that was sent to a value may be found
    double travel_slack = 0.001;  ///< so far outside of `travel` the device still moves
    std::optional<Range> travel;  ///< in machine coordinates, where it is known
    /// Where travel and rate are set, for the operator: " ($20, $130)".
    std::string travel_setting = {}, rate_setting = {};
  };
  std::array<std::optional<AxisRules>, kMaxAxes> axes;  ///< absent: no such axis
  int decimals = 3;
  std::size_t line_limit = 250;  ///< characters without the line's end
  /// A feed is the speed of all axes together, degrees as millimeters; false: that of the linear
  /// axes where one moves.
  bool feeds_all_axes = false;
  /// Linear and rotary axes together move by their time (G93): what the device makes of a feed then
  /// depends on its version and settings.
  bool times_rotary_axes = false;
  double min_feed = 0;  ///< per minute; the device raises a lower one
  /// Larger arcs are written as chords: the device's numbers are too coarse for their center.
  double max_arc_radius = std::numeric_limits<double>::infinity();
  /// So are those that come as near (mm) to the end of the travel: the device would be beyond it.
  double arc_margin = 0;
  double max_dwell = 1e6;  ///< seconds of one line
  /// G61.1 and G61 before the move; false: a dwell of no time after it.
  bool has_stop_mode = false;
  /// A device that does what it has when its link is cut gets no more motion than this ahead of its
  /// axes, long moves in pieces; absent: a device that stops by itself.
  std::optional<double> seconds_ahead;
  std::optional<double> max_rpm, min_rpm;  ///< of a spindle that is on, where they are known
  bool has_mist = true;
  bool has_reverse = true;  ///< the spindle has both directions
  bool homes = true;        ///< the axes are homed before every program
  std::optional<ProgramReader> reader = {};
  std::string max_rpm_setting = {}, min_rpm_setting = {}, homing_setting = {};

  bool has(std::size_t axis) const { return axis < kMaxAxes && axes[axis].has_value(); }
};

/// "X", "A"
inline char letter_of(std::size_t axis) {
  return interpreter::letter(static_cast<interpreter::Axis>(axis));
}
/// Marks the axes that the device has.
interpreter::Position position_of(const Coordinates& point, const TextRules& rules);
Coordinates coordinates_of(const interpreter::Position& position);
/// Of all axes, degrees as millimeters.
double distance(const Coordinates& from, const Coordinates& to);

}  // namespace dripline::machine::streamed
