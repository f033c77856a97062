#include "clients/cli/server/runs/run_restart.hpp"

#include <chrono>
#include <memory>
#include <thread>

#include "clients/cli/context.hpp"
#include "clients/cli/server/machine_text.hpp"
#include "clients/cli/server/runs/restart_text.hpp"
#include "clients/cli/server/runs/run_control.hpp"
#include "clients/cli/server/runs/run_follower.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

using namespace std::chrono_literals;

/// While a program is looked through nothing else happens; a program that needs longer is watched.
constexpr auto kLongestLook = 10min;
constexpr auto kAskAgain = 100ms;

struct RestartCommand {
  std::string run, at = "executed";
  bool follows = false;
};

/// The report of the restart; nothing: the run has ended before it, or Ctrl-C.
client::Reply<std::optional<nlohmann::ordered_json>> wait_for_report(client::Client& client,
                                                                     client::Run& run) {
  const auto limit = std::chrono::steady_clock::now() + kLongestLook;
  for (;;) {
    auto records = client.records(run.id, "message", {100, 0});
    if (!records) return client::failed(records.error());
    for (const client::Record& record : *records) {
      if (record.device != "restart") continue;
      auto report = nlohmann::ordered_json::parse(record.text, nullptr, false);
      return std::optional(std::move(report));
    }
    auto now = client.run(run.id);
    if (!now) return client::failed(now.error());
    run = *std::move(now);
    if (has_ended(run) || is_interrupted() || std::chrono::steady_clock::now() > limit)
      return std::optional<nlohmann::ordered_json>();
    std::this_thread::sleep_for(kAskAgain);
  }
}

void print_next_steps(Context& context, const client::Run& run) {
  const std::string id = short_id(run.id);
  context.print(fmt::format(
      "\nNothing has moved. Run {0} waits for cycle start:\n"
      "  dncgw panel --machine {1} cycle-start    at the machine\n"
      "  dnc run resume {0}                  where the machine may be started from the network\n"
      "  dnc run abort {0}                   leaves it\n",
      id, run.machine));
}

int restart(Context& context, client::Client& client, const RestartCommand& command) {
  catch_interrupts();
  auto original = find_run(client, command.run);
  if (!original) return complain(original.error());
  auto run = client.restart_run(original->id, command.at);
  if (!run) return complain(run.error());
  auto report = wait_for_report(client, *run);
  if (!report) return complain(report.error());
  if (!*report) {
    print_error("dnc: run {}: {}\n", short_id(run->id),
                run->reason.empty() ? "no report of the restart yet; dnc run watch follows it"
                                    : run->reason);
    return kExitNo;
  }
  if (context.wants_json) {
    nlohmann::ordered_json json{{"run", client::to_json_value(*run)}, {"restart", **report}};
    context.print(json_text(json));
  } else {
    const auto details = restart_details(**report);
    if (!details) {
      print_error("dnc: {}\n", details.error().what);
      return kExitNo;
    }
    context.print(*details);
    print_next_steps(context, *run);
  }
  return command.follows ? watch_run(context, client, *run, WatchStyle::Live) : kExitOk;
}

}  // namespace

void add_run_restart_command(Command group, Context& context) {
  auto command = group.add_subcommand("restart", "Continue a run where it was cut off");
  auto options = std::make_shared<RestartCommand>();
  command.add_option("ID", options->run, kRunHelp).required();
  command.add_option("--at", options->at,
                     "Continue after the block executed last (executed), at a block (block=1234), "
                     "a line (L7), an N number (N120), a tool change (T3), or after what was "
                     "executed by a time (time=2026-11-23T15:04:05Z) [executed]");
  command.add_flag("--follow", options->follows, "Follow the run to its end");
  add_json_flag(command, context);
  command.footer(
      "The gateway looks through the program from the nearest checkpoint, without motion, and "
      "compares the state\nwith what it recorded when the program ran. The result is a run of its "
      "own, which waits for cycle start:\nread first what it will switch on, where the axes go and "
      "how. Of a line, an N number or a tool the last\ntime it was executed counts. The "
      "interrupted block is executed again from its beginning.\n\nA restart is refused when "
      "revision, setup or the control's memory have changed since, and names which.\n\nExit "
      "status: 0 it waits for cycle start, 1 refused.\n\nExample:\n  dnc run restart latest\n  dnc "
      "run restart latest --at N120");
  run_at_server(command, context, options, restart);
}

}  // namespace dripline::cli
