#include <map>
#include <memory>
#include <string>

#include "clients/cli/context.hpp"
#include "clients/cli/server/display_text.hpp"
#include "clients/cli/server/jog_commands.hpp"
#include "clients/cli/server/machine_text.hpp"
#include "clients/cli/server/position_commands.hpp"
#include "clients/cli/server/runs/run_control.hpp"
#include "clients/cli/server/runs/run_follower.hpp"
#include "clients/cli/server/value_commands.hpp"
#include "clients/cli/setup/change_log.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/terminal.hpp"
#include "clients/cli/text/value_text.hpp"
#include "clients/lib/event_stream.hpp"

namespace dripline::cli {
namespace {

using namespace std::chrono_literals;

class MachineWatch {
 public:
  MachineWatch(Context& context, client::Client& client, std::string name)
      : context_(context), client_(client), name_(std::move(name)) {}

  int run() {
    if (auto read = refresh(); !read) return complain(read.error());
    client::EventStream stream(client_.servers(), name_);
    while (!is_interrupted()) {
      auto item = stream.next(200ms);
      if (!item) continue;
      if (auto* lost = std::get_if<client::StreamLost>(&*item)) {
        if (lost->failure.kind == client::Failure::Kind::Denied) return complain(lost->failure);
        say_once(lost->failure.what + "; trying again");
      } else if (std::holds_alternative<client::StreamOpened>(*item)) {
        said_.clear();
        if (auto read = refresh(); !read) say_once(read.error().what);
      } else if (auto* machine = std::get_if<client::Machine>(&*item)) {
        take(*machine);
      }
    }
    area_.clear();
    return kExitInterrupted;
  }

 private:
  client::Reply<void> refresh() {
    if (name_.empty()) {
      auto machines = client_.machines();
      if (!machines) return client::failed(machines.error());
      for (const auto& machine : *machines) take(machine);
      return {};
    }
    auto machine = client_.machine(name_);
    if (!machine) return client::failed(machine.error());
    take(*machine);
    return {};
  }

  void take(const client::Machine& machine) {
    if (!name_.empty() && machine.name != name_) return;
    const std::string line = status_line(machine);
    if (context_.wants_json) {
      context_.print(json_line(client::to_json_value(machine)));
      std::fflush(stdout);
    } else if (area_.is_live()) {
      lines_[machine.name] = line;
      draw();
    } else {
      print_change(machine, line);
    }
  }

  void print_change(const client::Machine& machine, const std::string& line) {
    const auto status = status_of(machine);
    const std::string key =
        fmt::format("{}|{}|{}|{}", machine.connected, status.execution, status.run, status.message);
    if (!logs_[machine.name].is_worth_a_line(key, line, clock_.steady_now())) return;
    context_.print(printable(line) + "\n");
    std::fflush(stdout);
  }

  void draw() {
    std::vector<std::string> lines;
    for (const auto& [name, line] : lines_) lines.push_back(line);
    area_.show(lines);
  }

  void say_once(const std::string& text) {
    if (said_ == text) return;
    said_ = text;
    area_.clear();
    print_error("dnc: {}\n", text);
  }

  Context& context_;
  client::Client& client_;
  std::string name_;
  SystemClock clock_;
  LiveArea area_ = LiveArea::on_stderr();
  std::map<std::string, std::string> lines_;
  std::map<std::string, ChangeLog> logs_;
  std::string said_;
};

/// Follows one machine (or all: empty name) until Ctrl-C; gives the exit status.
int watch_machines(Context& context, client::Client& client, const std::string& name) {
  catch_interrupts();
  return MachineWatch(context, client, name).run();
}

void add_row(Table& table, const client::Machine& machine) {
  const auto status = status_of(machine);
  const bool has_run = !status.run.empty();
  table.add({machine.name, machine.control,
             machine.connected ? Cell("yes", Style::Good) : Cell("no", Style::Bad),
             execution_cell(machine), status.program,
             has_run ? fmt::format("{:.0f}", fraction_executed(status) * 100) : "",
             has_run ? std::to_string(status.executed) : "",
             position_text(status, display_of(machine)), time_text(machine.last_seen),
             machine.connected ? status.message : ""});
}

int list_machines(Context& context, client::Client& client) {
  auto machines = client.machines();
  if (const auto status = finished(context, machines, "machines")) return *status;
  if (machines->empty()) {
    context.print("No machine has announced itself yet; start its gateway, dncgw.\n");
    return kExitOk;
  }
  Table table({"NAME", "CONTROL", "CONNECTED", "EXECUTION", "PROGRAM", right("DONE %"),
               right("BLOCKS"), "POSITION mm", "LAST SEEN", "MESSAGE"});
  for (const auto& machine : *machines) add_row(table, machine);
  context.print(table);
  return kExitOk;
}

int show_status(Context& context, client::Client& client, const std::string& name) {
  auto machine = client.machine(name);
  if (const auto status = finished(context, machine)) return *status;
  context.print(machine_details(*machine));
  return kExitOk;
}

struct SwitchCommand {
  std::string machine, name, state;
};

int set_switch(Context& context, client::Client& client, const SwitchCommand& command) {
  const auto request = switch_command(command.name, command.state == "on");
  if (auto given = client.command_machine(command.machine, request); !given)
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
  run_at_server(command, context, options, set_switch);
}

int confirm_gateway(Context& context, client::Client& client, const std::string& machine) {
  if (auto confirmed = client.confirm_gateway(machine); !confirmed)
    return complain(confirmed.error());
  context.print(fmt::format("The gateway that waited is that of {} from now on.\n", machine));
  return kExitOk;
}

void add_confirm_gateway(Command group, Context& context) {
  auto command = group.add_subcommand("confirm-gateway",
                                      "Take another gateway than the one before for the machine's");
  auto name = std::make_shared<std::string>();
  command.add_option("NAME", *name, "The machine").required();
  command.footer(
      "While a run may be in progress, a gateway with another state folder than the one before is "
      "not taken by itself:\nit may be a second one by mistake, and the first one, which is not "
      "heard, may still cut. Look at the machine first.\nThe run is shown as interrupted then."
      "\n\nExample:\n  dnc machine confirm-gateway lathe-1");
  run_at_server(command, context, name, confirm_gateway);
}

int remove_machine(Context& context, client::Client& client, const std::string& machine) {
  if (auto removed = client.remove_machine(machine); !removed) return complain(removed.error());
  context.print(fmt::format("{} is removed; its runs and records stay.\n", machine));
  return kExitOk;
}

void add_remove_machine(Command group, Context& context) {
  auto command = group.add_subcommand("remove", "Remove a machine that is no more there");
  auto name = std::make_shared<std::string>();
  command.add_option("NAME", *name, "The machine").required();
  command.footer(
      "It is listed no more. Its runs, records, setups and entries of the audit trail stay, and "
      "the groups that name it.\nRefused while its gateway is connected, a run of it has not "
      "ended, "
      "or it has a port or jobs in its queue. When its\ngateway connects again it is there again, "
      "as before.\n\nExample:\n  dnc machine remove lathe-9");
  run_at_server(command, context, name, remove_machine);
}

struct MdiCommand {
  std::string machine;
  std::vector<std::string> blocks;
  bool waits = false;
  std::optional<std::uint32_t> timeout;
};

int key_in(Context& context, client::Client& client, const MdiCommand& command) {
  std::string text;
  for (const std::string& block : command.blocks) text += block + "\n";
  auto keyed_in = client.key_in(command.machine, text);
  if (!keyed_in) return complain(keyed_in.error());
  if (!keyed_in->notice.empty()) print_error("dnc: {}\n", keyed_in->notice);
  const client::Run& run = keyed_in->run;
  if (command.waits || command.timeout) {
    std::optional<std::chrono::seconds> timeout;
    if (command.timeout) timeout = std::chrono::seconds(*command.timeout);
    return watch_run(context, client, run, WatchStyle::Silent, timeout);
  }
  if (context.wants_json) {
    context.print(json_text(*keyed_in));
  } else {
    context.print(fmt::format("Run {} of what was keyed in started on {}.\n", run.id, run.machine));
  }
  return kExitOk;
}

void add_mdi(Command group, Context& context) {
  auto command = group.add_subcommand("mdi", "Key in blocks and run them (MDI)");
  auto options = std::make_shared<MdiCommand>();
  command.add_option("MACHINE", options->machine, "The machine").required();
  command.add_option("BLOCK", options->blocks, "One block; a few where the control takes them")
      .required();
  command.add_flag("--wait", options->waits, "Wait for its end and print only the outcome");
  command
      .add_option("--timeout", options->timeout,
                  "Wait so many seconds for its end; the run continues then (exit status 124)")
      .check(in_range(1, 86'400));
  add_json_flag(command, context);
  command.footer(
      "It runs on an idle machine, from where its axes are and with what the last text has left "
      "in force (modes, tool,\noffsets, spindle). After an abort, an alarm or a restart of the "
      "gateway, and when axes, setup or memory were changed\nmeanwhile, it begins with the modes "
      "of power on and without a tool, and standard error says so: the axes stay, and the\n"
      "position is that of no tool from there on. A program begins as always: MDI changes nothing "
      "for it but position\nand memory. Where it waits (a tool change, a stop, a question), "
      "standard error names the prompt and the command\nthat answers it.\n\nIt is a run of the "
      "program \"MDI "
      "MACHINE\", whose revisions are what was keyed in: dnc run hold, abort and show work.\n"
      "Centurion and Tektronix take one block, the TNC one single-axis block or TOOL CALL, Fanuc "
      "and RS274/NGC ten\nlines, a ProtoTRAK none.\n\nExample:\n  dnc machine mdi mill-1 'G90 G0 "
      "X1 Y2' --wait");
  run_at_server(command, context, options, key_in);
}

}  // namespace

void add_machine_commands(Command app, Context& context) {
  auto group = app.add_subcommand("machine", "Machines and what they do now");
  group.require_subcommand(1);

  auto list =
      group.add_subcommand("list", "List all machines that ever connected, without removed ones");
  add_json_flag(list, context);
  run_at_server(list, context, list_machines);

  auto name = std::make_shared<std::string>();
  auto status = group.add_subcommand("status", "Show everything known of a machine");
  status.add_option("NAME", *name, "The machine").required();
  add_json_flag(status, context);
  run_at_server(status, context, name, show_status);

  add_switch(group, context);
  add_confirm_gateway(group, context);
  add_remove_machine(group, context);
  add_value_verbs(group, context);
  add_mdi(group, context);
  add_position_verbs(group, context);
  add_jog_verbs(group, context);

  auto watched = std::make_shared<std::string>();
  auto watch = group.add_subcommand("watch", "Follow a machine, or all, until Ctrl-C");
  watch.add_option("NAME", *watched, "The machine (default: all)");
  watch.add_flag("--json", context.wants_json, "Print each change as one JSON object per line");
  watch.footer(
      "On a terminal one live line per machine; in a pipe one line for each change of what it "
      "executes\nor reports, and of its counters every five seconds. Watching changes nothing at "
      "the "
      "machine.\n\nExample:\n  dnc machine watch lathe-1");
  run_at_server(watch, context, watched, watch_machines);
}

}  // namespace dripline::cli
