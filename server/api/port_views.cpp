#include "server/api/port_views.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace dripline::api {

using nlohmann::json;

namespace {

json optional_text(std::string_view text) {
  return text.empty() ? json(nullptr) : json(text);
}

std::string_view phase_name(wire::Phase phase) {
  switch (phase) {
    case wire::Phase::Idle:
      return "idle";
    case wire::Phase::Sending:
      return "sending";
    case wire::Phase::Receiving:
      return "receiving";
    case wire::Phase::Requesting:
      return "requesting";
  }
  return "idle";
}

json settings_json(const wire::LineSettings& settings) {
  json values = json::object();
  for (const wire::SettingRow& row : wire::setting_rows()) {
    values[std::string(row.key)] = row.get(settings);
  }
  return values;
}

json own_settings_json(const storage::Port& port) {
  json values = json::object();
  for (const auto& [key, value] : port.settings) values[key] = value;
  return values;
}

json line_json(const wire::LineState& line) {
  return {{"phase", phase_name(line.phase)},
          {"stopped", line.is_stopped},
          {"stopping", line.is_stopping},
          {"waiting_for", optional_text(line.waiting_for)},
          {"without_limit", line.may_wait_without_limit}};
}

json request_json(const ports::PortRequest& request) {
  return {{"since", to_iso8601(request.since)},
          {"program", optional_text(request.program)},
          {"answer", optional_text(request.answer)}};
}

std::string hex(std::string_view bytes) {
  std::string text;
  text.reserve(2 * bytes.size());
  for (const char c : bytes) {
    text += fmt::format("{:02x}", static_cast<unsigned char>(c));
  }
  return text;
}

}  // namespace

json transfer_json(const ports::PortTransfer& transfer) {
  return {{"id", transfer.id},
          {"programs", transfer.programs},
          {"size", transfer.size},
          {"sent", transfer.sent},
          {"state", to_string(transfer.state)},
          {"reason", optional_text(transfer.reason)}};
}

json port_json(const ports::PortView& view) {
  return {
      {"name", view.port.name},
      {"machine", view.port.machine},
      {"address", view.port.address},
      {"template", optional_text(view.port.line_template)},
      {"settings", own_settings_json(view.port)},
      {"rules", optional_text(view.port.rules)},
      {"enabled", view.port.is_enabled},
      {"effective", settings_json(view.settings)},
      {"open", view.is_open},
      {"fault", optional_text(view.fault)},
      {"line", line_json(view.line)},
      {"run", optional_text(view.run)},
      {"transfer", view.transfer ? transfer_json(*view.transfer) : json(nullptr)},
      {"sent", view.sent},
      {"received", view.received},
      {"waiting_since", view.waiting_since ? json(to_iso8601(*view.waiting_since)) : json(nullptr)},
      {"request", view.request ? request_json(*view.request) : json(nullptr)}};
}

json traffic_json(const ports::PortTraffic& traffic) {
  return {{"port", traffic.port},
          {"time", to_iso8601(traffic.time)},
          {"what", ports::to_string(traffic.what)},
          {"bytes", hex(traffic.bytes)},
          {"text", traffic.text}};
}

json port_test_json(const ports::PortTest& test) {
  return {{"passed", test.is_passed}, {"findings", test.findings}};
}

json verdict_json(const ports::RuleVerdict& verdict) {
  return {{"rule", optional_text(verdict.rule)},
          {"action", verdict.action},
          {"argument", optional_text(verdict.argument)},
          {"why", verdict.why}};
}

json port_templates_json() {
  json templates = json::array();
  for (const wire::LineTemplate& row : wire::line_templates()) {
    templates.push_back({{"name", row.name},
                         {"title", row.title},
                         {"control", optional_text(row.control)},
                         {"settings", settings_json(row.settings)}});
  }
  const wire::LineSettings defaults;
  json rows = json::array();
  for (const wire::SettingRow& row : wire::setting_rows()) {
    rows.push_back(
        {{"key", row.key}, {"type", row.type}, {"text", row.text}, {"default", row.get(defaults)}});
  }
  return {{"templates", std::move(templates)}, {"settings", std::move(rows)}};
}

}  // namespace dripline::api
