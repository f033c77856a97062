#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

/// Conversational programming of the Centurion: events, the fields of their screens, and the
/// program text the control posts for them.
namespace dripline::conversational {

/// The number in a field of an event's screen; nothing is a field left blank, which posts nothing.
using Entry = std::optional<double>;

/// A number as it was typed.
struct TypedNumber {
  double value = 0;
  bool is_fraction = false;  ///< such as 5/16: rounded to what the field shows
};

/// "1.25", "-.5" or "5/16" (up to 9 digits on each side of the stroke, no exponent). Errors:
/// Syntax.
Result<TypedNumber> parse_entry(std::string_view typed);

/// As the control writes numbers into a program: up to six decimals, no zero before the point,
/// none at the end (".5", "-2", "0").
std::string number_text(double value);

}  // namespace dripline::conversational
