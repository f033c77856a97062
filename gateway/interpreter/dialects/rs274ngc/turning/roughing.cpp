#include "gateway/interpreter/dialects/rs274ngc/turning/roughing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gateway/interpreter/dialects/rs274ngc/execution/motion.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

ProfilePoint profile_point(PlaneVector at) {
  return {at.second, at.first};
}

PlaneVector plane_point(const ProfilePoint& at) {
  return {at.along, at.depth};
}

void add_piece(ProfilePieces& profile, const ContourPiece& piece) {
  if (!piece.is_arc) return add_line(profile, profile_point(piece.from), profile_point(piece.to));
  const Turn turn = piece.is_counterclockwise ? Turn::Counterclockwise : Turn::Clockwise;
  add_arc(profile, {.from = profile_point(piece.from),
                    .to = profile_point(piece.to),
                    .center = profile_point(piece.center),
                    .is_counterclockwise = piece.is_counterclockwise,
                    .sweep = sweep_of(piece.center, piece.from, piece.to, turn)});
}

/// Cuts one pocket after the other: down the contour in steps, each a straight cut to where the
/// contour comes up, then up along the contour to where it goes down again.
class Roughing {
 public:
  Roughing(const RoughingPlan& plan, const ContourLimits& limits)
      : plan_(plan), limits_(limits), here_(profile_point(plan.start)) {
    add_line(profile_, here_, profile_point(plan.contour.front().from));
    for (const ContourPiece& piece : plan.contour) add_piece(profile_, piece);
    const ProfilePoint end = profile_.back().to;
    if (end.depth < here_.depth) add_line(profile_, end, {here_.depth, end.along});
  }

  bool make() {
    if (plan_.pockets == Pockets::Only) go_to_first_pocket();
    for (;;) {
      if (!cut_pocket()) return false;
      if (at_ == profile_.size()) return true;
      if (plan_.pockets == Pockets::None) {
        pass_over_pockets();
        return has_room();
      }
      while (at_ < profile_.size() && !goes_down(profile_[at_])) follow();
      if (at_ == profile_.size()) return has_room();
      if (plan_.pockets == Pockets::Only) note_top();
    }
  }

  CutMoves take() { return std::move(moves_); }

 private:
  bool has_room() const { return moves_.size() <= kMaxCutMoves; }
  bool goes_down(const ProfilePiece& piece) const {
    return piece.to.depth < piece.from.depth - limits_.same;
  }
  bool is_same(double a, double b) const { return std::fabs(a - b) <= limits_.same; }
  bool reaches(const ProfilePiece& piece, double level) const {
    const auto [low, high] = std::minmax(piece.from.depth, piece.to.depth);
    return low <= level + limits_.same && high >= level - limits_.same;
  }
  /// The first point of a piece at a level.
  double meets_at(const ProfilePiece& piece, double level) const {
    return is_same(piece.from.depth, piece.to.depth) ? piece.from.along : along_at(piece, level);
  }

  void move(CutMove::Kind kind, const ProfilePoint& to) {
    moves_.push_back({kind, plane_point(to)});
    here_ = to;
    followed_ = kNone;
  }
  void rapid(double along, double depth) { move(CutMove::Kind::Rapid, {depth, along}); }
  void feed(double along, double depth) { move(CutMove::Kind::Line, {depth, along}); }

  /// Along a piece up to `to`: down to the contour as the contour's first block says, rapidly.
  void follow_to(std::size_t at, const ProfilePoint& to) {
    const ProfilePiece& piece = profile_[at];
    if (!piece.is_arc) return move(at == 0 ? CutMove::Kind::Rapid : CutMove::Kind::Line, to);
    const std::size_t before = std::exchange(followed_, kNone);
    if (before != kNone && is_same_arc(profile_[before], piece)) {
      moves_.back().to = plane_point(to);
      here_ = to;
    } else if (std::hypot(to.along - here_.along, to.depth - here_.depth) <= limits_.shown) {
      here_ = to;
    } else {
      move(CutMove::Kind::Arc, to);
      moves_.back().center = plane_point(piece.center);
      moves_.back().is_counterclockwise = piece.is_counterclockwise;
    }
  }
  /// One move in the direction of the cut: but over the top of a hill, where a pocket may begin.
  bool is_same_arc(const ProfilePiece& before, const ProfilePiece& piece) const {
    return before.is_arc && before.center.along == piece.center.along &&
           before.center.depth == piece.center.depth && (goes_down(before) || !goes_down(piece));
  }
  void follow() {
    follow_to(at_, profile_[at_].to);
    if (profile_[at_].is_arc && !moves_.empty()) followed_ = at_;
    ++at_;
  }

  void go_to_first_pocket() {
    while (at_ < profile_.size() && goes_down(profile_[at_])) follow();
  }
  /// Down to where the contour comes up.
  bool cut_pocket() {
    double level = top_.value_or(plan_.start.second);
    while (at_ < profile_.size() && goes_down(profile_[at_])) {
      if (!has_room()) return false;
      if (level - limits_.same > here_.depth) {
        const double steps = std::ceil((level - limits_.same - here_.depth) / plan_.increment);
        level -= std::max(1.0, steps) * plan_.increment;
        continue;
      }
      const ProfilePiece& piece = profile_[at_];
      if (level < piece.to.depth - limits_.same) {
        follow();
        continue;
      }
      follow_to(at_, {level, along_at(piece, level)});
      if (is_same(level, piece.to.depth)) ++at_;
      if (at_ == profile_.size()) return true;
      if (!cut_at(level)) return false;
    }
    return true;
  }

  /// Straight from here to the next wall, and back.
  bool cut_at(double& level) {
    for (std::size_t i = at_; i < profile_.size(); ++i) {
      if (!reaches(profile_[i], here_.depth)) continue;
      const double wall = meets_at(profile_[i], here_.depth);
      if (wall < here_.along - limits_.same) continue;
      if (is_same(wall, here_.along)) {
        if (i == at_ && goes_down(profile_[i])) continue;
        if (i > at_) level -= plan_.increment;  // a pocket without width
        return true;
      }
      const ProfilePoint begin = here_;
      const double size =
          plan_.retract > 0 ? std::min(1.0, (wall - begin.along) / 2 / plan_.retract) : 1;
      const double escape = size * plan_.retract;
      feed(wall, begin.depth);
      rapid(wall - escape, begin.depth + escape);
      rapid(begin.along + escape, begin.depth + escape);
      move(at_ == 0 ? CutMove::Kind::Rapid : CutMove::Kind::Line, begin);
      level -= plan_.increment;
      return true;
    }
    return false;
  }

  /// Up along what is left of the contour, straight over what goes down.
  void pass_over_pockets() {
    while (at_ < profile_.size()) {
      const ProfilePiece& piece = profile_[at_];
      if (goes_down(piece) || !reaches(piece, here_.depth)) {
        ++at_;
        continue;
      }
      const double along = meets_at(piece, here_.depth);
      if (along != here_.along) feed(along, here_.depth);
      follow();
    }
  }

  /// The level from which the next pocket's cuts count.
  void note_top() { top_ = std::max(top_.value_or(here_.depth), here_.depth); }

  const RoughingPlan& plan_;
  const ContourLimits& limits_;
  ProfilePieces profile_;
  ProfilePoint here_;
  std::size_t at_ = 0;         ///< the piece that the tool is on
  std::optional<double> top_;  ///< the highest that was noted; until then the start counts
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::size_t followed_ = kNone;  ///< the piece that the last move has followed to its end
  CutMoves moves_;
};

}  // namespace

std::optional<CutMoves> rough(const RoughingPlan& plan, const ContourLimits& limits,
                              std::string_view& why) {
  Roughing roughing(plan, limits);
  if (!roughing.make()) {
    why = "too many cuts, or a cut that the contour does not end";
    return std::nullopt;
  }
  return roughing.take();
}

bool is_clear(const CutMoves& moves, PlaneVector from, const ContourPieces& contour,
              const ContourLimits& limits) {
  constexpr int kSamples = 16;
  ProfilePieces profile;
  for (const ContourPiece& piece : contour) add_piece(profile, piece);
  const auto is_below = [&](PlaneVector at) {
    const auto beside = [&](double along) {
      const auto highest = highest_between(profile, along, along);
      return highest && at.second < *highest - limits.least;
    };
    return beside(at.first - 5 * limits.same) && beside(at.first + 5 * limits.same);
  };
  for (const CutMove& move : moves) {
    for (int i = 0; i <= kSamples && move.kind != CutMove::Kind::Arc; ++i) {
      if (is_below(from + (static_cast<double>(i) / kSamples) * (move.to - from))) return false;
    }
    from = move.to;
  }
  return true;
}

}  // namespace dripline::interpreter::rs274ngc
