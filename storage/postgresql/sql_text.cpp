#include "storage/postgresql/sql_text.hpp"

#include <algorithm>
#include <charconv>

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

/// The row of values at the end: "(?1, ?2)"; empty: there is none, or something follows it.
std::string_view values_of(std::string_view sql) {
  constexpr std::string_view kValues = " VALUES ";
  const std::size_t at = sql.find(kValues);
  if (!sql.starts_with("INSERT INTO ") || at == std::string_view::npos) return {};
  const std::string_view row = sql.substr(at + kValues.size());
  const bool is_plain = row.size() > 2 && row.front() == '(' && row.find(')') == row.size() - 1 &&
                        row.find_first_not_of("(?0123456789, )") == std::string_view::npos;
  return is_plain ? row : std::string_view();
}

void append_row(std::string& text, std::string_view row, int from) {
  while (!row.empty()) {
    int number = 0;
    const bool is_parameter = row.front() == '?';
    row.remove_prefix(is_parameter ? 1 : 0);
    const auto end = std::from_chars(row.data(), row.data() + row.size(), number).ptr;
    if (is_parameter) {
      text += '?' + std::to_string(number + from);
      row.remove_prefix(static_cast<std::size_t>(end - row.data()));
    } else {
      text += row.front();
      row.remove_prefix(1);
    }
  }
}

}  // namespace

std::string for_many_rows(std::string_view sql, int parameters, int rows) {
  const std::string_view row = values_of(sql);
  if (row.empty()) return {};
  std::string text(sql.substr(0, sql.size() - row.size()));
  for (int i = 0; i < rows; ++i) {
    if (i > 0) text += ", ";
    append_row(text, row, i * parameters);
  }
  return text;
}

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
