#pragma once

#include "gateway/interpreter/stages/blending/impl/corner.hpp"
#include "gateway/interpreter/stages/blending/impl/state.hpp"

namespace dripline::interpreter::blending::impl {

/// Gives decided moves to the sink and keeps `State::sent` where they lead. Lives for one call.
class PathWriter {
 public:
  PathWriter(EventSink& sink, State& state) : sink_(sink), state_(state) {}

  void put_out(const Element& element);
  /// The piece at the end of `element`, after it.
  void put_out(const Corner& corner, const Element& element, const Origin& origin);

 private:
  void straight(const Element& element, const Origin& origin, const Position& to, Feed feed);

  EventSink& sink_;
  State& state_;
};

}  // namespace dripline::interpreter::blending::impl
