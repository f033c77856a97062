#include "gateway/report/kept_memory.hpp"

#include <fmt/format.h>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "protocol/base/digest.hpp"

namespace dripline::report {

namespace sqlite = storage::sqlite;

namespace {

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

/// Covers everything that is kept, so that a row which another program has changed is noticed.
std::string digest_of(const KeptCells& memory, const KeptMemory::Beginning& beginning,
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

bool is_same_number(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

bool operator==(const KeptCell& a, const KeptCell& b) {
  return is_same_number(a.value, b.value) && is_same_number(a.base, b.base) &&
         a.is_named == b.is_named;
}

Result<void> KeptMemory::load(sqlite::Database& database) {
  auto cells = read_cells(database, "memory");
  if (!cells) return fail(cells.error());
  cells_ = *std::move(cells);
  cells = read_cells(database, "memory_beginning");
  if (!cells) return fail(cells.error());
  beginning_.cells = *std::move(cells);
  return load_state(database);
}

Result<void> KeptMemory::load_state(sqlite::Database& database) {
  auto query = database.prepare("SELECT revision, digest, fault FROM memory_state");
  if (!query) return fail(query.error());
  const auto row = query->step();
  if (!row) return fail(row.error());
  if (!*row) {
    fault_ = "the row that seals what the control has kept is gone";
    return {};
  }
  beginning_.revision = query->text(0);
  const std::string digest = query->text(1);
  fault_ = query->text(2);
  if (digest.empty() || digest == digest_of(cells_, beginning_, fault_)) return {};
  fault_ = "what the control has kept is not as it was written";
  return {};
}

void KeptMemory::stage_none() {
  for (const auto& [name, cell] : cells_) staged_cells_[name] = std::nullopt;
  staged_beginning_ = Beginning{};
  staged_fault_ = "";
}

Result<void> KeptMemory::write_cells(sqlite::Database& database) const {
  auto replace = database.prepare("INSERT OR REPLACE INTO memory VALUES (?1, ?2, ?3, ?4)");
  if (!replace) return fail(replace.error());
  auto drop = database.prepare("DELETE FROM memory WHERE name = ?1");
  if (!drop) return fail(drop.error());
  for (const auto& [name, cell] : staged_cells_) {
    const auto done = cell ? insert_cell(*replace, name, *cell) : drop->bind(name).run();
    if (!done) return done;
  }
  return {};
}

Result<void> KeptMemory::write_beginning(sqlite::Database& database) const {
  if (!staged_beginning_) return {};
  if (auto done = database.execute("DELETE FROM memory_beginning"); !done) return done;
  auto insert = database.prepare("INSERT INTO memory_beginning VALUES (?1, ?2, ?3, ?4)");
  if (!insert) return fail(insert.error());
  for (const auto& [name, cell] : staged_beginning_->cells) {
    if (const auto done = insert_cell(*insert, name, cell); !done) return done;
  }
  return {};
}

KeptCells KeptMemory::cells_with_staged() const {
  KeptCells cells = cells_;
  for (const auto& [name, cell] : staged_cells_) {
    if (cell) {
      cells[name] = *cell;
    } else {
      cells.erase(name);
    }
  }
  return cells;
}

Result<void> KeptMemory::write(sqlite::Database& database) const {
  if (!is_staged()) return {};
  if (const auto done = write_cells(database); !done) return done;
  if (const auto done = write_beginning(database); !done) return done;
  const Beginning& beginning = staged_beginning_ ? *staged_beginning_ : beginning_;
  const std::string& fault = staged_fault_ ? *staged_fault_ : fault_;
  auto replace = database.prepare("INSERT OR REPLACE INTO memory_state VALUES (1, ?1, ?2, ?3)");
  if (!replace) return fail(replace.error());
  const std::string digest = digest_of(cells_with_staged(), beginning, fault);
  return replace->bind(beginning.revision, digest, fault).run();
}

void KeptMemory::apply() {
  if (!staged_cells_.empty()) cells_ = cells_with_staged();
  if (staged_beginning_) beginning_ = *std::move(staged_beginning_);
  if (staged_fault_) fault_ = *std::move(staged_fault_);
  discard();
}

void KeptMemory::discard() {
  staged_cells_.clear();
  staged_beginning_.reset();
  staged_fault_.reset();
}

}  // namespace dripline::report
