#include "clients/tools/report_template/taken_json.hpp"

#include <nlohmann/json.hpp>

namespace dripline::report_template {

using nlohmann::ordered_json;

namespace {

ordered_json optional_json(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json(nullptr);
}

}  // namespace

ordered_json event_json(const ReportEvent& event) {
  if (const auto* value = std::get_if<Value>(&event)) {
    const auto& characteristic = value->characteristic;
    return {{"event", "measurement"},
            {"characteristic", characteristic.name},
            {"nominal", optional_json(characteristic.nominal)},
            {"lower", optional_json(characteristic.lower)},
            {"upper", optional_json(characteristic.upper)},
            {"unit", characteristic.unit},
            {"tool", value->tool},
            {"actual", value->actual},
            {"verdict", measurement::to_string(value->verdict)}};
  }
  if (const auto* finding = std::get_if<Finding>(&event)) {
    return {{"event", "finding"}, {"kind", to_string(finding->kind)}, {"text", finding->text}};
  }
  if (const auto* ended = std::get_if<PartEnded>(&event)) {
    return {{"event", "part_ended"},
            {"part_number", ended->part.number},
            {"serial", ended->part.serial},
            {"verdict", measurement::to_string(ended->part.verdict)}};
  }
  return {{"event", "part_begun"}};
}

ordered_json taken_json(std::string_view line, const LineRule* rule, const Taken& taken) {
  ordered_json fields = ordered_json::object(), events = ordered_json::array();
  for (const auto& [name, value] : taken.fields) fields[name] = value;
  for (const auto& event : taken.events) events.push_back(event_json(event));
  return {{"line", std::string(line)},
          {"understood", rule != nullptr},
          {"template_line", rule == nullptr ? ordered_json(nullptr) : ordered_json(rule->line)},
          {"fields", fields},
          {"events", events}};
}

}  // namespace dripline::report_template
