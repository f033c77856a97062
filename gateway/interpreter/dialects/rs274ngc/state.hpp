#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "gateway/interpreter/core/block_interpreter.hpp"
#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/language/line_reader.hpp"
#include "gateway/interpreter/dialects/rs274ngc/turning/contour.hpp"

/// Everything that stays from one line to the next. Coordinates are program coordinates in
/// millimeters and degrees whatever the units in force; bare numbers (feed, cycle words) stay as
/// they were written, as this control keeps them. `visit` (snapshot.cpp) lists the
/// members of State: add new ones there.
namespace dripline::interpreter::rs274ngc {

using Axes = std::array<double, kAxisCount>;
constexpr std::size_t index_of(Axis axis) {
  return static_cast<std::size_t>(axis);
}

inline Axes values_of(const Position& position) {
  Axes values{};
  for (const Axis axis : kAllAxes) values[index_of(axis)] = position.raw(axis);
  return values;
}

/// How the end of the program is marked (NIST 3.3).
enum class Demarcation : std::uint8_t { Unknown, Percent, None };
enum class FeedMode : std::uint8_t { PerMinute, InverseTime, PerRevolution };
enum class Side : std::uint8_t { Off, Left, Right };

inline constexpr std::size_t kMaxCalls = 10;
inline constexpr std::size_t kMaxBlocks = 100;  ///< loops and conditions within one another
inline constexpr std::size_t kMaxLabels = 1000;
inline constexpr std::size_t kArguments = 30;
inline constexpr int kSystems = 9;
inline constexpr std::array<std::string_view, kSystems> kWorkSystems{
    "G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3"};

struct Modes {
  std::int16_t motion = 800;
  Plane plane = Plane::XY;
  bool has_tilted_plane = false;  ///< G17.1 to G19.1: no arcs
  bool is_incremental = false;
  bool is_arc_absolute = false;
  bool retracts_to_start = false;  ///< G98
  bool is_diameter = false;        ///< G7
  FeedMode feed = FeedMode::PerMinute;
  std::int16_t path = 640;
  double path_tolerance = 0;
  double cam_tolerance = 0;
};

struct SpindleModes {
  SpindleState state = SpindleState::Off;
  double speed = 0;
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  bool is_surface = false;
  double most = kNoLimit;  ///< revolutions per minute under G96

  /// LinuxCNC's D0 takes S as revolutions per minute.
  bool turns_by_surface() const { return is_surface && most != 0; }
  bool is_turning() const { return interpreter::is_turning(state); }
};

struct ToolModes {
  int selected = 0;
  int loaded = 0;
};

struct Overrides {
  bool speed = true, feed = true, adaptive = false, hold = true;
  friend bool operator==(const Overrides&, const Overrides&) = default;
};

/// Words of the cycle that is in force; a line may leave them out. As written.
struct CycleWords {
  double r = 0, bottom = 0, p = 0, q = 0, i = 0, j = 0, k = 0, d = 0;
  bool is_series = false;  ///< since the last motion that was no cycle
  double initial = 0;      ///< mm: level at which the series began
};

struct Compensation {
  Side side = Side::Off;
  double radius = 0;             ///< mm, not negative
  bool is_first = false;         ///< no move since it was turned on
  bool was_on = false;           ///< turned off, and no move since
  double x = 0, y = 0;           ///< end of the last move as programmed, along the plane's axes
  std::array<double, 3> left{};  ///< with `was_on`: machine X Y Z of the tool
  std::uint8_t orientation = 0;  ///< of a lathe tool's tip, 1 to 8; its nose's center else
  double held_sweep = 0;         ///< degrees of the held arc as programmed, without full circles
};

inline constexpr int kLeastOrder = 3;
inline constexpr int kMaxOrder = 20;
inline constexpr std::size_t kMaxControlPoints = 1000;
struct ControlPoint {
  double x = 0, y = 0;  ///< mm
  double weight = 1;
};
/// From G5.2 to G5.3; without points, no curve is open.
struct Nurbs {
  int order = kLeastOrder;
  std::vector<ControlPoint> points;
};

/// An O word's label: a number, or a name by its place in `label_names`.
struct Label {
  std::int64_t value = -1;
  friend bool operator==(const Label&, const Label&) = default;
};

enum class BlockKind : std::uint8_t { If, While, Do, Repeat };
struct BlockFrame {
  BlockKind kind = BlockKind::If;
  Label label;
  TextPlace head;  ///< where another pass begins: the line itself, of a repeat the next
  std::uint64_t left =
      0;  ///< passes of a repeat after this one; of an if, 1 once a branch was taken
};

struct SavedModes {
  bool is_valid = false;
  bool restores_at_return = false;  ///< M73
  Modes modes;
  Units units = Units::Millimeter;
  std::uint8_t system = 1;
  double feed = 0;  ///< as shown
  SpindleModes spindle;
  bool flood = false, mist = false;
  Overrides overrides;
  Side side = Side::Off;
  bool has_length = false, has_g92 = false;
};

struct CallFrame {
  Label scope;  ///< of the labels inside
  TextPlace back;
  TextPlace entry;
  bool is_fanuc = false;  ///< M98: parameters are shared
  std::uint64_t passes_left = 0;
  std::uint32_t block_base = 0;
  std::array<double, kArguments> saved{};
  SavedModes modes;
};

/// Where a label was met first: each names one thing within its subprogram.
struct KnownLabel {
  Label scope;  ///< the subprogram, or none
  Label label;
  bool is_subprogram = false;
  TextPlace place;  ///< of its line
};

/// What lines are passed over for: everything until one of `wanted` with `label`.
enum class SkipFor : std::uint8_t {
  Nothing,
  EndOfSub,     ///< endsub; on after it
  Branch,       ///< elseif, else or endif; on with it
  EndOfIf,      ///< endif; on with it
  EndOfWhile,   ///< endwhile; on after it
  EndOfRepeat,  ///< endrepeat; on after it
  EndOfDo,      ///< the while of a do; on after it
  TestOfDo,     ///< the same; on with it
  FileSub,      ///< the sub of a called file; on after it
  LaterSub,     ///< the sub after its call; on after it
  FanucLabel,   ///< the label alone, for M98; on after it
  SubFile,      ///< the source's answer: a file with the sub
  FanucFile,    ///< the same, for M98
};
struct Skip {
  SkipFor until = SkipFor::Nothing;
  Label label;
  TextPlace from;  ///< line that asked
};

struct State {
  RunPhase phase = RunPhase::Running;
  bool has_header = false;
  Demarcation demarcation = Demarcation::Unknown;
  std::uint64_t blocks = 0;
  TextPlace at;
  std::int64_t sequence = Origin::kNone;

  Units units = Units::Millimeter;
  Axes position{};
  bool is_displaced = false;  ///< the tool may be elsewhere: the next move is one in any case
  Position machine;           ///< the same point in machine coordinates; the axes that have moved
  Axes system_offset{};
  Axes g92{};
  Axes tool_length{};
  double rotation = 0;  ///< degrees, of the active system
  std::uint8_t system = 1;

  double feed = 0;                       ///< F as written
  Units feed_units = Units::Millimeter;  ///< that it counts in, along linear axes
  bool has_lost_lead = false;  ///< LinuxCNC in G95, from a synchronized move to a rapid or F
  Modes modes;
  SpindleModes spindle;
  ToolModes tool;
  Overrides overrides;
  bool flood = false, mist = false;
  CycleWords cycle;
  Compensation compensation;
  double spline_i = 0, spline_j = 0;  ///< mm: end direction of the last G5
  bool follows_spline = false;
  Nurbs nurbs;
  TurningCycle turning;  ///< the lathe cycle whose contour is being recorded

  std::vector<BlockFrame> frames;
  std::vector<CallFrame> calls;
  std::vector<KnownLabel> labels;
  std::vector<std::string> label_names;
  Skip skip;
  std::uint64_t passes = 0;  ///< of loops and calls since the machine last moved or waited
  SavedModes saved;

  double mm_per_unit() const { return interpreter::mm_per_unit(units); }
  /// F in the units in force; per revolution it stays as written.
  double shown_feed() const {
    const bool is_as_written = feed_units == units || modes.feed == FeedMode::PerRevolution;
    return is_as_written ? feed : feed * interpreter::mm_per_unit(feed_units) / mm_per_unit();
  }
  double& operator[](Axis axis) { return position[index_of(axis)]; }
  double operator[](Axis axis) const { return position[index_of(axis)]; }
};

}  // namespace dripline::interpreter::rs274ngc
