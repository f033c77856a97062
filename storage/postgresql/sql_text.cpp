#include "storage/postgresql/sql_text.hpp"

#include <algorithm>

namespace dripline::storage::postgresql {
namespace {

constexpr std::string_view kIndexedBy = "INDEXED BY ";
constexpr std::string_view kCrossJoin = "CROSS JOIN ";

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Up to and with the closing quotation mark; the same mark twice is two texts side by side.
std::size_t quoted_length(std::string_view sql) {
  const std::size_t end = sql.find(sql.front(), 1);
  return end == std::string_view::npos ? sql.size() : end + 1;
}

std::size_t hint_length(std::string_view sql) {
  const std::size_t end = std::min(sql.find(' ', kIndexedBy.size()), sql.size());
  return std::min(end + 1, sql.size());
}

}  // namespace

std::string spelled(std::string_view sql) {
  std::string text;
  text.reserve(sql.size());
  while (!sql.empty()) {
    std::size_t taken = 1;
    if (sql.front() == '\'' || sql.front() == '"') {
      taken = quoted_length(sql);
      text += sql.substr(0, taken);
    } else if (sql.front() == '?' && sql.size() > 1 && is_digit(sql[1])) {
      text += '$';
    } else if (sql.starts_with(kIndexedBy)) {
      taken = hint_length(sql);
    } else if (sql.starts_with(kCrossJoin)) {
      taken = kCrossJoin.size();
      text += "JOIN ";
    } else {
      text += sql.front();
    }
    sql.remove_prefix(taken);
  }
  return text;
}

}  // namespace dripline::storage::postgresql
