#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/core/geometry/arc_point.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/core/path_feed.hpp"

namespace dripline::interpreter::fanuc {
namespace {

/// Pieces of an arc that is made of straight moves, at most this many degrees each.
constexpr double kPieceDegrees = 5;

bool is_imaginary(const ModalState& state, Axis axis) {
  return (state.imaginary >> static_cast<unsigned>(axis) & 1u) != 0;
}

/// Imaginary axes stay where they are.
Position held(const ModalState& state, Position to) {
  for (const Axis axis : kAllAxes) {
    if (!is_imaginary(state, axis)) continue;
    to.set_raw(axis, state.held[static_cast<std::size_t>(axis)]);
    if (!state.position.has(axis)) to.unmark(axis);
  }
  return to;
}

bool same_place(const Position& a, const Position& b) {
  return a.same_point(b);
}

/// In G68.2, G43.4 and cutter compensation the stage that knows the axes' moves checks them.
bool is_limited(const Run& run) {
  return (run.options.checks_stroke() || run.state.zone.is_on) && !run.tilted.is_on() &&
         !run.state.is_compensating();
}

/// The part of the path that lies within the box, by clipping axis after axis.
bool crosses(const StrokeZone& zone, const Position& from, const Position& to) {
  double begin = 0;
  double end = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Axis>(i);
    const double start = from.raw(axis);
    const double travel = to.raw(axis) - start;
    if (travel == 0) {
      if (start <= zone.low[i] || start >= zone.high[i]) return false;
      continue;
    }
    double enter = (zone.low[i] - start) / travel;
    double leave = (zone.high[i] - start) / travel;
    if (enter > leave) std::swap(enter, leave);
    begin = std::max(begin, enter);
    end = std::min(end, leave);
    if (begin >= end) return false;
  }
  return true;
}

bool check_path(Run& run, const Position& from, const Position& to) {
  const std::string text =
      stroke_fault(run.options, run.state.zone, {from, to, run.length_display()});
  return text.empty() || run.fail(ErrorCode::OverTravel, 0, text);
}

bool check_arc(Run& run, const Arc& arc) {
  Position from = run.state.position;
  const int pieces = std::max(1, static_cast<int>(std::ceil(arc.sweep.degrees() / kPieceDegrees)));
  for (int piece = 1; piece <= pieces; ++piece) {
    const Position to = point_on_arc(arc, run.state.position, arc.sweep.degrees() * piece / pieces);
    if (!check_path(run, from, to)) return false;
    from = to;
  }
  return true;
}

/// An arc in which an axis is imaginary: straight pieces.
void pieces_of_arc(Run& run, const Arc& arc) {
  const Position start = run.state.position;
  const int pieces = std::max(1, static_cast<int>(std::ceil(arc.sweep.degrees() / kPieceDegrees)));
  Position last = held(run.state, start);
  for (int piece = 1; piece <= pieces; ++piece) {
    const double degrees = arc.sweep.degrees() * piece / pieces;
    Position to = held(run.state, piece == pieces ? arc.to : point_on_arc(arc, start, degrees));
    const bool rests = arc.rests && piece == pieces;
    if (!same_place(last, to)) run.events().on_line({run.origin, to, arc.feed, rests});
    last = to;
  }
  arrive(run, arc.to);
}

}  // namespace

std::string stroke_fault(const ControlOptions& options, const StrokeZone& zone,
                         const StrokePath& path) {
  const Position& from = path.from;
  const Position& to = path.to;
  for (std::size_t i = 0; options.has_limits && i < 3; ++i) {
    const auto axis = static_cast<Axis>(i);
    const double at = to.raw(axis);
    if (at >= options.limit_low[i] && at <= options.limit_high[i]) continue;
    return fmt::format("{} {} is beyond stroke limit 1", shown_axis(axis, at, path.display),
                       shown_unit(axis, path.display.units));
  }
  for (const RotaryAxis* rotary : {&options.kinematics.master, &options.kinematics.slave}) {
    const double at = to.raw(rotary->axis);
    if (at >= rotary->low && at <= rotary->high) continue;
    return fmt::format("{} {} is not {} to {}", letter(rotary->axis), at, rotary->low,
                       rotary->high);
  }
  return zone.is_on && crosses(zone, from, to) ? "the path enters the zone of G22" : "";
}

bool check_stroke(Run& run, const Position& to) {
  return !is_limited(run) || check_path(run, run.state.position, to);
}

Feed feed_on_line(const Run& run, const Position& from, const Position& to, const Feed& feed) {
  return feed_of_all_axes(feed, travel_between(from, to), Length::mm(run.increments.mm_per_unit));
}

Feed feed_into_stages(const Run& run, const Position& to, const Feed& feed) {
  const Position& from = run.state.position;
  const bool rotates = from.raw(Axis::A) != to.raw(Axis::A) ||
                       from.raw(Axis::B) != to.raw(Axis::B) || from.raw(Axis::C) != to.raw(Axis::C);
  if (!rotates || run.last != &run.sink) [[likely]]
    return feed;
  return feed_on_line(run, from, to, feed);
}

bool rapid_to(Run& run, const Position& to) {
  if (same_place(run.state.position, to)) return true;
  if (is_limited(run) && !check_path(run, run.state.position, to)) return false;
  run.events().on_rapid({run.origin, to});
  for (const Axis axis : kAllAxes) {
    if (is_imaginary(run.state, axis)) {
      run.state.held[static_cast<std::size_t>(axis)] = to.raw(axis);
    }
  }
  arrive(run, to);
  return true;
}

bool line_to(Run& run, const Position& to, const Feed& feed) {
  if (same_place(run.state.position, to)) return true;
  if (is_limited(run) && !check_path(run, run.state.position, to)) return false;
  if (run.state.imaginary != 0) [[unlikely]] {
    const Position from = held(run.state, run.state.position);
    const Position real = held(run.state, to);
    if (!same_place(from, real)) {
      const Feed own = run.last == &run.sink ? feed_on_line(run, from, real, feed) : feed;
      run.events().on_line({run.origin, real, own, run.rests_at_end()});
    }
  } else {
    const Feed own = feed_into_stages(run, to, feed);
    run.events().on_line({run.origin, to, own, run.rests_at_end()});
  }
  arrive(run, to);
  return true;
}

bool thread_to(Run& run, const Position& to, Length lead, std::optional<Angle> start) {
  if (same_place(run.state.position, to)) return true;
  if (!check_stroke(run, to)) return false;
  run.events().on_thread({run.origin, to, lead, start});
  arrive(run, to);
  return true;
}

bool arc_to(Run& run, const Arc& arc) {
  if (is_limited(run) && !check_arc(run, arc)) return false;
  if (run.state.imaginary != 0) {
    pieces_of_arc(run, arc);
    return true;
  }
  if (run.last != &run.sink || run.options.helix_feed_is_path) {
    run.events().on_arc(arc);
  } else {
    Arc own = arc;
    own.feed = feed_along_circle(arc.feed, arc, run.state.position);
    run.events().on_arc(own);
  }
  arrive(run, arc.to);
  return true;
}

}  // namespace dripline::interpreter::fanuc
