#include <memory>

#include "clients/cli/context.hpp"
#include "clients/cli/text/error_output.hpp"
#include "clients/cli/text/standard_output.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {
namespace {

struct JobQueueCommand {
  std::string machine;
  bool closed = false;
};

struct JobAddition {
  client::Client::JobRequest request;
};

struct JobChoice {
  std::string machine;
  std::uint64_t job = 0, place = 0;
};

struct JobStart {
  std::string machine;
  std::optional<std::uint64_t> job;
};

struct JobHoldCommand {
  std::string machine, reason;
};

Cell state_cell(const client::Job& job) {
  if (job.state == "active") return {"active", Style::Good};
  return printable(job.state);
}

void print_jobs(const Context& context, const client::JobList& list) {
  if (const auto& hold = list.hold) {
    context.print(fmt::format("Held by {} since {}: {}\n\n", printable(hold->who),
                              time_text(hold->since), printable(hold->reason)));
  }
  Table table({right("JOB"), "PROGRAM", right("REV"), right("PARTS"), right("GOOD"),
               right("REWORK"), right("SCRAP"), right("UNKNOWN"), right("RUNS"), "STATE", "AUTHOR",
               "COMMENT"});
  for (const auto& job : list.jobs) {
    const bool counts_good = job.counts == "good";
    const auto of_quantity = [&](std::uint64_t parts) {
      return fmt::format("{}/{}", parts, job.quantity);
    };
    table.add({std::to_string(job.id), printable(job.program),
               job.revision ? std::to_string(*job.revision) : "latest",
               counts_good ? std::to_string(job.completed) : of_quantity(job.completed),
               counts_good ? of_quantity(job.good) : std::to_string(job.good),
               std::to_string(job.rework), std::to_string(job.scrap), std::to_string(job.unknown),
               std::to_string(job.runs), state_cell(job), printable(job.author),
               printable(job.comment)});
  }
  context.print(table);
}

int list_jobs(Context& context, client::Client& client, const JobQueueCommand& command) {
  constexpr std::uint64_t kAll = 1000;
  const auto list = client.jobs(command.machine, !command.closed, {.limit = kAll, .offset = 0});
  if (const auto status = finished(context, list)) return *status;
  if (list->jobs.empty() && !list->hold) {
    context.print(fmt::format("No job {} machine {}.\n",
                              command.closed ? "was done or removed at" : "waits for",
                              command.machine));
    return kExitOk;
  }
  print_jobs(context, *list);
  return kExitOk;
}

int add_job(Context& context, client::Client& client, const JobAddition& command) {
  const auto job = client.add_job(command.request);
  if (const auto status = finished(context, job)) return *status;
  context.print(fmt::format("Job {}: {} {}parts of {} on {}.\n", job->id, job->quantity,
                            job->counts == "good" ? "good " : "", job->program, job->machine));
  return kExitOk;
}

int move_job(Context& context, client::Client& client, const JobChoice& command) {
  const auto job = client.move_job(command.machine, command.job, command.place);
  if (const auto status = finished(context, job)) return *status;
  context.print(fmt::format("Job {} is at place {}.\n", job->id, command.place));
  return kExitOk;
}

int remove_job(Context& context, client::Client& client, const JobChoice& command) {
  const auto removed = client.remove_job(command.machine, command.job);
  if (!removed) return complain(removed.error());
  context.print(
      fmt::format("Removed job {} from the queue of {}.\n", command.job, command.machine));
  return kExitOk;
}

int start_job(Context& context, client::Client& client, const JobStart& command) {
  const auto started = client.start_job(command.machine, command.job);
  if (started && !started->notice.empty()) print_error("dnc: {}\n", started->notice);
  if (const auto status = finished(context, started)) return *status;
  const client::Run& run = started->run;
  context.print(fmt::format("Run {} of {} revision {} started on {}, job {}.\n", run.id,
                            run.program, run.revision, run.machine, run.job.value_or(0)));
  return kExitOk;
}

int hold_jobs(Context& context, client::Client& client, const JobHoldCommand& command) {
  const auto held = client.hold_jobs(command.machine, command.reason);
  if (!held) return complain(held.error());
  context.print(fmt::format("The queue of {} is held: it starts nothing.\n", command.machine));
  return kExitOk;
}

int release_jobs(Context& context, client::Client& client, const JobHoldCommand& command) {
  const auto released = client.release_jobs(command.machine);
  if (!released) return complain(released.error());
  context.print(fmt::format("The queue of {} is released.\n", command.machine));
  return kExitOk;
}

void add_machine(Command command, std::string& machine) {
  command.add_option("MACHINE", machine, "The machine").required();
}

void add_adding(Command group, Context& context) {
  auto add = group.add_subcommand("add", "Add a program to a machine's queue");
  auto options = std::make_shared<JobAddition>();
  auto& request = options->request;
  add_machine(add, request.machine);
  add.add_option("PROGRAM", request.program, "The program").required();
  add.add_option("--revision", request.revision,
                 "This revision; without it the latest that may run when it is started");
  add.add_option("--quantity", request.quantity, "Parts that are wanted; the default is 1");
  add.add_option("--count", request.counts,
                 "Which parts count up to the quantity: made (of completed runs, the default) or "
                 "good (of these, those that were measured good)")
      .check(one_of({"made", "good"}));
  add.add_option("--parts-per-run", request.parts_per_run,
                 "Parts that a run makes (pallets, tombstones); the default is 1");
  add.add_option("--place", request.place, "Place in the queue, 1 is the first; the end without");
  add.add_option("--comment", request.comment, "What the operator should know");
  add_json_flag(add, context);
  add.footer(
      "The program must be one that the machine may run: under a release policy a released one.\n"
      "With --count good a report template must measure the parts: without one none is good, and "
      "the job\nis never done.\n\n"
      "Example:\n  dnc job add mill-3 O0200 --quantity 25 --comment \"steel, fixture 7\"");
  run_at_server(add, context, options, add_job);
}

void add_starting(Command group, Context& context) {
  auto start = group.add_subcommand("start", "Start a run of the next job");
  auto options = std::make_shared<JobStart>();
  add_machine(start, options->machine);
  start.add_option("--job", options->job, "This job instead of the next one");
  add_json_flag(start, context);
  start.footer(
      "It is a start as dnc run start: an attended machine waits for its operator's cycle "
      "start.\n\n"
      "Example:\n  dnc job start mill-3");
  run_at_server(start, context, options, start_job);
}

void add_holding(Command group, Context& context) {
  auto hold = group.add_subcommand("hold", "Hold a queue: it starts nothing until it is released");
  auto options = std::make_shared<JobHoldCommand>();
  add_machine(hold, options->machine);
  hold.add_option("--reason", options->reason, "State why; everybody sees it").required();
  hold.footer(
      "What runs continues.\n\nExample:\n  dnc job hold mill-3 --reason \"bore is 0.03 wide\"");
  run_at_server(hold, context, options, hold_jobs);

  auto release = group.add_subcommand("release", "Release a queue that is held");
  auto freed = std::make_shared<JobHoldCommand>();
  add_machine(release, freed->machine);
  run_at_server(release, context, freed, release_jobs);
}

}  // namespace

void add_job_commands(Command app, Context& context) {
  auto group = app.add_subcommand("job", "The job queues of machines: add, move, start, hold");
  group.require_subcommand(1);

  auto list = group.add_subcommand("list", "List a machine's jobs in their order");
  list.footer(
      "PARTS are those of completed runs, GOOD and UNKNOWN of them by what was measured; REWORK "
      "and "
      "SCRAP\nalso those of runs that did not complete. The one that is counted up to the quantity "
      "is shown with it.");
  auto list_options = std::make_shared<JobQueueCommand>();
  add_machine(list, list_options->machine);
  list.add_flag("--closed", list_options->closed, "List what is done or removed, newest first");
  add_json_flag(list, context);
  run_at_server(list, context, list_options, list_jobs);

  add_adding(group, context);

  auto move = group.add_subcommand("move", "Move a job to another place in the queue");
  auto move_options = std::make_shared<JobChoice>();
  add_machine(move, move_options->machine);
  move.add_option("JOB", move_options->job, "The job's number").required();
  move.add_option("PLACE", move_options->place, "1 is the first").required();
  add_json_flag(move, context);
  run_at_server(move, context, move_options, move_job);

  auto remove = group.add_subcommand("remove", "Remove a job from the queue");
  auto remove_options = std::make_shared<JobChoice>();
  add_machine(remove, remove_options->machine);
  remove.add_option("JOB", remove_options->job, "The job's number").required();
  run_at_server(remove, context, remove_options, remove_job);

  add_starting(group, context);
  add_holding(group, context);
}

}  // namespace dripline::cli
