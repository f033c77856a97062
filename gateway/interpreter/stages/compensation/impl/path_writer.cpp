#include "gateway/interpreter/stages/compensation/impl/path_writer.hpp"

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

/// With inverse time, the pieces that lead to an element and the element share its time.
bool shares_time(const Element& element) {
  return element.lead_in.count != 0 && element.feed.per() == Feed::Per::Move;
}

}  // namespace

PlaneVector PathWriter::nose() const {
  return in_plane(state_.sent, axes_) - state_.tip;
}

/// Positions are built from older ones wherever they are needed: a copy of one whose numbers have
/// just been written has to wait for them.
void PathWriter::move_tool(PlaneVector tip, const Position& others) {
  if (&others != &state_.sent) state_.sent = others;
  set_in_plane(state_.sent, axes_, tip);
}

/// Moves per minute and millimeter of an element that shares its time.
Feed PathWriter::paced(const Element& element, double own_length) const {
  const LeadIn& lead_in = element.lead_in;
  double total = own_length;
  PlaneVector from = nose();
  for (std::uint8_t i = 0; i < lead_in.count; ++i) {
    total += length_of(lead_in.pieces[i], from);
    from = lead_in.pieces[i].to;
  }
  return Feed::inverse_time(element.feed.moves_per_minute() * total);
}

/// `feed` of inverse time is per millimeter here.
void PathWriter::lead_in(const Element& element, const Feed& feed) {
  const bool is_paced = feed.per() == Feed::Per::Move;
  for (std::uint8_t i = 0; i < element.lead_in.count; ++i) {
    const Piece& piece = element.lead_in.pieces[i];
    // an arc that leads away belongs to the contour, not to the move after it
    const bool leads_away = element.role == Role::Cancel && piece.origin;
    Feed own;
    if (is_paced) own = Feed::inverse_time(feed.moves_per_minute() / length_of(piece, nose()));
    const Feed& pace = leads_away ? state_.waiting().feed : is_paced ? own : feed;
    if (piece.is_arc) {
      arc(element, piece, {state_.sent, pace.is_zero() ? arc_at_rapid_ : pace});
    } else {
      straight(element, piece.to + state_.tip, {state_.sent, pace});
    }
  }
}

void PathWriter::straight(const Element& element, PlaneVector tip, const Company& with) {
  Line move{element.origin, with.others, with.feed, with.rests};
  set_in_plane(move.to, axes_, tip);
  if (move.to.same_point(state_.sent)) return;
  move_tool(tip, with.others);
  if (element.is_rapid) {
    sink_.on_rapid({element.origin, move.to, move.rests});
  } else {
    sink_.on_line(move);
  }
}

void PathWriter::arc(const Element& element, const Piece& piece, const Company& with) {
  const PlaneVector center = piece.center + state_.tip;
  const PlaneVector tip = piece.to + state_.tip;
  Arc move{.origin = piece.origin.value_or(element.origin),
           .to = with.others,
           .center_first = Length::mm(center.first),
           .center_second = Length::mm(center.second),
           .plane = state_.plane,
           .turn = piece.sweep > 0 ? Turn::Counterclockwise : Turn::Clockwise,
           .sweep = Angle::radians(std::fabs(piece.sweep)),
           .feed = with.feed,
           .rests = with.rests};
  set_in_plane(move.to, axes_, tip);
  move_tool(tip, with.others);
  sink_.on_arc(move);
}

void PathWriter::put_out_straight(const Element& element, PlaneVector tip) {
  if (!shares_time(element)) [[likely]] {
    lead_in(element, element.feed);
    return straight(element, tip, {element.to, element.feed, element.rests});
  }
  const double own = length(tip - state_.tip - element.begin);
  Feed feed = paced(element, own);
  lead_in(element, feed);
  if (own > 0) feed = Feed::inverse_time(feed.moves_per_minute() / own);
  straight(element, tip, {element.to, feed, element.rests});
}

void PathWriter::put_out_arc(const Element& element, PlaneVector end, double sweep) {
  const Arch& arch = element.arch;
  const Piece piece{.is_arc = true, .to = end, .center = arch.center, .sweep = arch.side * sweep};
  if (!shares_time(element)) [[likely]] {
    lead_in(element, element.feed);
    return arc(element, piece, {element.to, element.feed, element.rests});
  }
  const double own = sweep * 0.5 * (element.offset_radius_in() + element.offset_radius_out());
  Feed feed = paced(element, own);
  lead_in(element, feed);
  feed = Feed::inverse_time(feed.moves_per_minute() / own);
  arc(element, piece, {element.to, feed, element.rests});
}

bool PathWriter::put_out(const Element& element, PlaneVector end) {
  if (element.is_arc) {
    const double radius = std::min(element.offset_radius_in(), element.offset_radius_out());
    // a cutter that just fits does not move: its arc is a point
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
  put_out_straight(element, end + state_.tip);
  return true;
}

}  // namespace dripline::interpreter::compensation::impl
