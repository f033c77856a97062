#include "clients/cli/port/port_text.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/mod_functions.hpp"
#include "protocol/base/clock.hpp"

namespace dripline::cli {

namespace {

/// A line that is not there: tried for the first time, or in vain.
std::string closed_text(const client::Port& port) {
  return port.fault.empty() ? "opening" : "closed";
}

std::string value_of(const client::Settings& settings, const std::string& key) {
  const auto found = settings.find(key);
  return found == settings.end() ? "?" : found->second;
}

/// The settings that differ from the template: "baud=4800 eob=lf".
std::string own_settings_text(const client::Settings& settings) {
  std::string text;
  for (const auto& [key, value] : settings) {
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", key, value);
  }
  return text;
}

std::string transfer_text(const std::optional<client::Transfer>& transfer) {
  if (!transfer) return {};
  std::string text = transfer->state + ":";
  for (const auto& program : transfer->programs) text += " " + program;
  text += fmt::format(", {} of {}", bytes_text(transfer->sent), bytes_text(transfer->size));
  const bool is_uncertain = transfer->state == "interrupted" && transfer->at_most > transfer->sent;
  if (is_uncertain) text += fmt::format(", at most {}", bytes_text(transfer->at_most));
  return transfer->reason.empty() ? text : text + ": " + transfer->reason;
}

std::string reception_text(const std::optional<client::Transfer>& reception) {
  if (!reception) return {};
  std::string text = reception->state + ":";
  for (const auto& program : reception->programs) text += " " + program;
  text +=
      fmt::format("{}{}", reception->programs.empty() ? " " : ", ", bytes_text(reception->sent));
  return reception->reason.empty() ? text : text + ": " + reception->reason;
}

/// The line's own fault, else what was broken off on it last.
std::string listed_fault(const client::Port& port) {
  if (!port.fault.empty()) return port.fault;
  if (port.transfer && port.transfer->state == "interrupted")
    return "transfer " + transfer_text(port.transfer);
  if (port.reception && port.reception->state == "interrupted")
    return "reception " + reception_text(port.reception);
  return {};
}

std::string rules_text(const std::string& rules) {
  if (rules.empty()) return "none: programs are kept, lines are reported";
  const auto lines = std::count(rules.begin(), rules.end(), '\n') + (rules.back() != '\n' ? 1 : 0);
  return fmt::format("{} lines; dnc port test-rules NAME FILE tries them", lines);
}

}  // namespace

std::string line_text(const client::Settings& effective) {
  return value_of(effective, "line") + " " + value_of(effective, "flow");
}

std::string state_text(const client::Port& port) {
  if (!port.enabled) return "disabled";
  if (!port.open) return closed_text(port);
  std::string text = port.line.phase == "idle" ? "open" : port.line.phase;
  if (port.line.stopped) text += ", stopped by the control";
  if (port.line.stopping) text += ", holding the control";
  if (!port.line.waiting_for.empty()) text += ", waits for " + port.line.waiting_for;
  if (port.line.without_limit) text += " without limit";
  if (!port.waiting_since.empty()) text += " since " + time_text(port.waiting_since);
  return text;
}

std::string request_text(const std::optional<client::Port::Request>& request) {
  if (!request) return {};
  return fmt::format("the control asked for {} at {}; {}",
                     request->program.empty() ? "a program" : "program " + request->program,
                     time_text(request->since),
                     request->answer.empty() ? "no run waits" : "refused: " + request->answer);
}

std::string short_state(const client::Port& port) {
  if (!port.enabled) return "disabled";
  if (!port.open) return closed_text(port);
  std::string text = port.line.phase == "idle" ? "open" : port.line.phase;
  if (port.line.stopped) text += ", stopped";
  if (port.line.stopping) text += ", holding";
  return text;
}

std::string wait_text(const client::Port& port, std::string_view now) {
  if (!port.open) return {};
  if (port.line.waiting_for.empty()) {
    if (!port.request) return {};
    return port.request->answer.empty() ? "asked: no run waits" : "asked: refused";
  }
  std::string text = port.line.waiting_for;
  if (!port.waiting_since.empty()) {
    text += " for " + duration_text(seconds_between(port.waiting_since, now));
  }
  return text + (port.line.without_limit ? ", no limit" : "");
}

Style style_of_state(const client::Port& port) {
  if (!port.enabled) return Style::Faint;
  if (!port.open) return port.fault.empty() ? Style::Busy : Style::Bad;
  const bool is_held = port.line.stopped || !port.line.waiting_for.empty();
  return is_held ? Style::Busy : Style::Good;
}

std::string baud_warning(const client::Port& port, std::optional<int> control_rate) {
  const auto line = port.effective.find("baud");
  if (!control_rate || line == port.effective.end()) return {};
  if (line->second == std::to_string(*control_rate)) return {};
  return fmt::format("The setup of {} has {} baud for the control, and the line has {}.",
                     port.machine, *control_rate, line->second);
}

Details port_details(const client::Port& port) {
  Details details;
  details.add("port", port.name);
  details.add("machine", port.machine);
  details.add("address", port.address);
  details.add("template", port.line_template);
  details.add("own settings", own_settings_text(port.settings));
  details.add("line", line_text(port.effective));
  details.add("state", Cell(state_text(port), style_of_state(port)));
  details.add("fault", Cell(port.fault, port.fault.empty() ? Style::Plain : Style::Bad));
  details.add("run", port.run);
  details.add("request", request_text(port.request));
  details.add("transfer", transfer_text(port.transfer));
  details.add("reception", reception_text(port.reception));
  details.add("sent", bytes_text(port.sent));
  details.add("received", bytes_text(port.received));
  details.add("rules", rules_text(port.rules));
  return details;
}

namespace {

void add_row(Table& table, const client::Port& port, const std::string& now) {
  const std::string fault = listed_fault(port);
  table.add({port.name, port.machine, port.address, line_text(port.effective),
             Cell(short_state(port), style_of_state(port)), wait_text(port, now),
             short_id(port.run), bytes_text(port.sent), bytes_text(port.received),
             Cell(fault, fault.empty() ? Style::Plain : Style::Bad)});
}

void print_template(Context& context, const client::PortTemplates& all,
                    const client::PortTemplate& one) {
  Details details;
  details.add("template", one.name);
  details.add("for", one.title);
  details.add("control", one.control);
  context.print(details);
  Table table({"SETTING", "VALUE", "MEANING", "ALLOWED"});
  for (const auto& row : all.settings) {
    const auto value = one.settings.find(row.key);
    const std::string text = value == one.settings.end() ? "" : value->second;
    // A template is defined by its differences from a plain line.
    table.add(
        {row.key, Cell(text, text == row.preset ? Style::Plain : Style::Good), row.text, row.type});
  }
  context.print("\n");
  context.print(table);
}

/// The baud rate in the machine's newest setup; often there is no setup.
std::optional<int> baud_rate_of_control(client::Client& client, const std::string& machine) {
  const auto setup = client.setup(machine, std::nullopt);
  if (!setup) return std::nullopt;
  const auto data = interpreter::parse_control_data(setup->text);
  if (!data) return std::nullopt;
  const auto settings = interpreter::tnc155::read_mod_settings(data->control);
  return settings ? settings->baud_rate : std::nullopt;
}

int complain_unknown(const client::PortTemplates& all, const std::string& name) {
  std::string known;
  for (const auto& one : all.templates) known += (known.empty() ? "" : ", ") + one.name;
  return complain(
      client::Failure{client::Failure::Kind::Refused, Errc::NotFound,
                      fmt::format("template '{}' is not known; known are: {}", name, known)});
}

}  // namespace

int list_ports(Context& context, client::Client& client) {
  auto ports = client.ports();
  if (const auto status = finished(context, ports, "ports")) return *status;
  if (ports->empty()) {
    context.print("No serial port is set up; see dnc port add --help.\n");
    return kExitOk;
  }
  Table table({"NAME", "MACHINE", "ADDRESS", "LINE", "STATE", "WAITS FOR", "RUN", right("SENT"),
               right("RECEIVED"), "FAULT"});
  const std::string now = to_iso8601(SystemClock().now());
  for (const auto& port : *ports) add_row(table, port, now);
  context.print(table);
  return kExitOk;
}

int show_port(Context& context, client::Client& client, const std::string& name) {
  auto port = client.port(name);
  if (!port) return complain(port.error());
  const auto control_rate = baud_rate_of_control(client, port->machine);
  if (context.wants_json) {
    auto json = client::to_json_value(*port);
    if (control_rate) json["control_baud_rate"] = *control_rate;
    context.print(json_text(json));
    return kExitOk;
  }
  context.print(port_details(*port));
  const std::string warning = baud_warning(*port, control_rate);
  if (!warning.empty()) context.print(styled(warning, Style::Bad, context.has_color()) + "\n");
  return kExitOk;
}

int list_templates(Context& context, client::Client& client, const std::string& name) {
  auto all = client.port_templates();
  if (const auto status = finished(context, all)) return *status;
  if (!name.empty()) {
    for (const auto& one : all->templates) {
      if (one.name == name) return print_template(context, *all, one), kExitOk;
    }
    return complain_unknown(*all, name);
  }
  Table table({"NAME", "LINE", "CONTROL", "FOR"});
  for (const auto& one : all->templates) {
    table.add({one.name, line_text(one.settings), one.control, one.title});
  }
  context.print(table);
  context.print("\ndnc port templates NAME shows every setting and what it decides.\n");
  return kExitOk;
}

}  // namespace dripline::cli
