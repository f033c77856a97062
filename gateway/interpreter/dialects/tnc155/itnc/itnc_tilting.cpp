#include "gateway/interpreter/dialects/tnc155/itnc/itnc_tilting.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_execution.hpp"

/// Source: iTNC 530, User's Manual, "Programming: multiple axis machining": the PLANE function,
/// M128, FUNCTION TCPM.
namespace dripline::interpreter::tnc155::itnc {
namespace {

using tilting::AlignedPose;
using tilting::Kinematics;
using tilting::KinematicType;
using tilting::Matrix3;
using tilting::Point3;
using tilting::Pose;
using tilting::RotaryAxis;
using tilting::Tilt;
using tilting::operator*;
using tilting::operator-;

constexpr double kSameAngle = 1e-4;  ///< degrees: what a block that names Q120 to Q122 rounds

bool is_plane(const Run& run) {
  return run.tilted.kind() == Tilt::Kind::Plane;
}
bool is_tip_controlled(const Run& run) {
  return run.tilted.kind() == Tilt::Kind::TipControl;
}
bool fail_tilt(Run& run, std::string_view why) {
  return run.fail(ErrorCode::TiltFailed, why);
}

bool needs_option(Run& run, std::string_view what) {
  return run.options.kinematics.exists() ||
         run.fail(ErrorCode::OptionMissing,
                  fmt::format("{} needs the machine's kinematics ([control] kinematics)", what));
}

/// Where the datum has the rotary axes.
Pose zero_pose(const Run& run) {
  const Transformation& now = run.state.transformation;
  const auto zero = [&now](const RotaryAxis& rotary) {
    return now.datum[index(rotary.axis)] + now.shift[index(rotary.axis)];
  };
  return {zero(run.options.kinematics.master), zero(run.options.kinematics.slave)};
}

Pose present_pose(const Run& run) {
  return tilting::pose_of(run.options.kinematics,
                          run.tilted.is_on() ? run.tilted.machine() : run.state.machine);
}

bool is_same_pose(Pose a, Pose b) {
  return std::fabs(a.master - b.master) <= kSameAngle && std::fabs(a.slave - b.slave) <= kSameAngle;
}

/// What excludes both modes.
bool check_tilt_begins(Run& run, std::string_view what) {
  const State& state = run.state;
  const Transformation& now = state.transformation;
  if (!state.tool.is_called) return run.fail(ErrorCode::ToolCallMissing, what);
  if (state.tool.axis != Axis::Z)
    return fail_tilt(
        run, fmt::format("{} with tool axis {}; only Z is known", what, letter(state.tool.axis)));
  if (state.is_compensating() || state.is_parallel || state.blend.kind != BlendKind::None)
    return run.fail(ErrorCode::PathOffsetWronglyStarted, fmt::format("{} needs R0", what));
  if (now.is_special)
    return fail_tilt(run, fmt::format("{} under a rotation, mirror image or scaling", what));
  if (state.cycle.is_modal_call)
    return fail_tilt(run, fmt::format("{} while M89 calls the cycle", what));
  for (const Axis axis : {Axis::U, Axis::V, Axis::W}) {
    if (state.machine.raw(axis) != 0)
      return fail_tilt(run,
                       fmt::format("{}: {} is not at 0 and in no kinematics", what, letter(axis)));
  }
  return true;
}

/// From here on the program's places are those of another frame.
void enter_frame(Run& run, const Position& machine) {
  State& state = run.state;
  state.machine = machine;
  state.stand_at(state.transformation.to_program(values_of(state.machine)));
  state.last = LastMove{};
  state.polar.is_current = false;
  ++run.frame_changes;
  run.reset_stages();
}

void begin_tilt(Run& run, const Tilt& tilt) {
  const Position machine = run.tilted.is_on() ? run.tilted.machine() : run.state.machine;
  interrupt_contour(run);
  run.tilted.begin(tilt, machine);
  enter_frame(run, run.tilted.flat());
}

void end_tilt(Run& run) {
  interrupt_contour(run);
  const Position machine = run.tilted.machine();
  run.tilted.end();
  enter_frame(run, machine);
}

Tilt tilt_of(const Run& run, Tilt::Kind kind) {
  const State& state = run.state;
  const AxisValues origin = state.transformation.to_machine(AxisValues{});
  Tilt tilt{.kind = kind};
  for (std::size_t i = 0; i < 3; ++i) tilt.at[i] = tilt.flat_zero[i] = origin[i];
  tilt.zero = zero_pose(run);
  tilt.length = state.tool.data.length;
  tilt.mm_per_unit = state.mm_per_unit();
  return tilt;
}

/// SEQ decides by the angle of the first rotary axis from the tool, or the last from the table.
double sequence_angle(const Kinematics& machine, Pose zero, Pose pose) {
  return machine.type == KinematicType::HeadHead ? pose.slave - zero.slave
                                                 : pose.master - zero.master;
}

bool choose_pose(Run& run, const Tilt& tilt, Pose& chosen) {
  const Kinematics& machine = run.options.kinematics;
  const PlaneWords& plane = run.parts.itnc.plane;
  const Pose present = present_pose(run);
  auto poses = tilting::aligned_poses(machine, tilt.zero, tilt.frame.column(2), present);
  if (plane.sequence != 0) {
    std::erase_if(poses, [&](const AlignedPose& pose) {
      return plane.sequence * sequence_angle(machine, tilt.zero, pose.pose) < -kSameAngle;
    });
  }
  if (poses.empty())
    return fail_tilt(run, "no position of the rotary axes brings the tool normal to the plane");
  if (poses.size() == 2 && !is_same_pose(poses[0].pose, poses[1].pose)) {
    const auto travel = [&](std::size_t i) {
      return Pose{std::fabs(poses[i].pose.master - present.master),
                  std::fabs(poses[i].pose.slave - present.slave)};
    };
    const Pose first = travel(0), second = travel(1);
    const bool is_never_longer =
        first.master <= second.master + kSameAngle && first.slave <= second.slave + kSameAngle;
    const bool is_shorter =
        first.master < second.master - kSameAngle || first.slave < second.slave - kSameAngle;
    if (!is_never_longer || !is_shorter)
      return fail_tilt(run,
                       "two positions of the rotary axes do, and which is nearer is not known: "
                       "SEQ+ or SEQ-");
  }
  chosen = poses.front().pose;
  if (!poses.front().is_free) return true;
  // Of a rotation about the tool alone the table takes part with TABLE ROT, which is not known
  // here.
  const Point3 along = (tilting::table_motion(machine, chosen).turn *
                        transposed(tilting::table_motion(machine, tilt.zero).turn) * tilt.frame)
                           .column(0);
  constexpr double kStraight = 1e-7;
  const bool is_along = std::fabs(along[0] - 1) < kStraight;
  if (is_along || (plane.rotates_coordinates && is_same_pose(chosen, tilt.zero))) return true;
  return fail_tilt(run,
                   "a rotation about the tool axis alone: COORD ROT with the rotary axes at 0");
}

/// Q120 to Q122.
void keep_plane_angles(Run& run, Pose zero, Pose pose) {
  const Kinematics& machine = run.options.kinematics;
  for (std::int32_t q = kFirstPlaneAngle; q <= kLastPlaneAngle; ++q) run.set_q(q, 0);
  const auto keep = [&run](const RotaryAxis& rotary, double degrees) {
    run.set_q(kFirstPlaneAngle + static_cast<std::int32_t>(index(rotary.axis) - index(Axis::A)),
              degrees);
  };
  keep(machine.master, pose.master - zero.master);
  keep(machine.slave, pose.slave - zero.slave);
  run.state.has_plane_angles = true;
}

/// TURN and MOVE: F, FMAX or F AUTO of the block.
bool pace_of_turn(Run& run, const Block& block, Pace& pace) {
  pace = {block.is_rapid, 0, 0};
  if (pace.is_rapid) return true;
  if (run.parts.itnc.is_auto_feed) pace.feed = run.state.tool_feed;
  if (block.feed.is_programmed() && !read_cycle_feed(run, block.feed, pace.feed)) return false;
  if (run.state.has_linear_rotary_feed)
    return run.fail(ErrorCode::NotSupported, "PLANE with TURN or MOVE at a feed under M116");
  pace.rotary_feed = rotary_feed_of(run, pace.feed);
  return pace.feed > 0 || run.fail(ErrorCode::FeedRateMissing, "PLANE with TURN or MOVE needs F");
}

/// Of the rotary axes, as the stage takes it: a degree is as long as a unit of the program.
std::optional<Feed> turning_feed(const Run& run, const Pace& pace) {
  if (pace.is_rapid) return {};
  return Feed::per_minute(Length::mm(pace.rotary_feed * run.state.mm_per_unit()));
}

/// MB: the tool goes back along its axis before the rotary axes turn. In front of a table that is
/// Z.
bool retract_before_turn(Run& run, const Pace& pace) {
  const ItncWords& words = run.parts.itnc;
  const bool goes_back = words.retracts_to_limit || words.retract.is_programmed();
  if (!goes_back) return true;
  if (run.options.kinematics.type != KinematicType::TableTable)
    return fail_tilt(run, "MB of PLANE on a machine with a head");
  State& state = run.state;
  const Position machine = run.tilted.is_on() ? run.tilted.machine() : state.machine;
  double distance = run.length(words.retract);
  if (words.retracts_to_limit) {
    if (!run.options.limit_high.has(Axis::Z))
      return run.fail(ErrorCode::NotSupported, "MB MAX: the setup has no limit_high of Z");
    distance = std::max(0.0, run.options.limit_high.raw(Axis::Z) - machine.raw(Axis::Z));
  }
  if (distance < 0) return run.fail(ErrorCode::EntryOutOfRange, fmt::format("MB {}", distance));
  if (run.tilted.is_on() &&
      !is_same_pose(present_pose(run), {(*state.plane_pose)[0], (*state.plane_pose)[1]}))
    return fail_tilt(run, "MB while the rotary axes are not where the plane has them");
  Target target = here(state);
  target.set(Axis::Z, target.at[index(Axis::Z)] + distance);
  line_to(run, target, pace);
  return true;
}

/// With the tool's place on the workpiece kept.
void turn_around_tip(Run& run, Tilt tilt, Pose pose, const Pace& pace) {
  const Tilt::Kind kind = tilt.kind;
  tilt.kind = Tilt::Kind::TipControl;
  run.tilted.begin(tilt, run.state.machine);
  Position to = run.tilted.flat();
  to.set_raw(run.options.kinematics.master.axis, pose.master);
  to.set_raw(run.options.kinematics.slave.axis, pose.slave);
  if (const auto feed = turning_feed(run, pace)) {
    run.tilted.on_line({run.origin, to, *feed});
  } else {
    run.tilted.on_rapid({run.origin, to});
  }
  const Position machine = run.tilted.machine();
  tilt.kind = kind;
  run.tilted.end();
  run.state.machine = machine;
}

bool tilt_plane(Run& run, const Block& block) {
  State& state = run.state;
  const PlaneWords& words = run.parts.itnc.plane;
  if (is_plane(run) && state.transformation.shift != state.plane_shift)
    return fail_tilt(run, "PLANE after a datum shift in a tilted plane: PLANE RESET before it");
  Tilt tilt = tilt_of(run, Tilt::Kind::Plane);
  Pose pose;
  Pace pace;
  if (!frame_of_plane(run, is_plane(run) ? run.tilted.state().tilt.frame : Matrix3{}, tilt.frame) ||
      !choose_pose(run, tilt, pose))
    return false;
  if (words.turn != PlaneTurn::Stay && !pace_of_turn(run, block, pace)) return false;
  if (words.turn == PlaneTurn::Move && run.length(run.parts.itnc.length) != 0)
    return fail_tilt(run, "DIST of PLANE MOVE other than 0");
  run.events();
  if (!retract_before_turn(run, pace)) return false;
  if (run.tilted.is_on()) end_tilt(run);
  interrupt_contour(run);
  if (words.turn == PlaneTurn::Move) turn_around_tip(run, tilt, pose, pace);
  begin_tilt(run, tilt);
  state.plane_pose = {pose.master, pose.slave};
  state.plane_shift = state.transformation.shift;
  keep_plane_angles(run, tilt.zero, pose);
  if (words.turn != PlaneTurn::Turn) return true;
  run.tilted.turn_to(run.origin, pose, turning_feed(run, pace), false);
  enter_frame(run, run.tilted.flat());
  return true;
}

/// The rotary axes go to the datum's 0 with TURN and MOVE.
bool reset_plane(Run& run, const Block& block) {
  State& state = run.state;
  const PlaneWords& words = run.parts.itnc.plane;
  const bool moves_axes = words.turn != PlaneTurn::Stay;
  if (!run.options.kinematics.exists()) {
    if (moves_axes) return needs_option(run, "PLANE RESET with TURN or MOVE");
    run.warn("TNC-ACCEPTED", "PLANE RESET STAY is not followed: no plane is tilted");
    return true;
  }
  Pace pace;
  if (moves_axes && !check_tilt_begins(run, "PLANE RESET")) return false;
  if (moves_axes && !pace_of_turn(run, block, pace)) return false;
  if (words.turn == PlaneTurn::Move && run.length(run.parts.itnc.length) != 0)
    return fail_tilt(run, "DIST of PLANE MOVE other than 0");
  run.events();
  if (moves_axes && !retract_before_turn(run, pace)) return false;
  const Tilt flat = tilt_of(run, Tilt::Kind::Plane);
  if (is_plane(run)) {
    for (std::size_t i = 0; i < 3; ++i)
      state.doubtful_shift[i] |= state.transformation.shift[i] != state.plane_shift[i];
    end_tilt(run);
  }
  state.plane_pose.reset();
  if (!moves_axes) return true;
  interrupt_contour(run);
  if (words.turn == PlaneTurn::Move) {
    turn_around_tip(run, flat, flat.zero, pace);
  } else {
    run.tilted.begin(flat, state.machine);
    run.tilted.turn_to(run.origin, flat.zero, turning_feed(run, pace), false);
    state.machine = run.tilted.machine();
    run.tilted.end();
  }
  enter_frame(run, state.machine);
  return true;
}

}  // namespace

bool set_plane(Run& run, const Block& block) {
  const PlaneWords& words = run.parts.itnc.plane;
  if (is_tip_controlled(run)) return fail_tilt(run, "PLANE while M128 is in force: M129 before it");
  if (words.form == PlaneForm::Reset) return reset_plane(run, block);
  if (!run.options.kinematics.exists() && words.is_text_flat && words.turn == PlaneTurn::Stay) {
    run.state.has_plane_angles = true;
    run.warn("TNC-ACCEPTED", "PLANE SPATIAL with angles of 0 is not followed");
    return true;
  }
  return needs_option(run, "PLANE") && check_tilt_begins(run, "PLANE") && tilt_plane(run, block);
}

bool change_tip_control(Run& run, const Block&) {
  return run.parts.itnc.tip == TipWords::Begin ? begin_tip_control(run) : end_tip_control(run);
}

/// One that tilts nothing, as CAM systems write it before M128: its coordinates are those without.
bool is_plane_flat(const Run& run) {
  constexpr double kSame = 1e-9;
  const auto& turn = run.tilted.state().tilt.frame.at;
  const auto& straight = Matrix3{}.at;
  return std::ranges::equal(turn, straight,
                            [](double a, double b) { return std::fabs(a - b) < kSame; });
}

bool begin_tip_control(Run& run) {
  if (!needs_option(run, "M128, FUNCTION TCPM")) return false;
  if (is_tip_controlled(run)) return true;
  if (is_plane(run) &&
      (!is_plane_flat(run) || run.state.transformation.shift != run.state.plane_shift))
    return fail_tilt(run, "M128 in a tilted plane");
  if (!check_tilt_begins(run, "M128")) return false;
  run.events();
  if (is_plane(run)) end_tilt(run);
  begin_tilt(run, tilt_of(run, Tilt::Kind::TipControl));
  return true;
}

/// A plane that tilts nothing is in force again: the rotary axes go back before its coordinates do.
bool end_tip_control(Run& run) {
  if (!is_tip_controlled(run)) return true;
  end_tilt(run);
  if (run.state.plane_pose) begin_tilt(run, tilt_of(run, Tilt::Kind::Plane));
  return true;
}

}  // namespace dripline::interpreter::tnc155::itnc
