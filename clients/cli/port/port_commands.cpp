#include <memory>
#include <string>

#include "clients/cli/context.hpp"
#include "clients/cli/port/port_file.hpp"
#include "clients/cli/port/port_monitor.hpp"
#include "clients/cli/port/port_parameters.hpp"
#include "clients/cli/port/port_text.hpp"
#include "clients/cli/text/standard_output.hpp"

namespace dripline::cli {
namespace {

constexpr std::size_t kMaxText = 48 * 1024;

/// Programs are kept with LF; a file from a PC may have CR LF.
std::string with_line_feeds(std::string text) {
  std::erase(text, '\r');
  return text;
}

std::string verdict_text(const client::RuleVerdict& verdict) {
  std::string action = verdict.action;
  if (!verdict.argument.empty()) action += " " + verdict.argument;
  if (verdict.rule.empty()) return fmt::format("no rule fires; the default is: {}", action);
  return fmt::format("rule {} fires: {}", verdict.rule, action);
}

int test_port(Context& context, client::Client& client, const std::string& name) {
  auto test = client.test_port(name);
  if (!test) return complain(test.error());
  if (context.wants_json) {
    context.print(json_text(*test));
  } else {
    for (const auto& finding : test->findings) context.print(printable(finding) + "\n");
    const auto verdict = test->passed ? styled("passed", Style::Good, context.has_color())
                                      : styled("failed", Style::Bad, context.has_color());
    context.print(fmt::format("{}: {}\n", printable(name), verdict));
  }
  return test->passed ? kExitOk : kExitNo;
}

/// Shows what the port's rules would do with the text in `file`.
int test_rules(Context& context, const std::string& name, const std::string& file) {
  auto text = read_small_file(file, kMaxText);
  if (!text) return complain(text.error());
  auto client = context.connect();
  if (!client) return context.status;
  auto verdict = client->test_rules(name, with_line_feeds(*std::move(text)));
  if (const auto status = finished(context, verdict)) return *status;
  for (const auto& reason : verdict->why) context.print("  " + printable(reason) + "\n");
  const Style style = verdict->rule.empty() ? Style::Busy : Style::Good;
  context.print(styled(printable(verdict_text(*verdict)), style, context.has_color()) + "\n");
  return kExitOk;
}

struct PortCommand {
  client::PortRequest port;
  std::optional<std::string> machine, address, line_template, rules_file;
  bool is_disabled = false, has_no_rules = false;
  std::vector<std::string> settings;
};

client::PortRequest request_of(const client::Port& port) {
  return {port.name,  port.machine,  port.address, port.line_template,
          port.rules, port.settings, port.enabled};
}

/// Applies the given options to `port`; the rest stays. Errors: a setting, or the file of rules.
Result<void> apply(client::PortRequest& port, const PortCommand& command) {
  if (command.machine) port.machine = *command.machine;
  if (command.address) port.address = *command.address;
  if (command.line_template) port.line_template = *command.line_template;
  if (command.has_no_rules) port.rules.clear();
  if (command.rules_file) {
    auto rules = read_small_file(*command.rules_file, kMaxRulesFile);
    if (!rules) return fail(rules.error());
    port.rules = *std::move(rules);
  }
  for (const auto& setting : command.settings) {
    if (auto applied = apply_setting(port.settings, setting); !applied) return applied;
  }
  return {};
}

int save(Context& context, client::Client& client, const client::PortRequest& request) {
  auto port = client.save_port(request);
  if (const auto status = finished(context, port)) return *status;
  context.print(fmt::format("Port {} of {} at {}: {}, {}\n", port->name, port->machine,
                            port->address, line_text(port->effective), state_text(*port)));
  return kExitOk;
}

int add(Context& context, PortCommand command) {
  command.port.enabled = !command.is_disabled;
  if (auto applied = apply(command.port, command); !applied) return complain(applied.error());
  auto client = context.connect();
  if (!client) return context.status;
  if (client->port(command.port.name)) {
    return complain(client::Failure{
        client::Failure::Kind::Refused, Errc::Busy,
        fmt::format("port {} is there already; dnc port set changes it", command.port.name)});
  }
  return save(context, *client, command.port);
}

int change(Context& context, client::Client& client, const PortCommand& command) {
  auto known = client.port(command.port.name);
  if (!known) return complain(known.error());
  auto port = request_of(*known);
  if (auto applied = apply(port, command); !applied) return complain(applied.error());
  return save(context, client, port);
}

int set_enabled(Context& context, client::Client& client, const std::string& name,
                bool is_enabled) {
  auto known = client.port(name);
  if (!known) return complain(known.error());
  auto port = request_of(*known);
  port.enabled = is_enabled;
  return save(context, client, port);
}
int enable(Context& context, client::Client& client, const std::string& name) {
  return set_enabled(context, client, name, true);
}
int disable(Context& context, client::Client& client, const std::string& name) {
  return set_enabled(context, client, name, false);
}

int remove_port(Context& context, client::Client& client, const std::string& name) {
  auto removed = client.remove_port(name);
  if (!removed) return complain(removed.error());
  context.print(fmt::format("Removed port {}; its line is closed.\n", name));
  return kExitOk;
}

/// Everything in the file is looked at before the first port is touched.
int apply_file(Context& context, const std::string& path) {
  const auto ports = read_port_file(path);
  if (!ports) return complain(ports.error());
  auto client = context.connect();
  if (!client) return context.status;
  for (const auto& port : *ports) {
    if (const int status = save(context, *client, port); status != kExitOk) return status;
  }
  return kExitOk;
}

std::shared_ptr<PortCommand> add_port_options(Command command, Context& context) {
  auto options = std::make_shared<PortCommand>();
  command.add_option("NAME", options->port.name, "The port").required();
  command.add_option("--machine", options->machine, "Machine at the other end of the line");
  command.add_option("--address", options->address,
                     "/dev/ttyUSB0, tcp://HOST:PORT or rfc2217://HOST:PORT");
  command.add_option("--template", options->line_template,
                     "Template of the control's line settings; see dnc port templates");
  command.add_option("--rules", options->rules_file,
                     "TOML file with the rules for texts from the control");
  command.add_option("SETTING", options->settings,
                     "Override a setting of the template (KEY=VALUE), or give rate, parity, data "
                     "and stop bits in short form (9600e72)");
  add_json_flag(command, context);
  return options;
}

void add_port_add(Command group, Context& context) {
  auto command = group.add_subcommand("add", "Set up the serial line to a machine");
  auto options = add_port_options(command, context);
  command.get_option("--machine").required();
  command.get_option("--address").required();
  command.add_flag("--disabled", options->is_disabled, "Set it up, but leave the line closed");
  command.footer(
      "Examples:\n  dnc port add line-3 --machine mill-3 --address /dev/ttyUSB0 --template tnc155\n"
      "  dnc port add line-4 --machine mill-4 --address rfc2217://10.0.0.9:4001 \\\n"
      "      --template centurion 19200e72 line_delay_ms=20");
  command.callback([&context, options] { context.status = add(context, *options); });
}

void add_set(Command group, Context& context) {
  auto command = group.add_subcommand("set", "Change settings of a port");
  auto options = add_port_options(command, context);
  command.add_flag("--no-rules", options->has_no_rules, "Remove its rules");
  command.footer(
      "KEY= removes a setting of the port, so that its template's applies again. An open line is "
      "closed\nand opened again.\n\nExample:\n  dnc port set line-3 baud=4800 eob=");
  run_at_server(command, context, options, change);
}

using NamedAction = int (*)(Context&, client::Client&, const std::string&);
Command add_by_name(Command group, Context& context, const char* verb, const char* help,
                    NamedAction action) {
  auto command = group.add_subcommand(verb, help);
  auto name = std::make_shared<std::string>();
  command.add_option("NAME", *name, "The port").required();
  run_at_server(command, context, name, action);
  return command;
}

void add_templates(Command group, Context& context) {
  auto command = group.add_subcommand(
      "templates", "List the line templates of known controls, or show one in full");
  auto name = std::make_shared<std::string>();
  command.add_option("NAME", *name, "The template (default: list them)");
  add_json_flag(command, context);
  run_at_server(command, context, name, list_templates);
}

void add_apply(Command group, Context& context) {
  auto command = group.add_subcommand("apply", "Set up the ports of a TOML file");
  auto path = std::make_shared<std::string>();
  command.add_option("FILE", *path, "TOML file with a [[port]] for each port").required();
  add_json_flag(command, context);
  command.footer(
      "Ports of the same name are replaced, others stay. deploy/examples/ports.toml shows every "
      "key.");
  command.callback([&context, path] { context.status = apply_file(context, *path); });
}

void add_test_rules(Command group, Context& context) {
  auto command = group.add_subcommand("test-rules", "Show which rule a text matches, and why");
  auto names = std::make_shared<std::pair<std::string, std::string>>();
  command.add_option("NAME", names->first, "The port").required();
  command.add_option("FILE", names->second, "Text as the control would send it").required();
  add_json_flag(command, context);
  command.footer("Nothing is done: no program is sent or stored.");
  command.callback(
      [&context, names] { context.status = test_rules(context, names->first, names->second); });
}

void add_monitor(Command group, Context& context) {
  auto command = group.add_subcommand("monitor", "Watch a line until Ctrl-C");
  auto options = std::make_shared<MonitorCommand>();
  command.add_option("NAME", options->name, "The port").required();
  command.add_flag("--hex", options->is_hex, "Show bytes in hexadecimal");
  command.add_flag("--json", context.wants_json, "Print one JSON object per line");
  command.footer(
      "Each line: time, direction (→ to the control, ← from it, ! an error, ~ modem lines, = "
      "the\nstate of the line), and the characters; <DC3> and its like are control characters. "
      "Watching changes\nnothing on the line.");
  run_at_server(command, context, options, monitor_port);
}

void add_recording(Command group, Context& context) {
  auto command =
      group.add_subcommand("recording", "Show what passed over a line in the last minutes");
  auto options = std::make_shared<RecordingCommand>();
  command.add_option("NAME", options->name, "The port").required();
  command.add_option("-o,--output", options->output,
                     "Save it as JSON lines, - for standard output");
  command.add_flag("--hex", options->is_hex, "Show bytes in hexadecimal");
  add_json_flag(command, context);
  run_at_server(command, context, options, show_recording);
}

}  // namespace

void add_port_commands(Command app, Context& context) {
  auto group = app.add_subcommand("port", "Serial lines to machines");
  group.require_subcommand(1);
  add_port_add(group, context);
  add_set(group, context);
  auto list = group.add_subcommand("list", "List all ports with the state of their lines");
  add_json_flag(list, context);
  run_at_server(list, context, list_ports);
  add_json_flag(add_by_name(group, context, "show", "Show a port", show_port), context);
  add_by_name(group, context, "remove", "Close a line and remove the port", remove_port);
  add_json_flag(add_by_name(group, context, "enable", "Open the line", enable), context);
  add_json_flag(add_by_name(group, context, "disable", "Close the line, keep the port", disable),
                context);
  add_templates(group, context);
  add_apply(group, context);
  add_json_flag(add_by_name(group, context, "test", "Test a line without a program", test_port),
                context);
  add_test_rules(group, context);
  add_monitor(group, context);
  add_recording(group, context);
  add_port_transfer_commands(group, context);
  add_port_doctor_command(group, context);
  add_port_replay_command(group, context);
  add_port_page_command(group, context);
  add_port_parameters_command(group, context);
}

}  // namespace dripline::cli
