#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline {

/// A number as an NC program wrote it: value = digits / 10^scale. `X1`, `X1.` and `X1.0` differ on
/// many controls, so what was written is kept; a dialect converts in one place.
struct Decimal {
  std::int64_t digits = 0;     ///< signed
  std::uint8_t scale = 0;      ///< digits after the decimal point, 0..18
  bool has_point = false;      ///< a decimal point was written
  bool negative_zero = false;  ///< `-0` was written

  double value() const;
  /// Prints the number as it came: same digits, same point. Leading zeros and a leading plus are
  /// not kept.
  std::string text() const;
  friend bool operator==(const Decimal&, const Decimal&) = default;
};

/// Reads the whole of `text` as [+|-] digits [. digits], at least one digit, at most 18 significant
/// digits. No exponent, no blanks, no locale. Errors: Syntax, LimitExceeded (more than 18 digits).
Result<Decimal> parse_decimal(std::string_view text);

/// `value` rounded to at most `decimals` digits after the point; without zeros at its end, a point
/// that nothing follows, or "-0".
std::string decimal_text(double value, int decimals);

}  // namespace dripline
