#include "clients/cli/port/port_listing.hpp"

#include "clients/cli/port/port_text.hpp"
#include "clients/cli/text/json_text.hpp"
#include "clients/cli/text/value_text.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/mod_functions.hpp"
#include "protocol/base/clock.hpp"

namespace dripline::cli {
namespace {

void add_row(Table& table, const client::Port& port, const std::string& now) {
  table.add({port.name, port.machine, port.address, line_text(port.effective),
             Cell(short_state(port), style_of_state(port)), wait_text(port, now),
             short_id(port.run), bytes_text(port.sent), bytes_text(port.received),
             Cell(port.fault, port.fault.empty() ? Style::Plain : Style::Bad)});
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
