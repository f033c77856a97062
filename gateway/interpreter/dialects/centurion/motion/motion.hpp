#pragma once

#include "gateway/interpreter/dialects/centurion/run.hpp"

/// Moves (manual: G0 to G3): where a block's words lead, and the events.
namespace dripline::interpreter::centurion {

/// Which axes a move names, whether they change or not.
struct AxesNamed {
  bool x = false;
  bool z = false;
};

/// Moves in the active motion mode, if the block names an end point. A probe move asks.
bool move(Run& run);

/// Where the words lead, from the position and the active zero (or the machine's).
struct Target {
  Point to;
  AxesNamed named;
};
bool read_target(Run& run, Target& target);
/// What X, Z, U and W are measured from.
struct EndFrame {
  Point from;
  Point zero;
  bool is_incremental = false;
};
bool read_end_words(Run& run, const EndFrame& frame, Target& target);

/// G0 to `to`; nothing when already there.
void rapid_to(Run& run, const Point& to, AxesNamed named);
/// A straight feed to `to`; nothing when already there.
void feed_to(Run& run, const Point& to, AxesNamed named, Feed feed);
/// To a place of the program that is transformed already, or never is.
void rapid_untransformed(Run& run, const Point& machine, AxesNamed named);
/// To a place in machine coordinates: nothing is transformed, and no tool has a length.
void machine_rapid_to(Run& run, const Point& machine, AxesNamed named);
void machine_feed_to(Run& run, const Point& machine, AxesNamed named);

/// G2, G3; in arcs.cpp.
bool move_on_arc(Run& run);

// Shared by motion.cpp, arcs.cpp and the cycles.
inline constexpr AxesNamed kBothAxes{true, true};
bool check_target(Run& run, const Point& to);
bool check_feed(Run& run);
/// `point` as an event shows it; marks the axes that have moved.
Position event_position(Run& run, const Point& point, AxesNamed named);
/// The same, with another start point.
Position marked_position(Run& run, const Point& from, const Point& point, AxesNamed named);
/// The machine has moved to `at`, in the axes named or changed with the length of the tool.
void arrive(Run& run, const Point& at, AxesNamed named);
/// The axes are where the program's coordinates and the length of the tool place them.
void take_length(Run& run, AxesNamed named);
std::uint32_t motion_column(const Run& run);

}  // namespace dripline::interpreter::centurion
