#pragma once

#include <cstdint>
#include <optional>

namespace dripline::machine {

/// The switches and knobs of the operator, as plain state; the application maps commands to it. The
/// interpreter obeys block skip, it is kept here with the others.
struct OperatorPanel {
  bool single_block = false;   ///< stop after every block
  bool optional_stop = false;  ///< an optional stop (M1) stops
  bool block_skip = false;
  /// Bit n: blocks with /n are skipped; as the operator has set them. Nothing: as the setup has
  /// them.
  std::optional<std::uint16_t> skip_levels = {};
  double feed_override = 1;     ///< 0 .. 2; threads ignore it
  double rapid_override = 1;    ///< 0 .. 1
  double spindle_override = 1;  ///< 0 .. 2.55
  bool handwheel = false;       ///< the program advances only as the handwheel is turned
  bool emergency_stop = false;  ///< pressed in: see MotionBackend::set_panel
  /// Moves at feed, threads included, run at `dry_run_speed` (mm per second at 100 %) instead,
  /// which is that of all axes together, degrees as millimeters.
  bool dry_run = false;
  double dry_run_speed = 0;
  bool dry_run_spindle = true;  ///< the spindle runs in a dry run
  bool machine_lock = false;    ///< programs run, and the axes end where they were; kept here only
  bool test_run = false;        ///< a start tests the program and moves nothing; kept here only

  static constexpr double kMaxFeedOverride = 2, kMaxRapidOverride = 1, kMaxSpindleOverride = 2.55;

  /// The nearest panel within the limits; a NaN becomes 1.
  OperatorPanel clamped() const;
  friend bool operator==(const OperatorPanel&, const OperatorPanel&) = default;
};

}  // namespace dripline::machine
