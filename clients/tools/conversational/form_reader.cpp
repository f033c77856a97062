#include "clients/tools/conversational/impl/form_reader.hpp"

#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>

namespace dripline::conversational {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

/// Values of files may be long and hold anything; this shows enough to find them again.
std::string shown(const FileValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  constexpr std::size_t kMaxShown = 40;
  return fmt::format("\"{}\"", std::get<std::string>(value).substr(0, kMaxShown));
}

}  // namespace

const FileValue* FormReader::find(const Field& field) {
  known_.push_back(field.name);
  if (error_) return nullptr;
  const auto found = std::ranges::find(event_.fields, field.name, &FileField::name);
  if (found == event_.fields.end()) {
    if (field.is_required && field.applies) report("{} is missing", field.name);
    return nullptr;
  }
  if (!field.applies) {
    report("{} does not apply here ({})", field.name, field.condition);
    return nullptr;
  }
  return &found->value;
}

Entry FormReader::rounded(const Field& field, const TypedNumber& typed) {
  const Limits limits = limits_of(field, units_);
  if (!(typed.value >= limits.min && typed.value <= limits.max)) {
    report("{} = {:g} is not between {} and {}", field.name, typed.value, number_text(limits.min),
           number_text(limits.max));
    return std::nullopt;
  }
  const double scale = std::pow(10.0, limits.decimals);
  const double steps = std::round(typed.value * scale);
  constexpr double kNoise = 1e-4;  // of the last decimal, for the error of binary numbers
  if (!typed.is_fraction && std::abs(typed.value * scale - steps) > kNoise) {
    report("{} = {} has more than {} decimals", field.name, typed.value, limits.decimals);
    return std::nullopt;
  }
  return steps / scale;
}

Entry FormReader::number_of(const Field& field, const FileValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return rounded(field, {*number, false});
  const auto* text = std::get_if<std::string>(&value);
  if (text == nullptr) {
    report("{} = {}: expected a number", field.name, shown(value));
    return std::nullopt;
  }
  const auto typed = parse_entry(*text);
  if (typed) return rounded(field, *typed);
  report("{} = {}", field.name, typed.error().what);
  return std::nullopt;
}

void FormReader::number(const Field& field, Entry& entry) {
  if (const auto* value = find(field)) entry = number_of(field, *value);
}

void FormReader::whole(const Field& field, std::optional<int>& entry) {
  const auto* value = find(field);
  if (value == nullptr) return;
  if (const auto number = number_of(field, *value)) entry = static_cast<int>(*number);
}

void FormReader::text(const Field& field, std::string& entry) {
  const auto* value = find(field);
  if (value == nullptr) return;
  const auto* text = std::get_if<std::string>(value);
  if (text == nullptr) return report("{} = {}: expected a text", field.name, shown(*value));
  if (text->size() > static_cast<std::size_t>(field.max)) {
    return report("{} has {} characters, more than {}", field.name, text->size(), field.max);
  }
  for (const char c : *text) {
    if (c < ' ' || c > '~') {
      return report("{} has a character {:#04x}: only those of plain text can be posted",
                    field.name, static_cast<unsigned char>(c));
    }
  }
  const bool is_comment = field.quantity == Quantity::Comment;
  if (is_comment && text->find_first_of("()") != std::string::npos) {
    return report("{} = {}: no parentheses inside a comment", field.name, shown(*value));
  }
  entry = *text;
}

void FormReader::feedrate(const Field& field, Feedrate& entry) {
  const auto* value = find(field);
  if (value == nullptr) return;
  const auto* text = std::get_if<std::string>(value);
  entry = {};
  entry.is_rapid = text != nullptr && lower(*text) == "rapid";
  if (!entry.is_rapid) entry.value = number_of(field, *value);
}

void FormReader::choice(const Field& field, std::span<const std::string_view> names,
                        std::size_t& index) {
  const auto* value = find(field);
  if (value == nullptr) return;
  std::string wanted;
  if (const auto* text = std::get_if<std::string>(value)) wanted = lower(*text);
  if (const auto* flag = std::get_if<bool>(value)) wanted = *flag ? "yes" : "no";
  if (const auto* number = std::get_if<double>(value)) wanted = fmt::format("{:g}", *number);
  const auto found = std::ranges::find(names, wanted);
  if (found == names.end()) {
    return report("{} = {}: expected one of {}", field.name, shown(*value), fmt::join(names, ", "));
  }
  index = static_cast<std::size_t>(found - names.begin());
}

void FormReader::demand(bool holds, std::string_view text) {
  if (!holds) report("{}", text);
}

void FormReader::finish() {
  for (const auto& field : event_.fields) {
    if (field.name == "type" || std::ranges::count(known_, field.name) > 0) continue;
    report("{} is not a field here; known are {}", field.name.substr(0, 40),
           fmt::join(known_, ", "));
  }
}

}  // namespace dripline::conversational
