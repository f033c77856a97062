#include "gateway/interpreter/dialects/fanuc/reading/keywords.hpp"

#include <array>

#include "gateway/interpreter/core/language/spelling.hpp"

namespace dripline::interpreter::fanuc {
namespace {

using language::Operator;
using language::Spelling;

constexpr std::array kKeywords{
    Spelling<Keyword>{"IF", Keyword::If},       Spelling<Keyword>{"THEN", Keyword::Then},
    Spelling<Keyword>{"GOTO", Keyword::Goto},   Spelling<Keyword>{"WHILE", Keyword::While},
    Spelling<Keyword>{"DO", Keyword::Do},       Spelling<Keyword>{"END", Keyword::End},
    Spelling<Keyword>{"SETVN", Keyword::Setvn}, Spelling<Keyword>{"POPEN", Keyword::Popen},
    Spelling<Keyword>{"PCLOS", Keyword::Pclos}, Spelling<Keyword>{"DPRNT", Keyword::Dprnt},
    Spelling<Keyword>{"BPRNT", Keyword::Bprnt},
};
constexpr std::array kFunctions{
    Spelling<Function>{"SIN", Function::Sin},     Spelling<Function>{"COS", Function::Cos},
    Spelling<Function>{"TAN", Function::Tan},     Spelling<Function>{"ASIN", Function::Asin},
    Spelling<Function>{"ACOS", Function::Acos},   Spelling<Function>{"ATAN", Function::Atan},
    Spelling<Function>{"SQRT", Function::Sqrt},   Spelling<Function>{"ABS", Function::Abs},
    Spelling<Function>{"LN", Function::Ln},       Spelling<Function>{"EXP", Function::Exp},
    Spelling<Function>{"ROUND", Function::Round}, Spelling<Function>{"FIX", Function::Fix},
    Spelling<Function>{"FUP", Function::Fup},     Spelling<Function>{"BIN", Function::Bin},
    Spelling<Function>{"BCD", Function::Bcd},     Spelling<Function>{"POW", Function::Pow},
};
constexpr std::array kOperators{Spelling<Operator>{"*", Operator::Multiply},
                                Spelling<Operator>{"/", Operator::Divide},
                                Spelling<Operator>{"+", Operator::Add},
                                Spelling<Operator>{"-", Operator::Subtract},
                                Spelling<Operator>{"MOD", Operator::Modulo},
                                Spelling<Operator>{"AND", Operator::And},
                                Spelling<Operator>{"OR", Operator::Or},
                                Spelling<Operator>{"XOR", Operator::ExclusiveOr},
                                Spelling<Operator>{"EQ", Operator::Equal},
                                Spelling<Operator>{"NE", Operator::NotEqual},
                                Spelling<Operator>{"GT", Operator::Greater},
                                Spelling<Operator>{"LT", Operator::Less},
                                Spelling<Operator>{"GE", Operator::GreaterOrEqual},
                                Spelling<Operator>{"LE", Operator::LessOrEqual}};

/// `word`, or its first letters, two or more, where no letter follows.
bool take_cut_word(const char*& at, std::string_view word) {
  constexpr std::size_t kLeast = 2;
  const char* next = at;
  const char* after = at;
  std::size_t taken = 0;
  for (; taken < word.size(); ++taken) {
    next = skip_blanks(next);
    if (language::capital<kCharKinds>(*next) != word[taken]) break;
    after = ++next;
  }
  if (taken < word.size() && (taken < kLeast || is_letter(*next))) return false;
  at = after;
  return true;
}

template <class Table>
auto take_from(const Table& table, const char*& at) {
  const char* next = skip_blanks(at);
  const char first = language::capital<kCharKinds>(*next);
  for (const auto& spelling : table) {
    if (spelling.text[0] != first || !take_cut_word(next, spelling.text)) continue;
    at = next;
    return spelling.meaning;
  }
  return decltype(table[0].meaning){};
}

}  // namespace

int rank(language::Operator op) {
  switch (op) {
    case Operator::None:
      return 0;
    case Operator::Multiply:
    case Operator::Divide:
    case Operator::Modulo:
    case Operator::And:
      return 3;
    case Operator::Add:
    case Operator::Subtract:
    case Operator::Or:
    case Operator::ExclusiveOr:
      return 2;
    default:
      return 1;
  }
}

bool take_word(const char*& at, std::string_view word) {
  const char* next = skip_blanks(at);
  if (!take_cut_word(next, word)) return false;
  at = next;
  return true;
}

Keyword take_keyword(const char*& at) {
  return take_from(kKeywords, at);
}
Function take_function(const char*& at) {
  return take_from(kFunctions, at);
}
language::Operator operator_at(const char* at, const char*& after) {
  after = skip_blanks(at);
  const Operator op = language::take_spelling<kCharKinds>(kOperators, after);
  if (op == Operator::None) after = at;
  return op;
}

}  // namespace dripline::interpreter::fanuc
