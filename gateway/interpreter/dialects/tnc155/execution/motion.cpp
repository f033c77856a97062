#include "gateway/interpreter/dialects/tnc155/execution/execution.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/core/shown_length.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

bool is_machine_block(const Block& block) {
  return block.m == 91 || block.m == 92;
}

/// Where the words of such a block lead: machine coordinates.
Target machine_target(Run& run, const Block& block) {
  run.ledger.take_all();
  Target target;
  for (const Coordinate& word : block.words()) {
    double value = run.coordinate(word.axis, word.value);
    if (word.is_incremental) {
      value += run.state.machine.raw(word.axis);
    } else if (block.m == 92) {
      value += run.options.m92_position.raw(word.axis);
    }
    target.set(word.axis, value);
    // Whether the length is in machine coordinates, no manual at hand decides.
    const ActiveTool& tool = run.state.tool;
    run.is_length_doubtful |= tool.data.length != 0 && word.axis == tool.axis;
  }
  return target;
}

/// M91, M92: the block's words are machine coordinates, and nothing else changes them.
bool run_machine_block(Run& run, const Block& block) {
  const State& state = run.state;
  if (block.coordinate_count == 0) {
    return run.fail(ErrorCode::BlockFormatIncorrect,
                    fmt::format("M{} refers to coordinates, and there are none", block.m));
  }
  if (block.compensation > Compensation::Off && block.compensation != state.compensation) {
    return run.fail(ErrorCode::PathOffsetWronglyStarted,
                    fmt::format("M{} moves without radius compensation", block.m));
  }
  const Target target = machine_target(run, block);
  if (!check_start(run, block, target) || !read_feed(run, block)) return false;
  Pace pace;
  if (!pace_of(run, block, pace)) return false;
  if (block.compensation == Compensation::Off) {
    end_contour(run, false);
    run.state.compensation = Compensation::Off;
  }
  interrupt_contour(run);
  machine_line_to(run, target, pace);
  resume_contour(run);
  run.state.last = LastMove{};
  run.state.polar.is_current = false;
  return true;
}

/// PR and PA are relative to CC, which is not a machine coordinate.
bool refuse_machine_block(Run& run, const Block& block) {
  if (!is_machine_block(block)) [[likely]]
    return true;
  return run.fail(ErrorCode::BlockFormatIncorrect,
                  fmt::format("M{} is for Cartesian coordinates", block.m));
}

/// The end of an arc: its words are program coordinates, or machine coordinates brought there.
bool read_arc_end(Run& run, const Block& block, Target& target) {
  if (!is_machine_block(block)) [[likely]] {
    read_coordinates(run, block, target);
    return true;
  }
  const State& state = run.state;
  if (state.is_compensating() || state.is_parallel || block.compensation > Compensation::Off) {
    return run.fail(ErrorCode::PathOffsetWronglyStarted,
                    fmt::format("M{} moves without radius compensation, and a contour neither "
                                "begins nor ends with an arc",
                                block.m));
  }
  const Target wanted = machine_target(run, block);
  AxisValues machine = values_of(state.machine);
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    if ((wanted.named >> i & 1u) != 0) machine[i] = wanted.at[i];
  }
  const AxisValues program = state.transformation.to_program(machine);
  target.named = wanted.named;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    if (state.transformation.is_special || (wanted.named >> i & 1u) != 0) target.at[i] = program[i];
  }
  return true;
}

/// A rotation may bring a third axis into a block that names two.
bool check_axes(Run& run, const Target& target) {
  constexpr double kSame = 1e-9;
  const ControlVersion& version = run.options.version;
  if (version.has(Feature::ThreeAxisLines)) [[likely]]
    return true;
  const Position to = machine_position(run.state, target);
  std::string moved;
  for (const Axis axis : kAllAxes) {
    if (std::fabs(to.raw(axis) - run.state.machine.raw(axis)) > kSame) moved += letter(axis);
  }
  if (moved.size() < 3) return true;
  return run.fail(ErrorCode::NotSupported, fmt::format("{} move in this block: {}", moved,
                                                       version.lacks(Feature::ThreeAxisLines)));
}

bool go_straight(Run& run, const Block& block, const Target& target) {
  State& state = run.state;
  if (!check_axes(run, target)) return false;
  const bool is_first = state.is_restart && target.named != 0;
  if (target.named != 0 && !check_start(run, block, target)) return false;
  if (!read_feed(run, block)) return false;
  const PlaneMove move = plane_move(state, target);
  Pace pace;
  if (target.named != 0 && !pace_of(run, block, pace)) return false;
  if (!begin_move(run, block, move)) return false;
  line_to(run, target, pace);
  if (!finish_move(run, block, move)) return false;
  if (is_first && !run.blend_follows) state.last.from = expected_in_plane(state);
  return true;
}

/// A block without coordinates: its compensation, its feed and its M; no element of a contour.
bool run_tail(Run& run, const Block& block, const Target& target) {
  const bool is_about_path = (block.compensation != Compensation::NotProgrammed &&
                              block.compensation != run.state.compensation) ||
                             (block.m >= 95 && block.m <= 98);
  run.state.last.starts_contour = false;  // RND belongs to the block directly before it
  if (!is_about_path) return read_feed(run, block);
  LastMove last = run.state.last;
  if (!go_straight(run, block, target)) return false;
  last.is_single_offset = false;
  run.state.last = last;
  return true;
}

/// Angle in degrees from `from` to `to` in the direction of `turn`, in (0, 360].
double sweep_of(double from, double to, Turn turn) {
  double sweep = turn == Turn::Counterclockwise ? to - from : from - to;
  sweep = std::fmod(sweep, 360.0);
  if (sweep < 0) sweep += 360;
  constexpr double kNoAngle = 1e-9;
  return sweep < kNoAngle || sweep > 360 - kNoAngle ? 360 : sweep;
}
double sweep_of(PlaneVector from, PlaneVector to, Turn turn) {
  const double angle = turn_between(from, to) * (180 / Angle::kPi);
  return sweep_of(0, angle, turn);
}
/// The sweep of IPA: its full circles, and the rest in the direction of `turn`, which may be 0.
double sweep_by(double angle, double from, Turn turn) {
  const double circles = std::floor(std::fabs(angle) / 360) * 360;
  const double rest =
      std::fmod(std::fabs(angle), 360) == 0 ? 0 : sweep_of(from, from + angle, turn);
  return circles + rest;
}

bool round_corner(Run& run, const Block& block, const ArcTarget& arc, bool has_both = true) {
  State& state = run.state;
  if (!check_circle_plane(run)) return false;
  if (!check_start(run, block, arc.to, true) || !read_feed(run, block)) return false;
  PlaneMove move = plane_move(state, arc.to);
  move.is_arc = true;
  move.has_both = has_both;
  move.has_travel = true;
  move.center = arc.center;
  move.turn = arc.turn;
  Pace pace;
  if (!pace_of(run, block, pace) || !begin_move(run, block, move)) return false;
  arc_to(run, arc, pace);
  return finish_move(run, block, move);
}

bool has_pole(Run& run) {
  if (run.state.has_pole) return true;
  return run.fail(ErrorCode::AngleReferenceMissing, "no CC before");
}

/// Circles lie in the plane in force; a helix moves the tool axis besides.
bool check_circle_axes(Run& run, const Block& block, bool is_polar) {
  const PlaneAxes axes = axes_of(run.state.plane);
  for (std::size_t i = 0; i < block.coordinate_count; ++i) {
    const Axis axis = block.coordinates[i].axis;
    const bool is_of_plane = axis == axes.first || axis == axes.second;
    const bool is_of_tool =
        axis == axes.normal || (axis == run.state.tool.axis && !is_rotary(axis));
    if (is_polar ? is_of_tool : is_of_plane) continue;
    return run.fail(
        ErrorCode::PlaneWronglyDefined,
        is_polar ? fmt::format("{} in CP, which has the tool axis alone besides PA", letter(axis))
                 : fmt::format("{} in C, whose circle lies in {} and {}", letter(axis),
                               letter(axes.first), letter(axes.second)));
  }
  return true;
}

/// CIRCLE END POS. INCORRECT where start and end are not on one circle.
bool check_radii(Run& run, PlaneVector start, PlaneVector end) {
  const double from = length(start);
  const double to = length(end);
  constexpr double kRounding = 1e-9;
  if (std::fabs(from - to) <= run.options.circle_tolerance + kRounding) return true;
  return run.fail(ErrorCode::CircleEndIncorrect,
                  fmt::format("radius {} at the start, {} at the end",
                              shown_number(Length::mm(from), run.state.units),
                              shown_number(Length::mm(to), run.state.units)));
}

}  // namespace

bool run_line(Run& run, const Block& block) {
  if (is_machine_block(block)) [[unlikely]]
    return run_machine_block(run, block);
  Target target = here(run.state);
  read_coordinates(run, block, target);
  if (block.coordinate_count == 0) [[unlikely]]
    return run_tail(run, block, target);
  run.state.polar.is_current = false;
  return go_straight(run, block, target);
}

bool run_polar_line(Run& run, const Block& block) {
  Target target = here(run.state);
  if (!refuse_machine_block(run, block)) return false;
  if (!has_pole(run) || !read_polar(run, block, target)) return false;
  return go_straight(run, block, target);
}

bool run_arc(Run& run, const Block& block) {
  constexpr double kNoTravel = 1e-6;  // a full circle ends where it begins
  State& state = run.state;
  if (!has_pole(run) || !check_arc_start(run)) return false;
  if (!check_circle_axes(run, block, false)) return false;
  ArcTarget arc;
  arc.to = here(state);
  if (!read_arc_end(run, block, arc.to)) return false;
  const bool has_both = names_plane(state, arc.to);
  name_plane(state, arc.to);
  arc.center = pole_in_plane(state);
  arc.turn = *block.turn;
  const PlaneVector start = nominal_in_plane(state) - arc.center;
  const PlaneVector end = in_plane(state, arc.to) - arc.center;
  if (!check_radii(run, start, end)) return false;
  if (length(start) == 0) return run.fail(ErrorCode::AngleReferenceMissing, "the tool is on CC");
  arc.sweep = length(end - start) < kNoTravel ? 360 : sweep_of(start, end, arc.turn);
  state.polar.is_current = false;
  return round_corner(run, block, arc, has_both);
}

bool run_polar_arc(Run& run, const Block& block) {
  State& state = run.state;
  if (!refuse_machine_block(run, block) || !has_pole(run)) return false;
  if (!check_arc_start(run) || !check_circle_axes(run, block, true)) return false;
  ArcTarget arc;
  arc.to = here(state);
  read_coordinates(run, block, arc.to);
  arc.center = pole_in_plane(state);
  arc.turn = *block.turn;
  const PlaneVector start = nominal_in_plane(state) - arc.center;
  const double radius = length(start);
  if (radius == 0) return run.fail(ErrorCode::AngleReferenceMissing, "the tool is on CC");
  const double from = turn_between({1, 0}, start) * (180 / Angle::kPi);
  const double angle = run.number(block.angle);
  const bool is_left = arc.turn == Turn::Counterclockwise;
  if (run.options.is_itnc && block.is_angle_incremental && angle != 0 && (angle > 0) != is_left)
    return run.fail(ErrorCode::WrongSign,
                    fmt::format("IPA {} with DR{}", angle, is_left ? '+' : '-'));
  const double to = block.is_angle_incremental ? from + angle : angle;
  arc.sweep =
      block.is_angle_incremental ? sweep_by(angle, from, arc.turn) : sweep_of(from, to, arc.turn);
  state.polar = {true, true, radius, to};
  if (arc.sweep == 0) return go_straight(run, block, arc.to);  // a helix without revolutions
  set_in_plane(state, arc.to, arc.center + radius * unit_vector(to));
  return round_corner(run, block, arc);
}

bool run_tangent_arc(Run& run, const Block& block) {
  State& state = run.state;
  const LastMove& last = state.last;
  if (!check_arc_start(run)) return false;
  ArcTarget arc;
  arc.to = here(state);
  if (!read_arc_end(run, block, arc.to)) return false;
  if (!last.exists) {
    return run.fail(ErrorCode::CircleEndIncorrect, "no element before CT");
  }
  if (!last.has_both || !names_plane(state, arc.to)) {
    return run.fail(ErrorCode::AngleReferenceMissing,
                    "CT and the block before need both coordinates of the plane");
  }
  const PlaneVector start = nominal_in_plane(state);
  const PlaneVector along = end_direction(last);
  const PlaneVector chord = in_plane(state, arc.to) - start;
  const double distance = length(chord);
  if (length(along) == 0 || distance == 0) {
    return run.fail(ErrorCode::CircleEndIncorrect, "CT goes nowhere, or no element before it");
  }
  state.polar.is_current = false;
  constexpr double kStraight = 1e-9;
  const double side = cross(along, chord) / distance;
  if (std::fabs(side) < kStraight) {
    if (dot(along, chord) > 0) return go_straight(run, block, arc.to);
    return run.fail(ErrorCode::CircleEndIncorrect, "the end of CT is after its start");
  }
  const double radius = distance / (2 * side);
  arc.center = start + radius * left_of(along);
  arc.turn = side > 0 ? Turn::Counterclockwise : Turn::Clockwise;
  arc.sweep = sweep_of(start - arc.center, in_plane(state, arc.to) - arc.center, arc.turn);
  return round_corner(run, block, arc);
}

/// R+: the arc of at most half a circle, R-: the other one. Source: TNC 426/430, User's Manual: CR.
bool run_radius_arc(Run& run, const Block& block) {
  State& state = run.state;
  if (!check_arc_start(run) || !check_circle_axes(run, block, false)) return false;
  ArcTarget arc;
  arc.to = here(state);
  if (!read_arc_end(run, block, arc.to)) return false;
  const bool has_both = names_plane(state, arc.to);
  name_plane(state, arc.to);
  arc.turn = *block.turn;
  const PlaneVector start = nominal_in_plane(state);
  const PlaneVector chord = in_plane(state, arc.to) - start;
  const double half = length(chord) / 2;
  const double radius = run.length(block.radius);
  const double reach = radius * radius - half * half;
  constexpr double kRounding = 1e-9;
  const double least = std::fabs(radius) + run.options.circle_tolerance + kRounding;
  if (half == 0 || half > least) {
    return run.fail(ErrorCode::CircleEndIncorrect,
                    fmt::format("R {:.4f}, and the end is {:.4f} away", radius, 2 * half));
  }
  const bool is_left = (arc.turn == Turn::Counterclockwise) == (radius > 0);
  const double out = std::sqrt(std::max(reach, 0.0)) / (2 * half);
  arc.center = start + 0.5 * chord + (is_left ? out : -out) * left_of(chord);
  arc.sweep = sweep_of(start - arc.center, in_plane(state, arc.to) - arc.center, arc.turn);
  state.polar.is_current = false;
  return round_corner(run, block, arc, has_both);
}

bool run_single_axis(Run& run, const Block& block) {
  if (is_machine_block(block)) return run_machine_block(run, block);
  State& state = run.state;
  if (block.coordinate_count == 0) return read_feed(run, block);
  const Axis axis = block.coordinates[0].axis;
  Target target = here(state);
  read_coordinates(run, block, target);
  const double wanted = target.at[static_cast<std::size_t>(axis)];
  const Compensation how =
      block.compensation == Compensation::NotProgrammed ? state.compensation : block.compensation;
  if (state.is_compensating() && block.compensation != Compensation::Off &&
      axis != axes_of(state.plane).normal && !is_rotary(axis)) {
    return run.fail(ErrorCode::PathOffsetWronglyStarted,
                    fmt::format("a single-axis block of {} within a contour", letter(axis)));
  }
  double extra = 0;
  const bool is_offset = how == Compensation::Longer || how == Compensation::Shorter;
  if (is_offset && axis != state.tool.axis && !is_rotary(axis)) {
    const double travel = wanted - state.nominal_of(axis);
    const double sign = travel > 0 ? 1 : travel < 0 ? -1 : 0;
    const double radius = state.tool.data.radius / state.transformation.factor(axis);
    extra = sign * (how == Compensation::Longer ? radius : -radius);
  }
  target.at[static_cast<std::size_t>(axis)] = wanted + extra;
  state.polar.is_current = false;
  if (!go_straight(run, block, target)) return false;
  state.stand_beside(axis, wanted, extra);
  state.last.exists = false;
  state.last.is_single_offset = is_offset;
  return true;
}

}  // namespace dripline::interpreter::tnc155
