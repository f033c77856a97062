#include "gateway/interpreter/dialects/fanuc/compensation/cutter_compensation.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <cmath>

#include "gateway/interpreter/dialects/fanuc/execution/coordinates.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/rotary_plane.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/tool_offsets.hpp"
#include "gateway/interpreter/dialects/fanuc/run.hpp"

namespace dripline::interpreter::fanuc {
namespace {

using compensation::FaultKind;

/// From the center of a nose to its imaginary tip, in radii along X and Z: 1 to 9, and 0.
struct TipDirection {
  int x, z;
};
constexpr std::array<TipDirection, 10> kTips{
    {{0, 0}, {1, 1}, {1, -1}, {-1, -1}, {-1, 1}, {0, 1}, {1, 0}, {0, -1}, {-1, 0}, {0, 0}}};

void place_tip(const Run& run, compensation::Cutter& cutter) {
  const double number = run.memory.tools.tip[static_cast<std::size_t>(run.state.d_number)];
  const TipDirection tip = kTips[number >= 0 && number <= 9 ? static_cast<std::size_t>(number) : 0];
  const double radius = cutter.radius.mm();
  if (cutter.plane != Plane::ZX) return;  // in other planes a milling tool cuts
  cutter.tip_first = Length::mm(tip.z * radius);
  cutter.tip_second = Length::mm(tip.x * radius);
}

compensation::Cutter cutter_of(const Run& run) {
  compensation::Cutter cutter;
  cutter.plane = run.state.plane();
  cutter.side =
      run.state.g[kCompensationGroup] == 41 ? compensation::Side::Left : compensation::Side::Right;
  cutter.radius = Length::mm(radius_of_offset(run, run.state.d_number));
  if (run.options.is_lathe) place_tip(run, cutter);
  if (run.state.is_transformed && is_plane_mirrored(run.state, run.state.plane())) {
    cutter.side = cutter.side == compensation::Side::Left ? compensation::Side::Right
                                                          : compensation::Side::Left;
  }
  return cutter;
}

const DiagnosticRow& code_of(FaultKind kind) {
  switch (kind) {
    case FaultKind::NoIntersection:
      return ErrorCode::NoSolution;
    case FaultKind::StartUpNotStraight:
    case FaultKind::CancelNotStraight:
      return ErrorCode::ArcAtStartUp;
    case FaultKind::OtherPlane:
      return ErrorCode::PlaneInCompensation;
    default:
      return ErrorCode::Interference;
  }
}

const DiagnosticRow& code_of(blending::FaultKind kind) {
  switch (kind) {
    case blending::FaultKind::DoesNotFit:
      return ErrorCode::CornerTooLarge;
    case blending::FaultKind::ChamferAtArc:
      return ErrorCode::NotStraightCorner;
    case blending::FaultKind::OtherPlane:
      return ErrorCode::IllegalPlane;
    case blending::FaultKind::OffArc:
      return ErrorCode::RadiusTolerance;
    default:
      return ErrorCode::MissingAfterCorner;
  }
}

void begin_stages(Run& run) {
  ModalState& state = run.state;
  if (state.uses_compensator) return;
  run.events();  // the header first
  run.compensator.reset(state.position);
  if (!run.tilted.is_on()) run.tilted.place(state.position, run.increments.mm_per_unit);
  state.uses_compensator = true;
  run.lead_stages();
}

/// False: an alarm.
bool turn_on(Run& run) {
  ModalState& state = run.state;
  begin_stages(run);
  run.blender.flush();
  // D0 cancels: the next move goes to its programmed end
  if (state.d_number == 0 && run.compensator.is_on()) {
    run.compensator.turn_off();
    return true;
  }
  const compensation::Cutter cutter = cutter_of(run);
  if (run.compensator.changes_tip(cutter)) {
    // The move that waits ends with the nose that was; that of the next one is elsewhere.
    return run.fail(ErrorCode::ImproperCommand, run.block.words.column(T),
                    "T changes the nose radius or the tip's direction within G41 or G42");
  }
  run.compensator.turn_on(cutter);
  return true;
}

/// I, J, K of G39, of length 1, as scaling and rotation turn it. False: an alarm.
bool read_direction(Run& run, PlaneVector& direction) {
  const Words& words = run.block.words;
  const PlaneAxes axes = axes_of(run.state.plane());
  constexpr std::array<Address, 3> kComponents{I, J, K};
  Point3 from = program_position(run);
  Point3 to = from;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!words.has(kComponents[i])) continue;
    if (static_cast<Axis>(i) == axes.normal) {
      return run.fail(ErrorCode::IllegalPlaneAxis, words.column(kComponents[i]),
                      fmt::format("{}", letter(kComponents[i])));
    }
    to[i] += run.length(words[kComponents[i]]);
  }
  if (run.state.is_transformed) {
    from = transform(run.state, from);
    to = transform(run.state, to);
  }
  const auto along = [&](Axis axis) {
    return to[static_cast<std::size_t>(axis)] - from[static_cast<std::size_t>(axis)];
  };
  const PlaneVector vector{along(axes.first), along(axes.second)};
  const double size = length(vector);
  if (!(size > 0)) {
    return run.fail(ErrorCode::CornerMoveNotAllowed, words.first_column(kCenterWords),
                    "I, J, K say no direction");
  }
  direction = (1 / size) * vector;
  return true;
}

void end_on_normal(Run& run) {
  run.blender.flush();
  run.compensator.flush();
}

bool refuse_corner(Run& run, std::string_view why) {
  return run.fail(ErrorCode::CornerMoveNotAllowed, run.block.parts.g_column, why);
}

bool reaches_machine(const Block& block) {
  const Block::Parts& parts = block.parts;
  if (parts.kind != BlockKind::Nc || parts.ending == Ending::Return) return false;
  if (parts.m_count == 1 && block.m[0] == 98) return block.words.has_any(kAxisWords);
  return (block.words.present() & ~set_of(N, O)) != 0 || parts.groups != 0 || parts.m_count != 0 ||
         parts.one_shot != Block::kNoCode;
}

}  // namespace

compensation::Policy policy_of(const ControlOptions& options) {
  compensation::Policy policy;
  policy.cutter_change = compensation::CutterChange::AtNextEnd;
  if (options.start_up_b) {
    policy.start_up = compensation::StartUp::Corner;
    policy.cancel = compensation::Cancel::Corner;
  }
  return policy;
}

blending::Policy corner_policy() {
  return {.every_move_waits = false, .refuses_open_corner = true, .refuses_straight_corner = false};
}

bool end_waiting(Run& run) {
  if (!run.state.uses_blender) return true;
  run.blender.flush();
  return check_compensation(run);
}

bool announce_corner(Run& run) {
  ModalState& state = run.state;
  const Block::Parts& parts = run.block.parts;
  const bool is_scaled = state.g[kScalingGroup] == 51 &&
                         !std::all_of(state.scaling.factor.begin(), state.scaling.factor.end(),
                                      [](double factor) { return std::fabs(factor) == 1; });
  if (is_scaled || state.imaginary != 0) {
    return run.fail(ErrorCode::CornerOfNoMove, parts.corner_column,
                    is_scaled ? "a corner under scaling" : "a corner with an imaginary axis");
  }
  begin_stages(run);
  if (!state.uses_blender) {
    run.blender.reset(state.position);
    state.uses_blender = true;
    run.lead_stages();
  }
  run.blender.set_plane(state.plane());
  const Length size = Length::mm(parts.corner_size);
  if (parts.corner == CornerKind::Round) {
    run.blender.round_next_corner(size);
  } else {
    run.blender.chamfer_next_corner(size);
  }
  return true;
}

bool check_open_corner(Run& run) {
  if (!run.state.uses_blender || !reaches_machine(run.block)) return true;
  const Origin* corner = run.blender.open_corner();
  if (corner == nullptr || corner->block == run.origin.block) return true;
  const bool moves = run.block.words.has_any(kAxisWords | kCenterWords);
  const std::uint64_t line = run.origin.line;
  run.origin.line = corner->line;
  return run.fail(moves ? ErrorCode::MissingAfterCorner : ErrorCode::NotStraightCorner, 0,
                  fmt::format("line {} follows, which does not move in the plane", line));
}

bool apply_compensation(Run& run) {
  ModalState& state = run.state;
  const Block& block = run.block;
  const bool was_on = state.is_compensating();
  if (was_on && block.names(kPlaneGroup) && block.g[kPlaneGroup] != state.g[kPlaneGroup]) {
    return run.fail(ErrorCode::PlaneInCompensation, block.parts.g_column);
  }
  const bool is_lathe = run.options.is_lathe;
  if (!is_lathe && block.words.has(D) && !read_offset_number(run, D, state.d_number)) return false;
  const bool is_cycle =
      block.parts.one_shot >= kTurningCycles && block.parts.one_shot != Block::kNoCode;
  if (is_lathe && block.words.has(D) && !is_cycle) {
    return run.fail(ErrorCode::ImproperCommand, block.words.column(D),
                    "a lathe takes the offset of G41 and G42 from T");
  }
  const bool has_number = block.words.has(is_lathe ? T : D);
  if (!block.names(kCompensationGroup)) {
    return !was_on || !has_number || run.is_recording() || turn_on(run);
  }
  const std::uint8_t code = block.g[kCompensationGroup];
  if (block.words.has_any(kCenterWords) && state.g[kMotionGroup] < 2 && !state.is_cycle() &&
      block.parts.one_shot == Block::kNoCode) {
    // A vector that the control would aim at: without it the tool goes elsewhere.
    return run.fail(ErrorCode::ImproperCommand, block.words.first_column(kCenterWords),
                    fmt::format("I, J, K beside G{}: a vector is not supported", code));
  }
  if (run.is_recording()) {  // the finishing cut goes along the compensated contour
    state.g[kCompensationGroup] = code;
    return true;
  }
  const bool changes = code != state.g[kCompensationGroup] || has_number;
  state.g[kCompensationGroup] = code;
  if (code != 40) {
    if (changes) return turn_on(run);
    // Alone it has the move before it end on its own normal, whatever the corner.
    if (!block.words.has_any(kAxisWords)) end_on_normal(run);
  } else if (was_on) {
    run.blender.flush();
    run.compensator.turn_off();
  }
  return true;
}

bool round_corner(Run& run) {
  const Words& words = run.block.words;
  if (!run.state.is_compensating()) return refuse_corner(run, "without G41 or G42");
  if (words.has_any(kAxisWords)) return refuse_corner(run, "with a move in its block");
  if (!check_feed(run)) return false;
  std::optional<PlaneVector> direction;
  if (words.has_any(kCenterWords) && !read_direction(run, direction.emplace())) return false;
  if (!end_waiting(run)) return false;
  // D0: nothing to go round
  if (!run.compensator.is_on()) return true;
  if (run.compensator.round_outside_corner(run.origin, run.active_feed(), direction)) return true;
  return refuse_corner(run, "before a compensated move");
}

void interrupt_compensation(Run& run, bool first_keeps_distance) {
  if (!run.state.uses_compensator || !run.state.is_compensating()) return;
  run.blender.flush();
  if (first_keeps_distance) {
    run.compensator.cancel_in_parallel();
  } else {
    run.compensator.cancel();
  }
}

void resume_compensation(Run& run) {
  if (!run.state.uses_compensator || !run.state.is_compensating()) return;
  run.compensator.turn_on(cutter_of(run));
}

void end_compensated_block(Run& run) {
  if (reaches_machine(run.block)) {
    run.path().on_block_end(run.origin);
  } else {
    run.path().on_uncounted_block_end(run.origin);
  }
}

bool check_compensation(Run& run) {
  if (const auto& fault = run.blender.fault()) {
    run.origin.line = fault->origin.line;
    return run.fail(code_of(fault->kind), 0, blending::describe(*fault, run.state.units));
  }
  const auto& fault = run.compensator.fault();
  if (!fault) return check_last_stage(run);
  run.origin.line = fault->origin.line;
  return run.fail(code_of(fault->kind), 0, compensation::describe(*fault, run.state.units));
}

}  // namespace dripline::interpreter::fanuc
