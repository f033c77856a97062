#include "gateway/interpreter/compensation/impl/path_writer.hpp"

#include <algorithm>
#include <cmath>

namespace dripline::interpreter::compensation::impl {
namespace {

/// Rounding may make an element that its corners eat up altogether run this far backwards.
constexpr double kBackwards = 1e-7;

double length_of(const Piece& piece, PlaneVector from) {
  return piece.is_arc ? std::fabs(piece.sweep) * length(from - piece.center)
                      : length(piece.to - from);
}

}  // namespace

PlaneVector PathWriter::nose() const {
  return in_plane(state_.tool, axes_of(state_.plane)) - state_.tip;
}

Position PathWriter::tool_at(PlaneVector nose, const Position& others) const {
  Position to = others;
  set_in_plane(to, axes_of(state_.plane), nose + state_.tip);
  return to;
}

/// With inverse time, the pieces that lead to an element and the element share its time.
Feed PathWriter::paced(const Element& element, double own_length) const {
  const LeadIn& lead_in = element.lead_in;
  if (lead_in.count == 0 || element.feed.per() != Feed::Per::Move) return element.feed;
  double total = own_length;
  PlaneVector from = nose();
  for (std::uint8_t i = 0; i < lead_in.count; ++i) {
    total += length_of(lead_in.pieces[i], from);
    from = lead_in.pieces[i].to;
  }
  return Feed::inverse_time(element.feed.moves_per_minute() * total);
}

/// `feed` of inverse time is per millimetre here.
void PathWriter::lead_in(const Element& element, Feed feed) {
  for (std::uint8_t i = 0; i < element.lead_in.count; ++i) {
    const Piece& piece = element.lead_in.pieces[i];
    const double size = length_of(piece, nose());
    const Feed own =
        feed.per() == Feed::Per::Move ? Feed::inverse_time(feed.moves_per_minute() / size) : feed;
    const Position to = tool_at(piece.to, state_.tool);
    if (piece.is_arc) {
      arc(element, to, piece, own, false);
    } else {
      straight(element, to, own, false);
    }
  }
}

void PathWriter::straight(const Element& element, const Position& to, Feed feed, bool rests) {
  if (to.same_point(state_.tool)) return;
  state_.tool = to;
  if (element.is_rapid) {
    sink_.on_rapid({element.origin, to});
  } else {
    sink_.on_line({element.origin, to, feed, rests});
  }
}

void PathWriter::arc(const Element& element, const Position& to, const Piece& piece, Feed feed,
                     bool rests) {
  const PlaneVector center = piece.center + state_.tip;
  state_.tool = to;
  sink_.on_arc({.origin = element.origin,
                .to = to,
                .center_first = Length::mm(center.first),
                .center_second = Length::mm(center.second),
                .plane = state_.plane,
                .turn = piece.sweep > 0 ? Turn::CounterClockwise : Turn::Clockwise,
                .sweep = Angle::radians(std::fabs(piece.sweep)),
                .feed = feed,
                .rests = rests});
}

void PathWriter::put_out_straight(const Element& element, const Position& to) {
  const PlaneAxes axes = axes_of(state_.plane);
  const PlaneVector start = element.lead_in.count ? element.begin : nose();
  const double own = length(in_plane(to, axes) - state_.tip - start);
  Feed feed = paced(element, own);
  if (element.lead_in.count) {
    lead_in(element, feed);
    if (feed.per() == Feed::Per::Move && own > 0)
      feed = Feed::inverse_time(feed.moves_per_minute() / own);
  }
  straight(element, to, feed, element.rests);
}

void PathWriter::put_out_arc(const Element& element, PlaneVector end, double sweep) {
  const Arch& arch = element.arch;
  const double own = sweep * 0.5 * (element.offset_radius_in() + element.offset_radius_out());
  Feed feed = paced(element, own);
  if (element.lead_in.count) {
    lead_in(element, feed);
    if (feed.per() == Feed::Per::Move) feed = Feed::inverse_time(feed.moves_per_minute() / own);
  }
  const Piece piece{.is_arc = true, .to = end, .center = arch.center, .sweep = arch.side * sweep};
  arc(element, tool_at(end, element.to), piece, feed, element.rests);
}

bool PathWriter::put_out(const Element& element, PlaneVector end) {
  if (element.is_arc) {
    const double radius = std::min(element.offset_radius_in(), element.offset_radius_out());
    // a cutter that just fits stands still: its arc is a point
    const double sweep = radius > kNoLength ? offset_sweep(element, end) : 0;
    if (sweep * radius < -kBackwards) return false;
    if (sweep * radius > kNoLength) {
      put_out_arc(element, end, sweep);
      return true;
    }
  } else if (element.role == Role::Contour &&
             dot(end - element.begin, element.direction_in) < -kBackwards) {
    return false;
  }
  put_out_straight(element, tool_at(end, element.to));
  return true;
}

}  // namespace dripline::interpreter::compensation::impl
