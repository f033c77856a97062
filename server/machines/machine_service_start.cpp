// How a run is started: what is checked before it exists, and what becomes of it.
#include "protocol/process/log.hpp"
#include "server/library/history/test_runs.hpp"
#include "server/machines/control_memory.hpp"
#include "server/machines/identifiers.hpp"
#include "server/machines/machine_service.hpp"
#include "server/machines/start_point.hpp"

namespace dripline::machines {
Result<storage::Run> MachineService::make_run(const StartRequest& request,
                                              const MachineView& view) {
  const auto admitted = sources_.releases.admit(request.wish());
  if (!admitted) return fail(admitted.error());
  const storage::Revision* const revision = &admitted->revision;
  if (!revision->control.empty() && revision->control != view.machine.control) {
    return fail(Errc::Unsupported,
                "program '{}' revision {} is for control {}; machine '{}' is a {}",
                revision->program, revision->number, revision->control, request.machine,
                view.machine.control);
  }
  storage::Run run;
  run.created = clock_.now();
  run.id = make_run_id(run.created);
  run.machine = request.machine;
  run.program = revision->program;
  run.revision = revision->number;
  run.content = revision->content;
  run.size = revision->size;
  run.control = view.machine.control;
  run.author = request.author;
  run.allowed_as = admitted->allowed_as;
  run.approval = admitted->approval;
  run.job = request.job;
  run.is_test = request.is_test || is_testing(view);
  return run;
}

/// The machine's newest setup, or which one is in a control at the end of a line; none when the
/// server keeps none for it, or does not know.
Result<std::optional<storage::SetupRevision>> MachineService::setup_of(const MachineView& view) {
  std::optional<std::uint64_t> number;
  if (view.has_gateway_line()) {
    const auto loaded = store_.setups.loaded(view.machine.name);
    if (!loaded) return fail(loaded.error());
    if (!*loaded || !(*loaded)->number) return std::optional<storage::SetupRevision>{};
    number = (*loaded)->number;
  }
  auto setup = store_.setups.find(view.machine.name, number);
  if (setup) return std::optional(*std::move(setup));
  if (setup.error().code == Errc::NotFound) return std::optional<storage::SetupRevision>{};
  return fail(setup.error());
}

/// What the gateway cannot see: a newer revision or setup on the server is not silently passed
/// over.
Result<void> MachineService::check_restart(const StartRequest& request, const storage::Run& run) {
  if (!request.restart) return {};
  const auto original = store_.runs.find(request.restart->run);
  if (!original) return fail(original.error());
  if (library::is_test_run(*original))
    return fail(Errc::Conflict, "run {} was a test run: nothing of it was executed", original->id);
  const std::string_view state = storage::to_string(original->state);
  const bool was_cut_off = original->state == storage::RunState::Aborted ||
                           original->state == storage::RunState::Alarmed ||
                           original->state == storage::RunState::Interrupted;
  if (!was_cut_off)
    return fail(Errc::Conflict, "run {} was not cut off: it is {}", original->id, state);
  auto newest = request.wish();
  newest.revision.reset();
  const auto latest = sources_.releases.admit(newest);
  if (!latest) return fail(latest.error());
  if (latest->revision.number != original->revision) {
    return fail(Errc::Conflict,
                "program '{}' has revision {} since run {}, which is of revision {}: start it with "
                "--from, or make the old content the latest again",
                run.program, latest->revision.number, original->id, original->revision);
  }
  if (run.setup == original->setup) return {};
  const auto text = [](const std::optional<std::uint64_t>& number) {
    return number ? fmt::format("version {}", *number) : std::string("none");
  };
  return fail(Errc::Conflict, "the setup of machine '{}' is {}, run {} had {}", run.machine,
              text(run.setup), original->id, text(original->setup));
}

/// A control at the end of a line executes what it gets, and so does one that is not known to be at
/// none.
Result<void> MachineService::check_test(const StartRequest& request, const MachineView& view) {
  if (!request.is_test) return {};
  if (!view.status)
    return fail(Errc::Timeout, "machine '{}' has not reported its status yet", request.machine);
  if (!view.has_gateway_line()) return {};
  return fail(Errc::Unsupported,
              "machine '{}' is a control at the end of its gateway's line, and would execute the "
              "program: it has no test run (dnc check looks through a program without a machine)",
              request.machine);
}

Result<storage::Run> MachineService::start(const StartRequest& request) {
  Parts* parts = this->parts();
  if (parts == nullptr) return fail(Errc::Io, "the server is stopping");
  const SteadyTime given = request.given.value_or(clock_.steady_now());
  const auto view = machine_for_work(request.machine);
  if (!view) return fail(view.error());
  if (auto fits = check_test(request, *view); !fits) return fail(fits.error());
  auto run = make_run(request, *view);
  if (!run) return run;
  if (auto fits = check_control_memory(sources_, *run); !fits) return fail(fits.error());
  // No run begins that could not continue: the list of its chunks is checked before.
  if (auto sound = store_.programs.verify_content(run->content); !sound) {
    return fail(sound.error().code, "program '{}' revision {}: {}", run->program, run->revision,
                sound.error().what);
  }
  const auto setup = setup_of(*view);
  if (!setup) return fail(setup.error());
  if (*setup) run->setup = (*setup)->number;
  if (auto same = check_restart(request, *run); !same) return fail(same.error());
  if (auto created = store_.runs.create(*run); !created) return fail(created.error());
  parts->reconciler.watch(run->machine, run->id);
  announce_run(run->id);
  if (request.before) {
    if (auto ready = request.before(*run); !ready)
      return conclude_start(*run, fail(Errc::Busy, "{}", ready.error().what));
  }
  if (const auto waited = clock_.steady_now() - given; waited > StopOrder::kMaxWait) {
    return conclude_start(
        *run, fail(Errc::Busy,
                   "storing the start took {} s, {} are allowed: it was not sent to the machine",
                   std::chrono::duration_cast<std::chrono::seconds>(waited).count(),
                   StopOrder::kMaxWait.count()));
  }
  dds::Command command;
  command.machine = run->machine;
  command.session = view->session;  // whose switches were there when the start was asked for
  command.action = dds::CommandAction::Start;
  command.run = run->id;
  command.program = run->program;
  command.revision = run->content.hex();
  command.size = run->size;
  command.control = run->control;
  command.argument = start_argument(request);
  if (*setup) command.setup = (*setup)->text;
  const auto result = parts->commands.result_of(std::move(command), {.given = given});
  if (result && request.on_notice && !result->reason.empty()) request.on_notice(result->reason);
  return conclude_start(*run, result ? Result<void>() : fail(result.error()));
}

Result<storage::Run> MachineService::conclude_start(const storage::Run& run,
                                                    const Result<void>& outcome) {
  if (outcome) {
    process::log_info("run started machine={} run={} program={} revision={}", run.machine, run.id,
                      run.program, run.revision);
    return owned_parts_->reconciler.resolve_ordered(run.id, storage::RunState::Active, "");
  }
  process::log_warning("run not started machine={} run={} program={}: {}", run.machine, run.id,
                       run.program, outcome.error().what);
  // The server stops before the outcome is known: the next one determines it.
  const bool is_unknown =
      outcome.error().code == Errc::Timeout && owned_parts_->commands.is_stopping();
  if (is_unknown || outcome.error().code == Errc::Io) return fail(outcome.error());
  const auto refused = owned_parts_->reconciler.resolve_ordered(run.id, storage::RunState::Refused,
                                                                outcome.error().what);
  if (!refused) return fail(refused.error());
  if (refused->state != storage::RunState::Refused) return refused;
  owned_parts_->reconciler.drop(run.id);
  return fail(outcome.error());
}

}  // namespace dripline::machines
