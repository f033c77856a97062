#pragma once

namespace dripline::machine {

/// The switches and knobs of the operator, as plain state; the application maps commands to it. The
/// interpreter obeys block skip, it is kept here with the others.
struct OperatorPanel {
  bool single_block = false;   ///< stop after every block
  bool optional_stop = false;  ///< an optional stop (M1) stops
  bool block_skip = false;
  double feed_override = 1;     ///< 0 .. 2; threads ignore it
  double rapid_override = 1;    ///< 0 .. 1
  double spindle_override = 1;  ///< 0 .. 2.55
  bool handwheel = false;       ///< the program advances only as the handwheel is turned
  bool emergency_stop = false;  ///< pressed in: see MotionBackend::set_panel

  static constexpr double kMaxFeedOverride = 2, kMaxRapidOverride = 1, kMaxSpindleOverride = 2.55;

  /// The nearest panel within the limits; a NaN becomes 1.
  OperatorPanel clamped() const;
  friend bool operator==(const OperatorPanel&, const OperatorPanel&) = default;
};

}  // namespace dripline::machine
