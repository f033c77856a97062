#include "clients/tools/offline/trace_writer.hpp"

#include <algorithm>
#include <cmath>

#include "clients/tools/offline/number_text.hpp"
#include "gateway/interpreter/core/event.hpp"
#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::interpreter {
namespace {

constexpr std::size_t kFlushAt = 32 * 1024;
/// Millimeters or degrees: what rounding leaves of a path there and back is no move.
constexpr double kNoMove = 1e-7;

}  // namespace

TraceWriter::TraceWriter(Write write, const Position& start) : write_(std::move(write)) {
  buffer_.reserve(kFlushAt + 4096);
  for (const Axis axis : kAllAxes) last_.set_raw(axis, start.raw(axis));
  last_.unmark_all();
}

void TraceWriter::flush() {
  if (buffer_.empty()) return;
  write_(buffer_);
  buffer_.clear();
}

// The parts of an object.

void TraceWriter::begin(std::string_view event, const Origin& origin) {
  buffer_ += "{\"event\":\"";
  buffer_ += event;
  buffer_ += "\",\"line\":";
  append_integer(buffer_, origin.line);
  if (origin.sequence == Origin::kNone) {
    buffer_ += ",\"block\":null";
  } else {
    buffer_ += ",\"block\":\"";
    append_integer(buffer_, origin.sequence);
    buffer_ += '"';
  }
}

void TraceWriter::end() {
  buffer_ += "}\n";
  if (buffer_.size() >= kFlushAt) flush();
}

void TraceWriter::member(std::string_view name) {
  buffer_ += ",\"";
  buffer_ += name;
  buffer_ += "\":";
}
void TraceWriter::member(std::string_view name, double value) {
  member(name);
  append_number(buffer_, value);
}
void TraceWriter::member(std::string_view name, int value) {
  member(name);
  append_integer(buffer_, std::int64_t{value});
}
void TraceWriter::member(std::string_view name, bool value) {
  member(name);
  buffer_ += value ? "true" : "false";
}
void TraceWriter::member(std::string_view name, std::string_view value) {
  member(name);
  append_json_string(buffer_, value);
}

double TraceWriter::in_units(Length length) const {
  return is_inch_ ? length.inch() : length.mm();
}

void TraceWriter::coordinate(Axis axis, double raw) {
  const double value = is_rotary(axis) || !is_inch_ ? raw : raw / Length::kMillimetersPerInch;
  buffer_ += '"';
  buffer_ += letter(axis);
  buffer_ += "\":";
  append_number(buffer_, axis == Axis::X ? value * x_scale_ : value);
}

void TraceWriter::position(std::string_view name, const Position& position) {
  member(name);
  char separator = '{';
  for (const Axis axis : kAllAxes) {
    if (!position.has(axis) && !last_.has(axis)) continue;
    buffer_ += separator;
    separator = ',';
    coordinate(axis, position.raw(axis));
  }
  buffer_ += separator == '{' ? "{}" : "}";
}

void TraceWriter::feed(const Feed& feed, bool is_of_degrees) {
  const double length = is_of_degrees ? feed.length().mm() : in_units(feed.length());
  buffer_ += ",\"feed\":{\"value\":";
  append_number(buffer_, feed.per() == Feed::Per::Move ? feed.moves_per_minute() : length);
  buffer_ += ",\"per\":\"";
  buffer_ += word_of(feed.per());
  buffer_ += "\"}";
}

void TraceWriter::diagnostic(const Diagnostic& diagnostic) {
  member("code", diagnostic.id);
  member("text", std::string_view(diagnostic.text));
}

bool TraceWriter::is_turn(const Position& to) const {
  return std::ranges::all_of(kAllAxes, [&](Axis axis) {
    return is_rotary(axis) || std::fabs(to.raw(axis) - last_.raw(axis)) <= kNoMove;
  });
}

bool TraceWriter::moves_to(const Position& to) {
  bool moved = false;
  for (const Axis axis : kAllAxes) {
    moved |= std::fabs(to.raw(axis) - last_.raw(axis)) > kNoMove;
  }
  const Position before = last_;
  last_ = to;
  last_.mark_all_of(before);
  return moved;
}

// The events.

void TraceWriter::on_program(const ProgramHeader& header) {
  is_inch_ = header.units == Units::Inch;
  x_scale_ = header.x_is_diameter ? 2 : 1;
  buffer_ += "{\"event\":\"program\"";
  member("control", header.control);
  if (header.name) {
    member("name", *header.name);
  } else {
    buffer_ += ",\"name\":null";
  }
  member("units", word_of(header.units));
  if (header.x_is_diameter) member("x", std::string_view("diameter"));
  end();
}

void TraceWriter::on_units(const UnitsChange& change) {
  is_inch_ = change.units == Units::Inch;
  begin("units", change.origin);
  member("units", word_of(change.units));
  end();
}

void TraceWriter::on_rapid(const Rapid& rapid) {
  if (!moves_to(rapid.to)) return;
  begin("rapid", rapid.origin);
  position("to", rapid.to);
  end();
}

void TraceWriter::on_line(const Line& line) {
  const bool turns = is_turn(line.to);
  if (!moves_to(line.to)) return;
  begin("feed", line.origin);
  position("to", line.to);
  feed(line.feed, turns);
  end();
}

void TraceWriter::arc_path(const Arc& arc) {
  const PlaneAxes axes = axes_of(arc.plane);
  const double first = arc.center_first.mm();
  const double second = arc.center_second.mm();
  const bool x_is_second = axes.second == Axis::X;  // X, Y, Z is the order everywhere
  buffer_ += ",\"center\":{";
  coordinate(x_is_second ? axes.second : axes.first, x_is_second ? second : first);
  buffer_ += ',';
  coordinate(x_is_second ? axes.first : axes.second, x_is_second ? first : second);
  buffer_ += '}';
  member("plane", word_of(arc.plane));
  member("direction", word_of(arc.turn));
  member("sweep", arc.sweep.degrees());
}

void TraceWriter::on_arc(const Arc& arc) {
  if (!moves_to(arc.to) && arc.sweep.degrees() == 0) return;
  begin("arc", arc.origin);
  position("to", arc.to);
  arc_path(arc);
  feed(arc.feed);
  end();
}

void TraceWriter::on_thread(const Thread& thread) {
  if (!moves_to(thread.to) && !thread.arc) return;
  begin("thread", thread.origin);
  position("to", thread.to);
  if (thread.arc) arc_path(arc_of(thread));
  member("lead", in_units(thread.lead));
  if (thread.lead_change != Length{}) member("lead_change", in_units(thread.lead_change));
  if (thread.start_angle) member("start_angle", thread.start_angle->degrees());
  end();
}

void TraceWriter::on_dwell(const Dwell& dwell) {
  begin("dwell", dwell.origin);
  if (dwell.revolutions) {
    member("revolutions", *dwell.revolutions);
  } else {
    member("seconds", dwell.seconds);
  }
  end();
}

void TraceWriter::on_spindle(const Spindle& spindle) {
  begin("spindle", spindle.origin);
  member("state", word_of(spindle.state));
  if (spindle.surface_speed) {
    // As every control is programmed: feet or meters a minute.
    const Units units = is_inch_ ? Units::Inch : Units::Millimeter;
    member("surface_speed", spindle.surface_speed->mm() / mm_per_surface_unit(units));
  } else {
    member("speed", spindle.revolutions_per_minute);
  }
  if (spindle.max_revolutions) member("max_speed", *spindle.max_revolutions);
  end();
}

void TraceWriter::on_coolant(const Coolant& coolant) {
  begin("coolant", coolant.origin);
  member("flood", coolant.flood);
  member("mist", coolant.mist);
  end();
}

void TraceWriter::on_tool(const ToolChange& tool) {
  begin("tool", tool.origin);
  member(tool.is_preselection ? "next" : "number", tool.number);
  if (tool.offset) member("offset", *tool.offset);
  end();
}

void TraceWriter::corner(std::string_view name, const Position& corner) {
  member(name);
  char separator = '{';
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    buffer_ += separator;
    separator = ',';
    coordinate(axis, corner.raw(axis));
  }
  buffer_ += '}';
}

void TraceWriter::on_blank(const Blank& blank) {
  begin("blank", blank.origin);
  const char axis = letter(blank.spindle_axis);
  member("axis", std::string_view(&axis, 1));
  corner("min", blank.min);
  corner("max", blank.max);
  end();
}

void TraceWriter::on_miscellaneous(const Miscellaneous& function) {
  begin("misc", function.origin);
  member("code", function.code);
  if (function.e) member("e", *function.e);
  if (function.p) member("p", *function.p);
  if (function.q) member("q", *function.q);
  end();
}

void TraceWriter::on_pin(const PinChange& pin) {
  begin("pin", pin.origin);
  const char axis = letter(pin.axis);
  member("axis", std::string_view(&axis, 1));
  member("output", pin.output);
  member("state", pin.state ? 1 : 0);
  if (pin.pulse_ms) member("pulse_ms", *pin.pulse_ms);
  end();
}

void TraceWriter::on_probe(const Probe& probe) {
  if (!probe.result) return;
  Position at = probe.result->at;
  at.mark_all_of(probe.to);
  moves_to(at);
  begin("probe", probe.origin);
  position("to", probe.to);
  if (probe.arc) {
    Probe programmed = probe;
    programmed.result.reset();
    arc_path(arc_of(programmed));
  }
  if (probe.is_rapid) member("rapid", true);
  member("until", word_of(probe.until));
  buffer_ += ",\"result\":{\"tripped\":";
  buffer_ += probe.result->tripped ? "true" : "false";
  position("at", at);
  buffer_ += '}';
  end();
}

void TraceWriter::on_output(const Output& output) {
  begin("output", output.origin);
  member("device", word_of(output.device));
  member("text", output.text);
  end();
}

void TraceWriter::on_open(const Open& open) {
  begin("open", open.origin);
  member("device", word_of(open.device));
  if (open.name) member("name", *open.name);
  end();
}

void TraceWriter::on_close(const Close& close) {
  begin("close", close.origin);
  member("device", word_of(close.device));
  end();
}

void TraceWriter::on_message(const Message& message) {
  begin("message", message.origin);
  member("text", message.text);
  end();
}

void TraceWriter::on_prompt(const Prompt& prompt) {
  begin("prompt", prompt.origin);
  member("text", prompt.text);
  member("variable", prompt.variable);
  member("answer", prompt.answer);
  end();
}

void TraceWriter::on_stop(const Stop& stop) {
  begin("stop", stop.origin);
  member("kind", word_of(stop.kind));
  end();
}

void TraceWriter::on_warning(const Warning& warning) {
  begin("warning", warning.origin);
  diagnostic(warning.diagnostic);
  end();
}

void TraceWriter::on_alarm(const Alarm& alarm) {
  begin("alarm", alarm.origin);
  diagnostic(alarm.diagnostic);
  end();
  flush();
}

void TraceWriter::on_end(const End& end_of_program) {
  begin("end", end_of_program.origin);
  member("blocks");
  append_integer(buffer_, end_of_program.blocks);
  member("rewind", end_of_program.rewind);
  end();
  flush();
}

}  // namespace dripline::interpreter
