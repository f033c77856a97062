#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"

#include <fmt/core.h>
#include <cmath>
#include <utility>

#include "gateway/interpreter/core/shown_length.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

using compensation::OutsideCorner;

compensation::Cutter cutter_of(const State& state, Compensation side) {
  compensation::Cutter cutter;
  cutter.plane = state.plane;
  const bool is_left = (side == Compensation::Left) != state.transformation.turns_over(state.plane);
  cutter.side = is_left ? compensation::Side::Left : compensation::Side::Right;
  cutter.radius = Length::mm(state.tool.data.radius);
  return cutter;
}

/// The corner stage outputs what it holds: the block is not a side of a corner.
void release_corner(Run& run) {
  if (run.state.joins) run.blender.flush();
}

/// A nominal point of the plane where the machine has it.
PlaneVector in_machine(const State& state, PlaneVector at) {
  Target target = here(state);
  set_in_plane(state, target, at);
  return in_plane(machine_position(state, target), axes_of(state.plane));
}

bool refuse_start(Run& run, std::string_view why) {
  return run.fail(ErrorCode::PathOffsetWronglyStarted, why);
}

/// M96: the tool is on the offset path already. The programmed travel to P1 begins beside it.
bool start_from_offset(Run& run, const PlaneMove& move, const compensation::Cutter& cutter) {
  const double offset =
      cutter.side == compensation::Side::Left ? cutter.radius.mm() : -cutter.radius.mm();
  const PlaneVector tool = in_plane(run.compensator.sent(), axes_of(run.state.plane));
  const PlaneVector travel = in_machine(run.state, move.to) - tool;
  const double distance = length(travel);
  if (distance <= std::fabs(offset)) {
    return run.fail(
        ErrorCode::ToolRadiusTooLarge,
        fmt::format("{} to the first point", shown_length(Length::mm(distance), run.state.units)));
  }
  const double along = std::sqrt(distance * distance - offset * offset);
  const PlaneVector direction =
      (1 / (distance * distance)) * (along * travel + offset * left_of(travel));
  run.compensator.begin_contour(cutter, tool - offset * left_of(direction));
  return true;
}

void note_contour(State& state) {
  state.is_first_contour = !std::exchange(state.has_compensated, true);
}

bool start_contour(Run& run, const Block& block, const PlaneMove& move, Compensation side) {
  State& state = run.state;
  if (move.is_arc) return refuse_start(run, "a contour begins with a straight block");
  if (state.last.is_single_offset) return refuse_start(run, "R+ or R- in the block before");
  run.use_stages();
  release_corner(run);
  const compensation::Cutter cutter = cutter_of(state, side);
  note_contour(state);
  state.compensation = side;
  if (block.m == 96) return start_from_offset(run, move, cutter);
  if (move.has_any && !move.has_travel) {
    run.compensator.begin_contour(cutter);  // the tool is at P1: it goes to P1' all the same
  } else {
    run.compensator.turn_on(cutter);
  }
  return true;
}

/// After M98: the block keeps the distance the tool has, and a contour may begin at its end.
bool go_parallel(Run& run, const Block& block, const PlaneMove& move, Compensation side) {
  State& state = run.state;
  release_corner(run);
  if (block.compensation == Compensation::Off) {
    run.compensator.cancel();
    state.is_parallel = false;
    return true;
  }
  const bool begins = side == Compensation::Left || side == Compensation::Right;
  if (begins) {
    if (move.is_arc) return refuse_start(run, "a contour begins with a straight block");
    const compensation::Cutter cutter = cutter_of(state, side);
    note_contour(state);
    if (move.has_travel) {
      run.compensator.turn_on_in_parallel(cutter);
    } else {
      run.compensator.begin_contour(cutter);
    }
    state.compensation = side;
  }
  if (begins || move.has_travel) state.is_parallel = false;
  return true;
}

/// M95: the previous block begins the contour again, without compensation.
bool start_again(Run& run, const Block& block) {
  if (block.m != 95) return true;
  if (!run.state.last.starts_contour || !run.state.is_first_contour) {
    return refuse_start(run, "M95 is for the first compensated block of the run");
  }
  release_corner(run);
  run.compensator.start_again();
  return true;
}

/// R0 after a rounding leaves by an arc; other corners come before the end.
void finish_contour(Run& run) {
  State& state = run.state;
  Blend& blend = state.blend;
  const bool by_arc = blend.kind == BlendKind::TangentialDeparture ||
                      (blend.kind == BlendKind::Round && !blend.is_stated);
  state.compensation = Compensation::Off;
  if (!by_arc && blend.kind != BlendKind::None) return run.blender.turn_off();
  if (by_arc) run.blender.drop_corner();
  release_corner(run);
  if (!by_arc) return run.compensator.turn_off();
  run.compensator.turn_off_by_arc(blend.origin, Length::mm(blend.size));
  blend = Blend{};
}

bool change_compensation(Run& run, const Block& block, const PlaneMove& move) {
  State& state = run.state;
  Compensation side = block.compensation;
  if (side == Compensation::NotProgrammed) side = state.compensation;
  const bool is_side = side == Compensation::Left || side == Compensation::Right;
  const bool is_offset = side == Compensation::Longer || side == Compensation::Shorter;
  if (is_offset && (state.is_parallel || state.is_compensating())) {
    return refuse_start(run, "R+ and R- are only allowed between blocks with R0");
  }
  if (state.is_parallel) return go_parallel(run, block, move, side);
  if (!state.is_compensating()) {
    if (is_side) return start_contour(run, block, move, side);
    state.compensation = side;
    return true;
  }
  if (!is_side) {
    finish_contour(run);
    state.compensation = side;
    return true;
  }
  if (state.blend.kind == BlendKind::TangentialDeparture) {
    return refuse_start(run, "G27 is followed by the block with G40 that leaves the contour");
  }
  if (side != state.compensation) {
    if (run.options.is_itnc) return refuse_start(run, "between RL and RR comes a block with R0");
    if (state.joins) {
      run.blender.turn_on(cutter_of(state, side));
    } else {
      run.compensator.turn_on(cutter_of(state, side));
    }
    state.compensation = side;
  }
  return start_again(run, block);
}

/// A later control suspends RL and RR by M98 for its block only (iTNC 530, User's Manual: machining
/// open contour corners). Where its tool goes from there is a picture in the manual: without R0 the
/// path is not known.
bool is_after_m98(const Run& run) {
  return run.options.is_itnc && run.state.is_parallel && !run.state.needs_side;
}

bool is_plain(const State& state, const Block& block) {
  return !state.uses_stages &&
         (block.compensation == Compensation::NotProgrammed ||
          block.compensation == Compensation::Off) &&
         state.compensation == Compensation::Off;
}

void shape_corner(Run& run) {
  if (!run.state.is_compensating()) return;
  run.compensator.shape_next_corner(OutsideCorner::IntersectCurves);
}

/// Whether a side of a corner is certain to lie in the plane. A later control takes one coordinate
/// while RL or RR is in force (iTNC 530, User's Manual: corner rounding, chamfer and its example).
bool takes_one_coordinate(const Run& run) {
  return run.options.is_itnc && run.state.is_compensating();
}

/// The second side of a corner must lie in the plane as the first one does, and in its contour.
bool check_blend(Run& run, const Block& block, const PlaneMove& move) {
  const Blend& blend = run.state.blend;
  if (blend.kind == BlendKind::None) return true;
  if (blend.is_lost) {
    return run.fail(
        ErrorCode::PlaneWronglyDefined,
        fmt::format("the contour ended after RND or the chamfer of line {}", blend.origin.line));
  }
  const bool is_one = takes_one_coordinate(run) && block.compensation != Compensation::Off &&
                      (move.has_travel || move.is_arc);
  if ((move.has_both || is_one) && !move.has_third) return true;
  return run.fail(ErrorCode::PlaneWronglyDefined,
                  "the block after RND or a chamfer needs both coordinates of the plane only");
}

/// The tool comes from in front of P1' on the wrong side: the arc goes through the contour.
void warn_of_quadrant(Run& run, const PlaneMove& move) {
  State& state = run.state;
  LastMove next;
  next.is_arc = move.is_arc;
  next.from = move.to;  // the direction at the start: that of the reversed move's end, reversed
  next.to = move.from;
  next.center = move.center;
  next.turn = move.turn == Turn::Clockwise ? Turn::Counterclockwise : Turn::Clockwise;
  const PlaneVector along = -end_direction(next);
  const double sign = state.compensation == Compensation::Left ? 1 : -1;
  const PlaneVector first = move.from + sign * state.tool.data.radius * left_of(along);
  const PlaneVector travel = state.last.from - first;
  if (dot(travel, along) > 0 && cross(along, travel) * sign < 0) {
    run.warn("TNC-QUADRANT",
             "the tangential approach comes from quadrant IV: its arc cuts into the contour");
  }
}

/// F MAX applies to its own block only: a corner between rapid sides also has the contour feed.
bool has_corner_feed(Run& run, const Blend& blend) {
  const bool is_corner = blend.kind == BlendKind::Round || blend.kind == BlendKind::Chamfer;
  if (!is_corner || blend.size <= 0 || run.state.feed > 0) return true;
  return run.fail(ErrorCode::FeedRateMissing, "no F above 0 before RND or the chamfer");
}

}  // namespace

bool begin_move(Run& run, const Block& block, const PlaneMove& move) {
  run.starts_contour = false;
  if (is_plain(run.state, block)) [[likely]] {
    if (!run.blend_follows) return true;
  }
  State& state = run.state;
  if (!check_blend(run, block, move)) return false;
  if (is_after_m98(run) && move.has_any && block.compensation != Compensation::Off)
    return refuse_start(run, "the block after M98 needs R0 here");
  // The manual does not state whether the control continues beside the contour or on it: on it the
  // tool would cut too deep by its radius.
  if (block.compensation != Compensation::NotProgrammed) state.needs_side = false;
  if (state.needs_side && move.has_any) {
    return refuse_start(run,
                        "a tool call or the cycle of a transformation ended RL or RR, and the "
                        "block has neither these nor R0");
  }
  if (state.blend.kind == BlendKind::TangentialApproach) warn_of_quadrant(run, move);
  if (state.blend.kind == BlendKind::None) release_corner(run);
  const bool was_on = state.is_compensating();
  if (!change_compensation(run, block, move)) return false;
  if (!was_on) state.awaits_contour = state.is_compensating();
  if (block.m == 97 && !state.joins) shape_corner(run);
  // RND after the first compensated block is a tangential approach, which the compensation stage
  // makes
  run.starts_contour = state.is_compensating() && state.awaits_contour && move.has_any;
  if (run.blend_follows && !run.starts_contour) run.begin_blending();
  return true;
}

bool finish_move(Run& run, const Block& block, const PlaneMove& move) {
  State& state = run.state;
  LastMove& last = state.last;
  state.blend = Blend{};
  if (move.has_any) state.awaits_contour = false;
  if (block.m == 97 && state.joins) shape_corner(run);
  if (state.joins && !run.blend_follows) {
    run.blender.flush();
    state.joins = false;
  }
  last.exists = true;
  last.is_arc = move.is_arc;
  last.has_both = move.has_both;
  last.has_third = move.has_third;
  last.is_single_offset = false;
  last.starts_contour = run.starts_contour;
  last.from = move.from;
  last.to = move.to;
  last.center = move.center;
  last.turn = move.turn;
  if (block.m == 97 && !move.has_travel && state.is_compensating()) {
    // a line of no length between two elements: the corner is that of their tangents
    run.compensator.shape_corner(OutsideCorner::ExtendTangents);
  }
  if (block.m == 98 && state.is_compensating()) end_contour(run, true);
  return true;
}

bool make_blend(Run& run, const Block& block) {
  State& state = run.state;
  const LastMove& last = state.last;
  Blend blend;
  if (state.blend.kind != BlendKind::None) {
    return run.fail(ErrorCode::PlaneWronglyDefined, "RND and chamfers must directly follow a move");
  }
  blend.origin = run.origin;
  blend.size = run.length(block.radius);
  blend.kind = block.kind == BlockKind::Chamfer ? BlendKind::Chamfer : BlendKind::Round;
  const bool is_first = state.is_compensating() && last.starts_contour;
  if (block.rounding == RoundingUse::TangentialDeparture)
    blend.kind = BlendKind::TangentialDeparture;
  if (block.rounding == RoundingUse::TangentialApproach ||
      (blend.kind == BlendKind::Round && block.rounding == RoundingUse::Unstated && is_first)) {
    blend.kind = BlendKind::TangentialApproach;
  }
  blend.is_stated = block.rounding != RoundingUse::Unstated;
  const bool is_one =
      takes_one_coordinate(run) && !last.starts_contour && (last.is_arc || !(last.from == last.to));
  if (!last.exists || !(last.has_both || is_one) || last.has_third) {
    return run.fail(ErrorCode::PlaneWronglyDefined,
                    "the block before RND or a chamfer needs both coordinates of the plane only");
  }
  if (blend.kind == BlendKind::TangentialApproach && !is_first) {
    return refuse_start(run, "G26 is for the first compensated block");
  }
  if (blend.kind == BlendKind::TangentialDeparture && !state.is_compensating()) {
    return refuse_start(run, "G27 leaves a contour, and there is none");
  }
  if (blend.size < 0) {
    return run.fail(ErrorCode::EntryOutOfRange, fmt::format("R {} is less than 0", blend.size));
  }
  if (!has_corner_feed(run, blend)) return false;
  const Length size = Length::mm(blend.size * state.transformation.factor(state.plane));
  const Feed feed = Feed::per_minute(Length::mm(state.feed));
  blend.size = size.mm();
  state.blend = blend;
  if (blend.kind != BlendKind::TangentialApproach && !state.joins) {
    return run.fail(ErrorCode::PlaneWronglyDefined, "no move directly before RND or a chamfer");
  }
  switch (blend.kind) {
    case BlendKind::TangentialApproach:
      if (!run.compensator.approach_by_arc(run.origin, size)) {
        return refuse_start(run, "no travel to the first point before the arc that approaches it");
      }
      break;
    case BlendKind::Round:
    case BlendKind::TangentialDeparture:
      run.blender.round_corner(run.origin, size, feed);
      break;
    case BlendKind::Chamfer:
      run.blender.chamfer_corner(run.origin, size, blending::Chamfer::Leg, feed);
      break;
    case BlendKind::None:
      break;
  }
  return true;
}

void end_contour(Run& run, bool keeps_distance) {
  State& state = run.state;
  if (!state.uses_stages) return;
  release_corner(run);
  state.blend.is_lost = true;
  if (!state.is_compensating() && !state.is_parallel) return;
  state.compensation = Compensation::Off;
  state.is_parallel = keeps_distance;
  if (keeps_distance) {
    run.compensator.cancel_in_parallel();
  } else {
    run.compensator.cancel();
  }
}

void interrupt_contour(Run& run) {
  State& state = run.state;
  if (!state.uses_stages) return;
  release_corner(run);
  state.blend.is_lost = true;
  run.compensator.cancel();
  state.is_parallel = false;
}

void resume_contour(Run& run) {
  State& state = run.state;
  if (state.is_compensating()) run.compensator.turn_on(cutter_of(state, state.compensation));
}

void continue_contour(Run& run, const Position& programmed) {
  const State& state = run.state;
  const PlaneVector at = in_plane(programmed, axes_of(state.plane));
  if (!state.is_compensating() || state.awaits_contour) {
    run.compensator.cancel(at);
    return resume_contour(run);
  }
  run.compensator.begin_contour(cutter_of(state, state.compensation), at);
}

}  // namespace dripline::interpreter::tnc155
