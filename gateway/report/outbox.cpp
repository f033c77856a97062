#include "gateway/report/outbox.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "gateway/report/outbox_schema.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/base/random.hpp"
#include "storage/sqlite/transaction.hpp"

namespace dripline::report {

namespace sqlite = storage::sqlite;

namespace {

/// The stores of both ends keep signed numbers: 62 bits leave room for all epochs that follow.
std::uint64_t first_epoch() {
  return (random_number() >> 2) + 1;
}

/// Greater, because the records of a run are read in the order of their epochs; at random, because
/// a copy of this outbox may have to begin a new one as well.
std::uint64_t epoch_after(std::uint64_t epoch) {
  return epoch + 1 + (random_number() >> 32);
}

/// A vacant cell is NULL.
double number_or_vacant(const sqlite::Statement& row, int column) {
  double value = std::numeric_limits<double>::quiet_NaN();
  const std::string text = row.optional_text(column).value_or("");
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}
std::optional<std::string> stored(double value) {
  return std::isnan(value) ? std::nullopt : std::optional(fmt::format("{}", value));
}

}  // namespace

bool is_same_number(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

bool operator==(const KeptCell& a, const KeptCell& b) {
  return is_same_number(a.value, b.value) && is_same_number(a.base, b.base) &&
         a.is_named == b.is_named;
}

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
      "offset FROM active_run");
  if (!query) return fail(query.error());
  const auto row = query->step();
  if (!row) return fail(row.error());
  if (!*row) return load_memory();
  committed_run_ =
      ActiveRun{query->text(0), query->text(1), query->text(2), query->text(3), query->number(4)};
  committed_progress_ = {query->number(5), query->number(6),  query->number(7),
                         query->number(8), query->integer(9), query->number(10)};
  progress_ = committed_progress_;
  return load_memory();
}

namespace {

Result<KeptCells> read_cells(sqlite::Database& database, const std::string& table) {
  auto query = database.prepare("SELECT name, value, base, is_named FROM " + table);
  if (!query) return fail(query.error());
  KeptCells cells;
  for (;;) {
    const auto row = query->step();
    if (!row) return fail(row.error());
    if (!*row) return cells;
    cells[query->text(0)] = {number_or_vacant(*query, 1), number_or_vacant(*query, 2),
                             query->integer(3) != 0};
  }
}

Result<void> insert_cell(sqlite::Statement& insert, const std::string& name, const KeptCell& cell) {
  return insert.bind(name, stored(cell.value), stored(cell.base), cell.is_named ? 1 : 0).run();
}

/// Of everything that is kept, so that a row which was changed after our back is noticed.
std::string digest_of(const KeptCells& memory, const Outbox::Beginning& beginning,
                      const std::string& fault) {
  Sha256 hash;
  const auto add = [&hash](const std::string& text) {
    hash.update(std::as_bytes(std::span(text)));
  };
  const auto add_cells = [&add](char table, const KeptCells& cells) {
    for (const auto& [name, cell] : cells) {
      add(fmt::format("{} {} {} {} {}\n", table, name, stored(cell.value).value_or("vacant"),
                      stored(cell.base).value_or("vacant"), cell.is_named ? 1 : 0));
    }
  };
  add_cells('m', memory);
  add_cells('b', beginning.cells);
  add(beginning.revision + "\n" + fault);
  return hash.digest().hex();
}

}  // namespace

Result<void> Outbox::load_memory() {
  auto cells = read_cells(database_, "memory");
  if (!cells) return fail(cells.error());
  memory_ = *std::move(cells);
  cells = read_cells(database_, "memory_beginning");
  if (!cells) return fail(cells.error());
  beginning_.cells = *std::move(cells);
  return load_memory_state();
}

Result<void> Outbox::load_memory_state() {
  auto query = database_.prepare("SELECT revision, digest, fault FROM memory_state");
  if (!query) return fail(query.error());
  const auto row = query->step();
  if (!row) return fail(row.error());
  if (!*row) {
    memory_fault_ = "the row that seals what the control has kept is gone";
    return {};
  }
  beginning_.revision = query->text(0);
  const std::string digest = query->text(1);
  memory_fault_ = query->text(2);
  if (digest.empty() || digest == digest_of(memory_, beginning_, memory_fault_)) return {};
  memory_fault_ = "what the control has kept is not as it was written";
  return {};
}

void Outbox::stage_no_memory() {
  for (const auto& [name, cell] : memory_) staged_cells_[name] = std::nullopt;
  staged_beginning_ = Beginning{};
  staged_fault_ = "";
}

Result<void> Outbox::write_cells() {
  auto replace = database_.prepare("INSERT OR REPLACE INTO memory VALUES (?1, ?2, ?3, ?4)");
  if (!replace) return fail(replace.error());
  auto drop = database_.prepare("DELETE FROM memory WHERE name = ?1");
  if (!drop) return fail(drop.error());
  for (const auto& [name, cell] : staged_cells_) {
    const auto done = cell ? insert_cell(*replace, name, *cell) : drop->bind(name).run();
    if (!done) return done;
  }
  return {};
}

Result<void> Outbox::write_beginning() {
  if (!staged_beginning_) return {};
  if (auto done = database_.execute("DELETE FROM memory_beginning"); !done) return done;
  auto insert = database_.prepare("INSERT INTO memory_beginning VALUES (?1, ?2, ?3, ?4)");
  if (!insert) return fail(insert.error());
  for (const auto& [name, cell] : staged_beginning_->cells) {
    if (const auto done = insert_cell(*insert, name, cell); !done) return done;
  }
  return {};
}

Result<void> Outbox::write_memory() {
  if (staged_cells_.empty() && !staged_beginning_ && !staged_fault_) return {};
  if (const auto done = write_cells(); !done) return done;
  if (const auto done = write_beginning(); !done) return done;
  KeptCells memory = memory_;
  for (const auto& [name, cell] : staged_cells_) {
    if (cell) {
      memory[name] = *cell;
    } else {
      memory.erase(name);
    }
  }
  const Beginning& beginning = staged_beginning_ ? *staged_beginning_ : beginning_;
  const std::string& fault = staged_fault_ ? *staged_fault_ : memory_fault_;
  auto replace = database_.prepare("INSERT OR REPLACE INTO memory_state VALUES (1, ?1, ?2, ?3)");
  if (!replace) return fail(replace.error());
  return replace->bind(beginning.revision, digest_of(memory, beginning, fault), fault).run();
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
  staged_cells_.clear();
  staged_beginning_.reset();
  staged_fault_.reset();
}

Result<void> Outbox::commit() {
  const bool has_change = !staged_.empty() || !staged_results_.empty() || !staged_cells_.empty() ||
                          staged_beginning_ || staged_fault_ || run_change_ != RunChange::None;
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
  for (const auto& [name, cell] : std::exchange(staged_cells_, {})) {
    if (cell) {
      memory_[name] = *cell;
    } else {
      memory_.erase(name);
    }
  }
  if (staged_beginning_) beginning_ = *std::exchange(staged_beginning_, std::nullopt);
  if (staged_fault_) memory_fault_ = *std::exchange(staged_fault_, std::nullopt);
  return {};
}

Result<void> Outbox::write_all() {
  if (const auto done = write_records(); !done) return done;
  if (const auto done = write_run(); !done) return done;
  if (const auto done = write_command_results(); !done) return done;
  if (const auto done = write_memory(); !done) return done;
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
      "INSERT OR REPLACE INTO active_run VALUES (1, ?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11)");
  if (!replace) return fail(replace.error());
  replace->bind(run.run, run.program, run.revision, run.control, run.size, progress_.sent,
                progress_.accepted, progress_.executed, progress_.line, progress_.sequence,
                progress_.offset);
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
