#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "gateway/interpreter/core/program_source.hpp"
#include "protocol/base/units.hpp"

/// The actions of a program, as plain structs, in execution order.
/// Lengths are machine lengths in millimeters (a lathe's X is the radius), whatever the program's
/// units; the writer of a trace converts back. string_views live until the sink's function returns.
/// No event of an ordinary motion block allocates.

namespace dripline::interpreter {

/// One fault of a program, with an id that never changes. Tests and callers compare ids, people
/// read texts. The id is a dialect prefix and a number (CEN0103): the control's own number where
/// its manual numbers its errors.
struct Diagnostic {
  std::string_view id;  ///< static storage
  /// The control's own wording where its manual has one, then the value and the limit.
  std::string text;
  std::uint64_t line = 0;    ///< 1-based
  std::uint32_t column = 0;  ///< 1-based byte within the line; 0 where it concerns the whole block
};

/// A row of a control's table of alarms and warnings: its id, and the control's wording.
struct DiagnosticRow {
  std::string_view id;    ///< static storage
  std::string_view text;  ///< static storage
  bool operator==(const DiagnosticRow&) const = default;
};

/// `detail` follows the text: which value, which limit.
Diagnostic diagnostic(const DiagnosticRow& row, std::string_view detail, std::uint64_t line,
                      std::uint32_t column = 0);

/// The place in the program that an event comes from.
struct Origin {
  /// Ordinal of the executed block, from 1; every pass of a loop has new ones.
  std::uint64_t block = 0;
  std::uint64_t offset = 0;       ///< of the block's first byte in its program
  std::uint64_t line = 0;         ///< 1-based line of the source text
  std::int64_t sequence = kNone;  ///< the N or block number last seen on this block, or kNone
  ProgramIndex program = kMainProgram;

  static constexpr std::int64_t kNone = -1;
  friend bool operator==(const Origin&, const Origin&) = default;
};

enum class Axis : std::uint8_t { X, Y, Z, A, B, C, U, V, W };
inline constexpr std::size_t kAxisCount = 9;
inline constexpr std::array<Axis, kAxisCount> kAllAxes{Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::B,
                                                       Axis::C, Axis::U, Axis::V, Axis::W};
char letter(Axis axis);
/// The axis of a capital letter, or nullopt.
std::optional<Axis> axis_of(char letter);
inline bool is_rotary(Axis axis) {
  return axis == Axis::A || axis == Axis::B || axis == Axis::C;
}

/// A point of the machine. Linear axes hold millimeters, rotary axes degrees; `linear` and `rotary`
/// state the unit. An axis is marked when it has moved since the start of the program or takes part
/// in this move.
class Position {
 public:
  Length linear(Axis axis) const { return Length::mm(value_[index(axis)]); }
  Angle rotary(Axis axis) const { return Angle::degrees(value_[index(axis)]); }
  void set(Axis axis, Length value) {
    value_[index(axis)] = value.mm();
    axes_.set(index(axis));
  }
  void set(Axis axis, Angle value) {
    value_[index(axis)] = value.degrees();
    axes_.set(index(axis));
  }
  bool has(Axis axis) const { return axes_.test(index(axis)); }
  /// Millimeters or degrees: for loops over all axes.
  double raw(Axis axis) const { return value_[index(axis)]; }
  void set_raw(Axis axis, double value) {
    value_[index(axis)] = value;
    axes_.set(index(axis));
  }
  /// Marks every axis that `other` has; values stay.
  void mark_all_of(const Position& other) { axes_ |= other.axes_; }
  void mark(Axis axis) { axes_.set(index(axis)); }
  /// No axis has moved any more; values stay.
  void unmark_all() { axes_.reset(); }
  /// Keeps the value, but the axis has not moved.
  void unmark(Axis axis) { axes_.reset(index(axis)); }
  bool same_point(const Position& other) const { return value_ == other.value_; }
  friend bool operator==(const Position&, const Position&) = default;

 private:
  static constexpr std::size_t index(Axis axis) { return static_cast<std::size_t>(axis); }
  std::array<double, kAxisCount> value_{};
  std::bitset<kAxisCount> axes_;
};

enum class Units : std::uint8_t { Inch, Millimeter };
enum class Plane : std::uint8_t { XY, ZX, YZ };
enum class Turn : std::uint8_t {
  Clockwise,
  Counterclockwise
};  ///< seen from the positive third axis
enum class SpindleState : std::uint8_t { Off, Clockwise, Counterclockwise, Oriented };
constexpr bool is_turning(SpindleState state) {
  return state == SpindleState::Clockwise || state == SpindleState::Counterclockwise;
}
/// Of one unit of a coordinate or a feed.
constexpr double mm_per_unit(Units units) {
  return units == Units::Inch ? Length::kMillimetersPerInch : 1;
}
/// Of one unit of a surface speed: a foot or a meter.
constexpr double mm_per_surface_unit(Units units) {
  return units == Units::Inch ? 12 * Length::kMillimetersPerInch : 1000;
}
enum class StopKind : std::uint8_t { Program, Optional, ToolChange, Operator };
enum class ProbeUntil : std::uint8_t { Contact, Release };
enum class OutputDevice : std::uint8_t { File, Port1, Port2, Screen, Printer };

struct ProgramHeader {
  std::string_view control;              ///< the dialect's name
  std::optional<std::string_view> name;  ///< as the program calls itself, e.g. O0100
  Units units = Units::Millimeter;
  bool x_is_diameter = false;
};

struct UnitsChange {
  Origin origin;
  Units units;
};
struct Rapid {
  Origin origin;
  Position to;
  bool rests = true;  ///< in position before the next move; false: the control blends it into it
};
struct Line {
  Origin origin;
  Position to;
  Feed feed;
  bool rests = false;  ///< the axes come to rest at its end (exact stop)
};

struct Arc {
  Origin origin;
  Position to;
  Length center_first;   ///< along the plane's first axis (XY: X, ZX: Z, YZ: Y)
  Length center_second;  ///< along its second axis (XY: Y, ZX: X, YZ: Z)
  Plane plane = Plane::XY;
  Turn turn = Turn::Clockwise;
  Angle sweep;  ///< > 0; > 360 for several revolutions
  Feed feed;
  bool rests = false;  ///< as for a line
};

/// The arc of a move that has another event than Arc; members as there.
struct PathArc {
  Length center_first;
  Length center_second;
  Plane plane = Plane::XY;
  Turn turn = Turn::Clockwise;
  Angle sweep;
};
/// Feed synchronized to the spindle: the path advances by the lead with each revolution.
struct Thread {
  Origin origin;
  Position to;
  Length lead;  ///< at the start of the move
  std::optional<Angle> start_angle;
  std::optional<PathArc> arc{};  ///< absent: a straight or tapered thread
  Length lead_change{};          ///< added to the lead with each revolution
};
/// The path of a circular thread, fed by its lead with each revolution; only with `arc`.
Arc arc_of(const Thread& thread);
/// The constant lead that takes as many revolutions over `path`.
Length mean_lead(const Thread& thread, Length path);

struct Dwell {
  Origin origin;
  double seconds = 0;
  std::optional<double> revolutions;  ///< when given, replaces the seconds
};

struct Spindle {
  Origin origin;
  SpindleState state = SpindleState::Off;
  double revolutions_per_minute = 0;      ///< when `surface_speed` is absent
  std::optional<Length> surface_speed;    ///< length per minute, constant surface speed
  std::optional<double> max_revolutions;  ///< per minute, when limited
};

struct Coolant {
  Origin origin;
  bool flood = false;
  bool mist = false;
};
/// The shape of a tool, where programs or the control's memory have it.
struct ToolShape {
  Length length;  ///< as the control compensates it
  Length radius;
  friend bool operator==(const ToolShape&, const ToolShape&) = default;
};
struct ToolChange {
  Origin origin;
  int number = 0;
  bool is_preselection = false;
  std::optional<int> offset;
  std::optional<ToolShape> shape = {};  ///< for graphics; not part of a trace
  bool is_in_spindle = false;           ///< it is there already: nothing is changed (M61)
};
/// The block of material that a program declares, its sides along the axes.
struct Blank {
  Origin origin;
  Axis spindle_axis = Axis::Z;
  Position min, max;  ///< X, Y and Z of two corners
};
/// Any other M function.
struct Miscellaneous {
  Origin origin;
  int code = 0;
  std::optional<double> e = {}, p = {}, q = {};  ///< its words, where the control hands them on
  bool is_done = false;  ///< other events do what it does: nothing is left to the machine
};
struct PinChange {
  Origin origin;
  Axis axis = Axis::X;
  int output = 0;
  bool state = false;
  std::optional<double> pulse_ms;
};

/// `result` is absent while the question is open and present in the event that follows the answer.
struct ProbeResult {
  bool tripped = false;
  Position at;
};
struct Probe {
  Origin origin;
  Position from;
  Position to;
  ProbeUntil until = ProbeUntil::Contact;
  Feed feed;  ///< none at rapid traverse
  std::optional<ProbeResult> result;
  std::optional<PathArc> arc{};  ///< from `from` to `to`; absent: a straight move
  bool is_rapid = false;
};
/// The arc that a probe move passes: to `to`, or as far as its result; only with `arc`.
Arc arc_of(const Probe& probe);

struct Output {
  Origin origin;
  OutputDevice device = OutputDevice::File;
  std::string_view text;
};
struct Open {
  Origin origin;
  OutputDevice device = OutputDevice::File;
  std::optional<std::string_view> name;
};
struct Close {
  Origin origin;
  OutputDevice device = OutputDevice::File;
};
struct Message {
  Origin origin;
  std::string_view text;
};
struct Prompt {
  Origin origin;
  std::string_view text;
  std::string_view variable;
  std::string_view answer;
};
struct Stop {
  Origin origin;
  StopKind kind = StopKind::Program;
};

/// When a feed hold acts.
enum class FeedHoldInhibit : std::uint8_t {
  AtOnce,
  Later,     ///< after the moves that it cannot stop
  LaterToo,  ///< an earlier hold still waits; one from here on acts at once
};
/// The controls of the operator's panel that have no effect from here on, until the next event of
/// this kind: while a thread is tapped, or where the program inhibits them. The feed of a thread
/// ignores feed override and feed hold without it. Not part of a trace.
struct OverrideInhibit {
  Origin origin;
  bool feed_override = false;  ///< as if at 100 %; the rapid override stays
  bool spindle_override = false;
  bool single_block = false;
  FeedHoldInhibit hold = FeedHoldInhibit::AtOnce;
  bool is_tapping = false;  ///< a tapping cycle that ends where it began
};
struct Warning {
  Origin origin;
  Diagnostic diagnostic;
};
struct Alarm {
  Origin origin;
  Diagnostic diagnostic;
};
struct End {
  Origin origin;
  std::uint64_t blocks = 0;
  bool rewind = false;
};

/// Receives the events of a program. Called from the thread that steps the interpreter; must not
/// call back into it.
class EventSink {
 public:
  virtual ~EventSink() = default;
  virtual void on_program(const ProgramHeader&) {}
  virtual void on_units(const UnitsChange&) {}
  virtual void on_rapid(const Rapid&) {}
  virtual void on_line(const Line&) {}
  virtual void on_arc(const Arc&) {}
  virtual void on_thread(const Thread&) {}
  virtual void on_dwell(const Dwell&) {}
  virtual void on_spindle(const Spindle&) {}
  virtual void on_coolant(const Coolant&) {}
  virtual void on_tool(const ToolChange&) {}
  virtual void on_blank(const Blank&) {}
  virtual void on_miscellaneous(const Miscellaneous&) {}
  virtual void on_pin(const PinChange&) {}
  virtual void on_probe(const Probe&) {}
  virtual void on_output(const Output&) {}
  virtual void on_open(const Open&) {}
  virtual void on_close(const Close&) {}
  virtual void on_message(const Message&) {}
  virtual void on_prompt(const Prompt&) {}
  virtual void on_stop(const Stop&) {}
  virtual void on_override_inhibit(const OverrideInhibit&) {}
  virtual void on_warning(const Warning&) {}
  virtual void on_alarm(const Alarm&) {}
  virtual void on_end(const End&) {}
  /// The block is finished: every event it caused has been delivered.
  virtual void on_block_end(const Origin&) {}
};

// The override inhibits of a tapping cycle, on every control that cuts the thread in step with the
// spindle. `usual` are those that the program has set itself, where the control has codes for it.

/// It is in force from the clearance plane to the bottom and back.
inline OverrideInhibit tapping_lock(const Origin& origin) {
  return {.origin = origin,
          .feed_override = true,
          .spindle_override = true,
          .single_block = true,
          .hold = FeedHoldInhibit::Later,
          .is_tapping = true};
}

/// It is in force for the rapid retraction: a hold that came in the hole waits for its end too.
inline OverrideInhibit lock_after_tap(OverrideInhibit usual) {
  if (usual.hold == FeedHoldInhibit::AtOnce) usual.hold = FeedHoldInhibit::LaterToo;
  return usual;
}

/// The words of traces and records for the enumerators of events. Outside tools read them: add, do
/// not rename.
std::string_view word_of(Units units);
std::string_view word_of(Turn turn);
std::string_view word_of(ProbeUntil until);
std::string_view word_of(SpindleState state);
std::string_view word_of(StopKind kind);
std::string_view word_of(OutputDevice device);
std::string_view word_of(Feed::Per per);
std::string_view word_of(Plane plane);

}  // namespace dripline::interpreter
