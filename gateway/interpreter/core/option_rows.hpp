#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "gateway/interpreter/core/option.hpp"

/// The rows of a control's `[control]` table: one row is one key, from which come its reading, the
/// check of unknown keys, error texts, `dnc setup options` and deploy/docs/options.md.
namespace dripline::interpreter {

/// What a number may be: from `low` to `high`, both included, but `low` itself where `is_open`.
struct OptionRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool is_open = false;
  std::size_t max_count = std::numeric_limits<std::size_t>::max();  ///< of a list

  bool contains(double value) const {
    return (is_open ? value > low : value >= low) && value <= high;
  }
  std::string text() const;  ///< "1 to 16", "above 0"; empty where every number is allowed
};
inline constexpr OptionRange kNotNegative{.low = 0};
inline constexpr OptionRange kPositive{.low = 0, .is_open = true};

// What a setup file has for a key; the type of a choice is its words, as "inch|metric".
inline constexpr std::string_view kFlag = "true|false", kWhole = "whole number", kNumber = "number",
                                  kLength = "length", kFeed = "length per minute", kText = "text",
                                  kAxisTable = "axes", kWholes = "whole numbers",
                                  kAxisTables = "list of axes";

struct OptionKey {
  std::string_view key;
  std::string_view type;
  std::string_view text;  ///< what it decides
  std::string_view fallback =
      {};                      ///< in force when the key is absent; empty: as `list_rows` finds it
  OptionRange range = {};      ///< of a number, or of each number in a list
  std::string_view unit = {};  ///< empty: none, or that of the setup file's lengths
  std::string_view table = "[control]";  ///< how an error calls the table

  std::vector<std::string_view> words() const;  ///< of a choice
};

constexpr OptionKey option(std::string_view key, std::string_view type, std::string_view text,
                           std::string_view fallback = {}, OptionRange range = {},
                           std::string_view unit = {}) {
  return {key, type, text, fallback, range, unit};
}

/// `Control`: what the dialect reads its options into; its initial values are the defaults.
template <class Control>
struct OptionRow : OptionKey {
  using Read = Result<void> (*)(const Options& options, const OptionKey& key, Control& control);
  using Usual = std::string (*)(const OptionKey& key, const Control& control);
  Read read = nullptr;    ///< nullptr: another file of the dialect reads it
  Usual usual = nullptr;  ///< the default as text
};

/// A row as it is listed. Texts are constants of the dialect.
struct ListedOption {
  OptionKey key;
  std::string fallback;
};

/// Errors: Syntax, naming key, value and range.
Result<void> check_range(const OptionKey& key, double value);
/// Each number of a list, and how many there are. Errors: Syntax.
Result<std::vector<std::int64_t>> read_integers(const Options& options, const OptionKey& key);

/// The place of the given word among those of a choice. Errors: Syntax.
Result<std::size_t> read_word(const Options& options, const OptionKey& key, std::size_t fallback);

/// The value that was read into its place; an error is passed on.
template <class Read, class Value>
Result<void> assign(const Result<Read>& read, Value& value) {
  if (!read) return fail(read.error());
  value = static_cast<Value>(*read);
  return {};
}

// One value each, which keeps what it has when the key is absent. A length is in millimeters.
Result<void> read_value(const Options& options, const OptionKey& key, double& value);
Result<void> read_value(const Options& options, const OptionKey& key, Position& value);
Result<void> read_value(const Options& options, const OptionKey& key,
                        std::vector<std::int64_t>& values);
/// A flag, a whole number, or a choice, whose words are in the order of the values.
template <class Value>
Result<void> read_value(const Options& options, const OptionKey& key, Value& value) {
  if (options.find(key.key) == nullptr) return {};
  if (key.type == kFlag) return assign(options.flag(key.key, false), value);
  if (key.type != kWhole) return assign(read_word(options, key, 0), value);
  const auto whole = options.integer(key.key, 0);
  if (!whole) return fail(whole.error());
  if (auto good = check_range(key, static_cast<double>(*whole)); !good) return good;
  return assign(whole, value);
}

std::string value_text(const OptionKey& key, double value);
std::string value_text(const OptionKey& key, std::size_t value);
inline std::string value_text(const OptionKey&, const Position&) {
  return "none";
}
inline std::string value_text(const OptionKey&, const std::vector<std::int64_t>&) {
  return "none";
}

template <class Pointer>
struct ControlOf;
template <class Value, class Control>
struct ControlOf<Value Control::*> {
  using Type = Control;
};

/// A row that is read into a member. `fallback` only where the default is more than the member's
/// initial value.
template <auto kMember, class Control = typename ControlOf<decltype(kMember)>::Type>
constexpr OptionRow<Control> row(std::string_view key, std::string_view type, std::string_view text,
                                 OptionRange range = {}, std::string_view unit = "",
                                 std::string_view fallback = "") {
  return {{key, type, text, fallback, range, unit},
          [](const Options& options, const OptionKey& self, Control& control) {
            return read_value(options, self, control.*kMember);
          },
          [](const OptionKey& self, const Control& control) {
            using Value = std::remove_cvref_t<decltype(control.*kMember)>;
            if constexpr (std::is_enum_v<Value> || std::is_integral_v<Value>) {
              return value_text(self, static_cast<std::size_t>(control.*kMember));
            } else {
              return value_text(self, control.*kMember);
            }
          }};
}

/// The inputs that are at 1; when the key is given, no input needs the operator's answer.
template <auto kMember, auto kIsGiven, class Control = typename ControlOf<decltype(kMember)>::Type>
constexpr OptionRow<Control> pins_row() {
  return {
      {"pins", kWholes, "inputs that are at 1; all others are then at 0", "the operator is asked"},
      [](const Options& options, const OptionKey& self, Control& control) {
        control.*kIsGiven = options.find(self.key) != nullptr;
        return read_value(options, self, control.*kMember);
      }};
}

/// Reads a row whose value has no effect in the interpreter: a flag or a choice.
template <class Control>
Result<void> check_option(const Options& options, const OptionKey& key, Control&) {
  std::size_t unused = 0;
  return read_value(options, key, unused);
}

/// In the rows' order, so that a row may rely on the rows above it. Errors: Syntax, Unsupported (a
/// key that no row has).
template <class Control, std::size_t kCount>
Result<void> read_rows(const std::array<OptionRow<Control>, kCount>& rows, const Options& options,
                       Control& control) {
  const auto checked = [&]<std::size_t... kIndex>(std::index_sequence<kIndex...>) {
    return options.check_known({rows[kIndex].key...});
  }
  (std::make_index_sequence<kCount>());
  if (!checked) return checked;
  for (const auto& each : rows) {
    if (each.read == nullptr) continue;
    if (auto done = each.read(options, each, control); !done) return done;
  }
  return {};
}

/// The default is the row's own text, else the member's initial value, else the first word of a
/// choice, else "none".
template <class Control, std::size_t kCount>
std::vector<ListedOption> list_rows(const std::array<OptionRow<Control>, kCount>& rows) {
  std::vector<ListedOption> listed;
  const Control usual;
  for (const auto& each : rows) {
    std::string text(each.fallback);
    if (text.empty() && each.usual != nullptr) text = each.usual(each, usual);
    if (text.empty()) text = each.words().size() > 1 ? each.words().front() : "none";
    listed.push_back({each, std::move(text)});
  }
  return listed;
}

/// The rows of a control whose errors call the table `table`.
template <class Control, std::size_t kCount>
constexpr std::array<OptionRow<Control>, kCount> in_table(
    std::string_view table, std::array<OptionRow<Control>, kCount> rows) {
  for (auto& each : rows) each.table = table;
  return rows;
}

}  // namespace dripline::interpreter
