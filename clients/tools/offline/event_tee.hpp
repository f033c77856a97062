#pragma once

#include "gateway/interpreter/stages/event_filter.hpp"

namespace dripline::interpreter {

/// Delivers every event to two sinks, one after the other. Both must outlive it.
class EventTee final : public EventRelay<EventTee> {
 public:
  EventTee(EventSink& first, EventSink& second) : first_(first), second_(second) {}

 private:
  friend EventRelay;
  template <class Event>
  void pass(void (EventSink::*deliver)(const Event&), const Event& event) {
    (first_.*deliver)(event);
    (second_.*deliver)(event);
  }

  EventSink& first_;
  EventSink& second_;
};

}  // namespace dripline::interpreter
