#include "tests/support/event_log.hpp"

#include <fmt/core.h>

namespace dripline::interpreter {
namespace {

std::string text_of(const Position& position) {
  std::string text;
  for (std::size_t i = 0; i < kAxisCount; ++i) {
    const auto axis = static_cast<Axis>(i);
    if (position.has(axis)) text += fmt::format(" {}{}", letter(axis), position.raw(axis));
  }
  return text;
}

std::string text_of(const Feed& feed) {
  return fmt::format(" F{}/{}/{}", feed.length().mm(), feed.moves_per_minute(),
                     static_cast<int>(feed.per()));
}

template <class Value>
std::string or_none(const std::optional<Value>& value) {
  return value ? fmt::format(" {}", *value) : " none";
}

}  // namespace

void EventLog::add(const char* name, const Origin& origin, std::string members) {
  lines_.push_back(fmt::format("{} {}:{}:{}:{}:{}{}", name, origin.block, origin.offset,
                               origin.line, origin.sequence, origin.program, members));
}

void EventLog::on_program(const ProgramHeader& event) {
  lines_.push_back(fmt::format("program {}{} {} {}", event.control, or_none(event.name),
                               static_cast<int>(event.units), event.x_is_diameter));
}
void EventLog::on_units(const UnitsChange& event) {
  add("units", event.origin, fmt::format(" {}", static_cast<int>(event.units)));
}
void EventLog::on_rapid(const Rapid& event) {
  add("rapid", event.origin, text_of(event.to) + (event.rests ? "" : " flows"));
}
void EventLog::on_line(const Line& event) {
  add("line", event.origin,
      text_of(event.to) + text_of(event.feed) + (event.rests ? " rests" : ""));
}
void EventLog::on_arc(const Arc& event) {
  add("arc", event.origin,
      text_of(event.to) + text_of(event.feed) +
          fmt::format(" {} {} {} {} {}", event.center_first.mm(), event.center_second.mm(),
                      static_cast<int>(event.plane), static_cast<int>(event.turn),
                      event.sweep.degrees()) +
          (event.rests ? " rests" : ""));
}
void EventLog::on_thread(const Thread& event) {
  add("thread", event.origin,
      text_of(event.to) + fmt::format(" {}", event.lead.mm()) +
          (event.start_angle ? fmt::format(" at {}", event.start_angle->degrees()) : "") +
          (event.arc ? fmt::format(" {} {} {}", event.arc->center_first.mm(),
                                   event.arc->center_second.mm(), event.arc->sweep.degrees())
                     : "") +
          (event.lead_change != Length{} ? fmt::format(" {}", event.lead_change.mm()) : ""));
}
void EventLog::on_dwell(const Dwell& event) {
  add("dwell", event.origin, fmt::format(" {}", event.seconds) + or_none(event.revolutions));
}
void EventLog::on_spindle(const Spindle& event) {
  add("spindle", event.origin,
      fmt::format(" {} {} {}", static_cast<int>(event.state), event.revolutions_per_minute,
                  event.surface_speed.value_or(Length{}).mm()) +
          or_none(event.max_revolutions));
}
void EventLog::on_coolant(const Coolant& event) {
  add("coolant", event.origin, fmt::format(" {} {}", event.flood, event.mist));
}
void EventLog::on_tool(const ToolChange& event) {
  add("tool", event.origin,
      fmt::format(" {} {}", event.number, event.is_preselection) + or_none(event.offset) +
          (event.shape ? fmt::format(" L{} R{}", event.shape->length.mm(), event.shape->radius.mm())
                       : ""));
}
void EventLog::on_blank(const Blank& event) {
  add("blank", event.origin,
      fmt::format(" {}", letter(event.spindle_axis)) + text_of(event.min) + text_of(event.max));
}
void EventLog::on_miscellaneous(const Miscellaneous& event) {
  add("misc", event.origin, fmt::format(" {}", event.code));
}
void EventLog::on_pin(const PinChange& event) {
  add("pin", event.origin, fmt::format(" {}{} {}", letter(event.axis), event.output, event.state));
}
void EventLog::on_probe(const Probe& event) {
  add("probe", event.origin,
      text_of(event.from) + text_of(event.to) + text_of(event.feed) +
          (event.result ? fmt::format(" {}{}", event.result->tripped, text_of(event.result->at))
                        : " open"));
}
void EventLog::on_output(const Output& event) {
  add("output", event.origin, fmt::format(" {} {}", static_cast<int>(event.device), event.text));
}
void EventLog::on_open(const Open& event) {
  add("open", event.origin,
      fmt::format(" {}", static_cast<int>(event.device)) + or_none(event.name));
}
void EventLog::on_close(const Close& event) {
  add("close", event.origin, fmt::format(" {}", static_cast<int>(event.device)));
}
void EventLog::on_message(const Message& event) {
  add("message", event.origin, fmt::format(" {}", event.text));
}
void EventLog::on_prompt(const Prompt& event) {
  add("prompt", event.origin, fmt::format(" {} {} {}", event.text, event.variable, event.answer));
}
void EventLog::on_stop(const Stop& event) {
  add("stop", event.origin, fmt::format(" {}", static_cast<int>(event.kind)));
}
void EventLog::on_override_inhibit(const OverrideInhibit& event) {
  add("lock", event.origin,
      fmt::format(" {:d}{:d}{:d} {} {:d}", event.feed_override, event.spindle_override,
                  event.single_block, static_cast<int>(event.hold), event.is_tapping));
}
void EventLog::on_warning(const Warning& event) {
  add("warning", event.origin, fmt::format(" {} {}", event.diagnostic.id, event.diagnostic.text));
}
void EventLog::on_alarm(const Alarm& event) {
  add("alarm", event.origin,
      fmt::format(" {} {}:{} {}", event.diagnostic.id, event.diagnostic.line,
                  event.diagnostic.column, event.diagnostic.text));
}
void EventLog::on_end(const End& event) {
  add("end", event.origin, fmt::format(" {} {}", event.blocks, event.rewind));
}
void EventLog::on_block_end(const Origin& event) {
  add("block", event, "");
}

}  // namespace dripline::interpreter
