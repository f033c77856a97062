// Deriving a run again.
#include "server/measurements/measurements.hpp"

namespace dripline::measurements {
namespace {

constexpr std::uint64_t kRunPiece = 4000;  ///< records read at a time, of a whole run
constexpr std::uint64_t kArchivePiece = 1000;

/// Archives know machine, journal, numbers and times, not runs: one of the run's time has, or may
/// have, records of it.
bool may_have_records(const storage::Archive& archive, const storage::Run& run) {
  if (archive.kind != storage::ArchiveKind::Records || archive.machine != run.machine) return false;
  const UtcTime begin = run.started.value_or(run.created);
  return archive.last_time >= begin && (!run.ended || archive.first_time <= *run.ended);
}

bool has_record(const storage::Archive& archive, const measurement::RecordKey& record) {
  return archive.epoch == record.epoch && archive.first <= record.number &&
         record.number <= archive.last;
}

}  // namespace

Result<void> Measurements::check_is_whole(const storage::Run& run) {
  // Clocks of gateways may be set: what was measured tells its record, the oldest of which goes
  // first.
  const auto oldest =
      parts_.store.measurements.list({.run = run.id, .with_superseded = true}, {}, 1);
  if (!oldest) return fail(oldest.error());
  for (storage::Page page{.limit = kArchivePiece, .offset = 0};; page.offset += page.limit) {
    const auto archives = parts_.store.archives.list(page);
    if (!archives) return fail(archives.error());
    for (const storage::Archive& archive : *archives) {
      const bool is_of_machine =
          archive.kind == storage::ArchiveKind::Records && archive.machine == run.machine;
      if (may_have_records(archive, run) ||
          (is_of_machine && !oldest->empty() && has_record(archive, oldest->front().record))) {
        return fail(Errc::Conflict,
                    "records of run {} are in the archive {}: what is left would give fewer "
                    "measurements than there are",
                    run.id, archive.file);
      }
    }
    if (archives->size() < page.limit) return {};
  }
}

Result<std::vector<storage::MeasuredPart>> Measurements::derive(
    const std::string& id, const std::optional<std::string>& name,
    std::optional<std::uint64_t> version) {
  const auto run = parts_.store.runs.find(id);
  if (!run) return fail(run.error());
  if (!storage::is_finished(run->state))
    return fail(Errc::Conflict, "run {} has not ended: its report is derived as it comes", id);
  const std::lock_guard lock(derive_mutex_);
  Derivation::Sources from = sources();
  if (name) {
    auto used = cache_.find(*name, version);
    if (!used) return fail(used.error());
    from.templates = [used = *std::move(used)](const std::string&, const std::string&) {
      return Result<std::vector<UsedTemplate>>(std::vector{used});
    };
  }
  const auto next = parts_.store.measurements.next_part_id();
  if (!next) return fail(next.error());
  Derivation derivation(run->machine, {}, std::move(from), *next);
  storage::RecordPlace place;
  storage::Record last;
  for (std::uint64_t count = 0;;) {
    const auto piece = parts_.store.records.of_run_after(id, "", place, kRunPiece);
    if (!piece) return fail(piece.error());
    for (const storage::Record& record : *piece) {
      if (auto taken = derivation.take(record); !taken) return fail(taken.error());
    }
    count += piece->size();
    if (count > kMaxRunRecords) {
      return fail(Errc::LimitExceeded, "run {} has more than {} records", id, kMaxRunRecords);
    }
    if (!piece->empty()) last = piece->back();
    if (piece->size() < kRunPiece) break;
    place = {piece->back().epoch, piece->back().number};
  }
  // Asked after they were read: an archive is listed before its records leave.
  if (auto whole = check_is_whole(*run); !whole) return fail(whole.error());
  if (derivation.state().sessions.empty())
    return fail(Errc::Conflict, "no report template applies to run {}", id);
  if (auto ended = derivation.end_parts(last); !ended) return fail(ended.error());
  if (auto replaced = parts_.store.measurements.replace(id, derivation.batch()); !replaced)
    return fail(replaced.error());
  if (parts_.on_derived) parts_.on_derived(run->machine);
  return derivation.batch().parts;
}

}  // namespace dripline::measurements
