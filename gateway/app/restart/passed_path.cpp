#include "gateway/app/restart/passed_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace dripline::gateway {

using interpreter::Axis;
using interpreter::kAllAxes;
using interpreter::PlaneVector;
using interpreter::Position;

namespace {

constexpr std::array kLinear{Axis::X, Axis::Y, Axis::Z};

double product(const Position& from, const Position& a, const Position& b) {
  double sum = 0;
  for (const Axis axis : kLinear)
    sum += (a.raw(axis) - from.raw(axis)) * (b.raw(axis) - from.raw(axis));
  return sum;
}

Position between(const Position& from, const Position& to, double part) {
  Position place = from;
  for (const Axis axis : kLinear)
    place.set_raw(axis, from.raw(axis) + part * (to.raw(axis) - from.raw(axis)));
  return place;
}

double linear_distance(const Position& a, const Position& b) {
  return std::sqrt(product(a, b, b));
}

}  // namespace

void PassedPath::begin(const Begin& begin) {
  *this = PassedPath();
  given_ = begin;
  at_ = begin.at;
  if (begin.is_begin_of_run) taken_up_at_ = place();
}

std::optional<PlaneVector> PassedPath::place() const {
  if (!at_.has(Axis::X) || !at_.has(Axis::Z)) return std::nullopt;
  return in_plane(at_, kLathePlane);
}

/// What was free before may be no more, or is not known. Where the tool was taken up it still is,
/// if nothing has moved.
void PassedPath::begin_again(std::uint64_t block) {
  if (block > given_.executed + 1 || has_other_tool_) return;
  if (!moves_.empty() || !last_moves_.empty()) taken_up_at_.reset();
  moves_.clear();
  last_moves_.clear();
  if (block > given_.target) is_lost_ = true;
}

bool PassedPath::moves_others(const Position& to) const {
  return std::ranges::any_of(kAllAxes, [&](Axis axis) {
    if (axis == Axis::X || axis == Axis::Z || !to.has(axis)) return false;
    return !at_.has(axis) || at_.raw(axis) != to.raw(axis);
  });
}

void PassedPath::keep(const interpreter::Origin& origin, const PassedMove& move) {
  if (has_other_tool_ || is_lost_ || origin.block > given_.executed + 1) return;
  if (origin.block > given_.executed) {
    last_moves_.push_back(move);
    return;
  }
  if (moves_.size() >= kMaxMoves) {
    moves_.erase(moves_.begin(), moves_.begin() + kMaxMoves / 2);
    taken_up_at_.reset();
  }
  moves_.push_back(move);
}

void PassedPath::note_thread(const interpreter::Origin& origin, const Position& to, Kind kind) {
  const bool is_after = origin.block > given_.target;
  const bool is_thread = kind == Kind::Thread;
  const bool continues =
      is_thread && thread_block_ != 0 && product(last_thread_.to, last_thread_.from, to) <= 0;
  if (is_after && !has_continued_) {
    has_continued_ = true;
    is_in_chain_ = continues;
  }
  if (is_thread && origin.block == given_.executed + 1) threads_.push_back({at_, to});
  if (is_after) return;
  if (!is_thread) {
    thread_block_ = 0;
  } else {
    if (!continues) thread_block_ = origin.block;
    last_thread_ = {at_, to};
  }
}

void PassedPath::add(const interpreter::Origin& origin, const Position& to, PassedMove move,
                     Kind kind) {
  Position reached = at_;
  for (const Axis axis : kAllAxes)
    if (to.has(axis)) reached.set_raw(axis, to.raw(axis));
  const bool is_first = !has_continued_;
  note_thread(origin, reached, kind);
  if (is_first && has_continued_ && kind == Kind::Free && !move.arc)
    continues_with_ = {to, move.is_rapid};
  if (moves_others(to)) begin_again(origin.block);
  const auto from = place();
  at_ = reached;
  const auto end = place();
  if (!from || !end || kind == Kind::Thread || *from == *end) return;
  move.from = *from;
  move.to = *end;
  keep(origin, move);
}

void PassedPath::on_rapid(const interpreter::Rapid& event) {
  add(event.origin, event.to, {.from = {}, .to = {}, .is_rapid = true});
}

void PassedPath::on_line(const interpreter::Line& event) {
  const bool has_begun = has_continued_;
  add(event.origin, event.to, {});
  if (!has_begun && continues_with_) continues_with_->feed = event.feed;
}

void PassedPath::on_arc(const interpreter::Arc& event) {
  if (event.plane != interpreter::Plane::ZX) begin_again(event.origin.block);
  PassedMove move;
  move.arc = interpreter::PathArc{event.center_first, event.center_second, event.plane, event.turn,
                                  event.sweep};
  add(event.origin, event.to, move);
}

void PassedPath::on_thread(const interpreter::Thread& event) {
  add(event.origin, event.to, {}, Kind::Thread);
}

void PassedPath::on_probe(const interpreter::Probe& event) {
  if (!event.result) return;
  if (event.arc) begin_again(event.origin.block);
  add(event.origin, event.result->at, {});
}

void PassedPath::on_tool(const interpreter::ToolChange& event) {
  if (event.is_preselection) return;
  if (event.origin.block > given_.target) {
    if (event.origin.block <= given_.executed + 1) has_other_tool_ = true;
    return;
  }
  begin_again(event.origin.block);
  if (!given_.shifts_with_tool) {
    taken_up_at_ = place();
    return;
  }
  at_.unmark(Axis::X);
  at_.unmark(Axis::Z);
}

void PassedPath::on_miscellaneous(const interpreter::Miscellaneous& event) {
  begin_again(event.origin.block);
}

void PassedPath::on_pin(const interpreter::PinChange& event) {
  begin_again(event.origin.block);
}

/// The operator may do anything at it.
void PassedPath::on_stop(const interpreter::Stop& event) {
  if (event.origin.block <= given_.executed) begin_again(event.origin.block);
}

void PassedPath::on_block_end(const interpreter::Origin& origin) {
  ended_ = std::max(ended_, origin.block);
}

/// Where it passes the place more than once, up to the first time.
void PassedPath::stop_at(const std::optional<Position>& stopped) {
  const std::vector<PassedMove> made = std::exchange(last_moves_, {});
  if (is_lost_) moves_.clear();
  if (!stopped || is_lost_) return;
  const PlaneVector rest = in_plane(*stopped, kLathePlane);
  const auto last = std::ranges::find_if(
      made, [&](const PassedMove& move) { return move.part_at(rest, kNearPlace).has_value(); });
  if (last == made.end()) return;
  moves_.insert(moves_.end(), made.begin(), last);
  const double part = *last->part_at(rest, kNearPlace);
  if (part > 0) moves_.push_back(last->piece(0, part));
}

bool PassedPath::is_in_thread(const Position& place) const {
  return std::ranges::any_of(threads_, [&](const ThreadMove& thread) {
    const double square = product(thread.from, thread.to, thread.to);
    if (square <= 0 || linear_distance(place, thread.from) <= kNearPlace) return false;
    const double part = std::clamp(product(thread.from, thread.to, place) / square, 0.0, 1.0);
    return linear_distance(place, between(thread.from, thread.to, part)) <= kNearPlace;
  });
}

}  // namespace dripline::gateway
