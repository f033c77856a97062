#include "gateway/interpreter/dialects/rs274ngc/compensation/held_events.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

struct Deliver : look_ahead::Forwarder {
  using Forwarder::operator();
  void operator()(const Arc& event) const { sink.on_arc(event); }
  void operator()(const Thread& event) const { sink.on_thread(event); }
  void operator()(const HeldEvents::Text& event) const { give(event.head, event.text); }
};

}  // namespace

void HeldEvents::release(EventSink& sink) {
  const Deliver deliver{{sink}};
  for (const Event& event : events_) std::visit(deliver, event);
  events_.clear();
}

}  // namespace dripline::interpreter::rs274ngc
