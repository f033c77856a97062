#include "server/ports/line_transfer.hpp"

#include <fmt/ranges.h>
#include <algorithm>
#include <future>

#include "gateway/line/inbound/program_head.hpp"
#include "gateway/line/port_transfer.hpp"
#include "protocol/base/random.hpp"
#include "protocol/process/log.hpp"
#include "server/library/control_catalog.hpp"
#include "server/ports/line_runs.hpp"
#include "server/ports/port_settings.hpp"
#include "server/ports/programs/program_stream.hpp"

namespace dripline::ports {

using library::Refusal;
using library::with_control_words;
using line::has_numbered_programs;

namespace {

/// The text that is fetched ahead of a line may leave it before a kill: it is not much.
constexpr double kFetchedSeconds = 5;
constexpr std::uint64_t kLeastFetched = 2048;

std::uint64_t fetched_ahead(const wire::LineSettings& settings) {
  const double wanted = wire::characters_per_second(settings) * kFetchedSeconds;
  return std::clamp<std::uint64_t>(static_cast<std::uint64_t>(wanted), kLeastFetched,
                                   LineSession::kPrefetch);
}

/// On the line's strand. The store has it before anything leaves.
void begin_transfer(const LineInUse& in_use, SendJob job, const std::function<bool()>& is_late,
                    const PortLine::Answer& answer) {
  if (auto ready = line::check_ready(*in_use.line); !ready) return answer(ready);
  const LineView port = in_use.line->view();
  if (auto ready = in_use.resets.check(port, port.names.name); !ready) return answer(ready);
  if (auto kept = in_use.log->begin_send(job); !kept) return answer(kept);
  if (is_late()) {
    in_use.log->take_back_send(job.id);
    return answer(fail(Errc::Busy, "port {}: storing {} took longer than {} s: nothing was sent",
                       port.names.name, job.id, kTransferAnswerLimit.count()));
  }
  auto begun = [log = in_use.log, id = job.id, answer](const Result<void>& result) {
    if (!result) log->take_back_send(id);
    answer(result);
  };
  in_use.line->begin(std::move(job), std::move(begun));
}

void begin_reception(const LineInUse& in_use, const PortLine::Answer& answer) {
  const auto& [line, log, resets] = in_use;
  const bool can_ask =
      line->view().settings.flow == wire::Flow::Xmodem && line::check_ready(*line).has_value();
  const bool is_new = can_ask && !log->is_receiving();
  if (is_new) {
    if (auto kept = log->begin_reception(); !kept) return answer(kept);
  }
  line::receive_program(*line, [log = log, is_new, answer](const Result<void>& begun) {
    if (is_new && !begun)
      log->end_reception(storage::TransferState::Aborted, "", begun.error().what);
    answer(begun);
  });
}

using Ask = std::function<void(PortLine::Answer)>;

/// The promise lives here too: an answer that comes too late has where to go, and one that never
/// comes is a timeout.
Result<void> ask_line(const PortLine& line, const Ask& ask) {
  const auto promise = std::make_shared<std::promise<Result<void>>>();
  auto answer = promise->get_future();
  ask([promise](const Result<void>& result) { promise->set_value(result); });
  if (answer.wait_for(kTransferAnswerLimit) == std::future_status::ready) return answer.get();
  return fail(Errc::Timeout, "port {}: the line did not answer within {} s; the outcome is unknown",
              line.names().name, kTransferAnswerLimit.count());
}

/// On the line's strand, so that what was posted there before is done.
Result<void> ask_on_strand(const std::shared_ptr<PortLine>& line, const Ask& ask) {
  return ask_line(*line, [line, ask](const PortLine::Answer& answer) {
    line->post([ask, answer] { ask(answer); });
  });
}

/// What of the library is meant. Errors: as PortControl::send.
Result<std::vector<storage::Revision>> chosen(library::Releases& releases, const LineView& port,
                                              const storage::Machine& machine,
                                              const std::vector<ProgramChoice>& programs) {
  std::vector<storage::Revision> revisions;
  for (const auto& choice : programs) {
    // Who starts it at the control, and when, is not known: nothing is proved out so.
    auto admitted = releases.admit(
        {.machine = port.names.machine, .program = choice.program, .revision = choice.revision});
    if (!admitted) {
      return fail(with_control_words(
          admitted.error(), machine.control,
          admitted.error().code == Errc::NotFound ? Refusal::NoSuchProgram : Refusal::None));
    }
    auto& revision = admitted->revision;
    if (revision.is_held) {
      return fail(Errc::Conflict, "program '{}' revision {} waits for acceptance", revision.program,
                  revision.number);
    }
    if (auto fits = library::check_fits(revision, machine); !fits) return fail(fits.error());
    revisions.push_back(std::move(revision));
  }
  return revisions;
}

Result<void> check_count(const LineView& port, const storage::Machine& machine, std::size_t count) {
  if (count == 0) {
    return fail(with_control_words({Errc::Syntax, "no program is named"}, machine.control,
                                   Refusal::NothingToSelect));
  }
  if (count > kMaxTransferPrograms) {
    return fail(Errc::LimitExceeded, "{} programs: at most {} in one transfer", count,
                kMaxTransferPrograms);
  }
  if (count == 1 || !has_numbered_programs(port.settings.flow)) return {};
  return fail(Errc::Unsupported,
              "{} programs: the protocol of port {} names the one program of a transfer; send them "
              "one by one",
              count, port.names.name);
}

/// The limit of the control's memory, where the port sets it. Errors: LimitExceeded.
Result<void> check_memory(const LineView& port, const storage::Machine& machine,
                          std::uint64_t size) {
  const std::uint64_t memory = port.settings.program_memory;
  if (memory == 0 || size <= memory) return {};
  Error error{Errc::LimitExceeded,
              fmt::format("{} bytes are more than the {} of the control's memory (program_memory "
                          "of port {})",
                          size, memory, port.names.name)};
  return fail(with_control_words(std::move(error), machine.control, Refusal::MemoryFull));
}

/// Why several programs cannot be one text, in the control's words.
Error stream_error(const Error& error, const storage::Machine& machine) {
  const bool is_number = error.code == Errc::Syntax;
  return with_control_words(error, machine.control,
                            is_number ? Refusal::BadNumber : Refusal::NotLoaded);
}

Result<SendJob> job_of(storage::ProgramStore& store, const LineView& port,
                       const storage::Machine& machine,
                       const std::vector<storage::Revision>& revisions) {
  const auto& first = revisions.front();
  auto stream = revisions.size() == 1
                    ? Result<ProgramStream>(ProgramStream::of(first.content, first.size))
                    : ProgramStream::of(store, revisions);
  if (!stream) return fail(stream_error(stream.error(), machine));
  if (auto fits = check_memory(port, machine, stream->size()); !fits) return fail(fits.error());
  SendJob job;
  job.kind = JobKind::Transfer;
  job.id = fmt::format("transfer-{}", random_hex(4));
  job.name = has_numbered_programs(port.settings.flow) ? line::program_number(first.program)
                                                       : first.program;
  for (const auto& revision : revisions) {
    job.programs.push_back(fmt::format("{} revision {}", revision.program, revision.number));
  }
  job.size = stream->size();
  job.source = source_of(*std::move(stream), store);
  return job;
}

}  // namespace

Result<SendJob> make_transfer(const machines::RunSources& sources, const LineView& port,
                              const std::vector<ProgramChoice>& programs) {
  const storage::Store& store = sources.store;
  storage::Machine machine;
  if (auto known = store.machines.find(port.names.machine)) machine = *std::move(known);
  if (auto good = check_count(port, machine, programs.size()); !good) return fail(good.error());
  if (auto fits = check_protocol(store.setups, port.names.machine, port.settings.flow); !fits) {
    return fail(fits.error());
  }
  const auto revisions = chosen(sources.releases, port, machine, programs);
  if (!revisions) return fail(revisions.error());
  return job_of(store.programs, port, machine, *revisions);
}

Result<PortTransfer> send_programs(const LineInUse& in_use, const machines::RunSources& sources,
                                   const std::vector<ProgramChoice>& programs) {
  const auto& line = in_use.line;
  // Its sender has got "the outcome is unknown" then.
  const auto is_late = [&clock = sources.clock, asked = sources.clock.steady_now()] {
    return clock.steady_now() - asked > kTransferAnswerLimit;
  };
  auto job = make_transfer(sources, line->view(), programs);
  if (!job) return fail(job.error());
  job->prefetch = fetched_ahead(line->view().settings);
  job->source = guarded(job->source, in_use.log, job->id);
  const auto begun =
      ask_on_strand(line, [in_use, job = *job, is_late](const PortLine::Answer& answer) {
        begin_transfer(in_use, job, is_late, answer);
      });
  if (!begun) return fail(begun.error());
  process::log_info("programs sent without a run port={} id={} {}", line->names().name, job->id,
                    fmt::join(job->programs, ", "));
  return PortTransfer{.id = job->id, .programs = job->programs, .size = job->size};
}

Result<void> receive_program(const LineInUse& in_use) {
  return ask_on_strand(
      in_use.line, [in_use](const PortLine::Answer& answer) { begin_reception(in_use, answer); });
}

Result<void> stop_transfer(const std::shared_ptr<PortLine>& line, const std::string& reason) {
  // Not on the strand, which may wait for the store.
  return ask_line(*line, [line, reason](const PortLine::Answer& answer) {
    line::stop_transfer(*line, reason, answer);
  });
}

}  // namespace dripline::ports
