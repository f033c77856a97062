#include "server/ports/line_runs.hpp"

#include <string>

#include "gateway/line/line_words.hpp"
#include "protocol/dds/record_text.hpp"
#include "protocol/process/log.hpp"
#include "server/library/control_catalog.hpp"
#include "server/machines/control_memory.hpp"
#include "server/machines/identifiers.hpp"
#include "server/machines/machine_control.hpp"
#include "server/ports/programs/program_stream.hpp"
#include "server/ports/programs/start_finder.hpp"

namespace dripline::ports {
namespace {

storage::RunState to_state(SendOutcome outcome) {
  switch (outcome) {
    case SendOutcome::Completed:
      return storage::RunState::Completed;
    case SendOutcome::Aborted:
      return storage::RunState::Aborted;
    case SendOutcome::Interrupted:
      return storage::RunState::Interrupted;
  }
  return storage::RunState::Interrupted;
}

dds::RunOutcome to_outcome(storage::RunState state) {
  if (state == storage::RunState::Completed) return dds::RunOutcome::Completed;
  if (state == storage::RunState::Aborted) return dds::RunOutcome::Aborted;
  return dds::RunOutcome::Interrupted;
}

storage::Counters to_counters(const SendProgress& progress) {
  return {.sent = progress.sent.bytes,
          .accepted = progress.is_checked ? progress.sent.blocks : 0,
          .executed = 0};
}

LineRecords::Entry ending_entry(const storage::RunEnding& ending,
                                std::function<void()> stored = {}) {
  dds::RunEndText text;
  text.outcome = to_outcome(ending.state);
  text.sent = ending.counters.sent;
  text.accepted = ending.counters.accepted;
  text.reason = ending.reason;
  LineRecords::Entry entry;
  entry.record.run = ending.run;
  entry.record.kind = std::string(dds::to_string(dds::RecordKind::RunEnded));
  entry.record.text = dds::encode(text);
  entry.ending = ending;
  entry.on_stored = std::move(stored);
  return entry;
}

}  // namespace

Result<storage::Run> LineRuns::create(const machines::StartRequest& request,
                                      const storage::Machine& machine) {
  const auto admitted = sources_.releases.admit(request.wish());
  if (!admitted) return fail(admitted.error());
  const storage::Revision* const revision = &admitted->revision;
  if (auto fits = library::check_fits(*revision, machine); !fits) return fail(fits.error());
  storage::Run run;
  run.created = clock_.now();
  run.id = machines::make_run_id(run.created);
  run.machine = machine.name;
  run.program = revision->program;
  run.revision = revision->number;
  run.content = revision->content;
  run.size = revision->size;
  run.control = machine.control.empty() ? revision->control : machine.control;
  run.author = request.author;
  run.allowed_as = admitted->allowed_as;
  run.approval = admitted->approval;
  run.job = request.job;
  const auto loaded = store_.setups.loaded(machine.name);
  if (!loaded) return fail(loaded.error());
  if (*loaded) run.setup = (*loaded)->number;
  if (auto fits = machines::check_control_memory(sources_, run); !fits) return fail(fits.error());
  if (auto sound = store_.programs.verify_content(run.content); !sound) return fail(sound.error());
  if (auto created = store_.runs.create(run); !created) return fail(created.error());
  if (!request.before) return run;
  const auto ready = request.before(run);
  if (ready) return run;
  const auto refused =
      store_.runs.set_state(run.id, storage::RunState::Refused, ready.error().what);
  return fail(refused ? ready.error() : refused.error());
}

Result<SendJob> LineRuns::job(const storage::Run& run, const machines::StartRequest& request) {
  if (request.restart) {
    return fail(Errc::Unsupported,
                "machine '{}' is on a serial line: a restart there is a start "
                "with from and head",
                run.machine);
  }
  if (request.from.pass || request.memory != machines::StartMemory::Ask) {
    return fail(Errc::Unsupported,
                "pass and memory: only a gateway executes the skipped part; machine '{}' is on "
                "a serial line, and its control has its own memory",
                run.machine);
  }
  if (request.is_test) {
    return fail(Errc::Unsupported,
                "machine '{}' is on a serial line: only a gateway tests a program (dnc check does "
                "it without a machine)",
                run.machine);
  }
  const auto place = find_start(store_.programs, run, request.from);
  if (!place) return fail(place.error());
  auto head = start_head(store_.programs, run, *place, request.head);
  if (!head) return fail(head.error());
  SendJob job;
  job.head = *std::move(head);
  job.id = run.id;
  job.name = run.program;
  job.source = source_of(ProgramStream::of(run.content, run.size), store_.programs);
  job.size = run.size;
  job.first_byte = place->byte;
  job.first_line = place->line;
  return job;
}

void LineRuns::started(const storage::Run& run, LineRecords& records) {
  LineRecords::Entry entry;
  entry.record.run = run.id;
  entry.record.kind = std::string(dds::to_string(dds::RecordKind::RunStarted));
  entry.record.text = dds::encode(dds::RunStartText{
      .program = run.program, .revision = run.content.hex(), .control = run.control});
  entry.beginning = storage::RunBeginning{.run = run.id, .started = clock_.now()};
  process::log_info("run started over a line machine={} run={} program={} revision={}", run.machine,
                    run.id, run.program, run.revision);
  records.add({std::move(entry)});
}

void LineRuns::refused(const storage::Run& run, const Error& error) {
  process::log_warning("run not started over a line machine={} run={} program={}: {}", run.machine,
                       run.id, run.program, error.what);
  auto set = store_.runs.set_state(run.id, storage::RunState::Refused, error.what);
  if (!set) process::log_error("run={} not marked as refused: {}", run.id, set.error().what);
}

void LineRuns::progressed(const std::string& machine, const SendProgress& progress) {
  // Repeated soon by the next one.
  auto saved = store_.runs.update_counters({machine, progress.id, to_counters(progress), 0, -1});
  if (!saved) {
    process::log_debug("progress not saved run={}: {}", progress.id, saved.error().what);
  }
}

void LineRuns::ended(const SendEnd& end, LineRecords& records, std::function<void()> stored) {
  storage::RunEnding ending;
  ending.run = end.progress.id;
  ending.state = to_state(end.outcome);
  ending.counters = to_counters(end.progress);
  ending.reason =
      end.outcome == SendOutcome::Completed ? std::string(line::kSentToItsEnd) : end.reason;
  ending.ended = clock_.now();
  process::log_info("run ended over a line run={} state={} sent={} accepted={}: {}", ending.run,
                    storage::to_string(ending.state), ending.counters.sent,
                    ending.counters.accepted, ending.reason);
  records.add({ending_entry(ending, std::move(stored))});
}

Result<void> LineRuns::give_up_unfinished(const std::string& machine, LineRecords& records) {
  for (const auto state : {storage::RunState::Ordered, storage::RunState::Active}) {
    const auto runs = store_.runs.list({.machine = machine, .program = {}, .state = state}, {});
    if (!runs) return fail(runs.error());
    for (const auto& run : *runs) {
      storage::RunEnding ending;
      ending.run = run.id;
      ending.state = storage::RunState::Interrupted;
      ending.counters = run.counters;
      ending.reason =
          fmt::format("the server stopped; at least {} bytes were sent, {} blocks accepted",
                      run.counters.sent, run.counters.accepted);
      ending.ended = clock_.now();
      records.add({ending_entry(ending)});
    }
  }
  return {};
}

}  // namespace dripline::ports
