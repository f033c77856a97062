#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "gateway/line/port_transfer.hpp"
#include "server/api/api.hpp"
#include "server/api/bodies/port_bodies.hpp"
#include "server/api/nullable_json.hpp"
#include "server/api/views.hpp"
#include "server/machines/stop_order.hpp"
#include "server/ports/port_control.hpp"

namespace dripline::api {
namespace {

using nlohmann::json;

std::string_view phase_name(wire::Phase phase) {
  constexpr std::string_view kNames[] = {"idle", "sending", "receiving", "requesting"};
  return kNames[static_cast<std::size_t>(phase)];
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
          {"waiting_for", text_or_null(line.waiting_for)},
          {"without_limit", line.may_wait_without_limit}};
}

json request_json(const ports::PortRequest& request) {
  return {{"since", to_iso8601(request.since)},
          {"program", text_or_null(request.program)},
          {"answer", text_or_null(request.answer)}};
}

std::string hex(std::string_view bytes) {
  std::string text;
  text.reserve(2 * bytes.size());
  for (const char c : bytes) {
    text += fmt::format("{:02x}", static_cast<unsigned char>(c));
  }
  return text;
}

json transfer_json(const ports::PortTransfer& transfer) {
  return {{"id", transfer.id},
          {"programs", transfer.programs},
          {"size", transfer.size},
          {"sent", transfer.sent},
          {"at_most", transfer.at_most},
          {"state", to_string(transfer.state)},
          {"reason", text_or_null(transfer.reason)},
          {"began", time_or_null(transfer.began)},
          {"ended", time_or_null(transfer.ended)}};
}

json port_json(const ports::PortView& view) {
  return {{"name", view.port.name},
          {"machine", view.port.machine},
          {"address", view.port.address},
          {"template", text_or_null(view.port.line_template)},
          {"settings", own_settings_json(view.port)},
          {"rules", text_or_null(view.port.rules)},
          {"enabled", view.port.is_enabled},
          {"effective", settings_json(view.settings)},
          {"sends_at_once", line::sends_at_once(view.settings)},
          {"open", view.is_open},
          {"fault", text_or_null(view.fault)},
          {"line", line_json(view.line)},
          {"run", text_or_null(view.run)},
          {"transfer", view.transfer ? transfer_json(*view.transfer) : json(nullptr)},
          {"reception", view.reception ? transfer_json(*view.reception) : json(nullptr)},
          {"sent", view.sent},
          {"received", view.received},
          {"waiting_since", time_or_null(view.waiting_since)},
          {"request", view.request ? request_json(*view.request) : json(nullptr)}};
}

/// `bytes` in hexadecimal: any byte, one line.
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
  return {{"rule", text_or_null(verdict.rule)},
          {"action", verdict.action},
          {"argument", text_or_null(verdict.argument)},
          {"why", verdict.why}};
}

/// Every template with all its settings, and the text of each setting.
json port_templates_json() {
  json templates = json::array();
  for (const wire::LineTemplate& row : wire::line_templates()) {
    templates.push_back({{"name", row.name},
                         {"title", row.title},
                         {"control", text_or_null(row.control)},
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

using PortHandler = Response (*)(Services&, ports::PortControl&, const Request&);

/// No handler of a port takes a query, and each needs a server that has ports.
Handler with_ports(Services& services, PortHandler handler) {
  return [&services, handler](const Request& request) {
    QueryReader query(request);
    if (auto good = query.finish(); !good) return error_response(good.error());
    if (services.ports == nullptr) {
      return error_response({Errc::Unsupported, "this server runs without serial ports"});
    }
    return handler(services, *services.ports, request);
  };
}

void note(Services& services, const Request& request, std::string action, std::string detail) {
  services.audit.write({.who = request.who,
                        .action = std::move(action),
                        .subject = request.parameter("name"),
                        .detail = std::move(detail)});
}

Response list_ports(Services&, ports::PortControl& ports, const Request&) {
  auto list = nlohmann::json::array();
  for (const auto& view : ports.ports()) list.push_back(port_json(view));
  return json_response(200, {{"ports", std::move(list)}});
}

Response show_port(Services&, ports::PortControl& ports, const Request& request) {
  return value_response(200, ports.port(request.parameter("name")), port_json);
}

Response save_port(Services& services, ports::PortControl& ports, const Request& request) {
  const auto port = decode_port(request.parameter("name"), request.body);
  if (!port) return error_response(port.error());
  const bool is_new = !ports.port(port->name);
  const auto view = ports.save(*port);
  if (!view) return error_response(view.error());
  std::string detail = fmt::format("{} at {}, template '{}'{}", port->machine, port->address,
                                   port->line_template, port->is_enabled ? "" : ", disabled");
  for (const auto& [key, value] : port->settings) detail += fmt::format(" {}={}", key, value);
  note(services, request, "port.save", std::move(detail));
  return json_response(is_new ? 201 : 200, port_json(*view));
}

Response remove_port(Services& services, ports::PortControl& ports, const Request& request) {
  const auto removed = ports.remove(request.parameter("name"));
  if (!removed) return error_response(removed.error());
  note(services, request, "port.remove", "");
  return no_content();
}

Response test_port(Services& services, ports::PortControl& ports, const Request& request) {
  const auto test = ports.test(request.parameter("name"));
  if (!test) return error_response(test.error());
  note(services, request, "port.test", test->is_passed ? "passed" : "failed");
  return json_response(200, port_test_json(*test));
}

Result<ports::PortTransfer> too_late(SteadyTime::duration waited) {
  return fail(Errc::Busy, "storing the request took {} s, {} are allowed: nothing was sent",
              std::chrono::duration_cast<std::chrono::seconds>(waited).count(),
              machines::StopOrder::kMaxWait.count());
}

Response send_programs(Services& services, ports::PortControl& ports, const Request& request) {
  const auto programs = decode_transfer(request.body);
  if (!programs) return error_response(programs.error());
  std::vector<std::string> names;
  for (const auto& choice : *programs) {
    names.push_back(choice.revision ? fmt::format("{}@{}", choice.program, *choice.revision)
                                    : choice.program);
  }
  auto written = services.audit.write_before({.who = request.who,
                                              .action = "port.send",
                                              .subject = request.parameter("name"),
                                              .detail = fmt::format("{}", fmt::join(names, ", "))});
  if (!written) return error_response(written.error());
  const auto waited = services.clock.steady_now() - request.given;
  const auto transfer = waited > machines::StopOrder::kMaxWait
                            ? too_late(waited)
                            : ports.send(request.parameter("name"), *programs);
  if (!transfer) {
    note(services, request, "port.send", "refused: " + transfer.error().what);
    return error_response(transfer.error());
  }
  note(services, request, "port.sending",
       fmt::format("{}: {} bytes", fmt::join(transfer->programs, ", "), transfer->size));
  return json_response(201, transfer_json(*transfer));
}

Response receive_program(Services& services, ports::PortControl& ports, const Request& request) {
  const auto begun = ports.receive(request.parameter("name"));
  if (!begun) return error_response(begun.error());
  note(services, request, "port.receive", "");
  return no_content();
}

Response confirm_reset(Services& services, ports::PortControl& ports, const Request& request) {
  const auto broken = ports.confirm_reset(request.parameter("name"));
  if (!broken) return error_response(broken.error());
  note(services, request, "port.confirm-reset", *broken + " was broken off");
  return no_content();
}

Response stop_transfer(Services& services, ports::PortControl& ports, const Request& request) {
  const auto stopped =
      ports.stop_transfer(request.parameter("name"), "stopped by " + request.who.name);
  if (!stopped) return error_response(stopped.error());
  services.audit.write_late({.who = request.who,
                             .action = "port.stop",
                             .subject = request.parameter("name"),
                             .detail = ""});
  return no_content();
}

Response test_rules(Services&, ports::PortControl& ports, const Request& request) {
  const auto text = decode_rules_text(request.body);
  if (!text) return error_response(text.error());
  return value_response(200, ports.test_rules(request.parameter("name"), *text), verdict_json);
}

/// The recording as JSON lines, converted some entries at a time.
BodySource recording_source(std::vector<ports::PortTraffic> recording) {
  constexpr std::size_t kPiece = 256;
  auto entries = std::make_shared<std::vector<ports::PortTraffic>>(std::move(recording));
  return [entries, at = std::size_t{0}]() mutable -> Result<std::optional<std::string>> {
    if (at == entries->size()) return std::nullopt;
    std::string text;
    for (const std::size_t end = std::min(at + kPiece, entries->size()); at < end; ++at) {
      text += to_text(traffic_json((*entries)[at])) + "\n";
    }
    return text;
  };
}

Response send_recording(Services&, ports::PortControl& ports, const Request& request) {
  auto recording = ports.recording(request.parameter("name"));
  if (!recording) return error_response(recording.error());
  Response response;
  response.content_type = "application/x-ndjson";
  response.source = recording_source(*std::move(recording));
  return response;
}

Response open_traffic(Services& services, ports::PortControl& ports, const Request& request) {
  const auto view = ports.port(request.parameter("name"));
  if (!view) return error_response(view.error());
  Response response;
  response.events = services.events.subscribe_port(view->port.name);
  if (!response.events) return too_many_listeners();
  response.events->push(
      {.kind = "port", .data = to_text(port_json(*view)), .port = view->port.name});
  response.content_type = "text/event-stream";
  return response;
}

Response list_templates(const Request& request) {
  QueryReader query(request);
  if (auto good = query.finish(); !good) return error_response(good.error());
  return json_response(200, port_templates_json());
}

}  // namespace

void add_port_routes(Router& router, Services& services) {
  const std::string port = "/api/v1/ports/{name}";
  router.add("GET", "/api/v1/ports", with_ports(services, list_ports));
  router.add("GET", port, with_ports(services, show_port));
  router.add("PUT", port, with_ports(services, save_port));
  router.add("DELETE", port, with_ports(services, remove_port));
  router.add("POST", port + "/test", with_ports(services, test_port), Waits::ForMachine);
  router.add("POST", port + "/test-rules", with_ports(services, test_rules), Waits::ForMachine);
  router.add("POST", port + "/transfers", with_ports(services, send_programs), Waits::ForMachine);
  router.add("POST", port + "/receive", with_ports(services, receive_program), Waits::ForMachine);
  router.add("POST", port + "/confirm-reset", with_ports(services, confirm_reset),
             Waits::ForMachine);
  router.add("DELETE", port + "/transfers", with_ports(services, stop_transfer), Waits::ForMachine);
  router.add("GET", port + "/recording", with_ports(services, send_recording), Waits::ForMachine);
  router.add("GET", port + "/traffic", with_ports(services, open_traffic));
  router.add("GET", "/api/v1/port-templates", list_templates);
}

std::function<void(const ports::PortTraffic&)> publish_traffic_to(EventHub& hub) {
  return [&hub](const ports::PortTraffic& traffic) {
    if (!hub.has_port_listeners(traffic.port)) return;
    hub.publish({.kind = "traffic", .data = to_text(traffic_json(traffic)), .port = traffic.port});
  };
}

}  // namespace dripline::api
