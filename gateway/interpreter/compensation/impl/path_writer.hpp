#pragma once

#include "gateway/interpreter/compensation/impl/state.hpp"

namespace dripline::interpreter::compensation::impl {

/// Gives decided moves to the sink and keeps `State::tool` where they lead. Lives for one call.
class PathWriter {
 public:
  PathWriter(EventSink& sink, State& state) : sink_(sink), state_(state) {}

  /// The way to the element and the element itself, to `end`. False, and nothing given out, when
  /// it would run against its programmed direction.
  bool put_out(const Element& element, PlaneVector end);
  /// The way to the element, then straight to `to`, a position of the tool.
  void put_out_straight(const Element& element, const Position& to);

 private:
  void put_out_arc(const Element& element, PlaneVector end, double sweep);
  void lead_in(const Element& element, Feed feed);
  void straight(const Element& element, const Position& to, Feed feed, bool rests);
  void arc(const Element& element, const Position& to, const Piece& piece, Feed feed, bool rests);
  Position tool_at(PlaneVector nose, const Position& others) const;
  PlaneVector nose() const;
  Feed paced(const Element& element, double own_length) const;

  EventSink& sink_;
  State& state_;
};

}  // namespace dripline::interpreter::compensation::impl
