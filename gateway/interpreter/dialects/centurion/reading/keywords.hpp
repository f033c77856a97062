#pragma once

#include <cstdint>
#include <string_view>

#include "gateway/interpreter/core/language/function.hpp"

/// The words of several letters; blanks inside them mean nothing (manual: addresses and keywords).
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

using language::Function;

/// Moves `at` past `word` (in capitals) when the text continues with it.
bool take_word(const char*& at, std::string_view word);

/// The keyword at `at`, which moves past it; None leaves it where it is.
Keyword take_keyword(const char*& at);
Function take_function(const char*& at);
/// The operator at `at` and where it ends; None when the text continues with something else.
language::Operator operator_at(const char* at, const char*& after);

}  // namespace dripline::interpreter::centurion
