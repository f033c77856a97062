#include <nlohmann/json.hpp>

#include "clients/tools/report_template/report_interpreter.hpp"

namespace dripline::report_template {

std::string line_of_probe(std::string_view text) {
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("at") || !json["at"].is_object())
    return std::string(text);
  const bool is_tripped = json.contains("tripped") && json["tripped"] == true;
  std::string line = is_tripped && json.contains("until") && json["until"].is_string()
                         ? "PROBE " + json["until"].get<std::string>()
                         : "PROBE none";
  for (const auto& [axis, value] : json["at"].items()) {
    if (value.is_number()) line += fmt::format(" {} {:.6f}", axis, value.get<double>());
  }
  return line;
}

}  // namespace dripline::report_template
