#include "gateway/app/restart/passed_route.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>

namespace dripline::gateway {

using interpreter::PathArc;
using interpreter::PlaneVector;
using interpreter::Turn;

namespace {

constexpr double kSamePoint = 1e-6;  ///< millimeters: of computed points

PlaneVector center_of(const PathArc& arc) {
  return {arc.center_first.mm(), arc.center_second.mm()};
}

double arc_angle(const PathArc& arc, PlaneVector place) {
  const PlaneVector off = place - center_of(arc);
  return std::atan2(off.second, off.first);
}

double move_length(const PassedMove& move) {
  if (!move.arc) return length(move.to - move.from);
  return length(move.from - center_of(*move.arc)) * std::fabs(move.arc->sweep.radians());
}

}  // namespace

PlaneVector PassedMove::at(double part) const {
  if (part <= 0) return from;
  if (part >= 1) return to;
  if (!arc) return from + part * (to - from);
  const double radius = length(from - center_of(*arc));
  const double turn = part * std::fabs(arc->sweep.radians());
  const double angle = arc_angle(*arc, from) + (arc->turn == Turn::Counterclockwise ? turn : -turn);
  return center_of(*arc) + radius * PlaneVector{std::cos(angle), std::sin(angle)};
}

std::optional<double> PassedMove::part_at(PlaneVector place, double tolerance) const {
  if (length(place - from) <= tolerance) return 0;
  if (length(place - to) <= tolerance) return 1;
  double part = 0;
  if (arc) {
    const double full = std::fabs(arc->sweep.radians());
    double turned = arc_angle(*arc, place) - arc_angle(*arc, from);
    if (arc->turn == Turn::Clockwise) turned = -turned;
    turned = std::fmod(turned, 2 * Angle::kPi);
    if (turned < 0) turned += 2 * Angle::kPi;
    part = full > 0 ? turned / full : 2;
  } else {
    const PlaneVector along = to - from;
    const double square = dot(along, along);
    part = square > 0 ? dot(place - from, along) / square : 2;
  }
  if (!(part > 0 && part < 1) || length(at(part) - place) > tolerance) return std::nullopt;
  return part;
}

PassedMove PassedMove::piece(double first, double last) const {
  PassedMove move{at(first), at(last), is_rapid};
  if (!arc) return move;
  move.arc = arc;
  move.arc->sweep = Angle::radians(std::fabs(arc->sweep.radians() * (last - first)));
  if (last < first) {
    const bool was_clockwise = arc->turn == Turn::Clockwise;
    move.arc->turn = was_clockwise ? Turn::Counterclockwise : Turn::Clockwise;
  }
  return move;
}

namespace {

/// Corners.
struct Box {
  PlaneVector low, high;
};

Box box_of(const PassedMove& move) {
  const PlaneVector around{kSamePoint, kSamePoint};
  if (move.arc) {
    const PlaneVector center = center_of(*move.arc);
    const double radius = length(move.from - center);
    const PlaneVector half = around + PlaneVector{radius, radius};
    return {center - half, center + half};
  }
  const auto [left, right] = std::minmax(move.from.first, move.to.first);
  const auto [below, above] = std::minmax(move.from.second, move.to.second);
  return {PlaneVector{left, below} - around, PlaneVector{right, above} + around};
}

bool are_apart(const Box& a, const Box& b) {
  const auto is_below = [](PlaneVector one, PlaneVector other) {
    return one.first < other.first || one.second < other.second;
  };
  return is_below(a.high, b.low) || is_below(b.high, a.low);
}

/// The nearest place of a move.
std::optional<PlaneVector> nearest_on(const std::vector<PassedMove>& moves, PlaneVector place) {
  std::optional<PlaneVector> nearest;
  for (const PassedMove& move : moves) {
    const auto part = move.part_at(place, kNearPlace);
    if (!part) continue;
    const PlaneVector found = move.at(*part);
    if (!nearest || length(found - place) < length(*nearest - place)) nearest = found;
  }
  return nearest;
}

/// Moves cut where they meet: places, and pieces between them.
class MoveNetwork {
 public:
  explicit MoveNetwork(const std::vector<PassedMove>& moves) : moves_(moves), cuts_(moves.size()) {
    boxes_.reserve(moves_.size());
    for (std::size_t i = 0; i < moves_.size(); ++i) {
      boxes_.push_back(box_of(moves_[i]));
      cut(i, 0, moves_[i].from);
      cut(i, 1, moves_[i].to);
      for (std::size_t k = 0; k < i; ++k) meet(i, k);
    }
  }
  /// A place of a move.
  std::size_t add(PlaneVector place);
  std::optional<std::vector<PassedMove>> shortest(std::size_t from, std::size_t to);

 private:
  struct Cut {
    double part;
    std::size_t place;
  };
  struct Edge {
    std::size_t to = 0, move = 0;
    double first = 0, last = 0;
  };

  std::size_t number(PlaneVector place);
  void cut(std::size_t move, double part, PlaneVector place) {
    cuts_[move].push_back({part, number(place)});
  }
  void meet(std::size_t i, std::size_t k);
  void cut_at_ends(std::size_t move, const PassedMove& other);
  void connect();
  std::vector<PassedMove> path_to(std::size_t from, std::size_t to) const;

  const std::vector<PassedMove>& moves_;
  std::vector<std::vector<Cut>> cuts_;
  std::vector<Box> boxes_;
  std::vector<PlaneVector> places_;
  std::unordered_multimap<std::int64_t, std::size_t> cells_;
  std::vector<std::vector<Edge>> edges_;
  std::vector<std::pair<std::size_t, Edge>> reached_by_;
};

std::int64_t cell_of(PlaneVector place) {
  constexpr double kCell = 0.001;
  const auto row = static_cast<std::int64_t>(std::llround(place.first / kCell));
  const auto column = static_cast<std::int64_t>(std::llround(place.second / kCell));
  return row * 1'000'003 + column;
}

std::size_t MoveNetwork::number(PlaneVector place) {
  for (const double first : {0.0, -kSamePoint, kSamePoint}) {
    for (const double second : {0.0, -kSamePoint, kSamePoint}) {
      const auto [begin, end] = cells_.equal_range(cell_of(place + PlaneVector{first, second}));
      for (auto found = begin; found != end; ++found) {
        if (length(places_[found->second] - place) <= kSamePoint) return found->second;
      }
    }
  }
  cells_.emplace(cell_of(place), places_.size());
  places_.push_back(place);
  return places_.size() - 1;
}

std::size_t MoveNetwork::add(PlaneVector place) {
  for (std::size_t i = 0; i < moves_.size(); ++i) {
    if (const auto part = moves_[i].part_at(place, kSamePoint)) cut(i, *part, place);
  }
  return number(place);
}

void MoveNetwork::cut_at_ends(std::size_t move, const PassedMove& other) {
  for (const PlaneVector place : {other.from, other.to}) {
    const auto part = moves_[move].part_at(place, kSamePoint);
    if (part) cut(move, *part, place);
  }
}

/// Arcs are cut where another move ends on them, lines also where they cross.
void MoveNetwork::meet(std::size_t i, std::size_t k) {
  if (are_apart(boxes_[i], boxes_[k])) return;
  const PassedMove &a = moves_[i], &b = moves_[k];
  cut_at_ends(i, b);
  cut_at_ends(k, a);
  if (a.arc || b.arc) return;
  const PlaneVector along = a.to - a.from, other = b.to - b.from;
  const double area = cross(along, other);
  if (std::fabs(area) < 1e-12) return;
  const double part = cross(b.from - a.from, other) / area;
  const double part_of_other = cross(b.from - a.from, along) / area;
  if (!(part > 0 && part < 1 && part_of_other > 0 && part_of_other < 1)) return;
  const PlaneVector place = a.at(part);
  cut(i, part, place);
  cut(k, part_of_other, place);
}

void MoveNetwork::connect() {
  edges_.assign(places_.size(), {});
  for (std::size_t i = 0; i < cuts_.size(); ++i) {
    auto& cuts = cuts_[i];
    std::ranges::sort(cuts, {}, &Cut::part);
    for (std::size_t k = 1; k < cuts.size(); ++k) {
      const Cut &a = cuts[k - 1], &b = cuts[k];
      if (a.place == b.place) continue;
      edges_[a.place].push_back({b.place, i, a.part, b.part});
      edges_[b.place].push_back({a.place, i, b.part, a.part});
    }
  }
}

std::optional<std::vector<PassedMove>> MoveNetwork::shortest(std::size_t from, std::size_t to) {
  connect();
  using Reached = std::pair<double, std::size_t>;
  std::vector<double> best(places_.size(), std::numeric_limits<double>::infinity());
  reached_by_.assign(places_.size(), {});
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> next;
  best[from] = 0;
  next.emplace(0, from);
  while (!next.empty()) {
    const auto [so_far, place] = next.top();
    next.pop();
    if (place == to) return path_to(from, to);
    if (so_far > best[place]) continue;
    for (const Edge& edge : edges_[place]) {
      const double length = so_far + move_length(moves_[edge.move].piece(edge.first, edge.last));
      if (length >= best[edge.to]) continue;
      best[edge.to] = length;
      reached_by_[edge.to] = {place, edge};
      next.emplace(length, edge.to);
    }
  }
  return std::nullopt;
}

/// One straight move where pieces continue each other.
bool join(PassedMove& move, const PassedMove& next) {
  if (move.arc || next.arc || move.is_rapid != next.is_rapid) return false;
  const PlaneVector a = move.to - move.from, b = next.to - next.from;
  const double lengths = std::sqrt(dot(a, a) * dot(b, b));
  if (dot(a, b) <= 0 || std::fabs(cross(a, b)) > 1e-9 * std::max(lengths, 1.0)) return false;
  move.to = next.to;
  return true;
}

std::vector<PassedMove> MoveNetwork::path_to(std::size_t from, std::size_t to) const {
  std::vector<PassedMove> pieces;
  for (std::size_t place = to; place != from; place = reached_by_[place].first) {
    const Edge& edge = reached_by_[place].second;
    PassedMove piece = moves_[edge.move].piece(edge.first, edge.last);
    piece.from = places_[reached_by_[place].first];
    piece.to = places_[place];
    pieces.push_back(piece);
  }
  std::ranges::reverse(pieces);
  std::vector<PassedMove> path;
  for (const PassedMove& piece : pieces)
    if (path.empty() || !join(path.back(), piece)) path.push_back(piece);
  return path;
}

}  // namespace

std::optional<std::vector<PassedMove>> passed_route(const std::vector<PassedMove>& moves,
                                                    PlaneVector from, PlaneVector to) {
  const auto first = nearest_on(moves, from), last = nearest_on(moves, to);
  if (!first || !last) return std::nullopt;
  MoveNetwork network(moves);
  const std::size_t begin = network.add(*first);
  const std::size_t end = network.add(*last);
  auto route = network.shortest(begin, end);
  if (!route) return std::nullopt;
  if (length(from - *first) > kSamePoint) route->insert(route->begin(), PassedMove{from, *first});
  if (length(*last - to) > kSamePoint) route->push_back(PassedMove{*last, to});
  return route;
}

}  // namespace dripline::gateway
