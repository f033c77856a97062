#include "gateway/machine/given_action.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dripline::machine {
namespace {

using Point = GivenAction::Point;

constexpr double kPlaceSlack = 0.02;  ///< a device's steps and rounding, mm or degrees
constexpr double kAtEnd = 0.005;      ///< a move with no more than this left is done
constexpr double kTogether = 0.2;     ///< places this close along the path are one place

double gap_between(const Point& a, const Point& b) {
  double square = 0;
  for (std::size_t i = 0; i < a.size(); ++i) square += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(square);
}

double way_along(const GivenAction& move) {
  if (!move.arc) return gap_between(move.from, move.end);
  const GivenAction::Arc& arc = *move.arc;
  double square = arc.sweep * (arc.start_radius + arc.end_radius) / 2;
  square *= square;
  for (std::size_t i = 0; i < move.from.size(); ++i) {
    const double change = move.end[i] - move.from[i];
    if (i != arc.first && i != arc.second) square += change * change;
  }
  return std::sqrt(square);
}

Point point_at(const GivenAction& move, double part) {
  Point point;
  for (std::size_t i = 0; i < point.size(); ++i)
    point[i] = move.from[i] + (move.end[i] - move.from[i]) * part;
  if (!move.arc) return point;
  const GivenAction::Arc& arc = *move.arc;
  const double radius = arc.start_radius + (arc.end_radius - arc.start_radius) * part;
  point[arc.first] = arc.center_first + radius * std::cos(arc.start + arc.sweep * part);
  point[arc.second] = arc.center_second + radius * std::sin(arc.start + arc.sweep * part);
  return point;
}

/// The parts of the move, from 0 to 1, that may be nearest to the point.
std::vector<double> nearest_parts(const GivenAction& move, const Point& at) {
  if (!move.arc) {
    double square = 0, along = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
      square += (move.end[i] - move.from[i]) * (move.end[i] - move.from[i]);
      along += (move.end[i] - move.from[i]) * (at[i] - move.from[i]);
    }
    return {square > 0 ? std::clamp(along / square, 0.0, 1.0) : 1.0};
  }
  constexpr double kTurn = 2 * Angle::kPi;
  const GivenAction::Arc& arc = *move.arc;
  const double sweep = std::fabs(arc.sweep);
  const double angle =
      std::atan2(at[arc.second] - arc.center_second, at[arc.first] - arc.center_first);
  const double turned = arc.sweep < 0 ? arc.start - angle : angle - arc.start;
  std::vector<double> parts{0, 1};
  for (double to = turned - std::floor(turned / kTurn) * kTurn; to < sweep; to += kTurn)
    parts.push_back(to / sweep);
  std::sort(parts.begin(), parts.end());
  return parts;
}

/// The places where a path passes a point, in its order.
class Places {
 public:
  explicit Places(const Point& at) : at_(at) {}

  void pass(const GivenAction& move, std::size_t index) {
    const double whole = way_along(move);
    for (const double part : nearest_parts(move, at_)) {
      const double miss = gap_between(point_at(move, part), at_);
      if (miss > kPlaceSlack) continue;
      const bool is_done = whole * (1 - part) < std::min(kAtEnd, whole / 2);
      note({before_ + whole * part, miss, is_done ? index + 1 : index});
    }
    before_ += whole;
  }
  std::optional<Reached> reached() const {
    if (places_.empty()) return std::nullopt;
    return Reached{places_.front().done, places_.back().done};
  }

 private:
  struct Place {
    double along = 0, miss = 0;
    std::size_t done = 0;
  };
  /// Of places that are one, the nearest counts.
  void note(const Place& place) {
    const bool is_same = !places_.empty() && place.along - along_ < kTogether;
    along_ = place.along;
    if (!is_same)
      places_.push_back(place);
    else if (place.miss < places_.back().miss - 1e-9)
      places_.back() = place;
  }

  const Point& at_;
  std::vector<Place> places_;
  double before_ = 0;  ///< length of the path
  double along_ = 0;   ///< of what was noted last
};

}  // namespace

std::optional<Reached> reached(std::span<const GivenAction> actions, const Point& at) {
  Places places(at);
  for (std::size_t i = 0; i < actions.size(); ++i) {
    if (actions[i].kind == GivenAction::Kind::Other) break;
    if (actions[i].kind == GivenAction::Kind::Motion) places.pass(actions[i], i);
  }
  return places.reached();
}

}  // namespace dripline::machine
