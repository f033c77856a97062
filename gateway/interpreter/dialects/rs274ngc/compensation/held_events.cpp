#include "gateway/interpreter/dialects/rs274ngc/compensation/held_events.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

class Deliver {
 public:
  explicit Deliver(EventSink& sink) : sink_(sink) {}
  void operator()(const Rapid& event) { sink_.on_rapid(event); }
  void operator()(const Line& event) { sink_.on_line(event); }
  void operator()(const Arc& event) { sink_.on_arc(event); }
  void operator()(const Thread& event) { sink_.on_thread(event); }
  void operator()(const Dwell& event) { sink_.on_dwell(event); }
  void operator()(const Spindle& event) { sink_.on_spindle(event); }
  void operator()(const Coolant& event) { sink_.on_coolant(event); }
  void operator()(const ToolChange& event) { sink_.on_tool(event); }
  void operator()(const Miscellaneous& event) { sink_.on_miscellaneous(event); }
  void operator()(const Stop& event) { sink_.on_stop(event); }
  void operator()(const UnitsChange& event) { sink_.on_units(event); }
  void operator()(const OverrideInhibit& event) { sink_.on_override_inhibit(event); }
  void operator()(const HeldEvents::BlockEnd& event) { sink_.on_block_end(event.origin); }
  void operator()(const HeldEvents::Text& event) {
    using Kind = HeldEvents::Text::Kind;
    switch (event.kind) {
      case Kind::Message:
        return sink_.on_message({event.origin, event.text});
      case Kind::Output:
        return sink_.on_output({event.origin, event.device, event.text});
      case Kind::Open:
        return sink_.on_open({event.origin, event.device, event.text});
      case Kind::Close:
        return sink_.on_close({event.origin, event.device});
    }
  }

 private:
  EventSink& sink_;
};

}  // namespace

void HeldEvents::release(EventSink& sink) {
  Deliver deliver(sink);
  for (const Event& event : events_) std::visit(deliver, event);
  events_.clear();
}

}  // namespace dripline::interpreter::rs274ngc
