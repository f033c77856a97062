#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gateway/interpreter/core/block_interpreter.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/tnc155/cycles/cycle_state.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/transformation.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block_reader.hpp"

/// The state that is kept from one block to the next. Lengths are millimeters, angles degrees.
/// `visit` (snapshot.cpp) lists the members of State: add new ones there.
namespace dripline::interpreter::tnc155 {

using AxisValues = std::array<double, kAxisCount>;
inline AxisValues values_of(const Position& position) {
  AxisValues values{};
  for (const Axis axis : kAllAxes) values[static_cast<std::size_t>(axis)] = position.raw(axis);
  return values;
}

inline constexpr int kParameterCount = 100;  ///< Q0 to Q99
inline constexpr int kLastTool = 254;
inline constexpr int kLastLabel = 254;
inline constexpr int kLastItncTool = 32'767;

inline constexpr std::size_t kMaxLabelLevels = 8;  ///< subprograms and repeats together
inline constexpr std::size_t kMaxProgramLevels = 4;
/// That a run has met and not left: more than a program may number.
inline constexpr std::size_t kMaxLabels = 80'000;

struct ToolData {
  double length = 0;
  double radius = 0;
};
struct ToolDefinition {
  std::uint16_t number = 0;
  ToolData data;
};
/// Where a tool of the store is. Without a pocket: nowhere in the magazine, changed by hand.
struct ToolPocket {
  std::uint8_t tool = 0;
  bool is_special = false;
  std::optional<int> pocket;  ///< 0: the spindle
};
/// What the last TOOL CALL left. Number 0 is no tool.
struct ActiveTool {
  int number = 0;
  bool is_called = false;  ///< a TOOL CALL named a spindle axis
  Axis axis = Axis::Z;
  ToolData data;
};

struct SpindleModes {
  SpindleState state = SpindleState::Off;
  double speed = 0;
  bool has_speed = false;
};
struct CoolantModes {
  bool flood = false;
};

/// CALL LBL: where a subprogram goes back to, or what a repeat has left.
struct LabelFrame {
  bool is_repeat = false;
  std::uint32_t label = 0;
  std::uint32_t left = 0;  ///< of a repeat: passes still to come
  TextPlace call;          ///< the calling block
  TextPlace back;          ///< after it
  std::uint64_t from = 0;  ///< of a repeat: offset of its label
};
/// CALL PGM, cycle 12.
struct ProgramFrame {
  TextPlace back;
  ReadingState reading;  ///< of the caller
  std::uint8_t label_base = 0;
  bool resumes_modal_call = false;  ///< M89 rests while this program of a cycle runs
  std::vector<double> locals;       ///< QL parameters of the caller, of a later control
};
struct LabelPlace {
  ProgramIndex program = kMainProgram;
  std::uint32_t label = 0;
  TextPlace at;  ///< the block LBL
  std::int32_t block = Block::kNone;
  std::string name;  ///< of a later control's label that has one
};

/// A jump that needs text of another place; taken before the next block.
enum class JumpKind : std::uint8_t {
  None,
  Label,
  Subprogram,
  Repeat,
  Program,
  CycleProgram,
};
struct Jump {
  JumpKind kind = JumpKind::None;
  std::uint32_t number = 0;
  std::uint32_t repeats = 0;
  std::string name = {};  ///< of a label or a program of a later control
  TextPlace call;         ///< the block that jumps
};

/// The previous positioning block, as CT, RND, chamfers and the single-axis rules need it.
struct LastMove {
  bool exists = false;
  bool is_arc = false;
  bool has_both = false;          ///< both coordinates of the plane
  bool has_third = false;         ///< and one besides
  bool is_single_offset = false;  ///< R+ or R-
  bool starts_contour = false;    ///< the first with RL or RR
  PlaneVector from, to;           ///< nominal, program coordinates
  PlaneVector center;
  Turn turn = Turn::Counterclockwise;
};

/// A corner that RND or a chamfer asked for and that the next move decides.
enum class BlendKind : std::uint8_t {
  None,
  Round,
  Chamfer,
  TangentialApproach,
  TangentialDeparture
};
struct Blend {
  BlendKind kind = BlendKind::None;
  bool is_stated = false;  ///< G25: a corner and nothing else
  bool is_lost = false;    ///< the contour ended before the move after the corner
  double size = 0;
  Origin origin;
};

/// The first half of DEF BLK FORM.
struct BlankState {
  bool has_minimum = false;
  bool is_tool_across = false;  ///< the warning about the graphics was given
  Axis axis = Axis::Z;
  std::array<double, 3> minimum{};
};

/// A start in the middle of the program (start_search.hpp).
struct StartState {
  bool is_searching = false;  ///< nothing reaches the machine yet
  std::int32_t block = Block::kNone;
  std::int64_t pass = 0;                      ///< which time; 0: the program comes there once
  std::int64_t arrivals = 0;                  ///< so often it has come there
  Position actual;                            ///< where the machine is
  Position expected;                          ///< where the program has it at the block
  bool has_changed_tool = false;              ///< before the block
  bool is_in_contour = false;                 ///< or a corner
  std::int32_t contour_block = Block::kNone;  ///< that began it
  std::bitset<100> codes;                     ///< M functions of the machine that were not output
  std::vector<std::int32_t> assigned;         ///< Q parameters that the program has set; sorted
  std::vector<std::int32_t> carried;          ///< or read before it set them
};

struct PolarData {
  bool exists = false;      ///< a polar block was executed in this run
  bool is_current = false;  ///< and nothing since moved the tool or the pole
  double radius = 0;
  double angle = 0;
};

struct State {
  RunPhase phase = RunPhase::Running;
  bool has_header = false;
  bool are_calls_checked = false;  ///< the programs that are called are there
  std::uint64_t blocks = 0;
  TextPlace at;                            ///< the next block
  std::int32_t number_due = Block::kNone;  ///< its number, where that is known
  ReadingState reading;
  std::int64_t program_number = -1;  ///< of the program that was started
  std::string program_name;          ///< a later control's
  Units units = Units::Millimeter;

  Position machine;      ///< as events say, before radius compensation; marked: moved so far
  AxisValues nominal{};  ///< program coordinates
  /// From there to the tool, program coordinates: what R+ and R- have added, until the axis is
  /// positioned again.
  AxisValues beside{};
  bool is_beside = false;  ///< one of them is not 0
  Transformation transformation;

  Plane plane = Plane::XY;
  ActiveTool tool;
  std::vector<ToolDefinition> definitions;  ///< executed in this run; the last one last
  std::vector<ToolPocket> pockets;          ///< of the random changer; empty without one
  SpindleModes spindle;
  CoolantModes coolant;
  /// F in force, by what moves: an inch program states it in tenths of an inch for linear axes and
  /// in degrees for a rotary axis alone. 0: none yet.
  double feed = 0;         ///< millimeters per minute
  double rotary_feed = 0;  ///< degrees per minute

  Compensation compensation = Compensation::Off;
  bool uses_stages = false;      ///< from the first RL, RR, RND or chamfer on
  bool joins = false;            ///< moves pass the corner stage: one waits there
  bool is_parallel = false;      ///< after M98: compensation has to be programmed again
  bool needs_side = false;       ///< RL or RR has ended without R0: it, RL or RR must be programmed
  bool has_compensated = false;  ///< a contour was started in this run
  bool is_first_contour = false;  ///< the one that was started last is that one
  bool awaits_contour = false;    ///< RL or RR is on, and no block in the plane has followed
  Blend blend;
  LastMove last;
  std::array<double, 3> pole{};  ///< X, Y, Z; program coordinates
  bool has_pole = false;
  /// Of a later control: CC named the tool axis, so circles lie in this plane, not in the working
  /// plane.
  std::optional<Plane> pole_plane;
  PolarData polar;

  std::vector<double> q = std::vector<double>(kParameterCount);  ///< a later control has more
  std::bitset<kRetainedParameters> known_retained;  ///< QR: set by the program or the setup
  std::vector<double> cycle_words;      ///< of a later control's cycle, in the order of its rows
  double tool_feed = 0;                 ///< F of TOOL CALL: F AUTO
  bool has_plane_angles = false;        ///< Q120 to Q122, which are 0: no plane is tilted
  bool takes_shorter_path = false;      ///< M126
  bool has_linear_rotary_feed = false;  ///< M116
  /// Where PLANE has computed the rotary axes to be; they may not be there yet.
  std::optional<std::array<double, 2>> plane_pose;
  AxisValues plane_shift{};  ///< the datum shift that was in force when the plane was tilted
  /// X, Y, Z: whether a datum shift of the axis holds, made in one coordinate system and in force
  /// in another, is not known.
  std::array<bool, 3> doubtful_shift{};
  bool is_rapid_next = false;  ///< the last positioning block had FMAX: the path to an approach
  /// A cycle has ended at a place in the plane that the control's manual does not state.
  bool has_open_place = false;
  bool has_rounded = false;  ///< a comparison of a later control took two values as equal
  CycleState cycle;
  BlankState blank;

  std::vector<LabelFrame> labels;
  std::vector<ProgramFrame> programs;
  std::vector<LabelPlace> known_labels;  ///< those met; by program, number and name
  Jump jump;
  StartState start;
  bool is_restart = false;      ///< after GOTO
  bool has_positioned = false;  ///< the first positioning of the run was executed

  double mm_per_unit() const { return interpreter::mm_per_unit(units); }
  bool is_compensating() const {
    return compensation == Compensation::Left || compensation == Compensation::Right;
  }
  double nominal_of(Axis axis) const { return nominal[static_cast<std::size_t>(axis)]; }
  /// The nominal position; where the tool is beside it, that of the tool.
  AxisValues tool_position() const {
    AxisValues place = nominal;
    for (std::size_t i = 0; is_beside && i < place.size(); ++i) place[i] += beside[i];
    return place;
  }
  /// The tool is there and not beside it.
  void stand_at(const AxisValues& place) {
    nominal = place;
    beside = {};
    is_beside = false;
  }
  /// It is beside its nominal position along this axis.
  void stand_beside(Axis axis, double value, double by) {
    nominal[static_cast<std::size_t>(axis)] = value;
    beside[static_cast<std::size_t>(axis)] = by;
    is_beside = is_beside || by != 0;
  }
};

}  // namespace dripline::interpreter::tnc155
