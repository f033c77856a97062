#include <memory>

#include "clients/cli/commands.hpp"
#include "clients/cli/server/machine_text.hpp"
#include "clients/cli/server/machine_watch.hpp"
#include "clients/cli/server/run_control.hpp"
#include "clients/cli/text/json_text.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

void add_row(Table& table, const client::Machine& machine) {
  const auto status = machine.status.value_or(client::MachineStatus{});
  const bool has_run = !status.run.empty();
  table.add({machine.name, machine.control,
             machine.connected ? Cell("yes", Style::Good) : Cell("no", Style::Bad),
             execution_cell(machine), status.program,
             has_run ? fmt::format("{:.0f}", fraction_executed(status) * 100) : "",
             has_run ? std::to_string(status.executed) : "", position_text(status),
             time_text(machine.last_seen), machine.connected ? status.message : ""});
}

int list_machines(Context& context) {
  auto client = context.connect();
  if (!client) return context.status;
  auto machines = client->machines();
  if (!machines) return complain(machines.error());
  if (context.wants_json) {
    context.print(json_list_text("machines", *machines));
    return kExitOk;
  }
  if (machines->empty()) {
    context.print("No machine has announced itself yet; start its gateway, dncgw.\n");
    return kExitOk;
  }
  Table table({{"NAME"},
               {"CONTROL"},
               {"CONNECTED"},
               {"EXECUTION"},
               {"PROGRAM"},
               {"DONE %", Align::Right},
               {"BLOCKS", Align::Right},
               {"POSITION mm"},
               {"LAST SEEN"},
               {"MESSAGE"}});
  for (const auto& machine : *machines) add_row(table, machine);
  context.print(table);
  return kExitOk;
}

int show_status(Context& context, const std::string& name) {
  auto client = context.connect();
  if (!client) return context.status;
  auto machine = client->machine(name);
  if (!machine) return complain(machine.error());
  if (context.wants_json) {
    context.print(json_text(*machine));
  } else {
    context.print(machine_details(*machine));
  }
  return kExitOk;
}

struct SwitchCommand {
  std::string machine, name, state;
};

int set_switch(Context& context, const SwitchCommand& command) {
  auto client = context.connect();
  if (!client) return context.status;
  const auto request = switch_command(command.name, command.state == "on");
  if (auto given = client->command_machine(command.machine, request); !given)
    return complain(given.error());
  context.print(fmt::format("{} took {}\n", command.machine, command_text(request)));
  return kExitOk;
}

void add_switch(Command group, Context& context) {
  auto command = group.add_subcommand("switch", "Set a switch of a machine's panel");
  auto options = std::make_shared<SwitchCommand>();
  command.add_option("MACHINE", options->machine, "The machine").required();
  command.add_option("NAME", options->name, kSwitchHelp).required();
  command.add_option("STATE", options->state, "on or off").required().check(one_of({"on", "off"}));
  command.footer(
      "It works with or without a run; dnc run switch does the same for the machine of a "
      "run.\n\nExample:\n  dnc machine switch mill-1 single_block on");
  command.callback([&context, options] { context.status = set_switch(context, *options); });
}

}  // namespace

void add_machine_commands(Command app, Context& context) {
  auto group = app.add_subcommand("machine", "Machines and what they do now");
  group.require_subcommand(1);

  auto list = group.add_subcommand("list", "List all machines that ever connected");
  add_json_flag(list, context);
  list.callback([&context] { context.status = list_machines(context); });

  auto name = std::make_shared<std::string>();
  auto status = group.add_subcommand("status", "Show everything known of a machine");
  status.add_option("NAME", *name, "The machine").required();
  add_json_flag(status, context);
  status.callback([&context, name] { context.status = show_status(context, *name); });

  add_switch(group, context);

  auto watched = std::make_shared<std::string>();
  auto watch = group.add_subcommand("watch", "Follow a machine, or all, until Ctrl-C");
  watch.add_option("NAME", *watched, "The machine (default: all)");
  watch.add_flag("--json", context.wants_json, "Print each change as one JSON object per line");
  watch.footer(
      "On a terminal one live line per machine; in a pipe one line for each change of what it "
      "executes\nor reports, and of its counters every five seconds. Watching changes nothing at "
      "the "
      "machine.\n\nExample:\n  dnc machine watch lathe-1");
  watch.callback([&context, watched] { context.status = watch_machines(context, *watched); });
}

}  // namespace dripline::cli
