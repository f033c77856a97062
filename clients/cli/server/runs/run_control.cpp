#include "clients/cli/server/runs/run_control.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include "clients/cli/context.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {

namespace {

constexpr const char* kLatest = "latest";

struct RunControlCommand {
  std::string run;
  std::string text, name, state;
  std::optional<double> feed, rapid, spindle;  ///< per cent
  int clicks = 1;
};

/// A hold of the machine can be one of its queue too, which continues only when it is released.
void say_queue_is_held(client::Client& client, const std::string& name) {
  const auto machine = client.machine(name);
  if (!machine || !machine->queue_hold) return;
  print_error("dnc: the queue of {} is still held by {}: {}; dnc job release {}\n", name,
              machine->queue_hold->who, machine->queue_hold->reason, name);
}

bool is_stop(const client::CommandRequest& command) {
  const bool is_emergency = command.action == "switch" && command.name == "emergency_stop";
  return command.action == "hold" || command.action == "abort" ||
         (is_emergency && command.value.value_or(0) != 0);
}

/// The only machine that reports a run whose id begins so. The server knows it without its library,
/// which may be away.
std::optional<client::Machine> find_machine_of(client::Client& client, const std::string& prefix) {
  const auto machines = client.machines();
  if (!machines) return std::nullopt;
  std::optional<client::Machine> found;
  for (const auto& machine : *machines) {
    if (!machine.status || machine.status->run.empty()) continue;
    if (!machine.status->run.starts_with(prefix)) continue;
    if (found) return std::nullopt;
    found = machine;
  }
  return found;
}

/// A stop that is not confirmed: the machine may go on.
int complain_of_stop(const client::Failure& failure) {
  const int status = complain(failure);
  print_error("dnc: the machine may not have stopped: stop it at its panel\n");
  return status;
}

/// Without the library. Nothing is done unless it is one stop, and of one machine.
std::optional<int> stop_reported_run(client::Client& client, Context& context,
                                     const std::string& prefix,
                                     const std::vector<client::CommandRequest>& commands) {
  if (commands.size() != 1 || !is_stop(commands.front())) return std::nullopt;
  const auto machine = find_machine_of(client, prefix);
  if (!machine) return std::nullopt;
  const auto& status = *machine->status;
  if (auto given = client.command(status.run, commands.front()); !given)
    return complain_of_stop(given.error());
  context.print(fmt::format("{} took {} (run {} of {})\n", machine->name,
                            command_text(commands.front()), short_id(status.run), status.program));
  return kExitOk;
}

/// Gives the orders one after the other, as long as the machine takes them.
int give(Context& context, const std::string& reference,
         std::vector<client::CommandRequest> commands) {
  // The run is looked up first, which waits while the database is away.
  for (auto& command : commands)
    if (!is_stop(command)) command.asked = std::chrono::steady_clock::now();
  auto client = context.connect();
  if (!client) return context.status;
  const bool is_latest = reference == kLatest;
  // A stop is sent at once: what the library has to say comes afterward, or not at all.
  if (!reference.empty() && !is_latest) {
    if (auto stopped = stop_reported_run(*client, context, reference, commands)) return *stopped;
  }
  const bool stops = !commands.empty() && is_stop(commands.front());
  auto run = find_run(*client, reference);
  // The library, which knows the latest run, is away: it is the only one there is.
  if (!run && is_latest && run.error().kind != client::Failure::Kind::Refused) {
    if (auto stopped = stop_reported_run(*client, context, "", commands)) return *stopped;
  }
  if (!run) return stops ? complain_of_stop(run.error()) : complain(run.error());
  for (const auto& command : commands) {
    auto given = client->command(run->id, command);
    if (!given) return is_stop(command) ? complain_of_stop(given.error()) : complain(given.error());
    context.print(fmt::format("{} took {} (run {} of {})\n", run->machine, command_text(command),
                              short_id(run->id), run->program));
    if (command.action == "resume") say_queue_is_held(*client, run->machine);
  }
  return kExitOk;
}

client::CommandRequest plain(std::string action) {
  return {std::move(action), {}, {}, {}};
}

void add_plain(Command group, Context& context, const std::string& action, const char* help) {
  auto command = group.add_subcommand(action, help);
  auto run = std::make_shared<std::string>();
  command.add_option("ID", *run, kRunHelp).required();
  command.callback(
      [&context, run, action] { context.status = give(context, *run, {plain(action)}); });
}

void add_answer(Command group, Context& context) {
  auto command = group.add_subcommand("answer", "Answer the prompt that a run is waiting for");
  auto options = std::make_shared<RunControlCommand>();
  command.add_option("ID", options->run, kRunHelp).required();
  command.add_option("TEXT", options->text, "Text that the operator would type").required();
  command.footer("Example:\n  dnc run answer latest 16.4856");
  command.callback([&context, options] {
    client::CommandRequest request = plain("answer");
    request.text = options->text;
    context.status = give(context, options->run, {request});
  });
}

void add_run_switch(Command group, Context& context) {
  auto command = group.add_subcommand("switch", "Set a switch of the machine's panel");
  auto options = std::make_shared<RunControlCommand>();
  command.add_option("ID", options->run, kRunHelp).required();
  command.add_option("NAME", options->name, kSwitchHelp).required();
  command.add_option("STATE", options->state, "on or off").required().check(one_of({"on", "off"}));
  command.footer(
      "emergency_stop brakes at once, switches spindle and coolant off and keeps the run from "
      "continuing; when\nit is off again the run ends as aborted. It can be released by dnc "
      "machine switch too.\nsingle_block, optional_stop, dry_run: from the block or move that the "
      "machine executes next (dry_run of a\nLinuxCNC or Grbl machine: from the next start). "
      "block_skip: for blocks that are not read yet; the run's report\nstates the block. "
      "machine_lock, test_run: only without a run.\n\nExample:\n  dnc run switch latest "
      "single_block on");
  command.callback([&context, options] {
    context.status =
        give(context, options->run, {switch_command(options->name, options->state == "on")});
  });
}

void add_handwheel(Command group, Context& context) {
  constexpr int kMaxClicks = 1000;
  auto command = group.add_subcommand("handwheel", "Turn the handwheel that drives the program");
  auto options = std::make_shared<RunControlCommand>();
  command.add_option("ID", options->run, kRunHelp).required();
  command.add_option("CLICKS", options->clicks, "Number of clicks, forward")
      .required()
      .check(in_range(1, kMaxClicks));
  command.footer(
      "In handwheel mode a program moves only as far as the handwheel is turned; the feed switch "
      "sets the\ndistance per click.\n\nExample:\n  dnc run switch latest handwheel on\n  dnc run "
      "handwheel latest 200");
  command.callback([&context, options] {
    client::CommandRequest request = plain("handwheel");
    request.value = options->clicks;
    context.status = give(context, options->run, {request});
  });
}

int give_overrides(Context& context, const RunControlCommand& command) {
  std::vector<client::CommandRequest> commands;
  const auto add = [&](const char* action, const std::optional<double>& percent) {
    if (!percent) return;
    commands.push_back(plain(action));
    commands.back().value = *percent / 100;
  };
  add("feed_override", command.feed);
  add("rapid_override", command.rapid);
  add("spindle_override", command.spindle);
  if (!commands.empty()) return give(context, command.run, commands);
  print_error("dnc: run override changes nothing; expected --feed, --rapid or --spindle\n");
  return kExitUsage;
}

void add_override(Command group, Context& context) {
  auto command = group.add_subcommand("override", "Set feed, rapid or spindle override");
  auto options = std::make_shared<RunControlCommand>();
  const Check percent = in_range(0.0, 1000.0);
  command.add_option("ID", options->run, kRunHelp).required();
  command.add_option("--feed", options->feed, "Percent of the programmed feed").check(percent);
  command.add_option("--rapid", options->rapid, "Percent of rapid traverse").check(percent);
  command.add_option("--spindle", options->spindle, "Percent of the programmed speed")
      .check(percent);
  command.footer(
      "The machine has its own limits and refuses what is beyond them.\n\nExample:\n  dnc run "
      "override latest --feed 80 --rapid 25");
  command.callback([&context, options] { context.status = give_overrides(context, *options); });
}

}  // namespace

client::CommandRequest switch_command(std::string name, bool is_on) {
  std::ranges::replace(name, '-', '_');
  client::CommandRequest command = plain("switch");
  command.name = std::move(name);
  command.value = is_on ? 1 : 0;
  return command;
}

std::string command_text(const client::CommandRequest& command) {
  if (command.action == "switch") {
    return fmt::format("{} {}", command.name.value_or(""), command.value == 1.0 ? "on" : "off");
  }
  if (command.action == "handwheel") return fmt::format("{:.0f} clicks", command.value.value_or(0));
  std::string text = command.action;
  std::ranges::replace(text, '_', ' ');
  if (command.value) text += fmt::format(" {:.4g} %", *command.value * 100);
  return text;
}

void add_run_control_commands(Command group, Context& context) {
  add_plain(group, context, "hold", "Hold the feed; dnc run resume continues");
  add_plain(group, context, "resume", "Resume after a hold, a stop or a single block");
  add_plain(group, context, "abort", "Abort a run; it cannot be resumed");
  add_answer(group, context);
  add_run_switch(group, context);
  add_override(group, context);
  add_handwheel(group, context);
}

namespace {

using client::Failure;
using client::Run;

constexpr std::uint64_t kMaxRunsLookedAt = 10000;

client::Reply<Run> find_latest(client::Client& client) {
  auto runs = client.runs({"", "", "", {1, 0}});
  if (!runs) return client::failed(runs.error());
  if (runs->empty()) {
    return client::failed(Failure::Kind::Refused, Errc::NotFound, "there is no run yet");
  }
  return runs->front();
}

client::Reply<Run> find_by_prefix(client::Client& client, const std::string& prefix) {
  auto runs = fetch_all(kMaxRunsLookedAt, [&](client::Page page) {
    return client.runs({"", "", "", page});
  });
  if (!runs) return client::failed(runs.error());
  const Run* found = nullptr;
  for (const auto& run : *runs) {
    if (!run.id.starts_with(prefix)) continue;
    if (found != nullptr) {
      return client::failed(Failure::Kind::Refused, Errc::Conflict,
                            "run '{}' fits {} and {}; expected more of the id", prefix, found->id,
                            run.id);
    }
    found = &run;
  }
  if (found != nullptr) return *found;
  return client::failed(Failure::Kind::Refused, Errc::NotFound,
                        "no run's id begins with '{}'; expected one of dnc run list, or latest",
                        prefix);
}

}  // namespace

client::Reply<Run> find_run(client::Client& client, const std::string& reference) {
  if (reference == kLatest) return find_latest(client);
  if (reference.empty()) return find_by_prefix(client, "(empty)");
  auto exact = client.run(reference);
  if (exact || exact.error().kind != Failure::Kind::Refused) return exact;
  return find_by_prefix(client, reference);
}

}  // namespace dripline::cli
