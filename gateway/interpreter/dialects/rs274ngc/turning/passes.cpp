#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/compensation/compensation.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/motion.hpp"
#include "gateway/interpreter/dialects/rs274ngc/turning/roughing.hpp"
#include "gateway/interpreter/dialects/rs274ngc/turning/turning.hpp"

/// From a recorded contour to the moves of its cycle.
namespace dripline::interpreter::rs274ngc {
namespace {

ContourPieces pieces_of(const TurningCycle& cycle, const CutFrame& frame) {
  ContourPieces pieces;
  PlaneVector from = frame.in(cycle.start);
  for (const ContourMove& move : cycle.moves) {
    ContourPiece piece{.from = from, .to = frame.in(move.to), .is_arc = move.is_arc};
    piece.center = move.is_arc ? frame.in(move.center) : PlaneVector{};
    piece.is_counterclockwise = move.is_arc && move.is_counterclockwise != frame.is_mirrored();
    pieces.push_back(piece);
    from = piece.to;
  }
  return pieces;
}

/// The contour of a lathe cycle, from its line to its moves. Nothing: an alarm.
class TurningPasses {
 public:
  TurningPasses(const TurningCycle& cycle, double mm_per_unit)
      : cycle_(cycle), limits_(mm_per_unit) {}

  bool plan() {
    why_ = "less than two moves";
    if (cycle_.moves.size() < 2 || !choose_frame()) return false;
    auto pieces = with_corners(pieces_of(cycle_, frame_), cycle_.moves, limits_, why_);
    if (!pieces) return false;
    why_ = "it begins where the cycle does";
    if (pieces->size() < 2 || pieces->front().is_arc ||
        length(frame_.in(cycle_.start) - pieces->front().from) > 0) {
      return false;
    }
    approach_ = pieces->front();
    contour_.assign(pieces->begin() + 1, pieces->end());
    why_ = "it is not monotonic";
    if (!is_monotonic(contour_)) return false;
    approach_.from.first = std::min(approach_.from.first, approach_.to.first);
    return is_finishing() ? plan_finishing() : plan_roughing();
  }

  std::string_view why() const { return why_; }
  const CutFrame& frame() const { return frame_; }
  const CutMoves& moves() const { return moves_; }

 private:
  bool is_finishing() const { return cycle_.code == 700; }
  bool is_monotonic(const ContourPieces& pieces) const {
    return std::ranges::all_of(pieces, [&](const auto& each) { return runs_along(each, limits_); });
  }

  bool choose_frame() {
    if (!is_finishing()) return choose_signs(cycle_.code / 10 == 72, false);
    // Along Z if that is monotonic, else along X.
    for (const bool is_facing : {false, true}) {
      if (!choose_signs(is_facing, true)) return false;
      const ContourPieces pieces = pieces_of(cycle_, frame_);
      if (is_monotonic({pieces.begin() + 1, pieces.end()})) return true;
    }
    why_ = "it is monotonic neither along Z nor along X";
    return false;
  }
  /// The cut runs from the first point to the last, and the start is out of the work.
  bool choose_signs(bool is_facing, bool may_be_beside) {
    frame_ = {.is_facing = is_facing};
    const PlaneVector start = frame_.in(cycle_.start);
    const PlaneVector first = frame_.in(cycle_.moves.front().to);
    const PlaneVector last = frame_.in(cycle_.moves.back().to);
    frame_.along_sign = last.first < first.first ? -1 : 1;
    double out = start.second - first.second;
    if (std::fabs(out) <= limits_.least && may_be_beside) {
      const PlaneVector end = frame_.in(cycle_.moves[cycle_.moves.size() - 2].to);
      out = frame_.along_sign * cross(first - start, end - start);
    }
    why_ = "the cycle begins at the depth of its first point";
    if (std::fabs(out) <= (may_be_beside ? 0 : limits_.least)) return false;
    frame_.depth_sign = out < 0 ? -1 : 1;
    return true;
  }

  bool set_off(double distance, ContourPieces& contour) {
    contour = contour_;
    if (distance == 0) return true;
    auto aside = kept_off(contour_, distance, limits_, why_);
    if (!aside) return false;
    contour = std::move(*aside);
    return true;
  }

  bool plan_roughing() {
    RoughingPlan plan;
    if (!set_off(cycle_.distance, plan.contour)) return false;
    plan.start = approach_.from;
    plan.increment = std::max(cycle_.increment, 2 * limits_.same);
    plan.retract = cycle_.retract;
    plan.pockets = static_cast<Pockets>(cycle_.code % 10);
    why_ = "the cycle begins at the depth of its first point";
    if (plan.start.second <= plan.contour.front().from.second + limits_.same) return false;
    moves_ = {{CutMove::Kind::Rapid, plan.start}};
    auto cuts = rough(plan, limits_, why_);
    if (!cuts) return false;
    moves_.insert(moves_.end(), cuts->begin(), cuts->end());
    return check_clear(moves_, plan.contour, frame_.in(cycle_.start));
  }

  bool plan_finishing() {
    PlaneVector from = frame_.in(cycle_.start);
    for (int pass = cycle_.passes; pass > 0; --pass) {
      const double over = (cycle_.distance - cycle_.last_distance) / cycle_.passes;
      ContourPieces contour;
      if (!set_off((pass - 1) * over + cycle_.last_distance, contour)) return false;
      CutMoves moves{{CutMove::Kind::Rapid, approach_.from},
                     {CutMove::Kind::Rapid, contour.front().from}};
      if (!check_clear(moves, contour, from)) return false;
      for (const ContourPiece& piece : contour) {
        moves.push_back({piece.is_arc ? CutMove::Kind::Arc : CutMove::Kind::Line, piece.to,
                         piece.center, piece.is_counterclockwise});
      }
      moves_.insert(moves_.end(), moves.begin(), moves.end());
      why_ = "too many moves";
      if (moves_.size() > kMaxCutMoves) return false;
      from = contour.back().to;
    }
    return true;
  }

  bool check_clear(const CutMoves& moves, const ContourPieces& contour, PlaneVector from) {
    why_ = "a move would lead through it";
    return is_clear(moves, from, contour, limits_);
  }

  const TurningCycle& cycle_;
  ContourLimits limits_;
  CutFrame frame_;
  ContourPiece approach_;
  ContourPieces contour_;
  CutMoves moves_;
  std::string_view why_;
};

bool deliver(Run& run, const CutMoves& moves, const CutFrame& frame, const Feed& feed) {
  for (const CutMove& move : moves) {
    const PlaneVector from = tool_point(run), to = frame.out(move.to);
    Target target{.to = run.state.position, .named = bit_of(Axis::X) | bit_of(Axis::Z)};
    target.to[index_of(Axis::Z)] = to.first;
    target.to[index_of(Axis::X)] = to.second;
    if (move.kind != CutMove::Kind::Arc) {
      move_to(run, target, move.kind == CutMove::Kind::Rapid, feed);
      continue;
    }
    const PlaneVector center = frame.out(move.center);
    const bool is_left = move.is_counterclockwise != frame.is_mirrored();
    ArcShape shape{.center_first = center.first, .center_second = center.second};
    shape.turn = is_left ? Turn::Counterclockwise : Turn::Clockwise;
    shape.sweep = sweep_of(center, from, to, shape.turn);
    if (!arc_to(run, target, shape, feed)) return false;
  }
  return true;
}

}  // namespace

bool make_turning(Run& run) {
  const TurningCycle cycle = run.state.turning;
  end_recording(run);
  Feed feed;
  if (!read_feed(run, false, feed)) return false;
  TurningPasses passes(cycle, run.state.mm_per_unit());
  if (passes.plan()) return deliver(run, passes.moves(), passes.frame(), feed);
  // Reported at the cycle.
  run.origin.line = cycle.line.line;
  run.origin.offset = cycle.line.offset;
  run.origin.program = cycle.line.program;
  return run.fail(ErrorCode::TurningContour, 1, passes.why());
}

}  // namespace dripline::interpreter::rs274ngc
