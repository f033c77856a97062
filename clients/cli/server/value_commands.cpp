#include "clients/cli/server/value_commands.hpp"

#include <memory>
#include <string>

#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

struct ValuesCommand {
  std::string machine, beginning;
  bool is_all = false;  ///< also those that are 0 or vacant
};

/// All pages. While a program runs each is of its own moment.
client::Reply<client::ControlValues> all_values(client::Client& client,
                                                const ValuesCommand& command) {
  auto all = client.control_values(command.machine, command.beginning, 0);
  while (all && all->next) {
    auto more = client.control_values(command.machine, command.beginning, *all->next);
    if (!more) return more;
    if (more->next && *more->next <= *all->next) more->next.reset();
    all->values.insert(all->values.end(), more->values.begin(), more->values.end());
    all->next = more->next;
  }
  return all;
}

int show_parameters(Context& context, client::Client& client, const ValuesCommand& command) {
  auto all = all_values(client, command);
  if (all && !command.is_all)
    std::erase_if(all->values, [](const auto& one) { return one.value.value_or(0) == 0; });
  if (const auto status = finished(context, all)) return *status;
  if (all->values.empty()) {
    context.print(command.is_all ? "The control has no such parameter.\n"
                                 : "All of them are 0 or vacant; --all lists them.\n");
    return kExitOk;
  }
  Table table({"NAME", right("VALUE")});
  for (const auto& one : all->values) table.add({one.name, control_value_text(one.value)});
  context.print(table);
  return kExitOk;
}

/// No variable is asked for.
constexpr const char* kNoName = "no parameter";

/// `M102 P2 Q3.5, M68 E0 Q2.5`; of an older gateway without words.
std::string functions_text(const client::ControlValues& values) {
  std::string text;
  const auto add = [&text](const std::string& one) { text += (text.empty() ? "" : ", ") + one; };
  for (const auto& function : values.functions) add(function);
  if (values.functions.empty())
    for (const auto code : values.codes) add(fmt::format("M{}", code));
  return text;
}

int show_pins(Context& context, client::Client& client, const std::string& machine) {
  const auto values = client.control_values(machine, kNoName, 0);
  if (const auto status = finished(context, values)) return *status;
  if (values->outputs.empty() && values->analog.empty() && values->codes.empty())
    context.print("No program has switched an output since the gateway began.\n");
  Table table({"AXIS", right("OUTPUT"), "STATE"});
  for (const auto& pin : values->outputs)
    table.add({pin.axis, std::to_string(pin.output), pin.on ? "on" : "off"});
  if (!values->outputs.empty()) context.print(table);
  Table analog({right("ANALOG OUTPUT"), right("VALUE")});
  for (const auto& one : values->analog)
    analog.add({std::to_string(one.output), control_value_text(one.value)});
  if (!analog.empty()) context.print(analog);
  const std::string codes = functions_text(*values);
  if (!codes.empty())
    context.print(
        fmt::format("M functions handed to the machine, the last one first: {}\n", codes));
  Table inputs({"INPUT", "STATE"});
  for (const auto& input : values->inputs) inputs.add({input.name, input.on ? "on" : "off"});
  if (!inputs.empty()) context.print(inputs);
  return kExitOk;
}

}  // namespace

void add_value_verbs(Command group, Context& context) {
  auto command = group.add_subcommand(
      "parameters", "Show the variables, offsets and tables of a control as they are now");
  auto options = std::make_shared<ValuesCommand>();
  command.add_option("MACHINE", options->machine, "The machine").required();
  command.add_option("BEGINNING", options->beginning,
                     "What their names begin with: P, #5, G54 (default: all)");
  command.add_flag("--all", options->is_all, "List those that are 0 or vacant too");
  add_json_flag(command, context);
  command.footer(
      "They are asked of the gateway, as the executed blocks have left them (before the first run: "
      "as its start\nwould find them): those that the "
      "control keeps from\nblock to block and from program to program, with its own names and in "
      "its own units, and those that it shows\nwhile a program runs (Q parameters of a TNC, #1 and "
      "up of a Fanuc, named parameters of LinuxCNC). What "
      "runs "
      "have left is kept on the server: dnc memory show.\n\n"
      "Example:\n  dnc machine parameters lathe-1 P1");
  run_at_server(command, context, options, show_parameters);

  auto machine = std::make_shared<std::string>();
  auto pins = group.add_subcommand(
      "pins",
      "Show the outputs that programs have switched or set, the last M functions, and the inputs");
  pins.add_option("MACHINE", *machine, "The machine").required();
  add_json_flag(pins, context);
  pins.footer(
      "Outputs and M functions, with the words that the control hands on (M68 E0 Q2.5, M102 P2 "
      "Q3.5), are those of the executed blocks since the gateway began. Inputs "
      "are "
      "those that the\nmachine reports at this moment: of a LinuxCNC by number, of a board by "
      "letter "
      "(P probe, D door, X Y Z limits);\na simulated machine has none.\n\nExample:\n  dnc machine "
      "pins lathe-1");
  run_at_server(pins, context, machine, show_pins);
}

}  // namespace dripline::cli
