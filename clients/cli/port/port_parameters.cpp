#include "clients/cli/port/port_parameters.hpp"

#include <memory>

#include <nlohmann/json.hpp>

#include "clients/cli/port/port_file.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/memory_files.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/mod_functions.hpp"
#include "protocol/wire/tnc_parameters.hpp"

namespace dripline::cli {

namespace {

namespace tnc = interpreter::tnc155;
using wire::Flow;
using wire::LineSettings;

struct ParametersCommand {
  std::string file, line, port;
  std::vector<std::string> changes;
  std::optional<unsigned> baud;
};

/// The control's side of the line, and whether its baud rate is known.
struct Interface {
  wire::TncInterface tnc;
  bool has_baud = false;
};

Result<void> read_setup(std::string_view text, Interface& interface) {
  const auto setup = interpreter::parse_setup(text);
  if (!setup) return fail(setup.error());
  const interpreter::Options& options = setup->control;
  if (options.find("machine_parameters") == nullptr && options.find("heading_letter") == nullptr &&
      options.find("baud_rate") == nullptr && options.find("user_parameters") == nullptr) {
    return fail(Errc::NotFound,
                "the setup has nothing of a TNC's interface: machine_parameters, heading_letter or "
                "baud_rate in [control]");
  }
  const auto parameters = tnc::all_machine_parameters(options);
  if (!parameters) return fail(parameters.error());
  interface.tnc.parameters = *parameters;
  if (options.find("heading_letter") != nullptr) {
    const auto letter = options.choice("heading_letter", {"%", "H"}, 0);
    if (!letter) return fail(letter.error());
    interface.tnc.heading = *letter == 0 ? '%' : 'H';
  }
  interface.has_baud = options.find("baud_rate") != nullptr;
  const auto baud = options.integer("baud_rate", interface.tnc.baud);
  if (!baud) return fail(baud.error());
  interface.tnc.baud = static_cast<unsigned>(std::clamp<std::int64_t>(*baud, 0, 1'000'000));
  return {};
}

/// A setup, or the parameters as the control sends them.
Result<Interface> interface_of(std::string_view text, std::optional<unsigned> baud) {
  Interface interface;
  const std::size_t begin = std::min(text.find_first_not_of(" \r\n\t\2"), text.size());
  if (text.substr(begin).starts_with("MP")) {
    const auto parameters = tnc::read_machine_parameters(text);
    if (!parameters) return fail(parameters.error());
    interface.tnc.parameters = *parameters;
  } else if (auto read = read_setup(text, interface); !read) {
    return fail(read.error());
  }
  if (baud) interface.tnc.baud = *baud;
  interface.has_baud |= baud.has_value();
  return interface;
}

Result<Interface> read_interface(const ParametersCommand& command) {
  constexpr std::size_t kMaxFile = 64 * 1024;
  const auto text = read_small_file(command.file, kMaxFile);
  if (!text) return fail(text.error());
  auto interface = interface_of(*text, command.baud);
  if (!interface) {
    return fail(interface.error().code, "{}: {}", command.file, interface.error().what);
  }
  return interface;
}

int parameters_of_line(Context& context, const ParametersCommand& command) {
  const auto line = line_named(command.line, command.changes);
  if (!line) return complain(line.error());
  const auto parameters = wire::tnc_parameters_of_line(*line);
  if (!parameters) return complain(parameters.error());
  if (!context.wants_json) {
    context.print_content(tnc::write_machine_parameters(*parameters));
    return kExitOk;
  }
  nlohmann::ordered_json json{{"baud_rate", line->baud}};
  for (const auto& [number, value] : *parameters) json[fmt::format("MP{}", number)] = value;
  context.print(json_text(json));
  return kExitOk;
}

int line_of_file(Context& context, const ParametersCommand& command) {
  const auto interface = read_interface(command);
  if (!interface) return complain(interface.error());
  const auto line = wire::line_of_tnc(interface->tnc);
  if (!line) return complain(line.error());
  return show_line(context, line->flow == Flow::HeidenhainBcc ? "tnc155-bcc" : "tnc155", *line);
}

/// The settings that the control's parameters decide; of the standard interface only the ends.
bool is_parameter(std::string_view key, bool is_blockwise, bool has_baud) {
  for (const std::string_view known :
       {"data_bits", "parity", "stop_bits", "flow", "tnc_stop", "tnc_etx", "tnc_eot"}) {
    if (key == known) return true;
  }
  if (key == "baud") return has_baud;
  if (!is_blockwise) return false;
  for (const std::string_view known : {"tnc_heading", "tnc_soh", "tnc_stx", "tnc_ack", "tnc_nak",
                                       "tnc_etb", "tnc_printable_bcc"}) {
    if (key == known) return true;
  }
  return false;
}

struct Difference {
  std::string key, port, control;
};

std::vector<Difference> differences(const client::Port& port, const LineSettings& line,
                                    bool has_baud) {
  std::vector<Difference> found;
  for (const auto& row : wire::setting_rows()) {
    if (!is_parameter(row.key, line.flow == Flow::HeidenhainBcc, has_baud)) continue;
    const auto set = port.effective.find(std::string(row.key));
    const std::string value = row.get(line);
    if (set == port.effective.end() || set->second == value) continue;
    found.push_back({std::string(row.key), set->second, value});
  }
  return found;
}

int report(Context& context, const client::Port& port, const std::vector<Difference>& found) {
  if (context.wants_json) {
    auto list = nlohmann::ordered_json::array();
    for (const auto& one : found) {
      list.push_back({{"setting", one.key}, {"port", one.port}, {"control", one.control}});
    }
    context.print(json_text(nlohmann::ordered_json{{"port", port.name}, {"differences", list}}));
  } else if (found.empty()) {
    context.print(fmt::format("Port {} matches its control's parameters.\n", port.name));
  } else {
    for (const auto& one : found) {
      context.print(
          fmt::format("{}: the port has {}, the control {}\n", one.key, one.port, one.control));
    }
  }
  return found.empty() ? kExitOk : kExitNo;
}

/// The port's line against the file, or against the setup that the server keeps of its machine.
int check_port(Context& context, const ParametersCommand& command) {
  auto client = context.connect();
  if (!client) return context.status;
  const auto port = client->port(command.port);
  if (!port) return complain(port.error());
  Result<Interface> interface = Interface{};
  if (!command.file.empty()) {
    interface = read_interface(command);
  } else {
    const auto setup = client->setup(port->machine, std::nullopt);
    if (!setup) return complain(setup.error());
    interface = interface_of(setup->text, command.baud);
    if (!interface) {
      return complain(Error{interface.error().code,
                            fmt::format("setup of {}: {}", port->machine, interface.error().what)});
    }
  }
  if (!interface) return complain(interface.error());
  const auto line = wire::line_of_tnc(interface->tnc);
  if (!line) return complain(line.error());
  return report(context, *port, differences(*port, *line, interface->has_baud));
}

int run(Context& context, const ParametersCommand& command) {
  if (!command.line.empty()) return parameters_of_line(context, command);
  if (!command.port.empty()) return check_port(context, command);
  if (!command.file.empty()) return line_of_file(context, command);
  return complain(Error{Errc::Syntax, "port parameters needs FILE, --port NAME or --for LINE"});
}

}  // namespace

void add_port_parameters_command(Command group, Context& context) {
  auto command = group.add_subcommand("parameters",
                                      "Derive the line from a TNC 151/155's machine parameters, or "
                                      "the parameters from a line,\nor compare a port with them");
  auto options = std::make_shared<ParametersCommand>();
  auto file = command.add_option(
      "FILE", options->file, "A setup (TOML), or parameters as the control sends them: MP0: ...");
  auto line = command.add_option("--for", options->line,
                                 "Print the parameters for this template or short form");
  command.add_option("--set", options->changes, "Settings of that line, KEY=VALUE").needs(line);
  auto port = command.add_option("--port", options->port,
                                 "Compare this port with FILE, or with its machine's setup");
  auto baud = command.add_option("--baud", options->baud,
                                 "Baud rate of the control (MOD) [the setup's baud_rate, or 2400]");
  baud.excludes(line);
  line.excludes(file).excludes(port);
  add_json_flag(command, context);
  command.footer(
      "MP 71 and 218 to 224 apply; the letter in headings is the setup's heading_letter, else that "
      "of MP 218,\nelse %. Only --port needs a server.\n\nExit status: 0 the settings match, 1 "
      "they differ, 2 usage, or a value that no line can have.\n\nExamples:\n  dnc port parameters "
      "mill-3.toml            # template and settings for dnc port add\n  dnc port parameters "
      "--for tnc155-bcc > mp  # what to set at the control\n  dnc port parameters --port line-3    "
      "      # does the port fit its machine's setup?");
  command.callback([&context, options] { context.status = run(context, *options); });
}

Result<wire::LineSettings> line_named(const std::string& name,
                                      const std::vector<std::string>& changes) {
  wire::LineSettings line;
  if (const auto found = wire::find_template(name)) {
    line = (*found)->settings;
  } else if (auto done = wire::apply_short_form(name, line); !done) {
    return fail(Errc::NotFound, "{}: neither a template nor a short form such as 9600e72", name);
  }
  for (const auto& change : changes) {
    const auto sign = change.find('=');
    auto done = sign == std::string::npos
                    ? wire::apply_short_form(change, line)
                    : wire::set_value(line, change.substr(0, sign), change.substr(sign + 1));
    if (!done) return fail(done.error());
  }
  return line;
}

int show_line(Context& context, std::string_view template_name, const wire::LineSettings& line) {
  const auto usual = wire::find_template(template_name);
  nlohmann::ordered_json settings = nlohmann::ordered_json::object();
  std::string text = fmt::format("--template {}", template_name);
  for (const auto& row : wire::setting_rows()) {
    const std::string value = row.get(line);
    if (row.key == "line" || (usual && value == row.get((*usual)->settings))) continue;
    settings[std::string(row.key)] = value;
    text += fmt::format(" {}={}", row.key, value);
  }
  if (context.wants_json) {
    context.print(
        json_text(nlohmann::ordered_json{{"template", template_name}, {"settings", settings}}));
  } else {
    context.print(text + "\n");
  }
  return kExitOk;
}

}  // namespace dripline::cli
