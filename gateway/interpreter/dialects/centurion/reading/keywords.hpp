#pragma once

#include <cstdint>
#include <string_view>

#include "gateway/interpreter/core/language/expression.hpp"

/// The words of several letters. Blanks inside them carry no information (spec 3.5).
namespace dripline::interpreter::centurion {

enum class Keyword : std::uint8_t {
  None,
  If,
  Then,
  While,
  Wend,
  Goto,
  Gosub,
  Return,
  Call,
  Print,
  Dprnt,
  Popen,
  Pclos,
  Input,
  Hdw,
  Clr,
  Set,
  Pulse0,
  Pulse1,
  Probe1,
  Probe2,
  Tana,
  Tanl,
  Cgen,
  Back,
};
std::string_view to_string(Keyword keyword);

enum class Function : std::uint8_t {
  None,
  Sin,
  Cos,
  Tan,
  Atan,
  Sqrt,
  Abs,
  Int,
  Rnd,
  Ln,
  Exp,
  Round,
  Pin,
};

/// Whether `word` (capitals) stands at `at`, blanks between its letters allowed; then `at` moves
/// after it.
bool take_word(const char*& at, std::string_view word);

/// The longest keyword at `at`, which then moves after it; None leaves it.
Keyword take_keyword(const char*& at);
Function take_function(const char*& at);
/// The operator at `at` and where it ends; None when something else stands there.
language::Operator operator_at(const char* at, const char*& after);

}  // namespace dripline::interpreter::centurion
