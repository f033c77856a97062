#include "server/machines/run_ending.hpp"

#include <algorithm>

#include "protocol/dds/record_text.hpp"
#include "protocol/process/log.hpp"

namespace dripline::machines {
namespace {

storage::RunState to_state(dds::RunOutcome outcome) {
  switch (outcome) {
    case dds::RunOutcome::Completed:
      return storage::RunState::Completed;
    case dds::RunOutcome::Aborted:
      return storage::RunState::Aborted;
    case dds::RunOutcome::Alarmed:
      return storage::RunState::Alarmed;
    case dds::RunOutcome::Tested:
      return storage::RunState::Tested;
    case dds::RunOutcome::Interrupted:
      return storage::RunState::Interrupted;
  }
  return storage::RunState::Interrupted;
}

/// The SHA-256 of the first `length` bytes of stored content. Errors: LimitExceeded (it is
/// shorter), NotFound, Corrupt.
Result<Digest> prefix_digest(storage::ProgramStore& store, const storage::Run& run,
                             std::uint64_t length) {
  if (length > run.size) {
    return fail(Errc::LimitExceeded, "the gateway reports {} bytes of a program of {}", length,
                run.size);
  }
  if (length == run.size) return run.content;
  constexpr std::uint64_t kPiece = 1024 * 1024;
  Sha256 hash;
  for (std::uint64_t offset = 0; offset < length;) {
    const auto bytes =
        store.read_content(run.content, offset, std::min<std::uint64_t>(kPiece, length - offset));
    if (!bytes) return fail(bytes.error());
    if (bytes->empty()) return fail(Errc::Corrupt, "content {} is short", run.content.hex());
    hash.update(*bytes);
    offset += bytes->size();
  }
  return hash.digest();
}

/// nullopt when there is nothing to compare.
std::optional<bool> verify(const storage::Store& store, const dds::Record& record,
                           const dds::RunEndText& text) {
  if (text.content_sha256.empty()) return std::nullopt;
  const auto run = store.runs.find(record.run);
  if (!run) return std::nullopt;
  const auto ours = prefix_digest(store.programs, *run, text.content_length);
  // When the stored bytes cannot be read, nothing is known of the machine's.
  if (!ours && ours.error().code != Errc::LimitExceeded) {
    process::log_error("executed bytes not compared machine={} run={} program={}: {}",
                       record.machine, record.run, run->program, ours.error().what);
    return std::nullopt;
  }
  const bool is_same = ours && ours->hex() == text.content_sha256;
  if (!is_same) {
    process::log_error(
        "the machine did not execute the revision's bytes machine={} run={} program={}: {}",
        record.machine, record.run, run->program, ours ? "the digests differ" : ours.error().what);
  }
  return is_same;
}

}  // namespace

Result<storage::RunEnding> read_run_ending(const storage::Store& store, const dds::Record& record) {
  const auto text = dds::decode_run_end(record.text);
  if (!text) return fail(text.error());
  storage::RunEnding ending;
  ending.run = record.run;
  ending.state = to_state(text->outcome);
  ending.counters = {.sent = text->sent, .accepted = text->accepted, .executed = text->executed};
  ending.line = text->line;
  ending.sequence = text->sequence;
  ending.reason = text->reason;
  if (!text->content_sha256.empty()) ending.executed_content = text->content_sha256;
  ending.content_verified = verify(store, record, *text);
  if (text->motion_seconds && text->path_mm)
    ending.statistics = storage::RunStatistics{*text->motion_seconds, *text->path_mm};
  ending.ended = record.time;
  return ending;
}

}  // namespace dripline::machines
