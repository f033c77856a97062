#include "gateway/interpreter/dialects/centurion/reading/keywords.hpp"

#include <array>

#include "gateway/interpreter/core/language/spelling.hpp"

namespace dripline::interpreter::centurion {
namespace {

using language::Operator;
using language::Spelling;

constexpr std::array kKeywords{
    Spelling<Keyword>{"IF", Keyword::If},         Spelling<Keyword>{"THEN", Keyword::Then},
    Spelling<Keyword>{"WHILE", Keyword::While},   Spelling<Keyword>{"WEND", Keyword::Wend},
    Spelling<Keyword>{"GOTO", Keyword::Goto},     Spelling<Keyword>{"GOSUB", Keyword::Gosub},
    Spelling<Keyword>{"RETURN", Keyword::Return}, Spelling<Keyword>{"CALL", Keyword::Call},
    Spelling<Keyword>{"PRINT", Keyword::Print},   Spelling<Keyword>{"DPRNT", Keyword::Dprnt},
    Spelling<Keyword>{"POPEN", Keyword::Popen},   Spelling<Keyword>{"PCLOS", Keyword::Pclos},
    Spelling<Keyword>{"INPUT", Keyword::Input},   Spelling<Keyword>{"HDW", Keyword::Hdw},
    Spelling<Keyword>{"CLR", Keyword::Clr},       Spelling<Keyword>{"SET", Keyword::Set},
    Spelling<Keyword>{"PULSE0", Keyword::Pulse0}, Spelling<Keyword>{"PULSE1", Keyword::Pulse1},
    Spelling<Keyword>{"PROBE1", Keyword::Probe1}, Spelling<Keyword>{"PROBE2", Keyword::Probe2},
    Spelling<Keyword>{"TANA", Keyword::Tana},     Spelling<Keyword>{"TANL", Keyword::Tanl},
    Spelling<Keyword>{"CGEN", Keyword::Cgen},     Spelling<Keyword>{"BACK", Keyword::Back},
};

constexpr std::array kFunctions{
    Spelling<Function>{"SIN", Function::Sin},     Spelling<Function>{"COS", Function::Cos},
    Spelling<Function>{"TAN", Function::Tan},     Spelling<Function>{"ATAN", Function::Atan},
    Spelling<Function>{"SQRT", Function::Sqrt},   Spelling<Function>{"ABS", Function::Abs},
    Spelling<Function>{"INT", Function::Int},     Spelling<Function>{"RND", Function::Rnd},
    Spelling<Function>{"LN", Function::Ln},       Spelling<Function>{"EXP", Function::Exp},
    Spelling<Function>{"ROUND", Function::Round}, Spelling<Function>{"PIN", Function::Pin},
};

/// Longer spellings before their beginnings.
constexpr std::array kOperators{
    Spelling<Operator>{"**", Operator::Power},
    Spelling<Operator>{"*", Operator::Multiply},
    Spelling<Operator>{"/", Operator::Divide},
    Spelling<Operator>{"DIV", Operator::IntegerDivide},
    Spelling<Operator>{"MOD", Operator::Modulo},
    Spelling<Operator>{"+", Operator::Add},
    Spelling<Operator>{"-", Operator::Subtract},
    Spelling<Operator>{"<>", Operator::NotEqual},
    Spelling<Operator>{"<=", Operator::LessOrEqual},
    Spelling<Operator>{"<", Operator::Less},
    Spelling<Operator>{">=", Operator::GreaterOrEqual},
    Spelling<Operator>{">", Operator::Greater},
    Spelling<Operator>{"=", Operator::Equal},
    Spelling<Operator>{"EQ", Operator::Equal},
    Spelling<Operator>{"NE", Operator::NotEqual},
    Spelling<Operator>{"LT", Operator::Less},
    Spelling<Operator>{"LE", Operator::LessOrEqual},
    Spelling<Operator>{"GT", Operator::Greater},
    Spelling<Operator>{"GE", Operator::GreaterOrEqual},
};

}  // namespace

std::string_view to_string(Keyword keyword) {
  for (const auto& spelling : kKeywords) {
    if (spelling.meaning == keyword) return spelling.text;
  }
  return "";
}

bool take_word(const char*& at, std::string_view word) {
  return language::take_word<kCharKinds>(at, word);
}

Keyword take_keyword(const char*& at) {
  return language::take_spelling<kCharKinds>(kKeywords, at);
}
Function take_function(const char*& at) {
  return language::take_spelling<kCharKinds>(kFunctions, at);
}

Operator operator_at(const char* at, const char*& after) {
  after = at;
  return language::take_spelling<kCharKinds>(kOperators, after);
}

}  // namespace dripline::interpreter::centurion
