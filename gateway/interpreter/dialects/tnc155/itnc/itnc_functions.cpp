#include <fmt/format.h>
#include <algorithm>
#include <charconv>

#include "gateway/interpreter/dialects/tnc155/itnc/itnc_reader.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/ranges.hpp"

namespace dripline::interpreter::tnc155::itnc {
namespace {

constexpr std::size_t kMaxSteps = 200;
constexpr int kMaxDepth = 24;  ///< of brackets and functions

using Kind = FormulaStep::Kind;

struct FunctionName {
  std::string_view name;
  FormulaFunction function;
};
/// Longer names before those they begin with.
constexpr std::array kFunctions{
    FunctionName{"SQRT", FormulaFunction::Sqrt}, FunctionName{"SQ", FormulaFunction::Sq},
    FunctionName{"SIN", FormulaFunction::Sin},   FunctionName{"COS", FormulaFunction::Cos},
    FunctionName{"TAN", FormulaFunction::Tan},   FunctionName{"ASIN", FormulaFunction::Asin},
    FunctionName{"ACOS", FormulaFunction::Acos}, FunctionName{"ATAN", FormulaFunction::Atan},
    FunctionName{"LN", FormulaFunction::Ln},     FunctionName{"LOG", FormulaFunction::Log},
    FunctionName{"EXP", FormulaFunction::Exp},   FunctionName{"NEG", FormulaFunction::Neg},
    FunctionName{"INT", FormulaFunction::Int},   FunctionName{"ABS", FormulaFunction::Abs},
    FunctionName{"FRAC", FormulaFunction::Frac}, FunctionName{"SGN", FormulaFunction::Sgn}};

bool add(Reading& in, Formula& formula, FormulaStep step) {
  if (formula.size() == kMaxSteps) return in.cursor.wrong("the formula is too long");
  formula.push_back(step);
  return true;
}

/// Where a number or a Q parameter should be, the formula ends or has another operator.
bool missing_operand(Reading& in) {
  const char* end = in.cursor.at();
  while (end != in.cursor.begin() && static_cast<unsigned char>(end[-1]) <= ' ') --end;
  const char* begin = end;
  while (begin != in.cursor.begin() && begin[-1] >= 'A' && begin[-1] <= 'Z') --begin;
  if (begin == end && begin != in.cursor.begin()) --begin;
  return in.cursor.wrong(
      ErrorCode::BlockFormatIncorrect, end,
      fmt::format("a number or a Q parameter is missing after {}", std::string_view(begin, end)));
}

bool is_operand_missing(TextCursor& cursor) {
  constexpr std::string_view kAfterOperand = "+-*/%^)=";
  return cursor.is_at_end() || kAfterOperand.find(cursor.peek()) != std::string_view::npos;
}

/// A number of any size, or a Q parameter; without sign.
bool read_operand(Reading& in, Formula& formula) {
  TextCursor& cursor = in.cursor;
  const char* start = (cursor.peek(), cursor.at());
  if (is_operand_missing(cursor)) return missing_operand(in);
  FormulaStep step;
  if (cursor.take('Q')) {
    if (!is_parameter(cursor.at() - 1)) return refuse(in, start);  // QS: a text
    step.kind = Kind::Parameter;
    if (!read_parameter_number(in, step.parameter)) return false;
    const bool is_known = step.parameter == kToolRadius || step.parameter == kToolAxis ||
                          step.parameter == kInchProgram || step.parameter == kToolLength ||
                          is_plane_angle(step.parameter);
    if (is_of_control(step.parameter) && !is_known) return refuse(in, start);
    return add(in, formula, step);
  }
  std::string digits;
  const char* at = cursor.at();
  for (; TextCursor::is_digit(*at) || *at == '.' || *at == ','; ++at) {
    digits += *at == ',' ? '.' : *at;
  }
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), step.number);
  if (digits.empty() || read.ec != std::errc{} || read.ptr != digits.data() + digits.size()) {
    return refuse(in, start);
  }
  cursor.back_to(at);
  return add(in, formula, step);
}

bool read_sum(Reading& in, Formula& formula, int depth);

/// One operand with its sign or function; `is_plain`: without either.
bool read_term(Reading& in, Formula& formula, int depth, bool& is_plain) {
  TextCursor& cursor = in.cursor;
  if (depth > kMaxDepth) return cursor.wrong("too many brackets");
  is_plain = true;
  if (cursor.take('(')) {
    if (!read_sum(in, formula, depth + 1)) return false;
    return cursor.take(')') || cursor.wrong(") is missing");
  }
  if (cursor.take("PI")) return add(in, formula, {.number = Angle::kPi});
  if (cursor.peek() == '+' || cursor.peek() == '-') {
    const bool is_negative = cursor.take('-');
    if (!is_negative) cursor.take('+');
    bool is_inner = false;
    if (!read_term(in, formula, depth + 1, is_inner)) return false;
    is_plain = !is_negative && is_inner;
    return !is_negative ||
           add(in, formula, {.kind = Kind::Function, .function = FormulaFunction::Neg});
  }
  for (const FunctionName& row : kFunctions) {
    if (!cursor.take(row.name)) continue;
    is_plain = false;
    bool is_inner = false;
    return read_term(in, formula, depth + 1, is_inner) &&
           add(in, formula, {.kind = Kind::Function, .function = row.function});
  }
  return read_operand(in, formula);
}

/// The manuals say that powers come before products, and not what -2^2, SQ 2^2 and 2^3^2 are.
bool read_power(Reading& in, Formula& formula, int depth) {
  bool is_plain = false;
  if (!read_term(in, formula, depth, is_plain)) return false;
  if (!in.cursor.take('^')) return true;
  if (!is_plain) return in.cursor.wrong("a sign or a function before ^ without brackets");
  if (!read_term(in, formula, depth, is_plain)) return false;
  if (in.cursor.peek() == '^') return in.cursor.wrong("^ after ^ without brackets");
  return add(in, formula, {.kind = Kind::Operator, .op = '^'});
}

bool read_product(Reading& in, Formula& formula, int depth) {
  if (!read_power(in, formula, depth)) return false;
  for (;;) {
    const char op = in.cursor.peek();
    if (in.cursor.is_at_end() || (op != '*' && op != '/' && op != '%')) return true;
    in.cursor.advance();
    if (!read_power(in, formula, depth) || !add(in, formula, {.kind = Kind::Operator, .op = op})) {
      return false;
    }
  }
}

bool read_sum(Reading& in, Formula& formula, int depth) {
  if (!read_product(in, formula, depth)) return false;
  for (;;) {
    const char op = in.cursor.peek();
    if (in.cursor.is_at_end() || (op != '+' && op != '-')) return true;
    in.cursor.advance();
    if (!read_product(in, formula, depth) ||
        !add(in, formula, {.kind = Kind::Operator, .op = op})) {
      return false;
    }
  }
}

bool read_target(Reading& in) {
  if (!in.cursor.take('Q') || !is_parameter(in.cursor.at() - 1)) return in.cursor.missing("Q");
  const char* start = in.cursor.at();
  if (!read_parameter_number(in, in.block.target)) return false;
  if (is_of_control(in.block.target)) return refuse(in, start);
  return in.cursor.take('=') || in.cursor.missing("=");
}

struct FunctionRow {
  int number;
  std::string_view word;  ///< between the operands, or before the only one
  char op;                ///< 0: a function of one operand
  FormulaFunction function = FormulaFunction::Sqrt;
};
constexpr std::array kCalculations{FunctionRow{1, "+", '+'},
                                   FunctionRow{2, "-", '-'},
                                   FunctionRow{3, "*", '*'},
                                   FunctionRow{4, "DIV", '/'},
                                   FunctionRow{5, "SQRT", 0, FormulaFunction::Sqrt},
                                   FunctionRow{6, "SIN", 0, FormulaFunction::Sin},
                                   FunctionRow{7, "COS", 0, FormulaFunction::Cos},
                                   FunctionRow{8, "LEN", 'L'},
                                   FunctionRow{13, "ANG", 'A'}};

/// FN 0 to FN 8 and FN 13, after the sign of equality.
bool read_calculation(Reading& in, int number) {
  in.block.kind = BlockKind::Assignment;
  Formula& formula = in.words.formula;
  if (!read_target(in)) return false;
  if (number == 0) return read_signed(in, formula) && in.cursor.ends();
  const auto* row =
      std::ranges::find_if(kCalculations, [=](const FunctionRow& r) { return r.number == number; });
  if (row->op == 0) {
    if (!in.cursor.take(row->word)) return in.cursor.missing(row->word);
    if (!read_signed(in, formula) ||
        !add(in, formula, {.kind = Kind::Function, .function = row->function})) {
      return false;
    }
    return in.cursor.ends();
  }
  if (!read_signed(in, formula)) return false;
  if (!in.cursor.take(row->word)) return in.cursor.missing(row->word);
  return read_signed(in, formula) && add(in, formula, {.kind = Kind::Operator, .op = row->op}) &&
         in.cursor.ends();
}

bool read_jump(Reading& in, int number) {
  static constexpr std::array<std::string_view, 4> kRelations{"EQU", "NE", "GT", "LT"};
  const std::string_view relation = kRelations[static_cast<std::size_t>(number - 9)];
  TextCursor& cursor = in.cursor;
  in.block.kind = BlockKind::Comparison;
  in.block.function = static_cast<std::uint8_t>(number);
  if (!cursor.take("IF")) return cursor.missing("IF");
  if (!read_signed(in, in.words.formula)) return false;
  if (!cursor.take(relation)) return cursor.missing(relation);
  if (!read_signed(in, in.words.second)) return false;
  if (!cursor.take("GOTO LBL")) return cursor.missing("GOTO LBL");
  if (cursor.peek() == '"') {
    in.block.target = kNameLabel;
    return read_quoted(in, in.words.name) && cursor.ends();
  }
  return cursor.read_integer(in.block.target, 1, kLastItncLabel, "GOTO LBL") && cursor.ends();
}

bool read_error(Reading& in) {
  in.block.kind = BlockKind::Error;
  in.cursor.take("ERROR");
  in.cursor.take('=');
  return in.cursor.read_integer(in.block.target, 0, 9999, "ERROR") && in.cursor.ends();
}

/// SYSREAD Q1 = ID20 NR1 IDX1, or IDXQ7: the formula is then the index.
bool read_system(Reading& in) {
  in.block.kind = BlockKind::SystemRead;
  if (!in.cursor.take("SYSREAD")) return in.cursor.missing("SYSREAD");
  if (!read_target(in)) return false;
  in.words.ids.assign(3, 0);
  constexpr std::array<std::string_view, 3> kWords{"ID", "NR", "IDX"};
  for (std::size_t i = 0; i < kWords.size() && !in.cursor.is_at_end(); ++i) {
    if (!in.cursor.take(kWords[i])) return in.cursor.missing(kWords[i]);
    if (kWords[i] == "IDX" && in.cursor.peek() == 'Q') {
      in.words.ids[i] = kIndexOfFormula;
      return read_operand(in, in.words.formula) && in.cursor.ends();
    }
    if (!in.cursor.read_integer(in.words.ids[i], 0, 99'999, kWords[i])) return false;
  }
  return in.cursor.ends();
}

/// FN 15: PRINT Q7/Q8/Q9. A number in place of a parameter is a text of the control, which is not
/// known.
bool read_print_of_values(Reading& in) {
  constexpr std::size_t kMostValues = 6;
  in.block.kind = BlockKind::Print;
  if (!in.cursor.take("PRINT")) return in.cursor.missing("PRINT");
  do {
    in.cursor.peek();
    const char* start = in.cursor.at();
    if (!in.cursor.take('Q') || !is_parameter(in.cursor.at() - 1)) return refuse(in, start);
    std::int32_t parameter = 0;
    if (!read_parameter_number(in, parameter)) return false;
    if (parameter >= kFirstRetained) in.words.retained.push_back(parameter);
    if (is_of_control(parameter)) return refuse(in, start);
    if (in.words.ids.size() == kMostValues) return in.cursor.wrong("more than six values");
    in.words.ids.push_back(parameter);
  } while (in.cursor.take('/'));
  return in.cursor.ends();
}

/// F-PRINT TNC:\\MASKS\\M1.A / TNC:\\LOG.TXT; both may have blanks.
bool read_print(Reading& in) {
  in.block.kind = BlockKind::Print;
  if (!in.cursor.take("F-PRINT")) return refuse(in, in.cursor.at());
  in.cursor.peek();
  const std::string_view text(in.cursor.at(), in.end);
  const std::size_t slash = text.find('/');
  const auto trimmed = [](std::string_view part) {
    while (!part.empty() && static_cast<unsigned char>(part.front()) <= ' ') part.remove_prefix(1);
    while (!part.empty() && static_cast<unsigned char>(part.back()) <= ' ') part.remove_suffix(1);
    return std::string(part);
  };
  in.words.name = trimmed(text.substr(0, slash));
  in.words.name.erase(0, in.words.name.find_last_of("\\:") + 1);  // folders are not ours
  if (slash != std::string_view::npos) in.words.target = trimmed(text.substr(slash + 1));
  if (in.words.name.empty()) return in.cursor.missing("the mask of F-PRINT");
  if (in.words.target.empty()) return in.cursor.missing("the target of F-PRINT");
  in.cursor.back_to(in.end);
  return true;
}

}  // namespace

bool read_signed(Reading& in, Formula& formula) {
  const bool is_negative = in.cursor.take('-');
  if (!is_negative) in.cursor.take('+');
  if (!read_operand(in, formula)) return false;
  return !is_negative ||
         add(in, formula, {.kind = Kind::Function, .function = FormulaFunction::Neg});
}

bool read_assignment(Reading& in) {
  in.block.kind = BlockKind::Assignment;
  const char* start = in.cursor.at();
  if (!read_parameter_number(in, in.block.target)) return false;
  if (is_of_control(in.block.target)) return refuse(in, start);
  if (!in.cursor.take('=')) return in.cursor.missing("=");
  return read_sum(in, in.words.formula, 0) && (in.cursor.is_at_end() || refuse(in, in.cursor.at()));
}

bool read_function(Reading& in) {
  const char* start = in.cursor.at() - 2;
  std::int32_t number = 0;
  if (!in.cursor.read_integer(number, 0, 99, "FN")) return false;
  in.cursor.take(':');
  if (number <= 8 || number == 13) return read_calculation(in, number);
  if (number <= 12) return read_jump(in, number);
  if (number == 14) return read_error(in);
  if (number == 15) return read_print_of_values(in);
  if (number == 16) return read_print(in);
  if (number == 18) return read_system(in);
  return refuse(in, start);
}

}  // namespace dripline::interpreter::tnc155::itnc
