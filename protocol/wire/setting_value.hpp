#pragma once

#include <chrono>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

/// One setting's value as text, and back. `key` is for the errors' words.
namespace dripline::wire {

struct SettingRange {
  std::uint64_t least = 0;
  std::uint64_t most = 0;
};

/// Errors: Syntax, LimitExceeded.
Result<std::uint64_t> parse_number(std::string_view key, std::string_view value,
                                   SettingRange range);
/// Errors: Syntax, LimitExceeded.
Result<double> parse_rate(std::string_view key, std::string_view value, SettingRange range);
/// "yes" or "no". Errors: Syntax.
Result<bool> parse_flag(std::string_view key, std::string_view value);
/// A printable character as itself, a control character by its name (ETX) or as 0x03. Errors:
/// Syntax.
Result<char> parse_character(std::string_view key, std::string_view value);
std::string character_text(char character);
/// Which of `words`. Errors: Syntax, naming them all.
Result<std::size_t> parse_word(std::string_view key, std::string_view value,
                               std::span<const std::string_view> words);

/// Stores what was parsed; `member` is unchanged by an error.
template <class T, class Member>
Result<void> store(const Result<T>& parsed, Member& member) {
  if (!parsed) return fail(parsed.error());
  member = static_cast<Member>(*parsed);
  return {};
}

}  // namespace dripline::wire
