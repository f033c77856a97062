#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_tilting.hpp"

/// What blocks may do in a tilted plane and under M128.
namespace dripline::interpreter::tnc155::itnc {
namespace {

using tilting::Kinematics;
using tilting::Pose;
using tilting::Tilt;

constexpr double kSamePose = 1e-4;  ///< degrees

bool refuse_in_tilt(Run& run, std::string_view what) {
  const bool is_plane = run.tilted.kind() == Tilt::Kind::Plane;
  return run.fail(
      ErrorCode::TiltFailed,
      fmt::format("{} {}", what, is_plane ? "in a tilted plane" : "while M128 is in force"));
}

bool is_path_in_plane(const Block& block) {
  const bool is_polar = block.kind == BlockKind::PolarLine || block.kind == BlockKind::PolarArc;
  return is_polar || block.kind == BlockKind::Approach || block.kind == BlockKind::Departure ||
         std::ranges::any_of(block.words(),
                             [](const Coordinate& word) { return !is_rotary(word.axis); });
}

/// Without it the tool would not be normal to the plane, and where the control then has the
/// program's points is not known.
bool check_pose(Run& run) {
  const auto& wanted = run.state.plane_pose;
  if (run.tilted.kind() != Tilt::Kind::Plane || !wanted) return true;
  const Kinematics& machine = run.options.kinematics;
  const Pose at = tilting::pose_of(machine, run.tilted.machine());
  if (std::fabs(at.master - (*wanted)[0]) <= kSamePose &&
      std::fabs(at.slave - (*wanted)[1]) <= kSamePose)
    return true;
  return run.fail(ErrorCode::TiltFailed,
                  fmt::format("PLANE has {} at {:.4f} and {} at {:.4f}, and they are not there yet",
                              letter(machine.master.axis), (*wanted)[0], letter(machine.slave.axis),
                              (*wanted)[1]));
}

/// Where a word brings a rotary axis, machine coordinates.
double rotary_target(Run& run, const Coordinate& word) {
  const double value = run.coordinate(word.axis, word.value);
  if (word.is_incremental) return run.tilted.machine().raw(word.axis) + value;
  return run.state.transformation.to_machine(word.axis, value);
}

/// Only to where PLANE has computed them, or whole revolutions from there.
bool read_rotary_words(Run& run, const Block& block, Pose& pose) {
  const Kinematics& machine = run.options.kinematics;
  auto& wanted = *run.state.plane_pose;
  for (const Coordinate& word : block.words()) {
    if (!is_rotary(word.axis)) continue;
    const bool is_master = word.axis == machine.master.axis;
    if (!is_master && word.axis != machine.slave.axis)
      return refuse_in_tilt(run, fmt::format("{}, which is in no kinematics,", letter(word.axis)));
    const double to = rotary_target(run, word);
    double& due = wanted[is_master ? 0 : 1];
    if (std::fabs(std::remainder(to - due, 360)) > kSamePose) {
      return refuse_in_tilt(run, fmt::format("{} to {:.4f} and not to {:.4f}, where PLANE has it,",
                                             letter(word.axis), to, due));
    }
    if (std::fabs(to - due) > kSamePose) due = to;
    (is_master ? pose.master : pose.slave) = due;
  }
  return true;
}

/// L A+Q120 C+Q122: the rotary axes alone.
bool turn_to_plane(Run& run, const Block& block) {
  State& state = run.state;
  Pose pose = tilting::pose_of(run.options.kinematics, run.tilted.machine());
  Pace pace;
  if (!check_start(run, block, here(state)) || !read_feed(run, block)) return false;
  if (!pace_of(run, block, pace) || !read_rotary_words(run, block, pose)) return false;
  run.ledger.take_all();
  interrupt_contour(run);
  std::optional<Feed> feed;
  if (!pace.is_rapid) feed = Feed::per_minute(Length::mm(pace.rotary_feed * state.mm_per_unit()));
  run.tilted.turn_to(run.origin, pose, feed, false);
  state.machine = run.tilted.flat();
  state.stand_at(state.transformation.to_program(values_of(state.machine)));
  state.last = LastMove{};
  state.polar.is_current = false;
  ++run.frame_changes;
  run.reset_stages();
  return true;
}

/// M91 and M92: machine coordinates of the linear axes, straight there.
bool move_in_machine(Run& run, const Block& block) {
  State& state = run.state;
  if (block.kind != BlockKind::Line || block.compensation > Compensation::Off)
    return refuse_in_tilt(run, fmt::format("M{} other than in a straight line with R0", block.m));
  Position to = run.tilted.machine();
  for (const Coordinate& word : block.words()) {
    if (is_rotary(word.axis)) return refuse_in_tilt(run, "a rotary axis with M91 or M92");
    double value = run.coordinate(word.axis, word.value);
    if (word.is_incremental) value += to.raw(word.axis);
    if (!word.is_incremental && block.m == 92) value += run.options.m92_position.raw(word.axis);
    to.set_raw(word.axis, value);
    run.is_length_doubtful |= state.tool.data.length != 0 && word.axis == state.tool.axis;
  }
  if (block.coordinate_count == 0)
    return run.fail(ErrorCode::BlockFormatIncorrect,
                    fmt::format("M{} refers to coordinates, and there are none", block.m));
  run.ledger.take_all();
  const AxisValues flat = values_of(run.tilted.flat_of(to));
  Target target;
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) target.set(axis, flat[index(axis)]);
  Pace pace;
  if (!check_start(run, block, target) || !read_feed(run, block) || !pace_of(run, block, pace))
    return false;
  interrupt_contour(run);
  machine_line_to(run, target, pace);
  state.last = LastMove{};
  state.polar.is_current = false;
  return true;
}

bool check_tip_controlled(Run& run, const Block& block) {
  if (block.m == 91 || block.m == 92) return refuse_in_tilt(run, fmt::format("M{}", block.m));
  if (block.compensation > Compensation::Off) return refuse_in_tilt(run, "radius compensation");
  if (block.kind == BlockKind::Approach || block.kind == BlockKind::Departure)
    return refuse_in_tilt(run, "APPR or DEP");
  if (run.blend_follows) return refuse_in_tilt(run, "RND or CHF");
  for (const Coordinate& word : block.words()) {
    const Axis axis = word.axis;
    const Kinematics& machine = run.options.kinematics;
    const bool is_known =
        axis <= Axis::Z || axis == machine.master.axis || axis == machine.slave.axis;
    if (!is_known)
      return refuse_in_tilt(run, fmt::format("{}, which is in no kinematics,", letter(axis)));
  }
  return true;
}

}  // namespace

bool check_tilted_move(Run& run, const Block& block, bool& is_made) {
  if (run.tilted.kind() == Tilt::Kind::TipControl) return check_tip_controlled(run, block);
  if (block.m == 91 || block.m == 92) return is_made = true, move_in_machine(run, block);
  const auto is_rotary_word = [](const Coordinate& word) { return is_rotary(word.axis); };
  const bool names_rotary = std::ranges::any_of(block.words(), is_rotary_word);
  if (!is_path_in_plane(block)) return !names_rotary || (is_made = true, turn_to_plane(run, block));
  for (const Axis axis : {Axis::U, Axis::V, Axis::W}) {
    if (block.names(axis))
      return refuse_in_tilt(run, fmt::format("{}, which is in no kinematics,", letter(axis)));
  }
  Pose pose{};
  return check_pose(run) && (!names_rotary || read_rotary_words(run, block, pose));
}

bool check_tilted_cycle(Run& run, std::string_view what) {
  if (run.tilted.kind() == Tilt::Kind::TipControl) return refuse_in_tilt(run, what);
  return check_pose(run);
}

bool check_tilted_tool(Run& run) {
  if (run.tilted.kind() == Tilt::Kind::TipControl)
    return refuse_in_tilt(run, "TOOL CALL, which needs M129 before it,");
  return run.options.kinematics.type == tilting::KinematicType::TableTable ||
         refuse_in_tilt(run, "TOOL CALL on a machine with a head");
}

bool check_tilted_transformation(Run& run, const Block& block) {
  State& state = run.state;
  if (run.tilted.kind() == Tilt::Kind::TipControl)
    return refuse_in_tilt(run, fmt::format("CYCL DEF {}", block.cycle));
  if (block.cycle != 7) return true;  // these act in the plane
  const bool is_tilted = run.tilted.is_on();
  bool had_shift = false;
  for (std::size_t i = 0; i < 3; ++i) had_shift |= state.plane_shift[i] != 0;
  for (const Coordinate& word : block.words()) {
    if (is_tilted && is_rotary(word.axis)) return refuse_in_tilt(run, "a shift of a rotary axis");
    if (word.axis > Axis::Z) continue;
    const double now = state.transformation.shift[index(word.axis)];
    const double value = run.coordinate(word.axis, word.value) + (word.is_incremental ? now : 0);
    bool& is_doubtful = state.doubtful_shift[index(word.axis)];
    if (is_tilted) {
      is_doubtful |= had_shift && value != now;
    } else if (!word.is_incremental) {
      is_doubtful = false;
    }
  }
  return true;
}

bool check_shift_is_known(Run& run, const Block& block) {
  if (!is_path_in_plane(block) || block.m == 91 || block.m == 92) return true;
  const auto& doubtful = run.state.doubtful_shift;
  const auto first = std::ranges::find(doubtful, true);
  if (first == doubtful.end()) return true;
  return run.fail(
      ErrorCode::TiltFailed,
      fmt::format("whether the datum shift of {}, made in one coordinate system, holds in "
                  "the other one is not known: CYCL DEF 7 for it before this move",
                  "XYZ"[first - doubtful.begin()]));
}

}  // namespace dripline::interpreter::tnc155::itnc
