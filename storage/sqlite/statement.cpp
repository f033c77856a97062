#include "storage/sqlite/statement.hpp"

#include <sqlite3.h>

#include <SQLiteCpp/Column.h>
#include <SQLiteCpp/Exception.h>
#include <SQLiteCpp/Statement.h>

#include "protocol/base/invariant.hpp"

namespace dripline::storage::sqlite {

namespace {

/// SQLiteCpp throws on a position that does not exist, or when memory is exhausted: neither is an
/// expected failure.
template <class Action>
auto expect_position(Action action) {
  try {
    return action();
  } catch (const SQLite::Exception& exception) {
    invariant(false, exception.what());
    throw;
  }
}

}  // namespace

PreparedCursor::PreparedCursor(std::shared_ptr<SQLite::Statement> statement, bool* is_busy)
    : statement_(std::move(statement)), is_busy_(is_busy) {
  if (is_busy_ != nullptr) *is_busy_ = true;
}

PreparedCursor::~PreparedCursor() {
  statement_->tryReset();
  expect_position([this] { statement_->clearBindings(); });  // lets go of the caller's bytes
  if (is_busy_ != nullptr) *is_busy_ = false;
}

Result<bool> PreparedCursor::step() {
  if (statement_->isDone()) statement_->tryReset();
  const int code = statement_->tryExecuteStep();
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  const Error error = error_of(statement_->getExtendedErrorCode(), statement_->getErrorMsg(),
                               statement_->getQuery());
  statement_->tryReset();
  return fail(error);
}

Result<void> PreparedCursor::run() {
  for (;;) {
    const auto has_row = step();
    if (!has_row) return fail(has_row.error());
    if (!*has_row) break;
  }
  reset();
  return {};
}

void PreparedCursor::reset() {
  statement_->tryReset();
}

void PreparedCursor::bind_integer(int position, std::int64_t value) {
  expect_position([&] { statement_->bind(position, value); });
}

void PreparedCursor::bind_real(int position, double value) {
  expect_position([&] { statement_->bind(position, value); });
}

void PreparedCursor::bind_text(int position, const std::string& value) {
  expect_position([&] { statement_->bind(position, value); });
}

void PreparedCursor::bind_blob(int position, std::span<const std::byte> value) {
  const void* bytes = value.empty() ? "" : static_cast<const void*>(value.data());  // null is NULL
  invariant(value.size() <= 1'000'000'000, "a blob has at most 10^9 bytes");
  expect_position([&] { statement_->bindNoCopy(position, bytes, static_cast<int>(value.size())); });
}

void PreparedCursor::bind_null(int position, sql::Kind) {
  expect_position([&] { statement_->bind(position); });
}

std::int64_t PreparedCursor::integer(int column) const {
  return expect_position([&] { return statement_->getColumn(column).getInt64(); });
}

double PreparedCursor::real(int column) const {
  return expect_position([&] { return statement_->getColumn(column).getDouble(); });
}

std::string PreparedCursor::text(int column) const {
  return expect_position([&] { return statement_->getColumn(column).getString(); });
}

std::span<const std::byte> PreparedCursor::blob(int column) const {
  return expect_position([&]() -> std::span<const std::byte> {
    const SQLite::Column value = statement_->getColumn(column);
    const auto* bytes = static_cast<const std::byte*>(value.getBlob());
    return {bytes, static_cast<std::size_t>(value.getBytes())};
  });
}

bool PreparedCursor::is_null(int column) const {
  return expect_position([&] { return statement_->isColumnNull(column); });
}

namespace {

Errc code_of(int primary) {
  switch (primary) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return Errc::Busy;
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB:
      return Errc::Corrupt;
    case SQLITE_CONSTRAINT:
      return Errc::Conflict;
    case SQLITE_TOOBIG:
      return Errc::LimitExceeded;
    default:
      return Errc::Io;
  }
}

/// The beginning of long SQL is enough for a log.
std::string_view shortened(std::string_view sql) {
  return sql.substr(0, 200);
}

}  // namespace

Error error_of(int extended, std::string_view message, std::string_view subject) {
  const int primary = extended & 0xff;
  const std::string_view prefix = primary == SQLITE_FULL ? "disk full: " : "";
  return {code_of(primary), fmt::format("{}{} (SQLite code {}) in: {}", prefix, message, extended,
                                        shortened(subject))};
}

Error error_of(const SQLite::Exception& exception, std::string_view subject) {
  const int code = exception.getExtendedErrorCode() > 0 ? exception.getExtendedErrorCode()
                                                        : exception.getErrorCode();
  return error_of(code, exception.what(), subject);
}

}  // namespace dripline::storage::sqlite
