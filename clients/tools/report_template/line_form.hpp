#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"

namespace re2 {
class RE2;
}

namespace dripline::report_template {

inline constexpr std::size_t kMaxForm = 512;   ///< characters of a form or a pattern
inline constexpr std::size_t kMaxLine = 8192;  ///< a longer line has no form
inline constexpr std::size_t kMaxFields = 32;  ///< of a form

/// What a field means. Numbers belong to one measurement; texts stay in force for the lines that
/// follow in the same part.
enum class FieldKind : std::uint8_t {
  Actual,
  Deviation,
  Nominal,
  Lower,
  Upper,
  Tolerance,       ///< both limits are so far from the nominal
  UpperDeviation,  ///< of the upper limit from the nominal, with its sign
  LowerDeviation,
  Count,     ///< number of this line, of a counted report
  Expected,  ///< how many lines with values the report will have
  Characteristic,
  Unit,
  Part,
  Serial,
  Tool,
  Free,  ///< any other name: for names of characteristics
};
bool is_number(FieldKind kind);

struct Field {
  std::string name;  ///< as written, without qualifier
  FieldKind kind = FieldKind::Free;
  std::string of;  ///< {actual.X}: the characteristic, for lines that have several
};

/// The value of a field in a line, as it is written there.
struct FieldText {
  const Field* field = nullptr;
  std::string_view text;
};

/// What a line looks like. Immutable; any thread. Time is linear in the line's length (RE2).
class LineForm {
 public:
  /// Literal text with fields: "BORE {feature} D {actual}". A blank matches any blanks, beside a
  /// number or a sign like | and : also for none. Blanks and control characters at the ends of a
  /// line do not matter. A number may have blanks before and after its sign. `{name:number}`,
  /// `{name:word}` and `{name:text}` (with blanks) state what a free field is; without it is a
  /// word.
  /// `{{`, `}}` are braces. Errors: Syntax, LimitExceeded.
  static Result<LineForm> of_form(std::string_view form, bool has_decimal_comma);
  /// A regular expression of RE2 for the whole line; its named groups are the fields, `actual_X`
  /// for actual.X. Errors: Syntax, LimitExceeded.
  static Result<LineForm> of_pattern(std::string_view pattern);

  /// nullopt: the line has another form. Views are into `line`.
  std::optional<std::vector<FieldText>> match(std::string_view line) const;
  const std::vector<Field>& fields() const { return fields_; }
  const std::string& text() const { return text_; }

 private:
  LineForm() = default;
  Result<void> compile(const std::string& pattern);

  std::string text_;
  std::vector<Field> fields_;
  std::vector<int> groups_;  ///< of the fields
  std::shared_ptr<const re2::RE2> pattern_;
};

/// Without blanks, control characters and what devices add at the ends of a line.
std::string_view trimmed(std::string_view line);

struct Number {
  double value = 0;
  std::uint8_t decimals = 0;
};
/// A number with blanks around its sign, and a decimal point or comma. Errors: Syntax,
/// LimitExceeded (18 digits).
Result<Number> read_number(std::string_view text);

}  // namespace dripline::report_template
