#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "gateway/interpreter/core/block_interpreter.hpp"
#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/dialects/fanuc/codes.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/rotary_path.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/text_cursor.hpp"
#include "gateway/interpreter/dialects/fanuc/turning/contour.hpp"

/// Everything that stays from one block to the next. Lengths are millimeters, angles degrees;
/// positions are machine coordinates of the programmed point, the tool's length left out, unless
/// said otherwise. `visit` (snapshot.cpp) lists the members of ModalState: add new ones there.

namespace dripline::interpreter::fanuc {

/// One value for each axis of event.hpp, in its order.
using AxisValues = std::array<double, kAxisCount>;

inline constexpr int kLocalCount = 33;
inline constexpr int kFirstExtra = 98'000;  ///< common variables beyond #999
inline constexpr int kExtraCount = 500;
inline constexpr std::size_t kMaxMacroLevels = 5;  ///< 0 is the main program's
inline constexpr std::size_t kMaxFrames = 32;      ///< calls, whatever the options say
inline constexpr std::size_t kMaxLoops = 3 * (kMaxFrames + 1);
inline constexpr std::size_t kMaxModalCalls = 4;
inline constexpr int kMaxOffsets = 400;
inline constexpr int kMoreWorkCount = 48;  ///< G54.1 P1 to P48
/// 0 external, 1 to 6 G54 to G59, then those of G54.1.
inline constexpr std::size_t kWorkCount = 7 + kMoreWorkCount;

/// A macro variable that holds nothing.
inline constexpr double kNull = std::numeric_limits<double>::quiet_NaN();

/// See memory/length_in_axes.hpp; of X, Y and Z, bit 0 = X.
struct LengthInAxes {
  using Lengths = std::array<double, 3>;
  Lengths taken{};            ///< in force when the program has moved the axis last
  std::uint8_t bare = 0;      ///< placed by machine coordinates since
  std::uint8_t doubtful = 0;  ///< what its coordinates mean
  bool is_even = false;       ///< no axis is bare, and all have taken what is in force
};

struct SpindleModes {
  SpindleState state = SpindleState::Off;
  double revolutions = 0;   ///< last S under G97
  double surface = 0;       ///< last S under G96, millimeters a minute
  double limit = 0;         ///< G92 S; 0 = none
  bool is_surface = false;  ///< which of both was in force last
};

struct ToolModes {
  int pending = 0;
  bool is_pending = false;
  int active = 0;
};

/// What G10 L50 can change of the setup's options.
struct Parameters {
  double arc_error = 0;
  double peck_return = 0;
  double peck_clearance = 0;
  double rotate_default = 0;
  double scale_default = 1;
};

/// G50, G51: point = center + factor * (point - center), in program coordinates.
struct Scaling {
  std::array<double, 3> center{};
  std::array<double, 3> factor{1, 1, 1};
};
/// G50.1, G51.1: at - (point - at), in program coordinates, before scaling.
struct Mirror {
  std::array<bool, 3> is_on{};
  std::array<double, 3> at{};

  bool any() const { return is_on[0] || is_on[1] || is_on[2]; }
};
/// G68, G69: about the center, in the plane in force at G68.
struct Rotation {
  Plane plane = Plane::XY;
  double first = 0;
  double second = 0;
  double degrees = 0;
  double sine = 0;
  double cosine = 1;
};

/// What has given an axis another coordinate; see check_open_axes.
enum class FrameCode : std::uint8_t {
  Rotation,
  RotationEnd,
  Scaling,
  ScalingEnd,
  Mirror,
  MirrorEnd
};
constexpr bool ends_frame(FrameCode code) {
  return code == FrameCode::RotationEnd || code == FrameCode::ScalingEnd ||
         code == FrameCode::MirrorEnd;
}

/// What a hole cycle keeps from block to block: levels in program coordinates of the hole's axis.
struct CycleData {
  double initial = 0;
  double initial_raw = 0;  ///< the same in machine coordinates
  double retract = 0;      ///< R
  double bottom = 0;       ///< Z
  double depth = 0;        ///< Q, a length above 0
  double dwell = 0;        ///< P, seconds
  bool has_retract = false;
  bool has_bottom = false;
  bool has_depth = false;
};

/// Registers of tool offsets, index 1 to 400.
struct ToolOffsets {
  std::array<double, kMaxOffsets + 1> length_geometry{};
  std::array<double, kMaxOffsets + 1> length_wear{};
  std::array<double, kMaxOffsets + 1> radius_geometry{};
  std::array<double, kMaxOffsets + 1> radius_wear{};
  // of a lathe, whose lengths are those along Z
  std::array<double, kMaxOffsets + 1> x_geometry{};
  std::array<double, kMaxOffsets + 1> x_wear{};
  std::array<double, kMaxOffsets + 1> tip{};  ///< 0 to 9
};

/// The modes that a contour of G71 to G73 leaves as they were.
struct ModesBefore {
  std::array<std::uint8_t, kGroupCount> g{};
  std::array<double, 2> feed{};
  Position position;
  SpindleModes spindle;
  Coolant coolant;
  ToolModes tool;
  int h_number = 0;
  int d_number = 0;
};

/// The modal cycles of one cut on a lathe: X and Z of the work system, X a radius.
struct BoxCycle {
  std::uint8_t code = 0;
  bool has_x = false;
  bool has_z = false;
  double x = 0;
  double z = 0;
  double taper = 0;  ///< R, a radius
};

struct Coordinates {
  std::array<AxisValues, kWorkCount> work{};
  AxisValues shift{};  ///< G92
  AxisValues local{};  ///< G52
  int more_work = 1;   ///< P of G54.1
};

struct StrokeZone {
  bool is_on = false;  ///< G22 is in force, and there is something to keep out of
  std::array<double, 3> low{};
  std::array<double, 3> high{};

  bool has_volume() const { return low[0] < high[0] && low[1] < high[1] && low[2] < high[2]; }
};

using Locals = std::array<double, kLocalCount>;

enum class CallKind : std::uint8_t { Subprogram, Macro, Modal, Code };

/// M98, G65, a call by G66.
struct CallFrame {
  CallKind kind = CallKind::Subprogram;
  TextPosition back;
  TextPosition entry;
  Locals arguments{};  ///< the locals of each pass
  std::uint32_t passes_left = 0;
  std::uint8_t loop_base = 0;     ///< loops of the caller are out of reach
  std::int8_t modal_active = -1;  ///< of the caller
  std::uint8_t modal_count = 0;
};
/// DO m ... END m
struct LoopFrame {
  TextPosition head;             ///< before the DO block
  TextPosition next;             ///< after the END block
  std::uint64_t end_offset = 0;  ///< of the END block
  std::uint8_t number = 1;
};
/// G66
struct ModalCall {
  std::uint32_t program = 0;
  std::string name;  ///< of a program that has one instead of a number
  std::uint32_t passes = 1;
  std::int8_t outer = -1;  ///< what calls while this one's macro runs
  Locals arguments{};
};

/// A jump that a block asked for and that needs text of another place; taken before the next block.
enum class JumpKind : std::uint8_t { None, Goto, Loop, Call };
struct Jump {
  JumpKind kind = JumpKind::None;
  CallKind call = CallKind::Subprogram;
  bool condition = false;  ///< of a loop
  bool is_return = false;  ///< M99 P: its own alarm number
  std::uint8_t loop_number = 1;
  std::int8_t modal = -1;    ///< which modal call, of CallKind::Modal
  std::uint32_t number = 0;  ///< sequence or program number
  std::string name;          ///< of a program that has one instead of a number
  std::uint32_t passes = 1;
  TextPosition from;  ///< the block that jumps
  Locals arguments{};
};

/// Since the machine last moved, dwelt or waited for the operator.
struct Counters {
  std::uint64_t jumps_back = 0;
  std::uint64_t blocks_after_jumps = 0;
};

/// Last commanded values that #4100 and up show.
struct LastWords {
  int b = 0, d = 0, h = 0, m = 0, n = 0, o = 0, s = 0, t = 0;
  double f = 0;
};

/// Places in ModalState::counters.
enum Counter : std::size_t { kClockBase, kHours, kSingle, kHold, kSettings, kMade, kRequired };

struct ModalState {
  RunPhase phase = RunPhase::Running;
  bool has_header = false;
  bool is_port_open = false;
  bool told_lower_case = false;
  bool speed_changed = false;  ///< within a block: S differs from the speed of the spindle
  std::uint64_t blocks = 0;
  TextPosition at;

  Position position;    ///< marked are the axes that have moved
  AxisValues origin{};  ///< of the active coordinates: work + external + local + G92 shift
  std::array<std::uint8_t, kGroupCount> g{};
  bool is_transformed = false;    ///< mirror image, scaling or rotation
  bool uses_compensator = false;  ///< from the first G41, G42 or corner word on
  bool uses_blender = false;      ///< from the first corner word on
  bool is_special = false;        ///< a block of axis words is more than a straight move or an arc
  Units units = Units::Millimeter;
  std::array<double, 2> feed{};  ///< per minute, per revolution
  double inverse_feed = 0;       ///< G93: moves per minute, of the block in hand

  SpindleModes spindle;
  Coolant coolant;
  ToolModes tool;
  int h_number = 0;
  int d_number = 0;
  Axis length_axis = Axis::Z;
  double length_offset = 0;  ///< in force, signed
  Position placed;           ///< where machine coordinates (G28, G30, G53) have brought an axis
  LengthInAxes length_in_axes;
  Parameters parameters;
  bool enters_parameters = false;  ///< G10 L50 to G11
  TurningData turning;
  BoxCycle box;
  ContourCycle contour;
  ModesBefore modes_before;  ///< of `contour`
  RotaryPlane rotary;
  Mirror mirror;
  Scaling scaling;
  Rotation rotation;
  std::uint8_t open_axes = 0;  ///< of X, Y, Z, bit 0 = X; see check_open_axes
  FrameCode opened_by = FrameCode::Rotation;
  CycleData cycle;
  StrokeZone zone;  ///< G22
  AxisValues intermediate{};
  std::uint16_t has_intermediate = 0;  ///< bit per axis
  std::uint16_t imaginary = 0;         ///< G07, bit per axis
  AxisValues held{};                   ///< where the imaginary axes really stand
  AxisValues skip{};                   ///< work coordinates
  LastWords last;
  double polar_angle = 0;              ///< degrees; where an angle of G16 in G91 counts from
  std::optional<double> polar_radius;  ///< of G16, about the program's zero; none: not written yet
  int offset_list = 0;  ///< of G10 in offset memory A: 10 or 11, whichever came first; 0: none
  bool is_rigid_tapping = false;  ///< M29, until the mode of hole cycles ends

  std::vector<Locals> locals{Locals{}};
  std::array<double, 100> commons{};        ///< #100
  std::array<double, 500> kept{};           ///< #500
  std::vector<double> extra;                ///< #98000 to #98499; empty: all null
  std::vector<std::string> variable_names;  ///< of #500 to #549; empty: none has one
  /// When #3001 was 0 (milliseconds since 1970, null: not begun), #3002, #3003, #3004, #3005,
  /// #3901, #3902.
  std::array<double, 7> counters{kNull};
  std::vector<CallFrame> calls;
  std::vector<LoopFrame> loops;
  std::vector<ModalCall> modals;
  std::int8_t modal_active = -1;
  Jump jump;
  Counters limits;

  double mm_per_unit() const { return interpreter::mm_per_unit(units); }
  bool is_polar() const { return g[kPolarGroup] == 16; }
  bool is_incremental() const { return g[kDistanceGroup] == 91; }
  bool is_inverse_time() const { return g[kFeedGroup] == 93; }
  bool is_per_revolution() const { return g[kFeedGroup] == 95; }
  bool is_cycle() const { return g[kCycleGroup] != 80; }
  /// After M29, and with codes of their own.
  bool taps_rigidly() const { return is_rigid_tapping || is_rigid_tap(g[kCycleGroup]); }
  bool is_compensating() const { return g[kCompensationGroup] != 40; }
  Plane plane() const {
    return g[kPlaneGroup] == 18 ? Plane::ZX : g[kPlaneGroup] == 19 ? Plane::YZ : Plane::XY;
  }
};

/// The control's memory that a program can change and that ordinary motion does not read.
struct Memory {
  ToolOffsets tools;
  Coordinates coordinates;
};

}  // namespace dripline::interpreter::fanuc
