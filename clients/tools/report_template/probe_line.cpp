#include <cmath>
#include <nlohmann/json.hpp>

#include "clients/tools/report_template/report_interpreter.hpp"

namespace dripline::report_template {

namespace {

/// The axes of `at` that are elsewhere than the end of the move.
nlohmann::json moved_axes(const nlohmann::json& record) {
  constexpr double kNone = 1e-6;  // mm: what the lines show
  const auto& at = record["at"];
  const auto to = record.find("to");
  nlohmann::json moved = nlohmann::json::object();
  if (to == record.end() || !to->is_object()) return at;
  for (const auto& [axis, value] : at.items()) {
    const auto end = to->find(axis);
    if (!value.is_number() || end == to->end() || !end->is_number()) continue;
    if (std::abs(value.get<double>() - end->get<double>()) > kNone) moved[axis] = value;
  }
  return moved.empty() ? at : moved;
}

}  // namespace

std::string line_of_probe(std::string_view text, ProbeAxes axes) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("at") || !json["at"].is_object())
    return std::string(text);
  const bool is_tripped = json.contains("tripped") && json["tripped"] == true;
  std::string line = is_tripped && json.contains("until") && json["until"].is_string()
                         ? "PROBE " + json["until"].get<std::string>()
                         : "PROBE none";
  const bool has_moved_only = axes == ProbeAxes::Moved && is_tripped;
  const nlohmann::json shown = has_moved_only ? moved_axes(json) : json["at"];
  for (const auto& [axis, value] : shown.items()) {
    if (value.is_number()) line += fmt::format(" {} {:.6f}", axis, value.get<double>());
  }
  return line;
}

}  // namespace dripline::report_template
