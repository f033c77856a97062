#include "storage/sqlite/error.hpp"

#include <sqlite3.h>
#include <SQLiteCpp/Exception.h>

namespace dripline::storage::sqlite {
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
