#pragma once

#include "gateway/interpreter/stages/compensation/impl/state.hpp"

namespace dripline::interpreter::compensation::impl {

/// Gives decided moves to the sink and keeps `State::sent` where they lead. Lives for one call.
class PathWriter {
 public:
  PathWriter(EventSink& sink, State& state, const Feed& arc_at_rapid)
      : sink_(sink), state_(state), arc_at_rapid_(arc_at_rapid), axes_(axes_of(state.plane)) {}

  /// The lead-in and the element itself, to `end`. False, and no move given out, when it would run
  /// against its programmed direction.
  bool put_out(const Element& element, PlaneVector end);
  /// The lead-in, then straight on until the tip is at `tip`.
  void put_out_straight(const Element& element, PlaneVector tip);

 private:
  /// The parts of a move besides its path in the plane.
  struct Company {
    const Position& others;  ///< where the axes outside the plane go
    const Feed& feed;
    bool rests = false;
  };

  void put_out_arc(const Element& element, PlaneVector end, double sweep);
  void lead_in(const Element& element, const Feed& feed);
  void straight(const Element& element, PlaneVector tip, const Company& with);
  void arc(const Element& element, const Piece& piece, const Company& with);
  void move_tool(PlaneVector tip, const Position& others);
  PlaneVector nose() const;
  Feed paced(const Element& element, double own_length) const;

  EventSink& sink_;
  State& state_;
  const Feed& arc_at_rapid_;
  PlaneAxes axes_;
};

}  // namespace dripline::interpreter::compensation::impl
