#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/server/attestation_commands.hpp"
#include "clients/cli/server/display_text.hpp"
#include "clients/cli/server/machine_text.hpp"
#include "clients/cli/server/runs/run_control.hpp"
#include "clients/cli/server/runs/run_follower.hpp"
#include "clients/cli/server/runs/run_restart.hpp"
#include "clients/cli/server/status_window.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

struct StartCommand {
  client::RunRequest request;
  bool follows = false, waits = false;
};

struct RunListCommand {
  client::RunQuery query;
  std::uint64_t limit = 20;
};

int start(Context& context, client::Client& client, const StartCommand& command) {
  const auto started = client.start_run(command.request);
  if (!started) return complain(started.error());
  const client::Run& run = started->run;
  if (!started->notice.empty()) print_error("dnc: {}\n", started->notice);
  if (command.follows || command.waits) {
    if (!context.wants_json && command.follows) {
      context.print(fmt::format("Run {} started.\n", short_id(run.id)));
      std::fflush(stdout);
    }
    const auto style = command.follows ? WatchStyle::Live : WatchStyle::Silent;
    return watch_run(context, client, run, style);
  }
  if (context.wants_json) {
    context.print(json_text(*started));
  } else {
    context.print(fmt::format("Run {} of {} revision {} started on {}.\n", run.id, run.program,
                              run.revision, run.machine));
  }
  return kExitOk;
}

/// What was tested and cut off is not what was executed and cut off.
std::string run_state_text(const client::Run& run) {
  const bool says_so = !run.test || run.state == "tested" || run.state == "refused";
  return says_so ? run.state : run.state + " (test run)";
}

void add_row(Table& table, const client::Run& run) {
  table.add(
      {short_id(run.id), run.machine, run.program, std::to_string(run.revision),
       Cell(run_state_text(run), style_of_state(run.state)), std::to_string(run.executed),
       std::to_string(run.outputs), time_text(run.started.empty() ? run.created : run.started),
       has_ended(run) ? duration_text(seconds_between(run.started, run.ended)) : "", run.reason});
}

int list_runs(Context& context, client::Client& client, const RunListCommand& command) {
  auto runs = fetch_all(command.limit, [&](client::Page page) {
    client::RunQuery query = command.query;
    query.page = page;
    return client.runs(query);
  });
  if (const auto status = finished(context, runs, "runs")) return *status;
  if (runs->empty()) {
    context.print("No such run; dnc run start MACHINE PROGRAM makes one.\n");
    return kExitOk;
  }
  Table table({"RUN", "MACHINE", "PROGRAM", right("REV"), "STATE", right("BLOCKS"),
               right("REPORT LINES"), "STARTED", right("TOOK"), "REASON"});
  for (const auto& run : *runs) add_row(table, run);
  context.print(table);
  return kExitOk;
}

/// Nothing under a policy that asks for nothing.
std::string allowance_text(const client::Run& run) {
  if (run.allowed_as == "prove_out") return "to prove out what is not released";
  return run.approval ? fmt::format("released by step {}", *run.approval) : "";
}

/// Nothing of a server that measures nothing, or of a run that nothing was measured of.
std::string parts_text(const std::optional<client::ShownRun::Parts>& parts) {
  if (!parts || parts->all() == 0) return "";
  std::string text;
  const auto add = [&](std::uint64_t count, std::string_view verdict) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, verdict);
  };
  add(parts->good, "good");
  add(parts->unknown, "unknown");
  add(parts->rework, "rework");
  add(parts->scrap, "scrap");
  if (parts->archived > 0) text += fmt::format(" ({} in archives)", parts->archived);
  return text;
}

/// `display`: of the control that executed it.
Details run_details(const client::ShownRun& shown, const client::Display& display) {
  const client::Run& run = shown.run;
  Details details;
  details.add("run", run.id);
  details.add("state", Cell(run.state, style_of_state(run.state)));
  if (shown.held) details.add("held", Cell(hold_text(*shown.held), Style::Bad));
  details.add("reason", run.reason);
  details.add("machine", run.machine);
  details.add("program", fmt::format("{} revision {}", run.program, run.revision));
  details.add("setup",
              run.setup ? fmt::format("{} of the server", *run.setup) : "none of the server");
  details.add("allowed", allowance_text(run));
  details.add("control", run.control);
  details.add("content", run.sha256);
  details.add("verified", run.content_verified ? (*run.content_verified ? "yes" : "NO") : "");
  details.add("sent", fmt::format("{} of {}", bytes_text(run.sent), bytes_text(run.size)));
  details.add("accepted", fmt::format("{} blocks", run.accepted));
  details.add("executed", fmt::format("{} blocks", run.executed));
  if (run.statistics) add_statistics(details, *run.statistics, display);
  details.add("last line", run.line.value_or(0) > 0 ? std::to_string(*run.line) : "");
  details.add("last N", run.sequence ? std::to_string(*run.sequence) : "");
  details.add("report lines", std::to_string(run.outputs));
  details.add("parts", parts_text(shown.parts));
  details.add("author", run.author);
  details.add("created", time_text(run.created));
  details.add("started", time_text(run.started));
  details.add("ended", time_text(run.ended));
  return details;
}

int show_run(Context& context, client::Client& client, const std::string& reference) {
  const auto found = find_run(client, reference);
  if (!found) return complain(found.error());
  const auto run = client.shown_run(found->id);
  if (const auto status = finished(context, run)) return *status;
  client::Display display;
  if (run->run.statistics) {
    if (const auto machine = client.machine(run->run.machine)) display = display_of(*machine);
  }
  context.print(run_details(*run, display));
  return kExitOk;
}

int watch(Context& context, client::Client& client, const std::string& reference) {
  auto run = find_run(client, reference);
  if (!run) return complain(run.error());
  return watch_run(context, client, *run, WatchStyle::Live);
}

void add_start(Command group, Context& context) {
  auto command = group.add_subcommand("start", "Start a program on a machine");
  auto options = std::make_shared<StartCommand>();
  command.add_option("MACHINE", options->request.machine, "The machine").required();
  command.add_option("PROGRAM", options->request.program, "The program in the library").required();
  command.add_option("--revision", options->request.revision,
                     "Revision to start (default: the latest)");
  command.add_option("--from", options->request.from,
                     "Begin at a block (N120), a line (L7), a byte (B4096), the first change to a "
                     "tool (T3) or, at "
                     "a gateway, after blocks (+25)");
  auto send = command.add_flag_callback(
      "--send-head", [options] { options->request.head = "send"; },
      "On a serial line: before the start block, send the modal words (units, feed, tool ...) that "
      "the rest of the program depends on");
  command
      .add_flag_callback(
          "--modes-set", [options] { options->request.head = "set"; },
          "On a serial line: confirm that those modal words are already in force at the control; "
          "nothing is sent for them")
      .excludes(send);
  command
      .add_option(
          "--memory", options->request.memory,
          "With --from at a gateway: search the skipped part with the control's memory (variables, "
          "offsets) as it was when this machine's last run of the revision began (begin), or as it "
          "is now (now); with now, the changes in the skipped part are applied again")
      .check(one_of({"begin", "now"}));
  command.add_option("--pass", options->request.pass,
                     "With --from at a gateway: start at this pass of the block (loops, "
                     "subprograms)");
  command.add_flag("--test-run", options->request.is_test,
                   "At a gateway: test the program with the control's memory and the machine's "
                   "limits; nothing moves");
  auto follow = command.add_flag("--follow", options->follows, "Follow the run to its end");
  command.add_flag("--wait", options->waits, "Wait for its end and print only the outcome")
      .excludes(follow);
  add_json_flag(command, context);
  command.footer(
      "On a serial line a start with --from is refused while the rest of the program depends on "
      "modal words\nbefore the start block. The refusal names each with its line, and the blocks "
      "that --send-head would send.\nAt a gateway the control searches the program up to the start "
      "block. A start is refused if it would apply\nchanges of the memory twice, or if its block "
      "is in a loop or a subprogram, unless --memory and --pass\ndecide it.\n\nWith --follow or "
      "--wait the exit status is the run's: 0 completed or tested, 1 anything else.\nCtrl-C ends "
      "the "
      "watching (status 130), never the run.\n\nExample:\n  dnc run start lathe-1 O0200 --follow");
  run_at_server(command, context, options, start);
}

void add_list(Command group, Context& context) {
  auto command = group.add_subcommand("list", "List runs, newest first");
  auto options = std::make_shared<RunListCommand>();
  command.add_option("--machine", options->query.machine, "List only runs of this machine");
  command.add_option("--program", options->query.program, "List only runs of this program");
  command.add_option("--state", options->query.state,
                     "List only runs in this state: ordered, active, completed, aborted, alarmed, "
                     "interrupted, refused, tested");
  command.add_option("--limit", options->limit, "List at most this many, 0 for all [20]");
  add_json_flag(command, context);
  run_at_server(command, context, options, list_runs);
}

}  // namespace

void add_run_commands(Command app, Context& context) {
  auto group = app.add_subcommand("run", "Run programs on machines");
  group.require_subcommand(1);
  add_start(group, context);
  add_run_restart_command(group, context);
  add_list(group, context);

  auto shown = std::make_shared<std::string>();
  auto show_command = group.add_subcommand("show", "Show everything known of a run");
  show_command.add_option("ID", *shown, kRunHelp).required();
  add_json_flag(show_command, context);
  run_at_server(show_command, context, shown, show_run);

  add_run_control_commands(group, context);
  add_attestation_commands(group, context);

  auto watched = std::make_shared<std::string>();
  auto watch_command = group.add_subcommand("watch", "Follow a run to its end");
  watch_command.add_option("ID", *watched, kRunHelp).required();
  watch_command.add_flag("--json", context.wants_json,
                         "Print each change as one JSON object per line");
  watch_command.footer(
      "Exit status: 0 completed or tested, 1 anything else, 130 after Ctrl-C (the run continues).");
  run_at_server(watch_command, context, watched, watch);
}

}  // namespace dripline::cli
