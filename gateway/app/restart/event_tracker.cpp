#include "gateway/app/restart/event_tracker.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::gateway {

using interpreter::Axis;
using interpreter::kAllAxes;
using interpreter::Position;

namespace {

/// What a machine's position may be off a path and still be on it, in millimeters.
constexpr double kOnPath = 0.02;

/// Marks of the kinds of events in the hash.
enum Mark : std::uint64_t {
  kRapid = 1,
  kLine,
  kArc,
  kThread,
  kDwell,
  kSpindle,
  kCoolant,
  kTool,
  kProbe
};

double distance(const Position& from, const Position& to) {
  double linear = 0, rotary = 0;
  for (const Axis axis : kAllAxes) {
    if (!to.has(axis)) continue;
    const double change = to.raw(axis) - from.raw(axis);
    (interpreter::is_rotary(axis) ? rotary : linear) += change * change;
  }
  return std::sqrt(linear != 0 ? linear : rotary);
}

double arc_length(const Position& from, const interpreter::Arc& arc) {
  const interpreter::PlaneAxes axes = axes_of(arc.plane);
  const double first = from.raw(axes.first) - arc.center_first.mm();
  const double second = from.raw(axes.second) - arc.center_second.mm();
  const double turn = std::hypot(first, second) * std::fabs(arc.sweep.radians());
  const double rise = arc.to.has(axes.normal) ? arc.to.raw(axes.normal) - from.raw(axes.normal) : 0;
  return std::hypot(turn, rise);
}

}  // namespace

void EventTracker::close(DeliveredState state, std::uint64_t last, OnOpen on_open) {
  state_ = std::move(state);
  last_ = last;
  on_open_ = std::move(on_open);
  is_closed_ = true;
  wanted_.reset();
  alarm_.reset();
  end_.reset();
  measured_block_ = 0;
  also_ = nullptr;
}

void EventTracker::expect(Axis axis, double value) {
  state_.position.set_raw(axis, value);
}

void EventTracker::measure(std::uint64_t block, const Position& at) {
  measured_block_ = block;
  measured_from_ = at;
  measured_ = {};
}

void EventTracker::add(std::uint64_t bits) {
  state_.path = (std::rotl(state_.path, 23) ^ bits) * 0xff51afd7ed558ccdULL;
}
void EventTracker::add(double value) {
  add(std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value));
}

/// A move names the axes that take part in it and those before it; the values of all count.
void EventTracker::move_to(const interpreter::Origin& origin, const Position& to,
                           const Shape& shape) {
  const ReachedHeights::Lengths lengths = lengths_ ? lengths_() : ReachedHeights::Lengths{};
  shape.arc ? state_.heights.move(to, *shape.arc, lengths)
            : state_.heights.move(to, lengths, shape.kind);
  for (const Axis axis : kAllAxes) {
    if (!to.has(axis)) continue;
    const double value = to.raw(axis);
    add(value);
    state_.position.set_raw(axis, value);
  }
  for (std::size_t i = 0; i < moves_.axes.size(); ++i) {
    if (!to.has(static_cast<Axis>(i))) continue;
    Moves::Blocks& blocks = moves_.axes[i];
    blocks.first = blocks.first == 0 ? origin.block : std::min(blocks.first, origin.block);
    blocks.last = std::max(blocks.last, origin.block);
  }
}

void EventTracker::measure_move(const interpreter::Origin& origin, const Position& to,
                                double length) {
  if (!is_closed_) length_ += length;
  if (measured_block_ == 0 || origin.block != measured_block_) return;
  measured_.length += length;
  if (measured_.left) {
    *measured_.left += length;
    return;
  }
  // A position on the straight line between the ends; arcs are measured by their ends alone.
  double from_start = 0, to_end = 0;
  for (const Axis axis : kAllAxes) {
    if (!to.has(axis) || interpreter::is_rotary(axis)) continue;
    from_start += std::pow(measured_from_.raw(axis) - state_.position.raw(axis), 2);
    to_end += std::pow(to.raw(axis) - measured_from_.raw(axis), 2);
  }
  from_start = std::sqrt(from_start);
  to_end = std::sqrt(to_end);
  if (from_start <= kOnPath || std::fabs(from_start + to_end - length) <= kOnPath)
    measured_.left = from_start <= kOnPath ? length : to_end;
}

void EventTracker::on_rapid(const interpreter::Rapid& event) {
  if (also_ != nullptr) also_->on_rapid(event);
  measure_move(event.origin, event.to, distance(state_.position, event.to));
  add(kRapid);
  move_to(event.origin, event.to, {.arc = {}, .kind = ReachedHeights::Kind::Rapid});
  EventGate::on_rapid(event);
}

ReachedHeights::Kind EventTracker::kind_of(const Feed& feed) const {
  const bool is_rapid =
      rapid_feed_ && feed.per() == Feed::Per::Minute && feed.length() >= *rapid_feed_;
  return is_rapid ? ReachedHeights::Kind::Rapid : ReachedHeights::Kind::Feed;
}

void EventTracker::on_line(const interpreter::Line& event) {
  if (also_ != nullptr) also_->on_line(event);
  measure_move(event.origin, event.to, distance(state_.position, event.to));
  add(kLine);
  state_.feed = event.feed;
  move_to(event.origin, event.to, {.arc = {}, .kind = kind_of(event.feed)});
  EventGate::on_line(event);
}

void EventTracker::on_arc(const interpreter::Arc& event) {
  if (also_ != nullptr) also_->on_arc(event);
  measure_move(event.origin, event.to, arc_length(state_.position, event));
  add(kArc + 16 * static_cast<std::uint64_t>(event.plane) +
      64 * static_cast<std::uint64_t>(event.turn));
  add(event.center_first.mm());
  add(event.center_second.mm());
  add(event.sweep.degrees());
  state_.feed = event.feed;
  move_to(event.origin, event.to,
          {interpreter::PathArc{event.center_first, event.center_second, event.plane, event.turn,
                                event.sweep}});
  EventGate::on_arc(event);
}

void EventTracker::on_thread(const interpreter::Thread& event) {
  if (also_ != nullptr) also_->on_thread(event);
  const double length = event.arc ? arc_length(state_.position, interpreter::arc_of(event))
                                  : distance(state_.position, event.to);
  measure_move(event.origin, event.to, length);
  add(kThread);
  add(event.lead.mm());
  move_to(event.origin, event.to, {event.arc});
  EventGate::on_thread(event);
}

/// The axes are where it ended: nothing else names that place.
void EventTracker::on_probe(const interpreter::Probe& event) {
  if (also_ != nullptr) also_->on_probe(event);
  if (event.result) {
    const Position& at = event.result->at;
    measure_move(event.origin, at,
                 event.arc ? arc_length(state_.position, interpreter::arc_of(event))
                           : distance(state_.position, at));
    add(kProbe);
    if (!event.is_rapid) state_.feed = event.feed;
    move_to(event.origin, at, {event.arc});
  }
  EventGate::on_probe(event);
}

void EventTracker::on_dwell(const interpreter::Dwell& event) {
  add(kDwell);
  add(event.seconds);
  EventGate::on_dwell(event);
}

void EventTracker::on_spindle(const interpreter::Spindle& event) {
  add(kSpindle + 16 * static_cast<std::uint64_t>(event.state));
  add(event.revolutions_per_minute);
  state_.spindle = event;
  EventGate::on_spindle(event);
}

void EventTracker::on_coolant(const interpreter::Coolant& event) {
  add(kCoolant + (event.flood ? 16U : 0U) + (event.mist ? 32U : 0U));
  state_.flood = event.flood;
  state_.mist = event.mist;
  EventGate::on_coolant(event);
}

void EventTracker::on_tool(const interpreter::ToolChange& event) {
  if (also_ != nullptr) also_->on_tool(event);
  add(kTool + 16 * static_cast<std::uint64_t>(static_cast<std::uint32_t>(event.number)));
  if (event.is_preselection) {
    state_.next_tool = event.number;
  } else {
    moves_.has_tool = true;
    state_.tool = event.number;
    state_.next_tool.reset();
    state_.tool_shape = event.shape;
    const bool is_wanted = is_closed_ && wanted_ && wanted_->tool == event.number &&
                           event.origin.block <= wanted_->until;
    if (is_wanted) found_ = event.origin.block;
  }
  if (event.offset) state_.tool_offset = event.offset;
  EventGate::on_tool(event);
}

void EventTracker::note_code(int code) {
  std::erase(state_.codes, code);
  if (state_.codes.size() >= DeliveredState::kMaxCodes) state_.codes.erase(state_.codes.begin());
  state_.codes.push_back(code);
}

void EventTracker::on_miscellaneous(const interpreter::Miscellaneous& event) {
  if (also_ != nullptr) also_->on_miscellaneous(event);
  note_code(event.code);
  EventGate::on_miscellaneous(event);
}

void EventTracker::on_pin(const interpreter::PinChange& event) {
  if (also_ != nullptr) also_->on_pin(event);
  note_code(DeliveredState::kOutput + 100 * static_cast<int>(event.axis) + event.output % 100);
  EventGate::on_pin(event);
}

void EventTracker::on_override_inhibit(const interpreter::OverrideInhibit& event) {
  state_.inhibit = event;
  EventGate::on_override_inhibit(event);
}

void EventTracker::on_stop(const interpreter::Stop& event) {
  if (also_ != nullptr) also_->on_stop(event);
  EventGate::on_stop(event);
}

void EventTracker::on_alarm(const interpreter::Alarm& event) {
  if (is_closed_) alarm_ = event.diagnostic;
  EventGate::on_alarm(event);
}

void EventTracker::on_end(const interpreter::End& event) {
  if (is_closed_) end_ = event;
  EventGate::on_end(event);
}

void EventTracker::note_found(const interpreter::Origin& origin) {
  const bool is_main = origin.program == interpreter::kMainProgram;
  if (!is_main || origin.block > wanted_->until) return;
  if (wanted_->line == origin.line || (wanted_->sequence && wanted_->sequence == origin.sequence))
    found_ = origin.block;
}

void EventTracker::on_block_end(const interpreter::Origin& origin) {
  if (also_ != nullptr) also_->on_block_end(origin);
  (*paths_)[origin.block % kPaths] = {origin.block, state_.path, length_};
  state_.ended = origin;
  if (origin.block == measured_block_ && measured_block_ != 0) {
    measured_.block = origin.block;
    measured_.line = origin.line;
    measured_.sequence = origin.sequence;
    measured_.has_ended = true;
  }
  if (!is_closed_) return out().on_block_end(origin);
  if (wanted_) note_found(origin);
  if (on_open_ && origin.block >= last_) open_now();
}

void EventTracker::open_now() {
  if (!is_closed_) return;
  is_closed_ = false;
  if (on_open_) std::exchange(on_open_, nullptr)(out());
  if (end_) out().on_end(*end_);
}

}  // namespace dripline::gateway
