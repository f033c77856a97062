#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/fanuc/turning/passes.hpp"
#include "gateway/interpreter/dialects/fanuc/turning/turning.hpp"

/// G71 and G72 of type I, and G73: the passes along a recorded contour, which G70 then finishes.
namespace dripline::interpreter::fanuc {
namespace {

/// Type I, and G73.
class ParallelPasses : public Passes {
 public:
  using Passes::Passes;

  bool rough() {
    if (!check_contour()) return false;
    const Place shift = place_of(cycle_.allowance_x, cycle_.allowance_z);
    const Place begin{start_.depth + shift.depth, start_.along + shift.along};
    const double bottom = first_.depth + shift.depth;
    const double depth = run_.state.turning.depth;
    if (!(std::fabs(begin.depth - bottom) / depth <= kMaxPasses)) {
      return refuse(fmt::format("more than {} cuts", kMaxPasses));
    }
    if (!rapid(begin)) return false;
    for (int cut = 1;; ++cut) {
      const double level = begin.depth - out_ * depth * cut;
      if (out_ * (level - bottom) <= kClose) break;
      if (!cut_level(level, begin, shift)) return false;
    }
    if (!approach({bottom, begin.along}) || !follow(1, cycle_.allowance_x, cycle_.allowance_z)) {
      return false;
    }
    return rapid({begin.depth, here().along}) && rapid(start_);
  }

  bool repeat() {
    const TurningData& data = run_.state.turning;
    const int passes = static_cast<int>(data.repeats);
    for (int pass = 0; pass < passes; ++pass) {
      const double part = passes == 1 ? 0 : static_cast<double>(passes - 1 - pass) / (passes - 1);
      const double x = cycle_.allowance_x + data.relief_x * part;
      const double z = cycle_.allowance_z + data.relief_z * part;
      const Position& at = run_.state.modes_before.position;
      const Place begin = place_of(at.raw(Axis::X) + x, at.raw(Axis::Z) + z);
      if (!leave_contour(run_, on_machine(begin)) || !follow(0, x, z)) return false;
    }
    return leave_contour(run_, on_machine(start_));
  }

 private:
  /// The first move goes down to the contour, along the depth alone; the rest is monotonic in both
  /// axes, and not beyond the start, to which the last cut returns.
  bool check_contour() {
    const auto& moves = cycle_.moves;
    if (moves.size() < 2) return refuse("there is no contour from P to Q");
    first_ = place_of(moves[0].x, moves[0].z);
    if (std::fabs(first_.along - start_.along) > kClose || moves[0].is_arc) {
      return refuse(is_facing_ ? "the first block of the contour moves Z alone"
                               : "the first block of the contour moves X alone");
    }
    out_ = start_.depth > first_.depth ? 1 : -1;
    const Place last = place_of(moves.back().x, moves.back().z);
    forward_ = last.along < first_.along ? -1 : 1;
    if (!check_allowance()) return false;
    Place from = first_;
    for (std::size_t i = 1; i < moves.size(); ++i) {
      const Place to = place_of(moves[i].x, moves[i].z);
      if (moves[i].is_rapid) return refuse("G00 within the contour");
      const bool is_monotonic = out_ * (to.depth - from.depth) >= -kClose &&
                                forward_ * (to.along - from.along) >= -kClose &&
                                (!moves[i].is_arc || is_monotonic_arc(moves[i], from, to));
      if (!is_monotonic) {
        return run_.fail(ErrorCode::NotMonotonic, 0,
                         fmt::format("move {} of the contour turns back", i + 1));
      }
      if (out_ * (to.depth - start_.depth) > kClose) {
        return refuse_beyond(i);
      }
      from = to;
    }
    return true;
  }

  /// Within a quarter of its circle.
  bool is_monotonic_arc(const ContourMove& arc, Place from, Place to) const {
    const Place center = place_of(arc.center_x, arc.center_z);
    const auto same_side = [](double a, double b) { return a * b >= -kClose; };
    return arc.sweep <= 90 + 1e-6 &&
           same_side(from.depth - center.depth, to.depth - center.depth) &&
           same_side(from.along - center.along, to.along - center.along);
  }

  /// Where the contour, shifted, comes up through the level.
  double along_at(double level, Place shift) const {
    Place from = first_;
    for (std::size_t i = 1; i < cycle_.moves.size(); ++i) {
      const ContourMove& move = cycle_.moves[i];
      const Place to = place_of(move.x, move.z);
      if (out_ * (to.depth + shift.depth - level) >= 0 &&
          std::fabs(to.depth - from.depth) > kClose) {
        return along_on(move, from, to, level - shift.depth) + shift.along;
      }
      from = to;
    }
    return from.along + shift.along;
  }

  double along_on(const ContourMove& move, Place from, Place to, double depth) const {
    if (!move.is_arc) {
      const double part = (depth - from.depth) / (to.depth - from.depth);
      return from.along + part * (to.along - from.along);
    }
    const Place center = place_of(move.center_x, move.center_z);
    const double radius = std::hypot(from.depth - center.depth, from.along - center.along);
    const double across = depth - center.depth;
    const double reach = std::sqrt(std::max(0.0, radius * radius - across * across));
    const double middle = (from.along + to.along) / 2;
    return center.along + (middle >= center.along ? reach : -reach);
  }

  bool cut_level(double level, Place begin, Place shift) {
    const double end = along_at(level, shift);
    if (forward_ * (end - begin.along) <= kClose) return true;  // nothing is left at this level
    const double escape = run_.state.turning.escape;
    return approach({level, begin.along}) && feed({level, end}) &&
           rapid({level + out_ * escape, end - forward_ * escape}) &&
           rapid({level + out_ * escape, begin.along});
  }
};

}  // namespace

bool make_passes(Run& run) {
  if (run.state.contour.is_type_two) return rough_pockets(run);
  ParallelPasses passes(run);
  return run.state.contour.code == 173 ? passes.repeat() : passes.rough();
}

}  // namespace dripline::interpreter::fanuc
