#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/base/result.hpp"

/// The events of conversational programming, one record a screen. Lengths are in the program's
/// units; X positions are diameters unless a member says radius. What each field means, its limits
/// and its default are in `fields.hpp`.

namespace dripline::conversational {

// Conversational programming of the Centurion: events, the fields of their screens, and the
// program text the control posts for them.

/// The number in a field of an event's screen; nothing is a field left blank, which posts nothing.
using Entry = std::optional<double>;

/// A number as it was typed.
struct TypedNumber {
  double value = 0;
  bool is_fraction = false;  ///< such as 5/16: rounded to what the field shows
};

/// "1.25", "-.5" or "5/16" (up to 9 digits on each side of the stroke, no exponent). Errors:
/// Syntax.
Result<TypedNumber> parse_entry(std::string_view typed);

/// As the control writes numbers into a program: up to six decimals, no zero before the point,
/// none at the end (".5", "-2", "0").
std::string number_text(double value);

enum class Dimensions { Absolute, Incremental };
enum class UnitSystem { English, Metric };

struct ProgramSetup {
  std::optional<int> program;  ///< the O number
  std::string name;
  Dimensions dimensions = Dimensions::Absolute;
  UnitSystem units = UnitSystem::English;
  Entry material_length, material_diameter;  ///< for the control's graphics
};

/// Blank: the feed in force.
struct Feedrate {
  bool is_rapid = false;
  Entry value;
};

enum class Coordinates { Cartesian, Polar };
enum class Pole { Current, Absolute };
struct Target {
  Coordinates coordinates = Coordinates::Cartesian;
  Entry x, z;
  Pole pole = Pole::Current;
  Entry xc, zc, length, angle;
};

struct Position {
  Feedrate feed{true, {}};
  Target target;
};

enum class CornerKind { None, Round, Chamfer };
/// The corner between an element and the next one.
struct Corner {
  CornerKind kind = CornerKind::None;
  Entry radius, length;
};

enum class Extension { Off, Short, Long };
/// A line known by its end and its angle, extended back to the element before it.
struct ExtendBack {
  Extension extension = Extension::Off;
  Entry angle;
};

struct Line {
  Feedrate feed;
  Target target;
  Corner corner;
  ExtendBack back;
};

enum class ArcDirection { Clockwise, Counterclockwise };
enum class ArcCenter { Incremental, Absolute, Polar, RadiusOnly };
enum class ArcLength { Short, Long };
enum class ArcEnd { Absolute, Incremental, Polar };
struct Arc {
  Feedrate feed;
  ArcDirection direction = ArcDirection::Clockwise;
  ArcCenter center = ArcCenter::Incremental;
  Entry i, k, xc, zc, aa, radius;  ///< i: radius
  ArcLength length = ArcLength::Short;
  ArcEnd end = ArcEnd::Absolute;
  Entry x, z, u, w, ab;
  Corner corner;
};

enum class Side { Left, Right };
enum class Connection { Line, Arc };
/// Two circles connected by a tangent line or arc. Posts the first arc and the connection; the
/// second arc is the next event's.
struct Tangents {
  ArcDirection direction = ArcDirection::Clockwise;  ///< of the first arc
  Entry r1, xc1, zc1, r2, xc2, zc2;
  Side exit = Side::Left, enter = Side::Left;
  Connection connection = Connection::Line;
  Side arc_center = Side::Left;
  Entry arc_radius;
  ArcDirection arc_direction = ArcDirection::Clockwise;
};

/// An arc through three points; it begins where the tool is.
struct ThreePointArc {
  Entry x1, z1, x2, z2, x3, z3;
  bool ends_at_third = true;
  Entry ab;  ///< else
};

struct ThreadLine {
  Entry x, z, lead, threads_per_unit, start_angle;
  ExtendBack back;
};

enum class Work { Turning, Facing };
enum class Relief { Pattern, Degrees45 };
enum class Compensation { Off, Left, Right };
struct RoughCycle {
  Work work = Work::Turning;
  Entry x_finish_stock, z_finish_stock, x_rough_stock, z_rough_stock;  ///< rough X: radius
  Entry first_depth, cut_increment;
  Relief relief = Relief::Pattern;
  Entry clearance;
  Compensation compensation = Compensation::Off;
  Entry start_x, start_z;
  std::optional<int> pattern;
};

struct PatternRepeat {
  Work work = Work::Turning;
  Entry x_finish_stock, z_finish_stock, x_rough_stock, z_rough_stock;
  std::optional<int> passes;
  Compensation compensation = Compensation::Off;
  Entry start_x, start_z;
  std::optional<int> pattern;
};

struct EndCycle {};

struct FinishCycle {
  Work work = Work::Turning;
  std::optional<int> pattern;
  Entry feed, speed, start_x, start_z;
};

/// Cycle A (turning) and cycle B (facing): one cut.
struct SingleCut {
  Work work = Work::Turning;
  Compensation compensation = Compensation::Off;
  Dimensions dimensions = Dimensions::Absolute;
  bool is_tapered = false;
  Entry feed, speed, start_x, start_z, x, u, z, w, taper;
};

/// Cycle 1: one threading cut.
struct SingleThread {
  Dimensions dimensions = Dimensions::Absolute;
  bool is_tapered = false;
  Entry start_x, start_z, x, u, z, w, taper, lead, start_angle, chamfer_length, chamfer_angle;
};

enum class ThreadEntry { RootAndHeight, Crest };
struct MultipleThread {
  ThreadEntry entry = ThreadEntry::RootAndHeight;
  bool is_tapered = false;
  Entry start_x, start_z, crest_x, root_x, height, z, taper, lead, start_angle;
  Entry chamfer_length, chamfer_angle, first_cut, nose_angle, minimum_cut;
  std::optional<int> finish_passes, method;
};

enum class ReturnPoint { Clearance, Initial };
enum class Drilling { Drill, DrillDwell, DrillPeck, Bore, BoreDwell };
struct DrillCycle {
  Drilling kind = Drilling::Drill;
  Entry feed;
  ReturnPoint return_point = ReturnPoint::Clearance;
  Entry clearance, z, dwell, first_depth, increment, peck_clearance;
};

enum class Hand { Right, Left };
struct TapCycle {
  Hand hand = Hand::Right;
  Entry speed, threads_per_unit;
  ReturnPoint return_point = ReturnPoint::Clearance;
  Entry clearance, z;
};

/// Face grooving (pecks in Z, steps in X) and diameter grooving (pecks in X, steps in Z).
struct GrooveCycle {
  Work work = Work::Facing;
  Entry feed;
  ReturnPoint return_point = ReturnPoint::Clearance;
  Entry clearance, x, z, first_depth, increment, peck_clearance, peck_up;
  Entry x_finish_stock, z_finish_stock, step, relief;
};

enum class FeedMode { PerRevolution, PerMinute };
enum class SpindleMode { SurfaceSpeed, Rpm };
enum class Restart { None, Clockwise, Counterclockwise };
/// Tool change, and tool call: offsets and modes without a change.
struct ToolSelection {
  bool is_change = true;
  std::optional<int> tool;
  std::string description;
  FeedMode feed_mode = FeedMode::PerRevolution;
  Entry feed;
  SpindleMode spindle_mode = SpindleMode::SurfaceSpeed;
  Entry maximum_speed, speed;
  Restart restart = Restart::None;
  bool has_coolant = false;
};

/// Each choice is an index into its list in `posting.hpp`; 0 posts nothing.
struct Miscellaneous {
  std::size_t feed_mode = 0;
  Entry feed;
  std::size_t spindle_mode = 0;
  Entry maximum_speed, speed;
  std::size_t gear = 0, spindle = 0, coolant = 0, compensation = 0, stop = 0, retract = 0;
  std::size_t cutting_mode = 0, program_mode = 0, work_coordinate = 0, option = 0;
  std::string text;  ///< a block of its own, as typed
};

struct ProgramCall {
  std::optional<int> program, repeats;
};

struct Scaling {
  bool is_on = true;
  Entry center_x, center_z, x_factor, z_factor;
};
struct Rotation {
  bool is_on = true;
  Entry x, z, angle;
};
struct Mirror {
  bool is_on = true;
  Entry x, z;
};
struct FloatingZero {
  Entry x, z;
};

struct EndOfProgram {
  bool stops_spindle = true, stops_coolant = true;
  Entry x, z;  ///< from machine zero
};

using Event =
    std::variant<ProgramSetup, Position, Line, Arc, Tangents, ThreePointArc, ThreadLine, RoughCycle,
                 PatternRepeat, EndCycle, FinishCycle, SingleCut, SingleThread, MultipleThread,
                 DrillCycle, TapCycle, GrooveCycle, ToolSelection, Miscellaneous, ProgramCall,
                 Scaling, Rotation, Mirror, FloatingZero, EndOfProgram>;

/// Event 0 is the set-up, the last one ends the program.
using Events = std::vector<Event>;

}  // namespace dripline::conversational
