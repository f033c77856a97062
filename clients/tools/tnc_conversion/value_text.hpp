#pragma once

#include <string>

#include "gateway/interpreter/dialects/tnc155/reading/block.hpp"

namespace dripline::tnc_conversion {

using interpreter::tnc155::Value;

enum class Sign : std::uint8_t { Always, Negative };

/// A value as the control shows it: `decimals` of them, or as many as it needs up to 4 (kAsNeeded).
/// Q parameters always show their sign.
struct ValueText {
  static constexpr int kAsNeeded = -1;

  char decimal_sign = ',';
  int decimals = 3;

  void add(std::string& text, const Value& value, Sign sign) const;
};

/// A whole number with at least `width` digits.
void add_integer(std::string& text, std::int64_t number, int width = 1);
/// Millionths; all 6 decimals, or as many as needed.
void add_millionths(std::string& text, std::int32_t number, char decimal_sign, bool has_all);

}  // namespace dripline::tnc_conversion
