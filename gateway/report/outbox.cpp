#include "gateway/report/outbox.hpp"

#include <algorithm>
#include <utility>

#include "gateway/report/outbox_schema.hpp"
#include "protocol/base/random.hpp"
#include "storage/sqlite/transaction.hpp"

namespace dripline::report {

namespace sqlite = storage::sqlite;

namespace {

/// Both ends store signed numbers: 62 bits leave room for all epochs that follow.
std::uint64_t first_epoch() {
  return (random_number() >> 2) + 1;
}

/// Greater, because the records of a run are read in the order of their epochs; at random, because
/// a copy of this outbox may have to begin a new one too.
std::uint64_t epoch_after(std::uint64_t epoch) {
  return epoch + 1 + (random_number() >> 32);
}

}  // namespace

Result<Outbox> Outbox::open(const std::filesystem::path& file, const OutboxOptions& options) {
  auto database = sqlite::Database::open(
      file, {.synchronous = sqlite::Synchronous::Full, .max_bytes = options.max_bytes});
  if (!database) return fail(database.error());
  if (const auto done = sqlite::migrate(*database, kOutboxMigrations); !done)
    return fail(done.error());
  Outbox outbox(std::move(*database));
  if (const auto done = outbox.load(); !done) return fail(done.error());
  return outbox;
}

Result<void> Outbox::load() {
  {
    auto query = database_.prepare(
        "SELECT epoch, last_number, (SELECT min(number) FROM record) FROM outbox");
    if (!query) return fail(query.error());
    const auto row = query->step();
    if (!row) return fail(row.error());
    if (*row) {
      epoch_ = query->number(0);
      last_number_ = query->number(1);
      acknowledged_ = query->is_null(2) ? last_number_ : query->number(2) - 1;
      deleted_ = acknowledged_;
    }
  }
  if (epoch_ == 0) return create();
  return load_run();
}

Result<void> Outbox::create() {
  epoch_ = first_epoch();
  auto insert = database_.prepare("INSERT INTO outbox VALUES (1, ?1, 0)");
  if (!insert) return fail(insert.error());
  return insert->bind(epoch_).run();
}

Result<void> Outbox::load_run() {
  auto query = database_.prepare(
      "SELECT run, program, revision, control, size, sent, accepted, executed, line, sequence, "
      "offset, path FROM active_run");
  if (!query) return fail(query.error());
  const auto row = query->step();
  if (!row) return fail(row.error());
  if (!*row) return memory_.load(database_);
  committed_run_ =
      ActiveRun{query->text(0), query->text(1), query->text(2), query->text(3), query->number(4)};
  committed_progress_ = {query->number(5),  query->number(6),  query->number(7), query->number(8),
                         query->integer(9), query->number(10), query->number(11)};
  progress_ = committed_progress_;
  return memory_.load(database_);
}

void Outbox::append(dds::Record record) {
  record.epoch = epoch_;
  record.number = last_number_ + staged_.size() + 1;
  staged_.push_back(std::move(record));
}

void Outbox::begin_run(const ActiveRun& run) {
  run_change_ = RunChange::Begins;
  staged_run_ = run;
  progress_ = {};
}

void Outbox::end_run() {
  run_change_ = RunChange::Ends;
}

void Outbox::add_command_result(const std::string& id, bool is_accepted,
                                const std::string& reason) {
  staged_results_.push_back({id, {is_accepted, reason}});
}

void Outbox::discard() {
  run_change_ = RunChange::None;
  staged_.clear();
  staged_results_.clear();
  memory_.discard();
  checkpoints_.discard();
}

Result<void> Outbox::commit() {
  const bool has_change = !staged_.empty() || !staged_results_.empty() || memory_.is_staged() ||
                          checkpoints_.is_staged() || run_change_ != RunChange::None;
  if (!has_change) return {};
  auto transaction = sqlite::Transaction::begin(database_);
  if (!transaction) return fail(transaction.error());
  if (const auto done = write_all(); !done) return fail(done.error());
  if (const auto done = transaction->commit(); !done) return fail(done.error());

  last_number_ += staged_.size();
  deleted_ = acknowledged_;
  if (run_change_ == RunChange::Begins) committed_run_ = staged_run_;
  if (run_change_ == RunChange::Ends) committed_run_.reset();
  run_change_ = RunChange::None;
  committed_progress_ = progress_;
  staged_.clear();
  staged_results_.clear();
  memory_.apply();
  checkpoints_.discard();
  return {};
}

Result<void> Outbox::write_all() {
  if (const auto done = write_records(); !done) return done;
  if (const auto done = write_run(); !done) return done;
  if (const auto done = write_command_results(); !done) return done;
  if (const auto done = memory_.write(database_); !done) return done;
  if (const auto done = checkpoints_.write(database_); !done) return done;
  return delete_acknowledged();
}

Result<void> Outbox::write_records() {
  if (staged_.empty()) return {};
  auto insert = database_.prepare("INSERT INTO record VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)");
  if (!insert) return fail(insert.error());
  for (const dds::Record& record : staged_) {
    insert->bind(record.number, record.time, record.run, static_cast<std::uint32_t>(record.kind),
                 record.block, record.line, record.sequence, record.device, record.text);
    if (const auto done = insert->run(); !done) return done;
  }
  auto update = database_.prepare("UPDATE outbox SET last_number = ?1");
  if (!update) return fail(update.error());
  return update->bind(last_number_ + staged_.size()).run();
}

Result<void> Outbox::write_run() {
  if (run_change_ == RunChange::Ends) return database_.execute("DELETE FROM active_run");
  const bool begins = run_change_ == RunChange::Begins;
  if (!begins && !committed_run_) return {};
  const ActiveRun& run = begins ? staged_run_ : *committed_run_;
  auto replace = database_.prepare(
      "INSERT OR REPLACE INTO active_run VALUES (1, ?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, "
      "?12)");
  if (!replace) return fail(replace.error());
  replace->bind(run.run, run.program, run.revision, run.control, run.size, progress_.sent,
                progress_.accepted, progress_.executed, progress_.line, progress_.sequence,
                progress_.offset, progress_.path);
  return replace->run();
}

Result<void> Outbox::write_command_results() {
  if (staged_results_.empty()) return {};
  auto insert = database_.prepare(
      "INSERT OR IGNORE INTO command_result (id, is_accepted, reason) VALUES (?1, ?2, ?3)");
  if (!insert) return fail(insert.error());
  for (const StagedResult& result : staged_results_) {
    insert->bind(result.id, result.answer.is_accepted ? 1 : 0, result.answer.reason);
    if (const auto done = insert->run(); !done) return done;
  }
  auto drop = database_.prepare(
      "DELETE FROM command_result WHERE position <= (SELECT max(position) FROM command_result) - "
      "?1");
  if (!drop) return fail(drop.error());
  return drop->bind(kKeptCommandResults).run();
}

Result<void> Outbox::delete_acknowledged() {
  if (deleted_ == acknowledged_) return {};
  auto drop = database_.prepare("DELETE FROM record WHERE number <= ?1");
  if (!drop) return fail(drop.error());
  return drop->bind(acknowledged_).run();
}

Result<std::optional<Outbox::Answer>> Outbox::command_result(const std::string& id) {
  for (const StagedResult& staged : staged_results_) {
    if (staged.id == id) return std::optional(staged.answer);
  }
  auto query = database_.prepare("SELECT is_accepted, reason FROM command_result WHERE id = ?1");
  if (!query) return fail(query.error());
  const auto row = query->bind(id).step();
  if (!row) return fail(row.error());
  if (!*row) return std::optional<Answer>();
  return std::optional(Answer{query->integer(0) != 0, query->text(1)});
}

Result<std::vector<dds::Record>> Outbox::read(const std::string& machine, std::uint64_t number,
                                              std::size_t limit) {
  auto query = database_.prepare(
      "SELECT number, time_us, run, kind, block, line, sequence, device, text FROM record "
      "WHERE number > ?1 ORDER BY number LIMIT ?2");
  if (!query) return fail(query.error());
  query->bind(number, limit);
  std::vector<dds::Record> records;
  for (;;) {
    const auto row = query->step();
    if (!row) return fail(row.error());
    if (!*row) return records;
    records.push_back({machine, epoch_, query->number(0), query->time(1), query->text(2),
                       static_cast<dds::RecordKind>(query->integer(3)), query->number(4),
                       query->number(5), query->integer(6), query->text(7), query->text(8)});
  }
}

void Outbox::acknowledge(std::uint64_t number) {
  acknowledged_ = std::clamp(number, acknowledged_, last_number_);
}

Result<void> Outbox::flush() {
  if (deleted_ == acknowledged_) return {};
  if (const auto done = delete_acknowledged(); !done) return done;
  deleted_ = acknowledged_;
  return {};
}

Result<void> Outbox::begin_epoch() {
  if (const auto done = flush(); !done) return done;
  auto transaction = sqlite::Transaction::begin(database_);
  if (!transaction) return fail(transaction.error());
  const std::uint64_t epoch = epoch_after(epoch_);
  const std::uint64_t base = acknowledged_;
  {
    // Every number stays below all that follow it, so no two rows ever meet.
    auto renumber = database_.prepare("UPDATE record SET number = number - ?1");
    if (!renumber) return fail(renumber.error());
    if (const auto done = renumber->bind(base).run(); !done) return done;
    auto update = database_.prepare("UPDATE outbox SET epoch = ?1, last_number = ?2");
    if (!update) return fail(update.error());
    if (const auto done = update->bind(epoch, last_number_ - base).run(); !done) return done;
  }
  if (const auto done = transaction->commit(); !done) return done;
  epoch_ = epoch;
  last_number_ -= base;
  acknowledged_ = deleted_ = 0;
  for (dds::Record& record : staged_) {
    record.epoch = epoch_;
    record.number -= base;
  }
  return {};
}

}  // namespace dripline::report
