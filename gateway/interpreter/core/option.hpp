#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "gateway/interpreter/core/event.hpp"
#include "protocol/base/result.hpp"

/// The options of a control: the `[control]` table of a setup file. The dialect decides
/// what an option means; this file reads one in the right kind, with errors that name the key, the
/// line and the expected value.
namespace dripline::interpreter {

struct OptionValue;
struct OptionEntry;
using OptionList = std::vector<OptionValue>;
using OptionTable = std::vector<OptionEntry>;  ///< in the file's order of keys

/// A value as TOML knows it. Times and dates are not options of any control and are refused.
struct OptionValue {
  std::variant<bool, std::int64_t, double, std::string, OptionList, OptionTable> value;
  std::uint32_t line = 0;  ///< of the setup file; 0 when it was not read from one
};
struct OptionEntry {
  std::string key;
  OptionValue value;
};

/// Value type. Every reader gives `fallback` when the option is absent. Errors: Syntax, naming the
/// option, its line and what was expected.
class Options {
 public:
  Options() = default;
  /// Lengths in the table are in `units`.
  Options(OptionTable table, Units units) : table_(std::move(table)), units_(units) {}

  /// The value under `key`, or nullptr.
  const OptionValue* find(std::string_view key) const;
  void set(std::string_view key, OptionValue value);
  bool empty() const { return table_.empty(); }

  /// Errors: Unsupported, naming the first option that is not among `known`, and those that are.
  Result<void> check_known(std::initializer_list<std::string_view> known) const;

  Result<bool> flag(std::string_view key, bool fallback) const;
  Result<std::int64_t> integer(std::string_view key, std::int64_t fallback) const;
  /// Whole numbers are numbers, too.
  Result<double> number(std::string_view key, double fallback) const;
  /// A number in the file's units.
  Result<Length> length(std::string_view key, Length fallback) const;
  Result<std::string> text(std::string_view key, std::string_view fallback) const;
  /// A text that must be one of `allowed`; the answer is its place among them.
  Result<std::size_t> choice(std::string_view key, std::initializer_list<std::string_view> allowed,
                             std::size_t fallback) const;
  /// One whole number or a list of them. Absent: empty.
  Result<std::vector<std::int64_t>> integers(std::string_view key) const;
  /// A table of axes, e.g. { X = 1.0, Z = 2.0 }: lengths in the file's units, angles in degrees.
  Result<Position> position(std::string_view key) const;
  /// One such table or a list of them. Absent: empty.
  Result<std::vector<Position>> positions(std::string_view key) const;

 private:
  OptionTable table_;
  Units units_ = Units::Millimeter;
};

}  // namespace dripline::interpreter
