#include "gateway/interpreter/stages/blending/impl/path_writer.hpp"

#include <cmath>

namespace dripline::interpreter::blending::impl {
namespace {

/// Axes that stay where they are have not moved.
void place(Position& at, const PlaneAxes& axes, PlaneVector to) {
  if (at.raw(axes.first) != to.first) at.set_raw(axes.first, to.first);
  if (at.raw(axes.second) != to.second) at.set_raw(axes.second, to.second);
}

Arc arc_event(const Origin& origin, const Position& to, Plane plane, PlaneVector center) {
  Arc arc;
  arc.origin = origin;
  arc.to = to;
  arc.center_first = Length::mm(center.first);
  arc.center_second = Length::mm(center.second);
  arc.plane = plane;
  return arc;
}

Turn turn_of(double side) {
  return side > 0 ? Turn::Counterclockwise : Turn::Clockwise;
}

}  // namespace

void PathWriter::straight(const Element& element, const Origin& origin, const Position& to,
                          Feed feed) {
  state_.sent = to;
  if (element.is_rapid) {
    sink_.on_rapid({origin, to, element.line.rests});
  } else {
    sink_.on_line({origin, to, feed, element.line.rests});
  }
}

void PathWriter::put_out(const Element& element) {
  if (!element.is_arc && !element.is_moved) {
    state_.sent = element.line.to;
    if (!element.is_rapid) return sink_.on_line(element.line);
    return sink_.on_rapid({element.line.origin, element.line.to, element.line.rests});
  }
  Position to = element.line.to;
  if (element.is_moved) place(to, axes_of(state_.plane), element.end);
  const bool is_point = element.is_moved && element.is_arc &&
                        element.sweep * length(element.end - element.center) <= kNoLength;
  if (!element.is_arc || is_point) {
    if (!to.same_point(state_.sent)) straight(element, element.line.origin, to, element.line.feed);
    return;
  }
  Arc arc = arc_event(element.line.origin, to, state_.plane, element.center);
  arc.turn = turn_of(element.side);
  arc.sweep = element.is_moved ? Angle::radians(element.sweep) : element.given_sweep;
  arc.feed = element.line.feed;
  arc.rests = element.line.rests;
  state_.sent = to;
  sink_.on_arc(arc);
}

void PathWriter::put_out(const Corner& corner, const Element& element, const Origin& origin) {
  if (length(corner.arrive - corner.leave) <= kNoLength) return;
  const std::optional<Feed>& own = element.announced.corner->feed;
  const Feed feed = own.value_or(element.line.feed);
  Position to = state_.sent;
  place(to, axes_of(state_.plane), corner.arrive);
  if (!corner.is_arc) {
    if (!own) return straight(element, origin, to, feed);
    state_.sent = to;
    return sink_.on_line({origin, to, feed, element.line.rests});
  }
  Arc arc = arc_event(origin, to, state_.plane, corner.center);
  arc.turn = turn_of(corner.sweep);
  arc.sweep = Angle::radians(std::fabs(corner.sweep));
  arc.feed = feed;
  arc.rests = element.line.rests;
  state_.sent = to;
  sink_.on_arc(arc);
}

}  // namespace dripline::interpreter::blending::impl
