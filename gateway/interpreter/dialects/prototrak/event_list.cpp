#include "gateway/interpreter/dialects/prototrak/event_list.hpp"

#include <fmt/format.h>
#include <cmath>
#include <string_view>

#include "protocol/base/decimal.hpp"

namespace dripline::interpreter::prototrak {
namespace {

/// At the control's resolution, without needless zeros but always with a point.
std::string number(double value, int decimals) {
  const std::string text = decimal_text(value, decimals);
  return text.find('.') == std::string::npos ? text + "." : text;
}

class EventLine {
 public:
  EventLine(const ProgramEvent& event, std::size_t index)
      : event_(event), text_(fmt::format("N{:03}", index % 1000)) {}

  std::string print();

 private:
  double units(double mm) const { return event_.is_metric ? mm : mm / Length::kMillimetersPerInch; }
  void word(std::string_view address, double mm, std::string_view tag = "") {
    text_ += fmt::format(" {}{}{}", address, number(units(mm), event_.is_metric ? 2 : 4), tag);
  }
  void point(std::string_view x, std::string_view y, XY at) {
    word(x, at.x, "A");
    word(y, at.y, "A");
  }
  void integer(std::string_view address, int value) {
    text_ += fmt::format(" {}{}", address, value);
  }
  void code(int g) { text_ += fmt::format(" G{}", g); }
  void feed() {
    const double value = units(event_.feed);
    text_ +=
        event_.is_metric ? fmt::format(" F{:.0f}", value) : fmt::format(" F{}", number(value, 1));
  }
  void tool_data() {
    feed();
    integer("TC", static_cast<int>(event_.side));
    word("D", event_.diameter);
  }
  void cut();
  void repeat();
  void hollow(int rectangle_code, int circle_code);

  const ProgramEvent& event_;
  std::string text_;
};

void EventLine::cut() {
  const bool is_arc = event_.kind == EventKind::Arc;
  code(!is_arc ? 101 : event_.is_counterclockwise ? 103 : 102);
  point("XB", "YB", event_.begin);
  point("XE", "YE", event_.end);
  if (is_arc) point("XC", "YC", event_.center);
  tool_data();
  event_.is_connected ? word("CR", event_.conrad) : void(text_ += " CR-");
}

void EventLine::repeat() {
  code(105);
  integer("FE", event_.from_event);
  integer("LE", event_.to_event);
  word("XO", event_.end.x);
  word("YO", event_.end.y);
  integer("RE", event_.passes);
  if (event_.has_diameter) word("D", event_.diameter);
}

void EventLine::hollow(int rectangle_code, int circle_code) {
  const bool is_rectangle =
      event_.kind == EventKind::RectangularPocket || event_.kind == EventKind::RectangularFrame;
  code(is_rectangle ? rectangle_code : circle_code);
  if (is_rectangle) {
    point("XB", "YB", event_.begin);
    point("XD", "YD", event_.end);
  } else {
    point("XC", "YC", event_.begin);
    word("R", event_.radius);
  }
  integer("DR", event_.is_counterclockwise ? 2 : 1);
  word("FC", event_.finish_cut);
  tool_data();
  if (is_rectangle) word("CR", event_.conrad);
}

std::string EventLine::print() {
  switch (event_.kind) {
    case EventKind::Position:
      code(100);
      point("X", "Y", event_.begin);
      break;
    case EventKind::Mill:
    case EventKind::Arc:
      cut();
      break;
    case EventKind::BoltHole:
      code(104);
      point("XC", "YC", event_.begin);
      integer("HL", event_.holes);
      word("R", event_.radius);
      text_ += fmt::format(" A{}", number(event_.angle, 3));
      break;
    case EventKind::Repeat:
      repeat();
      break;
    case EventKind::RectangularPocket:
    case EventKind::CircularPocket:
      hollow(106, 108);
      break;
    case EventKind::RectangularFrame:
    case EventKind::CircularFrame:
      hollow(107, 109);
  }
  if (event_.kind != EventKind::Repeat || event_.has_tool) integer("T", event_.tool);
  return text_ + " ;\r\n";
}

}  // namespace

std::string list_events(const StoredProgram& program) {
  bool is_metric = program.is_metric;
  std::string text = fmt::format("PN{} G{} ;\r\n", program.part_number, is_metric ? 21 : 20);
  for (std::size_t i = 0; i < program.events.size(); ++i) {
    const ProgramEvent& event = program.events[i];
    if (event.is_metric != is_metric) {
      is_metric = event.is_metric;
      text += fmt::format("G{} ;\r\n", is_metric ? 21 : 20);
    }
    text += EventLine(event, i + 1).print();
  }
  return text + "%\r\n";
}

}  // namespace dripline::interpreter::prototrak
