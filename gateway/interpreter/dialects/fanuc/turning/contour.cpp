#include "gateway/interpreter/dialects/fanuc/turning/contour.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include "gateway/interpreter/dialects/fanuc/compensation/cutter_compensation.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"
#include "gateway/interpreter/dialects/fanuc/turning/turning.hpp"

namespace dripline::interpreter::fanuc {

void ContourRecorder::add(const ContourMove& move) {
  if (!is_full()) moves_.push_back(move);
}

void ContourRecorder::on_rapid(const Rapid& event) {
  add({.x = event.to.raw(Axis::X), .z = event.to.raw(Axis::Z), .is_rapid = true});
}

void ContourRecorder::on_line(const Line& event) {
  add({.x = event.to.raw(Axis::X), .z = event.to.raw(Axis::Z)});
}

void ContourRecorder::on_arc(const Arc& event) {
  add({.x = event.to.raw(Axis::X),
       .z = event.to.raw(Axis::Z),
       .is_arc = true,
       .is_clockwise = event.turn == Turn::Clockwise,
       .center_x = event.center_second.mm(),
       .center_z = event.center_first.mm(),
       .sweep = event.sweep.degrees()});
}

namespace {

bool refuse_contour(Run& run, std::string_view why) {
  return run.fail(ErrorCode::IllegalContour, 0, why);
}

/// The modes that the blocks of a recorded contour must not leave in force.
void take_back_modes(Run& run) {
  ModalState& state = run.state;
  const ModesBefore& before = state.modes_before;
  state.g = before.g;
  state.feed = before.feed;
  state.position = before.position;
  state.spindle = before.spindle;
  state.coolant = before.coolant;
  state.tool = before.tool;
  state.h_number = before.h_number;
  state.d_number = before.d_number;
}

bool is_monotonic(std::span<const ContourMove> moves, double start, double ContourMove::*at) {
  constexpr double kClose = 1e-6;
  bool rises = false;
  bool falls = false;
  double from = start;
  for (const ContourMove& move : moves) {
    rises |= move.*at > from + kClose;
    falls |= move.*at < from - kClose;
    from = move.*at;
  }
  return !(rises && falls);
}

/// The axis that leads off the work, where the straight path back may lead through a shoulder.
/// nullopt: it does not, or no axis is known to.
std::optional<Axis> leaving_axis(const ModalState& state) {
  const ContourCycle& cycle = state.contour;
  std::span<const ContourMove> moves = cycle.moves;
  const Position& start = state.modes_before.position;
  ContourMove from{.x = start.raw(Axis::X), .z = start.raw(Axis::Z)};
  if (!cycle.is_type_two && !moves.empty()) {  // the block of P leads to the contour
    from = moves.front();
    moves = moves.subspan(1);
  }
  const bool is_turned = is_monotonic(moves, from.z, &ContourMove::z);
  const bool is_faced = is_monotonic(moves, from.x, &ContourMove::x);
  const bool is_open = !cycle.is_type_two && is_turned && is_faced;
  if (is_open || (!is_turned && !is_faced)) return std::nullopt;
  return is_faced && (state.turning.has_faced || !is_turned) ? Axis::Z : Axis::X;
}

bool end_contour(Run& run) {
  ModalState& state = run.state;
  ContourCycle& cycle = state.contour;
  const bool is_finishing = cycle.code == 170;
  if (!end_waiting(run)) return false;
  const Position start = state.modes_before.position;
  if (!is_finishing) take_back_modes(run);
  const std::uint8_t code = cycle.code;
  cycle.code = 0;
  run.lead_stages();
  if (state.uses_compensator && !is_finishing) {
    run.compensator.place(state.position);
    run.blender.place(state.position);
  }
  cycle.code = code;
  const bool is_done = is_finishing ? leave_contour(run, start) : make_passes(run);
  cycle.code = 0;
  cycle.moves.clear();
  run.lead_stages();
  if (!is_done) return false;
  // The program continues after a contour that follows its cycle; another one is left again.
  const bool continues = !is_finishing && state.at.offset > cycle.back.offset;
  if (!continues) state.at = cycle.back;
  run.update_special();
  return true;
}

/// Whether the block takes another code of the group than the one in force.
bool changes(const Run& run, Group group) {
  return run.block.names(group) && run.block.g[group] != run.state.g[group];
}

}  // namespace

bool leave_contour(Run& run, const Position& to) {
  if (const auto first = leaving_axis(run.state)) {
    Position off = run.state.position;
    off.set_raw(*first, to.raw(*first));
    if (!rapid_to(run, off)) return false;
  }
  return rapid_to(run, to);
}

namespace {

/// Alarm 065 of the manual: the block of P has G00 or G01, and of G71 and G72 the axis of the
/// depth. With the other axis as well it asks for type II, which cuts pockets along the contour.
bool check_first_block(Run& run) {
  const Block& block = run.block;
  ContourCycle& cycle = run.state.contour;
  if (std::exchange(cycle.has_begun, true)) return true;
  const bool names_x = block.words.has_any(set_of(X, U));
  const bool names_z = block.words.has_any(set_of(Z, W));
  const bool names_both = names_x && names_z;
  if (cycle.code == kTurningCycles) {
    cycle.is_type_two = names_both;
    return true;
  }
  if (!block.names(kMotionGroup) || block.g[kMotionGroup] > 1)
    return refuse_contour(run, "the block of P has no G00 or G01");
  if (cycle.code == kTurningCycles + 3) return true;
  cycle.is_type_two = names_both;
  const bool is_turning = cycle.code == kTurningCycles + 1;
  if (names_both || !(is_turning ? names_z : names_x)) return true;
  const AddressSet other = is_turning ? set_of(Z, W) : set_of(X, U);
  return run.fail(ErrorCode::IllegalContour, block.words.first_column(other),
                  fmt::format("the block of P names {} and not {}", is_turning ? "Z" : "X",
                              is_turning ? "X" : "Z"));
}

}  // namespace

/// The manual excludes one-shot codes but G04, motion codes but G00 to G03, and G20 and G21. What
/// moves the zero, the plane or the coordinates is excluded here: roughing knows one of each.
/// A 30i-T has G41 and G42 before the cycle and G40 after it (user's manual for lathes, multiple
/// repetitive cycles, limitations); older lathes take them within the contour, for G70.
bool check_contour_block(Run& run) {
  const Block& block = run.block;
  if (block.names(kCompensationGroup) && !run.options.compensates_in_contour) {
    return run.fail(
        ErrorCode::ShapeCommand, block.parts.g_column,
        fmt::format("G{} comes before the cycle, G40 after it", block.g[kCompensationGroup]));
  }
  const std::uint8_t one_shot = block.parts.one_shot;
  const std::uint8_t motion =
      block.names(kMotionGroup) ? block.g[kMotionGroup] : run.state.g[kMotionGroup];
  const bool moves = block.names(kMotionGroup) || block.words.has_any(kAxisWords);
  constexpr std::array kNever{kUnitsGroup, kMirrorGroup, kInterpolationGroup};
  constexpr std::array kFixed{kPlaneGroup, kStrokeGroup, kWorkGroup, kPolarGroup};
  const bool is_allowed =
      (one_shot == Block::kNoCode || one_shot == 4) && (motion <= 3 || !moves) &&
      std::none_of(kNever.begin(), kNever.end(), [&](Group group) { return block.names(group); }) &&
      std::none_of(kFixed.begin(), kFixed.end(), [&](Group group) { return changes(run, group); });
  if (is_allowed) return check_first_block(run);
  return run.fail(ErrorCode::IllegalContour, block.parts.g_column,
                  "the blocks from P to Q take G00 to G03, G04 and no other motion, zero, plane or "
                  "units");
}

bool follow_contour(Run& run) {
  ModalState& state = run.state;
  ContourCycle& cycle = state.contour;
  if (!cycle.has_place) {
    cycle.back = state.at;
    cycle.has_place = true;
    return true;
  }
  if (state.at.program != cycle.back.program) {
    return refuse_contour(run, "the blocks from P to Q call a program");
  }
  if (run.block.parts.ending != Ending::None || state.jump.kind == JumpKind::Call) {
    return refuse_contour(run, fmt::format("the program ends or calls before N{}", cycle.last));
  }
  const bool has_room = cycle.is_type_two || cycle.moves.size() < ContourRecorder::kMaxMoves;
  if (cycle.code == kTurningCycles && has_room) {
    cycle.moves.push_back({.x = state.position.raw(Axis::X), .z = state.position.raw(Axis::Z)});
  }
  if (run.recorder.is_full()) {
    return refuse_contour(
        run, fmt::format("more than {} moves from P to Q", ContourRecorder::kMaxMoves));
  }
  if (run.origin.sequence != static_cast<std::int64_t>(cycle.last)) return true;
  if (state.jump.kind != JumpKind::None) {
    return refuse_contour(run, fmt::format("N{} jumps", cycle.last));
  }
  return end_contour(run);
}

}  // namespace dripline::interpreter::fanuc
