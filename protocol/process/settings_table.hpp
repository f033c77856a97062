#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "protocol/base/result.hpp"

namespace dripline::process {

/// How a value may be written in a TOML file. On the command line every value is text.
enum class Written : std::uint8_t { Text, Number, TextOrNumber, List };

/// How one setting is read into an `Options` object and shown from it. The makers below cover the
/// usual types; a setting with rules of its own brings its own `set`.
template <class Options>
struct SettingValue {
  Written written = Written::Text;
  /// Errors: Syntax, LimitExceeded; without the key, which the reader puts in front.
  Result<void> (*set)(Options&, std::string_view text) = nullptr;
  /// The value in force, for the help; none: the row's `fallback` describes it.
  std::string (*show)(const Options&) = nullptr;
};

/// One setting of a daemon. The row `lease-ms` is `--lease-ms` on the command line and
/// `lease-ms = ...` in the TOML file; help, reading and errors come from the row alone.
template <class Options>
struct SettingRow {
  std::string_view key;
  std::string_view type;      ///< shown after the option in the help: "host:port", "number"
  std::string_view unit;      ///< shown after the default: "ms"
  std::string_view fallback;  ///< the default in words; empty: the value itself is shown
  std::string_view text;      ///< what the setting does
  SettingValue<Options> value;
};

namespace detail {

/// `at<&A::b, &B::c>(a)` is `a.b.c`.
template <auto first, auto... rest>
auto& at(auto& object) {
  if constexpr (sizeof...(rest) == 0) {
    return object.*first;
  } else {
    return at<rest...>(object.*first);
  }
}

template <class T>
struct OwnerOf;
template <class Owner, class Member>
struct OwnerOf<Member Owner::*> {
  using type = Owner;
};
template <auto first>
using Owner = typename OwnerOf<decltype(first)>::type;

std::string shown(const std::string& value);
std::string shown(const std::filesystem::path& value);
std::string shown(bool value);
std::string shown(std::uint64_t value);
template <class T>
std::string shown(const std::optional<T>& value) {
  return value ? shown(*value) : std::string();
}

}  // namespace detail

/// A whole number from `lowest` to `highest`. Errors: Syntax, LimitExceeded.
Result<std::uint64_t> parse_number(std::string_view text, std::uint64_t lowest,
                                   std::uint64_t highest);
/// Errors: Syntax.
Result<bool> parse_yes_no(std::string_view text);

/// Text or a path, possibly optional: `text_value<&Options::network, &Network::tag>()`.
template <auto first, auto... rest>
constexpr auto text_value() {
  using Options = detail::Owner<first>;
  return SettingValue<Options>{.written = Written::Text,
                               .set = [](Options& options, std::string_view text) -> Result<void> {
                                 detail::at<first, rest...>(options) = std::string(text);
                                 return {};
                               },
                               .show =
                                   [](const Options& options) {
                                     return detail::shown(detail::at<first, rest...>(options));
                                   }};
}

/// A whole number within limits, in an integer.
template <std::uint64_t lowest, std::uint64_t highest, auto first, auto... rest>
constexpr auto number_value() {
  using Options = detail::Owner<first>;
  using Number =
      std::remove_cvref_t<decltype(detail::at<first, rest...>(std::declval<Options&>()))>;
  static_assert(highest <= std::numeric_limits<Number>::max());
  return SettingValue<Options>{
      .written = Written::Number,
      .set = [](Options& options, std::string_view text) -> Result<void> {
        const auto number = parse_number(text, lowest, highest);
        if (!number) return fail(number.error());
        detail::at<first, rest...>(options) = static_cast<Number>(*number);
        return {};
      },
      .show =
          [](const Options& options) {
            return detail::shown(static_cast<std::uint64_t>(detail::at<first, rest...>(options)));
          }};
}

/// "yes" or "no", in a bool or an optional one.
template <auto first, auto... rest>
constexpr auto yes_no_value() {
  using Options = detail::Owner<first>;
  return SettingValue<Options>{.written = Written::Text,
                               .set = [](Options& options, std::string_view text) -> Result<void> {
                                 const auto is_yes = parse_yes_no(text);
                                 if (!is_yes) return fail(is_yes.error());
                                 detail::at<first, rest...>(options) = *is_yes;
                                 return {};
                               },
                               .show =
                                   [](const Options& options) {
                                     return detail::shown(detail::at<first, rest...>(options));
                                   }};
}

}  // namespace dripline::process
