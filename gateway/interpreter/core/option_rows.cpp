#include "gateway/interpreter/core/option_rows.hpp"

#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

namespace dripline::interpreter {
namespace {

/// 1000000000000 and not 1e+12.
std::string number_text(double number) {
  constexpr double kExact = 1e15;
  const bool is_whole = std::abs(number) < kExact && number == std::trunc(number);
  return is_whole ? fmt::format("{}", static_cast<std::int64_t>(number))
                  : fmt::format("{}", number);
}

bool is_length(const OptionKey& key) {
  return key.type == kLength || key.type == kFeed;
}

}  // namespace

std::string OptionRange::text() const {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  if (is_open && has_high) {
    return fmt::format("above {} and up to {}", number_text(low), number_text(high));
  }
  if (is_open) return fmt::format("above {}", number_text(low));
  if (has_low && has_high) return fmt::format("{} to {}", number_text(low), number_text(high));
  return has_low ? fmt::format("{} or more", number_text(low)) : "";
}

std::vector<std::string_view> OptionKey::words() const {
  std::vector<std::string_view> words;
  std::string_view rest = type;
  while (true) {
    const std::size_t end = rest.find('|');
    words.push_back(rest.substr(0, end));
    if (end == std::string_view::npos) return words;
    rest.remove_prefix(end + 1);
  }
}

Result<void> check_range(const OptionKey& key, double value) {
  const OptionRange& range = key.range;
  if (range.contains(value)) return {};
  std::string limit = "is not " + range.text();
  if (!std::isfinite(range.high)) {
    limit = (range.is_open ? "is not more than " : "is less than ") + number_text(range.low);
  } else if (key.type == kWhole) {
    limit = "is not a number from " + range.text();
  }
  return fail(Errc::Syntax, "{} {}: {} {}", key.table, key.key, number_text(value), limit);
}

Result<std::vector<std::int64_t>> read_integers(const Options& options, const OptionKey& key) {
  auto values = options.integers(key.key);
  if (!values) return values;
  if (values->size() > key.range.max_count) {
    return fail(Errc::Syntax, "{} {}: {} entries, at most {}", key.table, key.key, values->size(),
                key.range.max_count);
  }
  for (const std::int64_t value : *values) {
    if (auto good = check_range(key, static_cast<double>(value)); !good) return fail(good.error());
  }
  return values;
}

Result<std::size_t> read_word(const Options& options, const OptionKey& key, std::size_t fallback) {
  const OptionValue* value = options.find(key.key);
  if (value == nullptr) return fallback;
  const auto words = key.words();
  if (const auto* text = std::get_if<std::string>(&value->value)) {
    const auto at = std::find(words.begin(), words.end(), *text);
    if (at != words.end()) return static_cast<std::size_t>(at - words.begin());
  }
  // The error is the one of a choice among words that are known when it is compiled.
  return options.choice(key.key, {fmt::format("{}", fmt::join(words, ", "))}, 0);
}

Result<void> read_value(const Options& options, const OptionKey& key, double& value) {
  if (is_length(key)) {
    const auto length = options.length(key.key, Length::mm(value));
    if (!length) return fail(length.error());
    value = length->mm();
  } else if (auto done = assign(options.number(key.key, value), value); !done) {
    return done;
  }
  return check_range(key, value);
}

Result<void> read_value(const Options& options, const OptionKey& key, Position& value) {
  return assign(options.position(key.key), value);
}

Result<void> read_value(const Options& options, const OptionKey& key,
                        std::vector<std::int64_t>& values) {
  return assign(read_integers(options, key), values);
}

std::string value_text(const OptionKey& key, double value) {
  const std::string_view unit = key.type == kLength ? " mm" : key.type == kFeed ? " mm/min" : "";
  return number_text(value).append(unit);
}

std::string value_text(const OptionKey& key, std::size_t value) {
  if (key.type == kFlag) return value != 0 ? "true" : "false";
  if (key.type != kWhole) return std::string(key.words()[value]);
  return fmt::format("{}", static_cast<std::int64_t>(value));
}

}  // namespace dripline::interpreter
