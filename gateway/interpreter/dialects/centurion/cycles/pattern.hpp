#pragma once

#include <cstdint>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/dialects/centurion/reading/text_cursor.hpp"

/// What the cycles that follow a pattern (G70-G73) keep from block to block. It is part of the
/// run's state, so a cycle resumes from any snapshot.

namespace dripline::interpreter::centurion {

/// X is a radius.
struct Point {
  double x = 0;
  double z = 0;
  friend bool operator==(const Point&, const Point&) = default;
};

/// The moves of one pattern, so that no pass of a cycle makes more moves than a machine queues.
inline constexpr std::size_t kMaxPatternMoves = 500;

/// In millimeters.
using PlanePoint = Point;

/// One step of a pattern as its interpretation made it: compensated, not transformed.
struct PatternMove {
  enum class Kind : std::uint8_t { Rapid, Line, Arc, Spindle };
  Kind kind = Kind::Line;
  bool is_clockwise = false;
  bool is_feed_per_revolution = false;
  PlanePoint to;
  PlanePoint center;
  double sweep = 0;  ///< degrees
  double feed = 0;   ///< millimeters
  SpindleState spindle = SpindleState::Off;
  double revolutions = 0;
  double surface = -1;          ///< millimeters per minute; -1: `revolutions` applies
  double max_revolutions = -1;  ///< -1: no limit
  std::uint64_t line = 0;       ///< of its block
  std::int64_t sequence = Origin::kNone;
};

enum class PatternPhase : std::uint8_t {
  None,
  Searching,  ///< for the pattern's two labels
  Finishing,  ///< G70: its blocks are executed
  Reading,    ///< its blocks are interpreted into `moves`
  Levels,     ///< G71, G72: one cut a step
  Repeats,    ///< G73: one pass a step
};

/// Why a pattern cannot be read into moves.
enum class PatternFault : std::uint8_t { None, TooManyMoves, Thread, Probe };

struct PatternCycle {
  PatternPhase phase = PatternPhase::None;
  PatternFault fault = PatternFault::None;
  std::uint8_t code = 0;  ///< 70 to 73
  std::uint32_t last_label = 0;
  ProgramIndex program = kMainProgram;
  std::uint64_t end_offset = 0;  ///< of the last block of the pattern
  std::uint8_t calls = 0;        ///< level of the program the pattern is in
  TextPosition back;             ///< G70: where the program continues
  Origin origin;                 ///< of the cycle's block

  Point home;  ///< the start point in program units

  // Lengths in millimeters; those along X are radii.
  PlanePoint start;
  PlanePoint finish;  ///< stock that is left
  PlanePoint rough;   ///< stock that the contour pass takes
  double step = 0;
  double relief = 0;
  double first_level = 0;  ///< a machine position; with `has_first_level`
  bool has_first_level = false;
  bool relief_is_45 = false;
  std::uint32_t passes = 1;  ///< of G73
  Feed feed;                 ///< of the cuts

  PlanePoint tool;         ///< where the passes have moved it
  std::uint32_t done = 0;  ///< levels or passes
  std::vector<PatternMove> moves;
};

inline bool is_making_passes(const PatternCycle& cycle) {
  return cycle.phase >= PatternPhase::Levels;
}

}  // namespace dripline::interpreter::centurion
