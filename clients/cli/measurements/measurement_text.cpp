#include "clients/cli/measurements/measurement_text.hpp"

#include <algorithm>

#include "clients/cli/server/json_answer.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

using nlohmann::ordered_json;
using report_template::Finding;
using report_template::PartBegun;
using report_template::PartEnded;
using report_template::Value;

std::string shown_at(const ordered_json& object, const char* key) {
  return printable(text_at(object, key));
}

std::string number_at(const ordered_json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return "";
  return found->is_number_float() ? fmt::format("{}", found->get<double>()) : found->dump();
}

/// With at least these decimals, and with those that the number has beyond them: a limit of 40.05
/// beside a value of 40.1 is no 40.1.
std::string exact_text(double value, int decimals) {
  constexpr int kMost = 9;
  decimals = std::clamp(decimals, 0, kMost);
  const auto text = [value](int with) { return fmt::format("{:.{}f}", value, with); };
  const std::string most = text(kMost);
  const std::string_view zeros = "000000000";
  while (decimals < kMost &&
         text(decimals) + (decimals == 0 ? "." : "") +
                 std::string(zeros.substr(static_cast<std::size_t>(decimals))) !=
             most) {
    ++decimals;
  }
  return text(decimals);
}

/// As many decimals as the report has; more where the number has them.
std::string value_at(const ordered_json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return "";
  return exact_text(found->get<double>(), object.value("decimals", 3));
}

/// A part that has not ended is not good yet; what is outside its limits stays so.
std::string verdict_of_part(const ordered_json& part) {
  std::string verdict = shown_at(part, "verdict");
  const bool is_final =
      !shown_at(part, "ended").empty() || verdict == "rework" || verdict == "scrap";
  return is_final ? verdict : "open";
}

Cell verdict_cell(const std::string& verdict) {
  if (verdict == "good") return {verdict, Style::Good};
  if (verdict == "unknown" || verdict == "open") return {verdict, Style::Plain};
  return {verdict, Style::Bad};
}

std::string limit_text(const measurement::Characteristic& characteristic) {
  const auto text = [&](const std::optional<double>& limit) {
    return limit ? exact_text(*limit, characteristic.decimals) : std::string();
  };
  if (!characteristic.lower && !characteristic.upper) return "no limits";
  return fmt::format("{} to {}", text(characteristic.lower), text(characteristic.upper));
}

}  // namespace

Table template_table(const ordered_json& templates, const ordered_json& assignments) {
  Table table({"TEMPLATE", right("VERSION"), "BY", "SAVED", "FOR"});
  for (const auto& one : templates) {
    std::string uses;
    for (const auto& assigned : assignments) {
      if (assigned.at("template") != one.at("name")) continue;
      uses += fmt::format("{}{} {}", uses.empty() ? "" : ", ", shown_at(assigned, "scope"),
                          shown_at(assigned, "subject"));
      if (assigned.at("version").is_number())
        uses += fmt::format(" (version {})", number_at(assigned, "version"));
    }
    table.add({shown_at(one, "name"), number_at(one, "version"), shown_at(one, "author"),
               time_text(shown_at(one, "created")), uses});
  }
  return table;
}

Table measurement_table(const ordered_json& measurements) {
  Table table({"TIME", "MACHINE", right("PART"), "SERIAL", "CHARACTERISTIC", right("ACTUAL"),
               right("NOMINAL"), right("LOWER"), right("UPPER"), "UNIT", "TOOL", "VERDICT"});
  for (const auto& one : measurements) {
    table.add({time_text(shown_at(one, "time")), shown_at(one, "machine"), number_at(one, "part"),
               shown_at(one, "serial"), shown_at(one, "characteristic"), value_at(one, "actual"),
               value_at(one, "nominal"), value_at(one, "lower"), value_at(one, "upper"),
               shown_at(one, "unit"), shown_at(one, "tool"),
               verdict_cell(shown_at(one, "verdict"))});
  }
  return table;
}

Table part_table(const ordered_json& parts) {
  Table table({right("PART"), "MACHINE", "RUN", "PROGRAM", "TEMPLATE", "NUMBER", "SERIAL",
               right("VALUES"), right("FINDINGS"), "VERDICT", "BEGUN", "ENDED"});
  for (const auto& one : parts) {
    table.add({number_at(one, "id"), shown_at(one, "machine"), short_id(shown_at(one, "run")),
               shown_at(one, "program"),
               fmt::format("{}@{}", shown_at(one, "template"), number_at(one, "template_version")),
               shown_at(one, "part_number"), shown_at(one, "serial"),
               number_at(one, "measurements"), number_at(one, "findings"),
               verdict_cell(verdict_of_part(one)), time_text(shown_at(one, "begun")),
               time_text(shown_at(one, "ended"))});
  }
  return table;
}

Table finding_table(const ordered_json& findings) {
  Table table({"TIME", "MACHINE", right("PART"), right("RECORD"), "KIND", "TEXT"});
  for (const auto& one : findings) {
    table.add({time_text(shown_at(one, "time")), shown_at(one, "machine"), number_at(one, "part"),
               number_at(one, "number"), shown_at(one, "kind"), shown_at(one, "text")});
  }
  return table;
}

std::string event_text(const report_template::ReportEvent& event) {
  if (const auto* value = std::get_if<Value>(&event)) {
    const auto& characteristic = value->characteristic;
    return fmt::format("    {} = {} {} ({}{}): {}\n", printable(characteristic.name),
                       exact_text(value->actual, characteristic.decimals),
                       printable(characteristic.unit), limit_text(characteristic),
                       value->tool.empty() ? "" : ", tool " + printable(value->tool),
                       measurement::to_string(value->verdict));
  }
  if (const auto* finding = std::get_if<Finding>(&event)) {
    return fmt::format("    {}: {}\n", report_template::to_string(finding->kind),
                       printable(finding->text));
  }
  if (const auto* ended = std::get_if<PartEnded>(&event)) {
    return fmt::format("    part ends: {} values, {}\n", ended->part.values,
                       measurement::to_string(ended->part.verdict));
  }
  return "    part begins\n";
}

std::string taken_text(std::string_view line, const report_template::LineRule* rule,
                       const report_template::Taken& taken) {
  const char* mark = rule == nullptr ? "?" : rule->is_ignored ? "-" : " ";
  std::string text = fmt::format("{} {}\n", mark, printable(report_template::trimmed(line)));
  std::string fields;
  for (const auto& [name, value] : taken.fields)
    fields += fmt::format("{}{} {}", fields.empty() ? "" : ", ", name, printable(value));
  if (!fields.empty()) text += fmt::format("    {}\n", fields);
  for (const auto& event : taken.events) text += event_text(event);
  return text;
}

}  // namespace dripline::cli
