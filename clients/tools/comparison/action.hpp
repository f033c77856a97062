#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "gateway/interpreter/core/event.hpp"

namespace dripline::comparison {

/// Where an action comes from.
struct Place {
  std::uint64_t line = 0;    ///< 1-based, of the text of `program`
  std::uint64_t offset = 0;  ///< of the block's first byte there
  interpreter::ProgramIndex program = interpreter::kMainProgram;
};

enum class ActionKind : std::uint8_t {
  Rapid,
  Line,
  Arc,
  Thread,
  Probe,
  Dwell,
  Spindle,
  Coolant,
  Tool,
  Function,
  Pin,
  Inhibit,
  Output,
  Message,
  Stop,
  Alarm,
  End,
};
inline bool is_move(ActionKind kind) {
  return kind <= ActionKind::Probe;
}

/// One thing that a program does, with all that decides whether another program does the same.
/// Lengths are those of the machine, in millimeters.
struct Action {
  ActionKind kind = ActionKind::End;
  bool rests = false;    ///< moves: the axes come to rest at the end
  bool has_arc = false;  ///< arcs, and threads on an arc
  interpreter::Plane plane = interpreter::Plane::XY;
  interpreter::Turn turn = interpreter::Turn::Clockwise;
  Place place;
  interpreter::Position from, to;   ///< moves
  std::array<double, 3> lengths{};  ///< moves: of the tool in force, which both leave out; X Y Z
  std::array<double, 2> center{};   ///< along the plane's axes
  double sweep = 0;                 ///< radians
  Feed feed;                        ///< lines, arcs, probes
  std::int64_t code = 0;            ///< a state, a tool's number, an M function ...
  std::optional<int> offset;        ///< tool changes: the offset's number
  std::array<double, 3> numbers{};  ///< what else has a number; kNoNumber: absent
  /// Moves whose feed and speed make a thread: threads, feeds without override, as a tap's, and a
  /// feed out after the spindle was reversed.
  bool is_in_step = false;
  double speed = 0;  ///< of the spindle in force; moves in step with it
  std::string text;  ///< outputs, messages, alarms

  static constexpr double kNoNumber = -1e300;
};

/// What differs between two actions, or between two programs.
enum class Difference : std::uint8_t {
  Path,
  Pitch,     ///< feed or speed of a move in step with the spindle
  Feed,      ///< its amount
  FeedMode,  ///< per minute or revolution; or from or to none
  Speed,     ///< its amount
  Spindle,   ///< on, off, its sense, constant surface speed, its limit; or from or to none
  Tool,
  Offset,
  Dwell,
  Coolant,
  Function,
  ExactStop,
  Stop,
  Output,
  Order,
  Alarm,
};
inline constexpr std::size_t kDifferenceCount = 16;
std::string_view word_of(Difference difference);

/// A set of differences.
class Differences {
 public:
  constexpr Differences() = default;
  // Implicit, because one difference is a set of them.
  constexpr Differences(Difference one) : bits_(bit(one)) {}
  constexpr bool has(Difference one) const { return (bits_ & bit(one)) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr Differences& operator|=(Differences other) { return bits_ |= other.bits_, *this; }
  /// Nothing but what `other` has.
  constexpr bool is_within(Differences other) const { return (bits_ & ~other.bits_) == 0; }
  friend constexpr Differences operator|(Differences a, Differences b) { return a |= b; }
  friend constexpr bool operator==(Differences, Differences) = default;

 private:
  static constexpr std::uint32_t bit(Difference one) {
    return std::uint32_t{1} << static_cast<unsigned>(one);
  }
  std::uint32_t bits_ = 0;
};

/// How exactly two actions must agree.
struct Agreement {
  double tolerance = 0.001;  ///< mm between two paths; degrees of a rotary axis
  /// The programs are of two controls: what belongs to a control and not to the program is not
  /// compared (README.md, "Across controls").
  bool across_controls = false;
};

/// The largest distance of two moves of one kind, each point of one to the point at the same
/// fraction of the other: 0 for the same move. Infinity: an arc and a straight thread, two planes,
/// two senses, or revolutions that differ by more than a quarter.
double path_distance(const Action& a, const Action& b);

/// The same action but for its feed, a move's tool length and whether the axes rest: what aligns
/// two programs.
bool is_alike(const Action& a, const Action& b, const Agreement& agreement);

/// What differs between two actions of one kind; empty: nothing.
Differences differences(const Action& a, const Action& b, const Agreement& agreement);

/// What an action changes that the other program has not at all.
Difference difference_of(ActionKind kind);

/// In the words of the list of places: "line to X10 Y3, F100 mm/min".
std::string describe(const Action& action);

}  // namespace dripline::comparison
