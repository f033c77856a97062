#include "storage/migration/rows.hpp"

#include <bit>

#include "storage/sql/query.hpp"

namespace dripline::migration {
namespace {

constexpr std::uint64_t kFetched = 64;  ///< rows at once: of chunks 16 MiB

std::string list_of(const std::vector<Column>& columns) {
  std::string list;
  for (const Column& column : columns) list += (list.empty() ? "" : ", ") + quoted(column.name);
  return list;
}

/// Texts by the bytes that they were made of: what PostgreSQL stores for a byte that is not UTF-8
/// has another place.
std::string order_of(const Table& table, sql::Engine engine) {
  std::string list;
  for (const Column& column : table.order) {
    const bool is_text = engine == sql::Engine::Postgresql && column.kind == sql::Kind::Text;
    const std::string name = quoted(column.name);
    list += (list.empty() ? "" : ", ") + (is_text ? "hex(" + name + ") COLLATE \"C\"" : name);
  }
  return list;
}

void append_number(std::string& bytes, std::uint64_t number) {
  constexpr int kBits = 64, kByte = 8;
  for (int shift = kBits - kByte; shift >= 0; shift -= kByte)
    bytes += static_cast<char>(number >> shift);
}

struct Canonical {
  std::string& bytes;
  void operator()(std::monostate) const { bytes += 'n'; }
  void operator()(std::int64_t value) const {
    bytes += 'i';
    append_number(bytes, static_cast<std::uint64_t>(value));
  }
  void operator()(double value) const {
    bytes += 'r';
    append_number(bytes, std::bit_cast<std::uint64_t>(value == 0 ? 0.0 : value));
  }
  void operator()(const std::string& value) const {
    bytes += 't';
    append_number(bytes, value.size());
    bytes += value;
  }
  void operator()(const std::vector<std::byte>& value) const {
    bytes += 'b';
    append_number(bytes, value.size());
    bytes.append(reinterpret_cast<const char*>(value.data()), value.size());
  }
};

Value value_of(const sql::Statement& statement, int column, sql::Kind kind) {
  if (statement.is_null(column)) return {};
  switch (kind) {
    case sql::Kind::Integer:
      return statement.integer(column);
    case sql::Kind::Real:
      return statement.real(column);
    case sql::Kind::Text:
      return statement.text(column);
    default: {
      const auto bytes = statement.blob(column);
      return std::vector<std::byte>(bytes.begin(), bytes.end());
    }
  }
}

}  // namespace

Result<RowReader> RowReader::begin(sql::Database& database, const Table& table,
                                   std::uint64_t passed) {
  std::string rows = fmt::format("SELECT {} FROM {} ORDER BY {}", list_of(table.columns),
                                 quoted(table.name), order_of(table, database.engine()));
  const bool is_fetched = database.engine() == sql::Engine::Postgresql;
  if (is_fetched) {
    // The answer to a SELECT comes as a whole; a cursor's in parts.
    const std::string cursor = "rows_of_" + table.name;
    auto declared =
        database.execute(fmt::format("DECLARE {} NO SCROLL CURSOR FOR {}", cursor, rows));
    if (declared && passed > 0)
      declared = database.execute(fmt::format("MOVE FORWARD {} IN {}", passed, cursor));
    if (!declared) return fail(declared.error());
    rows = fmt::format("FETCH {} FROM {}", kFetched, cursor);
  } else {
    rows += fmt::format(" LIMIT -1 OFFSET {}", passed);
  }
  auto statement = database.prepare(rows);
  if (!statement) return fail(statement.error());
  return RowReader(database, table, *std::move(statement), is_fetched);
}

Result<std::optional<Row>> RowReader::next() {
  for (;;) {
    const auto has_row = statement_.step();
    if (!has_row) return fail(has_row.error());
    if (*has_row) {
      ++in_part_;
      return row();
    }
    if (!is_fetched_) return std::nullopt;
    if (in_part_ < kFetched) {
      auto closed = database_->execute("CLOSE rows_of_" + table_->name);
      if (!closed) return fail(closed.error());
      return std::nullopt;
    }
    in_part_ = 0;
  }
}

Row RowReader::row() const {
  Row row;
  row.reserve(table_->columns.size());
  for (std::size_t i = 0; i < table_->columns.size(); ++i)
    row.push_back(value_of(statement_, static_cast<int>(i), table_->columns[i].kind));
  return row;
}

void append_canonical(std::string& bytes, const Row& row) {
  for (const Value& value : row) std::visit(Canonical{bytes}, value);
}

std::uint64_t weight_of(const Row& row) {
  std::uint64_t weight = row.size() * sizeof(Value);
  for (const Value& value : row) {
    if (const auto* text = std::get_if<std::string>(&value)) weight += text->size();
    if (const auto* bytes = std::get_if<std::vector<std::byte>>(&value)) weight += bytes->size();
  }
  return weight;
}

Result<RowWriter> RowWriter::begin(sql::Database& database, const Table& table) {
  std::string places;
  for (std::size_t i = 1; i <= table.columns.size(); ++i)
    places += (i == 1 ? "?" : ", ?") + std::to_string(i);
  auto statement = database.prepare(fmt::format(
      "INSERT INTO {} ({}) VALUES ({})", quoted(table.name), list_of(table.columns), places));
  if (!statement) return fail(statement.error());
  return RowWriter(table, *std::move(statement));
}

Result<void> RowWriter::write(const Row& row) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    const int position = static_cast<int>(i) + 1;
    std::visit(
        [&](const auto& value) {
          using Kept = std::decay_t<decltype(value)>;
          if constexpr (std::is_same_v<Kept, std::monostate>) {
            statement_.bind_null_at(position, table_->columns[i].kind);
          } else if constexpr (std::is_same_v<Kept, std::vector<std::byte>>) {
            statement_.bind_at(position, std::span<const std::byte>(value));
          } else {
            statement_.bind_at(position, value);
          }
        },
        row[i]);
  }
  return statement_.post();
}

}  // namespace dripline::migration
