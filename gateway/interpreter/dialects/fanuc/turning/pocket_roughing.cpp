#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/fanuc/turning/passes.hpp"
#include "gateway/interpreter/dialects/fanuc/turning/pockets.hpp"

/// G71 and G72 of type II: passes that follow the contour into its pockets.
namespace dripline::interpreter::fanuc {
namespace {

class PocketPasses : public Passes {
 public:
  using Passes::Passes;

  bool rough() {
    if (!take_frame() || !read_profile()) return false;
    const Place shift = place_of(cycle_.allowance_x, cycle_.allowance_z);
    PocketCuts cuts{profile_, in_frame({start_.depth + shift.depth, start_.along + shift.along}),
                    run_.state.turning.depth, run_.state.turning.escape};
    const ProfilePoint off = in_frame(shift);
    interpreter::shift(cuts.profile, off.depth, off.along);
    if (off.along != 0 && reaches_into(cuts.profile, profile_)) {
      return refuse(
          fmt::format("the finish allowance {} leads into the part where the contour "
                      "goes down: {}0",
                      is_facing_ ? "U" : "W", is_facing_ ? "U" : "W"));
    }
    const std::size_t pockets = count_pockets(cuts);
    const std::size_t limit = run_.options.max_pockets;
    if (limit != 0 && pockets > limit) {
      return run_.fail(ErrorCode::TooManyPockets, 0,
                       fmt::format("{}; this model cuts {}", pockets, limit));
    }
    const ProfilePoint end = cuts.profile.back().to;
    add_line(cuts.profile, end, {cuts.begin.depth, end.along});
    const auto moves = cut_pockets(cuts, static_cast<std::size_t>(kMaxPasses));
    if (!moves) return refuse(fmt::format("more than {} cuts", kMaxPasses));
    run_.state.turning.has_faced = is_facing_;
    const Place begin = out_of_frame(cuts.begin);
    if (!rapid(begin)) return false;
    for (const PassMove& move : *moves) {
      if (!make(move)) return false;
    }
    if (is_straight_ && !approach({first_.depth + shift.depth, begin.along})) return false;
    return follow(is_straight_ ? 1 : 0, cycle_.allowance_x, cycle_.allowance_z) &&
           rapid({begin.depth, here().along}) && rapid(start_);
  }

 private:
  /// Of type II: the direction of the cuts, which the contour shows where it leaves the start.
  bool take_frame() {
    const auto& moves = cycle_.moves;
    if (moves.size() < 2) return refuse("there is no contour from P to Q");
    first_ = place_of(moves[0].x, moves[0].z);
    is_straight_ = !moves[0].is_arc && std::fabs(first_.along - start_.along) <= kClose;
    if (!is_straight_ && moves[0].is_rapid) {
      return refuse(
          fmt::format("the block of P leads along {} in G00, which is no line of the "
                      "contour: G01, or {} of the start point",
                      is_facing_ ? "X" : "Z", is_facing_ ? "X" : "Z"));
    }
    double drop = 0;
    for (const ContourMove& move : moves) {
      drop = start_.depth - place_of(move.x, move.z).depth;
      if (std::fabs(drop) > kClose) break;
    }
    if (std::fabs(drop) <= kClose) return refuse("the contour does not leave the start point");
    out_ = drop > 0 ? 1 : -1;
    forward_ = place_of(moves.back().x, moves.back().z).along < start_.along ? -1 : 1;
    return check_allowance();
  }

  /// The contour as it is programmed: monotonic along the cuts, and not beyond the start.
  bool read_profile() {
    const auto& moves = cycle_.moves;
    Place from = is_straight_ ? first_ : start_;
    if (out_ * (first_.depth - start_.depth) > kClose) return refuse_beyond(0);
    for (std::size_t i = is_straight_ ? 1 : 0; i < moves.size(); ++i) {
      const ContourMove& move = moves[i];
      if (i > 0 && move.is_rapid) return refuse("G00 within the contour");
      const std::size_t before = profile_.size();
      const Place to = place_of(move.x, move.z);
      if (move.is_arc) {
        add_arc(profile_,
                {in_frame(from), in_frame(to), in_frame(place_of(move.center_x, move.center_z)),
                 move.is_clockwise != keeps_rotation(), move.sweep});
      } else {
        add_line(profile_, in_frame(from), in_frame(to));
      }
      for (std::size_t n = before; n < profile_.size(); ++n) {
        ProfilePiece& piece = profile_[n];
        if (n > 0) piece.from.along = std::max(piece.from.along, profile_[n - 1].to.along);
        if (piece.to.along < piece.from.along - kClose) {
          return run_.fail(ErrorCode::NotMonotonic, 0,
                           fmt::format("move {} of the contour reverses along {}", i + 1,
                                       is_facing_ ? "X" : "Z"));
        }
        piece.to.along = std::max(piece.to.along, piece.from.along);
        if (piece.to.depth > in_frame(start_).depth + kClose) return refuse_beyond(i);
      }
      from = to;
    }
    return true;
  }

  /// As profile.hpp has it: out of the work, and with the cuts.
  ProfilePoint in_frame(Place at) const { return {out_ * at.depth, forward_ * at.along}; }
  Place out_of_frame(ProfilePoint at) const {
    return {out_ * at.depth + 0.0, forward_ * at.along + 0.0};  // no -0
  }
  bool keeps_rotation() const { return (out_ * forward_ > 0) != is_facing_; }

  bool make(const PassMove& move) {
    const Place to = out_of_frame(move.to);
    switch (move.kind) {
      case PassMove::Kind::Rapid:
        return rapid(to);
      case PassMove::Kind::Approach:
        return approach(to);
      case PassMove::Kind::Line:
        return feed(to);
      case PassMove::Kind::Arc:
        break;
    }
    const Place center = out_of_frame(move.center);
    const Place from = here();
    const double cross = (from.depth - center.depth) * (to.along - center.along) -
                         (from.along - center.along) * (to.depth - center.depth);
    const double dot = (from.depth - center.depth) * (to.depth - center.depth) +
                       (from.along - center.along) * (to.along - center.along);
    return arc({.is_arc = true,
                .is_clockwise = move.is_counterclockwise != keeps_rotation(),
                .center_x = is_facing_ ? center.along : center.depth,
                .center_z = is_facing_ ? center.depth : center.along,
                .sweep = Angle::radians(std::fabs(std::atan2(cross, dot))).degrees()},
               to);
  }

  bool is_straight_ = true;  ///< the first move leads down to the contour along the depth alone
  ProfilePieces profile_;    ///< without allowance
};

}  // namespace

bool rough_pockets(Run& run) {
  return PocketPasses(run).rough();
}

}  // namespace dripline::interpreter::fanuc
