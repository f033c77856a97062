#pragma once

#include <optional>

#include "gateway/interpreter/dialects/tektronix1704/run.hpp"

/// Moves in program counts; false: alarm.
namespace dripline::interpreter::tektronix1704 {

inline constexpr std::size_t kZ = 2;  ///< the quill among the axes

/// The rate in force, in mm per minute; nullopt after the alarm was made.
std::optional<double> feed_rate(Run& run);
/// Loads an F word. False: out of range, strict.
bool load_feed(Run& run, std::int32_t count);

enum class Pace : std::uint8_t { Rapid, Feed };
struct LineMove {
  Counts to;
  Pace pace = Pace::Feed;
  bool flows = false;
};
bool move_line(Run& run, const LineMove& move);
/// As a cycle does: one axis to a depth that need not be a whole count.
bool move_depth(Run& run, double to, Pace pace);

/// Option 1 counts in steps of two; a dimension between them is rounded toward zero.
void round_to_steps(Run& run);
/// The end point of a linear block: axes that are named go, the others stay.
Counts end_point(const Run& run);
/// Capacity (manual: numbers and units) and travel.
bool check_point(Run& run, const Counts& point);
/// The block's arc (arcs.cpp; manual: circular interpolation): within one quadrant, about the
/// stored center, to an end point whose missing coordinate is zero. Loads center words. False:
/// alarm.
bool move_arc(Run& run);
/// I, J and K alone fill their stores.
void load_center(Run& run);
/// R counts from where Z is when dimensions are incremental, and stays for the cycles that follow.
void load_clearance(Run& run);
/// The block in a fixed cycle (cycles.cpp; manual: G80 to G89): loads Z, positions, and works the
/// hole as the cycle table says.
bool run_cycle(Run& run);
/// The block's motion in the active mode; true without doing anything when it has none.
bool move_block(Run& run);

}  // namespace dripline::interpreter::tektronix1704
