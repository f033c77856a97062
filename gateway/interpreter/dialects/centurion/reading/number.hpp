#pragma once

#include "gateway/interpreter/core/language/number.hpp"
#include "gateway/interpreter/dialects/centurion/reading/characters.hpp"

/// Numbers as this control reads them: calculator format, a whole number means whole units, blanks
/// may be anywhere, also between digits (manual: numbers; section 1.4).
namespace dripline::interpreter::centurion {

using Number = NumberText;

/// Digits as written, leading zeros included.
inline unsigned digits_of(const Number& number) {
  return unsigned{number.leading} + number.trailing;
}

/// Reads the number at `at` and leaves `at` after it. The text must end with an end-of-block
/// character: it stops the reading, so there is no other end to look for.
inline Number read_number(const char*& at) {
  Number number;
  at = interpreter::read_number<NumberRules{.skip_blanks = true}>(at, nullptr, number);
  return number;
}

}  // namespace dripline::interpreter::centurion
