#include "gateway/interpreter/core/option.hpp"

#include <algorithm>

namespace dripline::interpreter {
namespace {

tl::unexpected<Error> wrong_kind(std::string_view key, const OptionValue& value,
                                 std::string_view expected) {
  if (value.line == 0) return fail(Errc::Syntax, "[control] {}: expected {}", key, expected);
  return fail(Errc::Syntax, "line {}: [control] {}: expected {}", value.line, key, expected);
}

std::string join(std::initializer_list<std::string_view> names) {
  std::string text;
  for (const std::string_view name : names) {
    if (!text.empty()) text += ", ";
    text += name;
  }
  return text;
}

std::optional<double> as_number(const OptionValue& option) {
  if (const auto* number = std::get_if<double>(&option.value)) return *number;
  if (const auto* whole = std::get_if<std::int64_t>(&option.value)) {
    return static_cast<double>(*whole);
  }
  return std::nullopt;
}

constexpr std::string_view kAxesExpected = "a table of axes such as { X = 1.0, Z = 2.0 }";

Result<Position> read_position(std::string_view key, const OptionValue& option, Units units) {
  const auto* table = std::get_if<OptionTable>(&option.value);
  if (!table) return wrong_kind(key, option, kAxesExpected);
  Position position;
  for (const OptionEntry& entry : *table) {
    const auto axis = entry.key.size() == 1 ? axis_of(entry.key[0]) : std::nullopt;
    const auto number = as_number(entry.value);
    if (!axis || !number) return wrong_kind(key, entry.value, kAxesExpected);
    const double scale =
        units == Units::Inch && !is_rotary(*axis) ? Length::kMillimetersPerInch : 1.0;
    position.set_raw(*axis, *number * scale);
  }
  return position;
}

}  // namespace

const OptionValue* Options::find(std::string_view key) const {
  for (const OptionEntry& entry : table_) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

void Options::set(std::string_view key, OptionValue value) {
  for (OptionEntry& entry : table_) {
    if (entry.key == key) {
      entry.value = std::move(value);
      return;
    }
  }
  table_.push_back({std::string(key), std::move(value)});
}

Result<void> Options::check_known(std::initializer_list<std::string_view> known) const {
  for (const OptionEntry& entry : table_) {
    if (std::find(known.begin(), known.end(), entry.key) != known.end()) continue;
    return fail(Errc::Unsupported,
                "line {}: [control] {}: this control has no such option; it has: {}",
                entry.value.line, entry.key, join(known));
  }
  return {};
}

Result<bool> Options::flag(std::string_view key, bool fallback) const {
  const OptionValue* option = find(key);
  if (!option) return fallback;
  const auto* value = std::get_if<bool>(&option->value);
  if (!value) return wrong_kind(key, *option, "true or false");
  return *value;
}

Result<std::int64_t> Options::integer(std::string_view key, std::int64_t fallback) const {
  const OptionValue* option = find(key);
  if (!option) return fallback;
  const auto* value = std::get_if<std::int64_t>(&option->value);
  if (!value) return wrong_kind(key, *option, "a whole number");
  return *value;
}

Result<double> Options::number(std::string_view key, double fallback) const {
  const OptionValue* option = find(key);
  if (!option) return fallback;
  const auto value = as_number(*option);
  if (!value) return wrong_kind(key, *option, "a number");
  return *value;
}

Result<Length> Options::length(std::string_view key, Length fallback) const {
  if (!find(key)) return fallback;
  const auto value = number(key, 0);
  if (!value) return fail(value.error());
  return units_ == Units::Inch ? Length::inch(*value) : Length::mm(*value);
}

Result<std::string> Options::text(std::string_view key, std::string_view fallback) const {
  const OptionValue* option = find(key);
  if (!option) return std::string(fallback);
  const auto* value = std::get_if<std::string>(&option->value);
  if (!value) return wrong_kind(key, *option, "a text in quotes");
  return *value;
}

Result<std::size_t> Options::choice(std::string_view key,
                                    std::initializer_list<std::string_view> allowed,
                                    std::size_t fallback) const {
  const OptionValue* option = find(key);
  if (!option) return fallback;
  if (const auto* value = std::get_if<std::string>(&option->value)) {
    const auto* at = std::find(allowed.begin(), allowed.end(), *value);
    if (at != allowed.end()) return static_cast<std::size_t>(at - allowed.begin());
  }
  return wrong_kind(key, *option, "one of " + join(allowed));
}

Result<std::vector<std::int64_t>> Options::integers(std::string_view key) const {
  std::vector<std::int64_t> values;
  const OptionValue* option = find(key);
  if (!option) return values;
  const OptionList one{*option};
  const auto* list = std::get_if<OptionList>(&option->value);
  for (const OptionValue& item : list ? *list : one) {
    const auto* value = std::get_if<std::int64_t>(&item.value);
    if (!value) return wrong_kind(key, item, "whole numbers");
    values.push_back(*value);
  }
  return values;
}

Result<Position> Options::position(std::string_view key) const {
  const OptionValue* option = find(key);
  if (!option) return Position{};
  return read_position(key, *option, units_);
}

Result<std::vector<Position>> Options::positions(std::string_view key) const {
  std::vector<Position> values;
  const OptionValue* option = find(key);
  if (!option) return values;
  const OptionList one{*option};
  const auto* list = std::get_if<OptionList>(&option->value);
  for (const OptionValue& item : list ? *list : one) {
    auto value = read_position(key, item, units_);
    if (!value) return fail(value.error());
    values.push_back(*value);
  }
  return values;
}

}  // namespace dripline::interpreter
