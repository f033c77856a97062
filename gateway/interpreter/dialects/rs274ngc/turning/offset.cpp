#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/turning/pieces.hpp"

/// Corners of a contour, and the contour that keeps off it. Sizes and steps are LinuxCNC's; what
/// it makes of a contour that does not fit is refused.
namespace dripline::interpreter::rs274ngc {
namespace {

/// A piece that ends or begins elsewhere has not become its own reverse.
bool is_part_of(const ContourPiece& cut, const ContourPiece& whole, const ContourLimits& limits) {
  if (whole.is_arc) {
    return distance_to(whole, cut.from) <= limits.least &&
           distance_to(whole, cut.to) <= limits.least;
  }
  return dot(cut.to - cut.from, whole.to - whole.from) >= 0;
}

bool round_corner(ContourPiece& piece, ContourPiece& next, const ContourMove& move,
                  const ContourLimits& limits, ContourPiece& corner) {
  constexpr double kStraight = 1e-6;
  const PlaneVector before = direction_at_end(piece), after = direction_at_start(next);
  const double turned = cross(before, after);
  if (std::fabs(turned) <= kStraight * length(before) * length(after)) return false;
  // The center is on the side that the contour bends to.
  const double aside = turned > 0 ? move.corner : -move.corner;
  ContourPiece to = piece, from = next;
  for (const ContourPiece* each : {&piece, &next}) {
    const bool shrinks = each->is_arc && each->is_counterclockwise == (aside > 0);
    if (shrinks && length(each->from - each->center) <= move.corner + limits.least) return false;
  }
  move_aside(to, aside);
  move_aside(from, aside);
  if (!meet(to, from, limits)) return false;
  corner.center = to.to;
  move_aside(to, -aside);
  move_aside(from, -aside);
  if (!is_part_of(to, piece, limits) || !is_part_of(from, next, limits)) return false;
  piece.to = corner.from = to.to;
  next.from = corner.to = from.from;
  corner.is_arc = !move.is_chamfer;
  corner.is_counterclockwise = turned > 0;
  return true;
}

void drop_short(ContourPieces& pieces, const ContourLimits& limits) {
  std::erase_if(pieces, [&](const ContourPiece& piece) { return size_of(piece) < limits.least; });
}

/// Where the pieces have come apart an arc about the corner joins them.
ContourPieces joined(const ContourPieces& pieces, double step, const ContourLimits& limits) {
  ContourPieces all;
  for (const ContourPiece& piece : pieces) {
    if (!all.empty() && piece.from.first - all.back().to.first > limits.gap) {
      ContourPiece before = all.back(), after = piece;
      move_aside(before, -step);
      move_aside(after, -step);
      ContourPiece corner{.from = all.back().to,
                          .to = piece.from,
                          .center = 0.5 * (before.to + after.from),
                          .is_arc = true};
      all.push_back(corner);
    }
    all.push_back(piece);
  }
  return all;
}

/// Ends each piece where it meets the next; those that have shrunk to nothing vanish.
bool trim_pieces(ContourPieces& pieces, const ContourLimits& limits) {
  for (std::size_t i = 0; i + 1 < pieces.size();) {
    std::size_t gone = pieces.size();
    if (!runs_along(pieces[i], limits)) {
      gone = i > 0 && size_of(pieces[i]) >= size_of(pieces[i - 1]) ? i - 1 : i;
    } else if (size_of(pieces[i]) < limits.least) {
      gone = i;
    }
    if (gone < pieces.size()) {
      pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(gone));
      i = 0;
      continue;
    }
    if (!meet(pieces[i], pieces[i + 1], limits)) return false;
    ++i;
  }
  return !pieces.empty();
}

/// Every point of `aside` is as far off as it should be, and no piece runs back.
bool is_kept_off(const ContourPieces& aside, const ContourPieces& pieces, double distance,
                 const ContourLimits& limits) {
  constexpr int kSamples = 16;
  for (const ContourPiece& piece : aside) {
    if (!runs_along(piece, limits)) return false;
    for (int i = 0; i <= kSamples; ++i) {
      const PlaneVector point = point_on(piece, static_cast<double>(i) / kSamples);
      for (const ContourPiece& each : pieces) {
        // The ends bound a piece along the cut.
        if (point.first < each.from.first - distance - limits.gap ||
            point.first > each.to.first + distance + limits.gap)
          continue;
        if (distance_to(each, point) < distance - limits.least) return false;
      }
    }
  }
  return true;
}

}  // namespace

std::optional<ContourPieces> with_corners(const ContourPieces& pieces,
                                          const std::vector<ContourMove>& moves,
                                          const ContourLimits& limits, std::string_view& why) {
  ContourPieces all = pieces;
  ContourPieces result;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ContourMove& move = moves[i];
    if (move.corner == 0) {
      result.push_back(all[i]);
      continue;
    }
    ContourPiece corner;
    if (i + 1 == all.size() || !round_corner(all[i], all[i + 1], move, limits, corner)) {
      why = "a fillet or chamfer does not fit";
      return std::nullopt;
    }
    result.push_back(all[i]);
    result.push_back(corner);
  }
  drop_short(result, limits);
  return result;
}

std::optional<ContourPieces> kept_off(const ContourPieces& pieces, double distance,
                                      const ContourLimits& limits, std::string_view& why) {
  constexpr std::size_t kMaxWork = 2'000'000;
  why = "the distance is too large for the contour";
  ContourPieces aside = pieces;
  double done = 0;
  for (std::size_t work = 0; done < distance; work += aside.size() + 1) {
    if (work > kMaxWork || aside.empty()) return std::nullopt;
    double step = distance - done;
    const double left = step;
    for (const ContourPiece& piece : aside) step = std::min(step, size_of(piece) / 2);
    for (ContourPiece& piece : aside) move_aside(piece, step);
    drop_short(aside, limits);
    aside = joined(aside, step, limits);
    if (!trim_pieces(aside, limits)) return std::nullopt;
    done = step == left ? distance : done + step;
  }
  for (std::size_t i = 0; i + 1 < aside.size(); ++i) {
    aside[i].to = aside[i + 1].from = 0.5 * (aside[i].to + aside[i + 1].from);
  }
  if (!is_kept_off(aside, pieces, distance, limits)) return std::nullopt;
  return aside;
}

}  // namespace dripline::interpreter::rs274ngc
