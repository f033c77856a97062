#include "storage/postgresql/errors.hpp"

#include <libpq-fe.h>
#include <array>
#include <string>

namespace dripline::storage::postgresql {
namespace {

std::string one_line(const char* message) {
  std::string text = message == nullptr ? "" : message;
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  for (char& c : text) {
    if (c == '\n' || c == '\t') c = ' ';
  }
  return text;
}

struct Row {
  std::string_view state;  ///< five characters, or the two of its class
  Errc code;
};

// PostgreSQL 15, appendix A.
constexpr std::array kCodes{
    Row{"40001", Errc::Busy},       Row{"40P01", Errc::Busy},
    Row{"55P03", Errc::Busy},     // lock_timeout
    Row{"55006", Errc::Busy},     // object_in_use
    Row{"53300", Errc::Busy},     // too_many_connections
    Row{"57014", Errc::Timeout},  // query_canceled
    Row{"22021", Errc::Syntax},   // not UTF-8, or a NUL
    Row{"22P05", Errc::Syntax},   // cannot be converted
    Row{"54", Errc::LimitExceeded}, Row{"23", Errc::Conflict},
    Row{"XX001", Errc::Corrupt},    Row{"XX002", Errc::Corrupt},
};  // 28, a password that is refused, is Io: no token and no user of ours is denied

}  // namespace

Errc code_of(std::string_view state) {
  for (const Row& row : kCodes) {
    if (state.starts_with(row.state)) return row.code;
  }
  return Errc::Io;
}

bool asks_to_repeat(std::string_view state) {
  return state == "40001" || state == "40P01";
}

std::string_view state_of(pg_result* result) {
  const char* state = result == nullptr ? nullptr : PQresultErrorField(result, PG_DIAG_SQLSTATE);
  return state == nullptr ? std::string_view() : state;
}

Error error_of(pg_conn* connection, pg_result* result) {
  const std::string_view state = state_of(result);
  if (state.empty()) {
    return {Errc::Io, fmt::format("the connection to PostgreSQL was lost: {}",
                                  one_line(PQerrorMessage(connection)))};
  }
  const std::string_view prefix = state == "53100" ? "disk full: " : "";
  return {code_of(state),
          fmt::format("{}{} (PostgreSQL code {})", prefix,
                      one_line(PQresultErrorField(result, PG_DIAG_MESSAGE_PRIMARY)), state)};
}

}  // namespace dripline::storage::postgresql
