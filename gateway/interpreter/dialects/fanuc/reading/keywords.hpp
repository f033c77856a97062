#pragma once

#include <cstdint>
#include <string_view>

#include "gateway/interpreter/core/language/function.hpp"

/// The words of custom macro B. Capitals or not; blanks within mean nothing.
namespace dripline::interpreter::fanuc {

enum class Keyword : std::uint8_t {
  None,
  If,
  Then,
  Goto,
  While,
  Do,
  End,
  Popen,
  Pclos,
  Dprnt,
  Bprnt  // clang-format off
};  // clang-format on
using language::Function;
// clang-format on
/// 3 products and AND, 2 sums, OR and XOR, 1 comparisons, 0 none.
int rank(language::Operator op);

/// Moves `at` past `word` when the text continues with it.
bool take_word(const char*& at, std::string_view word);
Keyword take_keyword(const char*& at);
Function take_function(const char*& at);
/// The operator at `at`, and where it ends.
language::Operator operator_at(const char* at, const char*& after);

}  // namespace dripline::interpreter::fanuc
