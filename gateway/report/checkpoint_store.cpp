#include "gateway/report/checkpoint_store.hpp"

#include <span>
#include <utility>

namespace dripline::report {

namespace sqlite = storage::sqlite;

namespace {

constexpr std::size_t kMaxStaged = 24;  ///< checkpoints of one run that wait for a full disk

std::span<const std::byte> bytes_of(const Bytes& bytes) {
  return {bytes.data(), bytes.size()};
}

Bytes blob_of(const sqlite::Statement& row, int column) {
  const auto blob = row.blob(column);
  return {blob.begin(), blob.end()};
}

Result<std::vector<CheckpointSize>> sizes_of(sqlite::Database& database, const std::string& run) {
  auto query =
      database.prepare("SELECT block, length(bytes) FROM checkpoint WHERE run = ?1 ORDER BY block");
  if (!query) return fail(query.error());
  query->bind(run);
  std::vector<CheckpointSize> sizes;
  for (;;) {
    const auto row = query->step();
    if (!row) return fail(row.error());
    if (!*row) return sizes;
    sizes.push_back({query->number(0), static_cast<std::size_t>(query->number(1))});
  }
}

/// Drops what is beyond the limits of one run.
Result<void> thin(sqlite::Database& database, const std::string& run) {
  auto sizes = sizes_of(database, run);
  if (!sizes) return fail(sizes.error());
  const auto dropped = checkpoints_to_drop(*std::move(sizes), CheckpointStore::kMaxCheckpoints,
                                           CheckpointStore::kMaxCheckpointBytes);
  if (dropped.empty()) return {};
  auto drop = database.prepare("DELETE FROM checkpoint WHERE run = ?1 AND block = ?2");
  if (!drop) return fail(drop.error());
  for (const std::uint64_t block : dropped) {
    if (auto done = drop->bind(run, block).run(); !done) return done;
  }
  return {};
}

}  // namespace

std::vector<std::uint64_t> checkpoints_to_drop(std::vector<CheckpointSize> kept,
                                               std::size_t max_count, std::size_t max_bytes) {
  std::vector<std::uint64_t> dropped;
  std::size_t bytes = 0;
  for (const CheckpointSize& one : kept) bytes += one.bytes;
  while (kept.size() > 2 && (kept.size() > max_count || bytes > max_bytes)) {
    std::size_t least = 1;
    // A gap counts by its distance from the end: what was executed last is asked for most.
    double least_cost = 0;
    for (std::size_t i = 1; i + 1 < kept.size(); ++i) {
      const double gap = static_cast<double>(kept[i + 1].block - kept[i - 1].block);
      const double distance = static_cast<double>(kept.back().block - kept[i - 1].block);
      const double cost = gap / distance;
      if (i == 1 || cost < least_cost) {
        least = i;
        least_cost = cost;
      }
    }
    bytes -= kept[least].bytes;
    dropped.push_back(kept[least].block);
    kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(least));
  }
  return dropped;
}

void CheckpointStore::stage(const std::string& run, StoredCheckpoint checkpoint, bool is_awaited) {
  is_awaited_ |= is_awaited;
  if (staged_.size() >= kMaxStaged) staged_.erase(staged_.begin() + 1);
  staged_.push_back({run, std::move(checkpoint)});
}

void CheckpointStore::stage_answer(const std::string& run, std::uint64_t number, Bytes answer) {
  staged_answers_.push_back({run, {number, std::move(answer)}});
}

void CheckpointStore::discard() {
  staged_run_.reset();
  staged_.clear();
  staged_answers_.clear();
  staged_conditions_.reset();
  staged_ending_.reset();
  is_awaited_ = false;
}

void CheckpointStore::drop_checkpoints() {
  if (!is_awaited_) staged_.clear();
}

Result<void> CheckpointStore::write(sqlite::Database& database) const {
  if (!is_staged()) return {};
  if (auto done = write_run(database); !done) return done;
  if (auto done = write_checkpoints(database); !done) return done;
  if (auto done = write_answers(database); !done) return done;
  if (staged_conditions_) {
    auto update = database.prepare("UPDATE checkpoint_run SET conditions = ?2 WHERE run = ?1");
    if (!update) return fail(update.error());
    const auto done =
        update->bind(staged_conditions_->run, bytes_of(staged_conditions_->bytes)).run();
    if (!done) return done;
  }
  if (!staged_ending_) return {};
  auto update = database.prepare("UPDATE checkpoint_run SET ending = ?2 WHERE run = ?1");
  if (!update) return fail(update.error());
  return update->bind(staged_ending_->run, bytes_of(staged_ending_->bytes)).run();
}

Result<void> CheckpointStore::write_run(sqlite::Database& database) const {
  if (!staged_run_) return {};
  if (!staged_run_->restart_of.empty()) {
    auto touch = database.prepare(
        "UPDATE checkpoint_run SET position = (SELECT max(position) + 1 FROM checkpoint_run) "
        "WHERE run = ?1");
    if (!touch) return fail(touch.error());
    if (auto done = touch->bind(staged_run_->restart_of).run(); !done) return done;
  }
  auto insert = database.prepare(
      "INSERT INTO checkpoint_run (run, program, revision, control, size, conditions, ending) "
      "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7)");
  if (!insert) return fail(insert.error());
  const ActiveRun& run = staged_run_->run;
  const auto done = insert
                        ->bind(run.run, run.program, run.revision, run.control, run.size,
                               bytes_of(staged_run_->conditions), bytes_of(staged_run_->ending))
                        .run();
  if (!done) return done;
  auto drop = database.prepare(
      "DELETE FROM checkpoint_run WHERE position NOT IN "
      "(SELECT position FROM checkpoint_run ORDER BY position DESC LIMIT ?1)");
  if (!drop) return fail(drop.error());
  return drop->bind(kKeptRuns).run();
}

Result<void> CheckpointStore::write_checkpoints(sqlite::Database& database) const {
  if (staged_.empty()) return {};
  // A run that is not kept, of a gateway that was restored from a copy, keeps none.
  auto insert = database.prepare(
      "INSERT OR REPLACE INTO checkpoint SELECT ?1, ?2, ?3, ?4, ?5 WHERE EXISTS "
      "(SELECT 1 FROM checkpoint_run WHERE run = ?1)");
  if (!insert) return fail(insert.error());
  for (const OfRun& one : staged_) {
    const StoredCheckpoint& kept = one.checkpoint;
    insert->bind(one.run, kept.block, kept.executed, kept.time, bytes_of(kept.bytes));
    if (auto done = insert->run(); !done) return done;
  }
  return thin(database, staged_.back().run);
}

Result<void> CheckpointStore::write_answers(sqlite::Database& database) const {
  if (staged_answers_.empty()) return {};
  auto insert = database.prepare(
      "INSERT OR REPLACE INTO checkpoint_answer SELECT ?1, ?2, ?3 WHERE EXISTS "
      "(SELECT 1 FROM checkpoint_run WHERE run = ?1)");
  if (!insert) return fail(insert.error());
  for (const AnswerOfRun& one : staged_answers_) {
    const auto done = insert->bind(one.run, one.answer.number, bytes_of(one.answer.bytes)).run();
    if (!done) return done;
  }
  const AnswerOfRun& last = staged_answers_.back();
  if (last.answer.number <= kMaxAnswers) return {};
  auto drop = database.prepare("DELETE FROM checkpoint_answer WHERE run = ?1 AND number <= ?2");
  if (!drop) return fail(drop.error());
  return drop->bind(last.run, last.answer.number - kMaxAnswers).run();
}

Result<StoredRun> CheckpointStore::find(sqlite::Database& database, const std::string& run) {
  auto query = database.prepare(
      "SELECT program, revision, control, size, conditions, ending FROM checkpoint_run "
      "WHERE run = ?1");
  if (!query) return fail(query.error());
  const auto row = query->bind(run).step();
  if (!row) return fail(row.error());
  if (!*row) return fail(Errc::NotFound, "no checkpoints of run {} are kept", run);
  return StoredRun{{run, query->text(0), query->text(1), query->text(2), query->number(3)},
                   blob_of(*query, 4),
                   blob_of(*query, 5),
                   {}};
}

Result<std::vector<StoredCheckpoint>> CheckpointStore::list(sqlite::Database& database,
                                                            const std::string& run) {
  auto query = database.prepare(
      "SELECT block, executed, time_us FROM checkpoint WHERE run = ?1 ORDER BY block");
  if (!query) return fail(query.error());
  query->bind(run);
  std::vector<StoredCheckpoint> found;
  for (;;) {
    const auto row = query->step();
    if (!row) return fail(row.error());
    if (!*row) return found;
    found.push_back({query->number(0), query->number(1), query->time(2), {}});
  }
}

Result<StoredCheckpoint> CheckpointStore::read(sqlite::Database& database, const std::string& run,
                                               std::uint64_t block) {
  auto query = database.prepare(
      "SELECT executed, time_us, bytes FROM checkpoint WHERE run = ?1 AND block = ?2");
  if (!query) return fail(query.error());
  const auto row = query->bind(run, block).step();
  if (!row) return fail(row.error());
  if (!*row) return fail(Errc::NotFound, "no checkpoint of run {} at block {}", run, block);
  return StoredCheckpoint{block, query->number(0), query->time(1), blob_of(*query, 2)};
}

Result<std::vector<CheckpointStore::Answer>> CheckpointStore::answers(sqlite::Database& database,
                                                                      const std::string& run,
                                                                      std::uint64_t number) {
  auto query = database.prepare(
      "SELECT number, bytes FROM checkpoint_answer WHERE run = ?1 AND number > ?2 ORDER BY number");
  if (!query) return fail(query.error());
  query->bind(run, number);
  std::vector<Answer> found;
  for (;;) {
    const auto row = query->step();
    if (!row) return fail(row.error());
    if (!*row) return found;
    found.push_back({query->number(0), blob_of(*query, 1)});
  }
}

}  // namespace dripline::report
