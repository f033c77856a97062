#include "clients/cli/offline/check_report.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "clients/cli/text/table.hpp"
#include "clients/cli/text/value_text.hpp"
#include "clients/tools/offline/check_summary.hpp"
#include "gateway/interpreter/core/event.hpp"

namespace dripline::cli {
namespace {

using interpreter::Axis;
using interpreter::AxisExtent;
using interpreter::Diagnostic;
using interpreter::MachineState;
using interpreter::Summary;
using Json = nlohmann::ordered_json;

bool is_inch(const Summary& summary) {
  return summary.units == interpreter::Units::Inch;
}

std::string_view unit_name(const Summary& summary) {
  return is_inch(summary) ? "in" : "mm";
}

double length(const Summary& summary, Length value) {
  return is_inch(summary) ? value.inch() : value.mm();
}

/// As the program would write it.
AxisExtent programmed(const Summary& summary, Axis axis, const AxisExtent& extent) {
  if (interpreter::is_rotary(axis)) return extent;
  const double diameter = axis == Axis::X && summary.x_is_diameter ? 2 : 1;
  return {diameter * length(summary, Length::mm(extent.least)),
          diameter * length(summary, Length::mm(extent.most))};
}

const std::string& file_of(const CheckReport& report, const interpreter::Origin& origin) {
  const bool is_called = origin.program > 0 && origin.program <= report.called.size();
  return is_called ? report.called[origin.program - 1] : report.file;
}

/// The first message's place is what editors jump to.
std::string place(const std::string& file, const Diagnostic& diagnostic) {
  std::string text = fmt::format("{}:{}", file, diagnostic.line);
  if (diagnostic.column > 0) text += fmt::format(":{}", diagnostic.column);
  return text;
}

template <class Event>
std::string diagnostic_line(const CheckReport& report, const Event& event, std::string_view kind) {
  const Diagnostic& diagnostic = event.diagnostic;
  return fmt::format("{}: {} {}: {}\n", place(file_of(report, event.origin), diagnostic), kind,
                     diagnostic.id, printable(diagnostic.text));
}

double blocks_per_second(const CheckReport& report) {
  if (report.elapsed_seconds <= 0) return 0;
  return static_cast<double>(report.summary.blocks) / report.elapsed_seconds;
}

void add_extents(Details& details, const Summary& summary) {
  for (const Axis axis : interpreter::kAllAxes) {
    const auto& extent = summary.extents[static_cast<std::size_t>(axis)];
    if (!extent) continue;
    const AxisExtent shown = programmed(summary, axis, *extent);
    const bool is_diameter = axis == Axis::X && summary.x_is_diameter;
    details.add(std::string(1, interpreter::letter(axis)),
                fmt::format("{:.4f} to {:.4f} {}{}", shown.least, shown.most,
                            interpreter::is_rotary(axis) ? "degrees" : unit_name(summary),
                            is_diameter ? " diameter" : ""));
  }
}

std::string block_name(const interpreter::Origin& origin) {
  if (origin.sequence < 0) return fmt::format("line {}", origin.line);
  return fmt::format("block {} in line {}", origin.sequence, origin.line);
}

std::string verdict(const CheckReport& report, bool has_color) {
  const auto& summary = report.summary;
  if (report.stopped) {
    return styled("comes to " + block_name(report.stopped->block()), Style::Good, has_color);
  }
  std::string place_text;
  if (summary.alarm) {
    place_text = fmt::format(" in line {}", summary.alarm->diagnostic.line);
    const std::string& file = file_of(report, summary.alarm->origin);
    if (file != report.file) place_text += " of " + file;
  }
  const std::string text =
      summary.ended ? "reaches its end" : fmt::format("raises an alarm{}", place_text);
  return styled(text, summary.ended ? Style::Good : Style::Bad, has_color);
}

std::string summary_feed(const Summary& summary, const Feed& feed) {
  switch (feed.per()) {
    case Feed::Per::Minute:
      return fmt::format("{:.1f} {}/min", length(summary, feed.length()), unit_name(summary));
    case Feed::Per::Revolution:
      return fmt::format("{:.4f} {}/rev", length(summary, feed.length()), unit_name(summary));
    case Feed::Per::Move:
      break;
  }
  return fmt::format("{:.3f} moves/min", feed.moves_per_minute());
}

void add_state(Details& details, const Summary& summary, const MachineState& state) {
  std::string position;
  for (const Axis axis : interpreter::kAllAxes) {
    if (!state.position().has(axis)) continue;
    const double raw = state.position().raw(axis);
    position += fmt::format("{}{} {:.4f}", position.empty() ? "" : "  ", interpreter::letter(axis),
                            programmed(summary, axis, {raw, raw}).least);
  }
  details.add("position", position);
  details.add("tool", state.tool() ? std::to_string(*state.tool()) : "");
  details.add("feed", state.feed() ? summary_feed(summary, *state.feed()) : "");
  const auto& spindle = state.spindle();
  std::string turning(word_of(spindle.state));
  if (spindle.state != interpreter::SpindleState::Off && !spindle.surface_speed) {
    turning += fmt::format(" {:.0f} rpm", spindle.revolutions_per_minute);
  }
  details.add("spindle", turning);
  const auto& coolant = state.coolant();
  details.add("coolant", coolant.flood ? (coolant.mist ? "flood, mist" : "flood")
                                       : (coolant.mist ? "mist" : "off"));
}

template <class Event>
Json diagnostic_json(const CheckReport& report, const Event& event) {
  const Diagnostic& diagnostic = event.diagnostic;
  return {{"code", std::string(diagnostic.id)},
          {"text", diagnostic.text},
          {"line", diagnostic.line},
          {"column", diagnostic.column},
          {"file", file_of(report, event.origin)}};
}

std::string_view kind_text(interpreter::StopKind kind) {
  constexpr std::string_view kTexts[] = {"program stop", "optional stop", "tool change by hand",
                                         "waits for the operator"};
  return kTexts[static_cast<std::size_t>(kind)];
}

std::string stop_lines(const CheckReport& report) {
  std::string text;
  if (!report.stops) return text;
  for (const auto& [stop, times, block] : report.stops->places) {
    text += fmt::format("{}:{}: stop: {}", file_of(report, stop.origin), stop.origin.line,
                        kind_text(stop.kind));
    if (stop.origin.sequence >= 0) text += fmt::format(", block {}", stop.origin.sequence);
    if (times > 1) text += fmt::format(", met {} times", times);
    text += fmt::format(": {}\n", printable(block));
  }
  if (report.stops->places.size() >= interpreter::StopList::kMaxPlaces) {
    text +=
        fmt::format("(only the first {} places are listed)\n", interpreter::StopList::kMaxPlaces);
  }
  return text;
}

Json stops_json(const CheckReport& report) {
  Json stops = Json::array();
  for (const auto& [stop, times, block] : report.stops->places) {
    const auto sequence = stop.origin.sequence;
    stops.push_back({{"file", file_of(report, stop.origin)},
                     {"line", stop.origin.line},
                     {"block", sequence >= 0 ? Json(sequence) : Json(nullptr)},
                     {"kind", std::string(word_of(stop.kind))},
                     {"text", block},
                     {"times", times}});
  }
  return stops;
}

/// Six decimals, as the trace has them: more would be noise of the conversion.
double rounded(double value) {
  return std::round(value * 1e6) / 1e6 + 0.0;
}

Json extents_json(const Summary& summary) {
  Json extents = Json::object();
  for (const Axis axis : interpreter::kAllAxes) {
    const auto& extent = summary.extents[static_cast<std::size_t>(axis)];
    if (!extent) continue;
    const AxisExtent shown = programmed(summary, axis, *extent);
    extents[std::string(1, interpreter::letter(axis))] = {{"min", rounded(shown.least)},
                                                          {"max", rounded(shown.most)}};
  }
  return extents;
}

Json state_json(const Summary& summary, const MachineState& state) {
  Json json{{"block", nullptr}, {"line", state.block().line}, {"position", Json::object()}};
  if (state.block().sequence >= 0) json["block"] = state.block().sequence;
  for (const Axis axis : interpreter::kAllAxes) {
    if (!state.position().has(axis)) continue;
    const double raw = state.position().raw(axis);
    json["position"][std::string(1, interpreter::letter(axis))] =
        rounded(programmed(summary, axis, {raw, raw}).least);
  }
  json["tool"] = state.tool() ? Json(*state.tool()) : Json(nullptr);
  json["spindle"] = std::string(word_of(state.spindle().state));
  json["speed"] = rounded(state.spindle().revolutions_per_minute);
  json["feed"] = state.feed() ? Json(summary_feed(summary, *state.feed())) : Json(nullptr);
  json["flood"] = state.coolant().flood;
  json["mist"] = state.coolant().mist;
  return json;
}

}  // namespace

std::string check_text(const CheckReport& report, bool has_color) {
  const auto& summary = report.summary;
  std::string text;
  for (const auto& warning : summary.warnings) {
    text += diagnostic_line(report, warning, "warning");
  }
  if (const auto more = summary.warning_count - summary.warnings.size(); more > 0) {
    text += fmt::format("{}: {} more warnings\n", report.file, more);
  }
  if (summary.alarm) text += diagnostic_line(report, *summary.alarm, "alarm");
  text += stop_lines(report);
  text += fmt::format("{}: {}\n", report.file, verdict(report, has_color));
  Details details;
  details.add("control", summary.control);
  details.add("program", summary.program.value_or(""));
  if (summary.programs > 1)
    details.add("programs",
                fmt::format("{} on the tape, each read after the one before", summary.programs));
  details.add("blocks", std::to_string(summary.blocks));
  details.add("moves", fmt::format("{}, {:.3f} {} rapid, {:.3f} {} at feed", summary.moves,
                                   length(summary, summary.rapid_length), unit_name(summary),
                                   length(summary, summary.feed_length), unit_name(summary)));
  details.add("time", duration_text(std::round(summary.seconds)) +
                          (summary.has_acceleration
                               ? " estimated, without stops and tool changes"
                               : " estimated, without acceleration, stops and tool changes"));
  add_extents(details, summary);
  if (report.stopped) add_state(details, summary, *report.stopped);
  if (report.stops) details.add("stops", std::to_string(report.stops->count));
  details.add("warnings", std::to_string(summary.warning_count));
  details.add("checked in", fmt::format("{:.2f} s, {:.0f} blocks/s", report.elapsed_seconds,
                                        blocks_per_second(report)));
  return text + details.render(has_color);
}

Json check_json(const CheckReport& report) {
  const auto& summary = report.summary;
  Json json{{"file", report.file}, {"control", summary.control}, {"program", nullptr}};
  if (summary.program) json["program"] = *summary.program;
  json["ended"] = summary.ended;
  json["programs"] = summary.programs;
  json["blocks"] = summary.blocks;
  json["moves"] = summary.moves;
  json["units"] = std::string(unit_name(summary));
  json["x"] = summary.x_is_diameter ? "diameter" : "radius";
  json["rapid_length"] = rounded(length(summary, summary.rapid_length));
  json["feed_length"] = rounded(length(summary, summary.feed_length));
  json["seconds"] = rounded(summary.seconds);
  json["has_acceleration"] = summary.has_acceleration;
  json["extents"] = extents_json(summary);
  if (report.stopped) json["stopped"] = state_json(summary, *report.stopped);
  if (report.stops) {
    json["stops"] = stops_json(report);
    json["stop_count"] = report.stops->count;
  }
  json["warnings"] = Json::array();
  for (const auto& warning : summary.warnings) {
    json["warnings"].push_back(diagnostic_json(report, warning));
  }
  json["warning_count"] = summary.warning_count;
  json["alarm"] = summary.alarm ? diagnostic_json(report, *summary.alarm) : Json(nullptr);
  json["elapsed_seconds"] = rounded(report.elapsed_seconds);
  json["blocks_per_second"] = std::round(blocks_per_second(report));
  return json;
}

}  // namespace dripline::cli
