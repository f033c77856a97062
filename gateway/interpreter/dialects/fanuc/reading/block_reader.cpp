#include "gateway/interpreter/dialects/fanuc/reading/block_reader.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/core/language/number.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/statements.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/variable_names.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/call_arguments.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/expression_reader.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/g_words.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/keywords.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/program_name.hpp"

namespace dripline::interpreter::fanuc {
namespace {

constexpr AddressSet kNoMinus = set_of(D, F, H, L, P, S, T);
constexpr AddressSet kNoPoint = set_of(D, H, L, P, S, T);

bool is_end(const Run& run, const char* at) {
  return *at == '\n' ? at == run.text.end() : *at == ';' && run.options.semicolon_eob;
}

/// Whether the CR at `at` belongs to the line's end. One in the middle is a line end of a file
/// without LF: read as a blank it would make one block of all of them.
bool ends_line(const Run& run, const char* at) {
  while (at != run.text.end() && kind_of(*at) == CharKind::Blank) ++at;
  return is_end(run, at);
}

bool refuse_number(Run& run, const char* at, const NumberText& number) {
  switch (number.fault) {
    case NumberFault::TooManyDigits:
      return run.fail(ErrorCode::TooManyDigits, run.column(at));
    case NumberFault::SecondPoint:
      return run.fail(ErrorCode::DecimalPoint, run.column(at), "two points in one number");
    default:
      return run.fail(ErrorCode::NoData, run.column(at));
  }
}

/// A code or number that must be whole and not negative.
bool read_whole(Run& run, const Word& word, double most, double& value) {
  value = run.whole(word);
  if (word.is_negative && word.form != WordForm::Computed) {
    return run.fail(ErrorCode::NegativeSign, word.column);
  }
  if (word.form == WordForm::Point) return run.fail(ErrorCode::DecimalPoint, word.column);
  if (value >= 0 && value <= most) return true;
  return run.fail(ErrorCode::TooManyDigits, word.column,
                  fmt::format("{} is above {}", value, most));
}

bool add_m(Run& run, const Word& word) {
  Block& block = run.block;
  constexpr double kMaxM = 99'999'999;
  double value = 0;
  if (!read_whole(run, word, kMaxM, value)) return false;
  if (calls_macro_by_m(run, value)) [[unlikely]]
    return begin_code_call(run, CodeCall::M, value, word.column);
  if (block.parts.m_count == Block::kMaxM) {
    return run.fail(ErrorCode::ImproperCommand, word.column, "too many M codes");
  }
  if (block.parts.m_count == 1) block.warn(WarningCode::SeveralM, word.column);
  block.m[block.parts.m_count++] = static_cast<std::int32_t>(value);
  return true;
}

bool set_sequence(Run& run, const Word& word) {
  if (word.form == WordForm::Computed) return run.fail(ErrorCode::MacroFormat, word.column);
  double value = 0;
  if (!read_whole(run, word, run.options.last_sequence, value)) return false;
  run.origin.sequence = static_cast<std::int64_t>(value);
  return true;
}

/// An O word within a block; at its head it names the program.
bool begin_program(Run& run, const Word& word) {
  if (word.form == WordForm::Computed) return run.fail(ErrorCode::MacroFormat, word.column);
  if (run.block.parts.has_code) {
    return run.fail(ErrorCode::IllegalAddress, word.column, "O is first in its block");
  }
  double value = 0;
  const double most = run.options.program_digits == 8 ? 99'999'999 : 9999;
  if (!read_whole(run, word, most, value)) return false;
  if (value == 0) return run.fail(ErrorCode::IllegalProgramNumber, word.column, "O0");
  run.state.last.o = static_cast<int>(value);
  if (run.state.at.program == kMainProgram && !run.name_is_settled) {
    run.name = fmt::format("O{:04}", static_cast<int>(value));
  }
  return true;
}

bool add_other(Run& run, Address address, const Word& word) {
  Block& block = run.block;
  if (block.words.has(address)) [[unlikely]] {
    block.warn(WarningCode::DuplicateWord, word.column);
  }
  block.words.set(address, word);
  return true;
}

bool add_word(Run& run, char letter, const Word& word) {
  Block& block = run.block;
  if (block.parts.kind == BlockKind::Call) [[unlikely]]
    return add_argument(run, letter, word);
  switch (letter) {
    case 'G':
      block.parts.has_code = true;
      return add_g(run, word);
    case 'M':
      block.parts.has_code = true;
      return add_m(run, word);
    case 'N':
      block.parts.has_code = true;
      return set_sequence(run, word);
    case 'O':
      return begin_program(run, word);
    case 'T':
      if (run.options.t_macro && !is_in_code_call(run)) {
        return begin_code_call(run, CodeCall::T, run.whole(word), word.column);
      }
      break;
    case 'E':
      return run.fail(ErrorCode::IllegalAddress, word.column, "E");
    default:
      break;
  }
  return add_other(run, address_of(letter), word);
}

/// ROUND in a word goes to the least increment of its address.
double least_of(const Run& run, char letter) {
  if (letter == 'A' || letter == 'B' || letter == 'C') return 1 / run.increments.per_degree;
  return (set_of(address_of(letter)) & (kLinearWords | kCenterWords | set_of(R, Q))) != 0
             ? 1 / run.increments.per_unit
             : 1;
}

/// The value is a variable or an expression. A null one is as if the word was not there.
bool read_computed_word(Run& run, char letter, const char* start, const char*& at) {
  Word word;
  word.column = static_cast<std::uint16_t>(run.column(start));
  word.form = WordForm::Computed;
  if (!read_operand(run, at, least_of(run, letter), word.value)) return false;
  if (std::isnan(word.value)) return true;
  word.is_negative = std::signbit(word.value);
  return add_word(run, letter, word);
}

/// A letter that no number follows directly: a variable, an expression, a control word.
bool read_spelled_item(Run& run, char letter, const char*& at) {
  const char* start = at;
  const char* value = skip_blanks(at + 1);
  const char* operand = kind_of(*value) == CharKind::Sign ? skip_blanks(value + 1) : value;
  if (*operand == '#' || *operand == '[') {
    at = value;
    return read_computed_word(run, letter, start, at);
  }
  if (letter == 'O' && *value == '<' && !run.block.parts.has_code) {
    at = value;
    return read_program_name(run, at);
  }
  if (is_letter(*value)) {
    if (const Keyword keyword = take_keyword(at); keyword != Keyword::None) {
      return read_statement(run, keyword, start, at);
    }
  }
  return run.fail(ErrorCode::NoData, run.column(start), std::string_view(&letter, 1));
}

/// `/` or `/n`: with its switch on, nothing after it counts.
bool read_skip(Run& run, const char*& at) {
  const char* start = at;
  at = skip_blanks(at + 1);
  unsigned level = 1;
  if (*at == '#' || *at == '[') return run.fail(ErrorCode::MacroFormat, run.column(start));
  if (is_digit(*at)) {
    level = static_cast<unsigned>(*at - '0');
    ++at;
  }
  if (level == 0) return run.fail(ErrorCode::IllegalAddress, run.column(start), "/0");
  run.block.parts.has_code = true;
  if ((run.skip_levels >> level & 1u) != 0) at = find_block_end(run, at);
  return true;
}

/// `,R` or `,C`: what becomes of the corner at the end of the block's move.
bool read_corner_word(Run& run, const char*& at) {
  const char* start = at;
  at = skip_blanks(at + 1);
  const char letter = is_letter(*at) ? upper(*at) : *at;
  if (letter != 'R' && letter != 'C') {
    return run.fail(ErrorCode::IllegalAddress, run.column(start), "R or C is expected here");
  }
  Block::Parts& parts = run.block.parts;
  if (parts.kind != BlockKind::Nc) return run.fail(ErrorCode::IllegalAddress, run.column(start));
  if (parts.corner != CornerKind::None) {
    return run.fail(ErrorCode::CornerOfNoMove, run.column(start), "two corners in one block");
  }
  const char* value = skip_blanks(at + 1);
  Word word;
  word.column = static_cast<std::uint16_t>(run.column(start));
  if (*value == '#' || *value == '[') {
    at = value;
    word.form = WordForm::Computed;
    if (!read_operand(run, at, 1 / run.increments.per_unit, word.value)) return false;
    if (std::isnan(word.value)) return true;
  } else {
    NumberText number;
    const char* after = read_number<NumberRules{.skip_blanks = true}>(value, nullptr, number);
    if (number.fault != NumberFault::None) return refuse_number(run, value, number);
    word.value = number.value;
    word.decimals = number.trailing;
    word.form = number.has_point ? WordForm::Point : WordForm::Whole;
    at = after;
  }
  if (word.value < 0) return run.fail(ErrorCode::NegativeSign, word.column);
  parts.corner = letter == 'R' ? CornerKind::Round : CornerKind::Chamfer;
  parts.corner_size = run.length(word);
  parts.corner_column = word.column;
  parts.groups |= 1u << kCornerBit;
  return true;
}

bool read_other_item(Run& run, const char*& at) {
  switch (*at) {
    case '(':
      skip_gaps(run, at);
      return true;
    case '#':
      run.block.parts.has_code = true;
      return read_assignment_block(run, at);
    case '[':
      if (!is_named_variable(at)) break;
      run.block.parts.has_code = true;
      return read_assignment_block(run, at);
    case ',':
      run.block.parts.has_code = true;
      return read_corner_word(run, at);
    case '/':
      return read_skip(run, at);
    case '<':
      return read_program_name(run, at);
    case ':': {
      const char* value = skip_blanks(at + 1);
      NumberText number;
      const char* after = read_number<NumberRules{.skip_blanks = true}>(value, nullptr, number);
      if (number.fault != NumberFault::None) return refuse_number(run, value, number);
      Word word{number.value, static_cast<std::uint16_t>(run.column(at)), number.trailing,
                number.has_point ? WordForm::Point : WordForm::Whole, number.is_negative};
      at = after;
      return begin_program(run, word);
    }
    default:
      break;
  }
  const CharKind kind = kind_of(*at);
  if (kind == CharKind::Digit || kind == CharKind::Point || kind == CharKind::Sign) {
    return run.fail(ErrorCode::AddressNotFound, run.column(at));
  }
  if (kind == CharKind::Bad) {
    return run.fail(ErrorCode::IllegalAddress, run.column(at),
                    fmt::format("code {}", static_cast<unsigned char>(*at)));
  }
  return run.fail(ErrorCode::IllegalAddress, run.column(at), std::string_view(at, 1));
}

void note_lower_case(Run& run, const char* at) {
  if (run.state.told_lower_case) return;
  run.block.warn(WarningCode::LowerCase, run.column(at));
}

/// Signs and points where none may stand.
bool check_forms(Run& run) {
  const Block::Parts& parts = run.block.parts;
  const bool is_scaling = run.block.names(kScalingGroup) && run.block.g[kScalingGroup] == 51;
  const AddressSet scale = is_scaling ? set_of(P) : 0;
  const Words& words = run.block.words;
  const AddressSet axis = run.options.is_lathe ? set_of(H) : 0;  // an increment of C
  if (const AddressSet bad = parts.negatives & kNoMinus & ~axis & ~scale & words.present();
      bad != 0) {
    return run.fail(ErrorCode::NegativeSign, words.first_column(bad));
  }
  if (const AddressSet bad = parts.points & kNoPoint & ~axis & ~scale & words.present(); bad != 0) {
    return run.fail(ErrorCode::DecimalPoint, words.first_column(bad));
  }
  return true;
}

}  // namespace

const Block::Parts kFreshParts{};

const char* find_block_end(const Run& run, const char* at) {
  const char* end = run.text.end();
  bool in_comment = false;
  for (; at != end; ++at) {
    if (*at == '(') in_comment = true;
    if (*at == ')') in_comment = false;
    if (*at == ';' && !in_comment && run.options.semicolon_eob) return at;
  }
  return end;
}

void skip_gaps(Run& run, const char*& at) {
  for (;;) {
    at = skip_blanks(at);
    if (*at != '(') return;
    const char* start = at;
    while (*at != ')' && at != run.text.end()) ++at;
    if (*at == ')') {
      ++at;
      continue;
    }
    run.block.warn(WarningCode::OpenComment, run.column(start));
    return;
  }
}

bool read_block(Run& run) {
  Block& block = run.block;
  const char* at = run.text.begin();
  for (;;) {
    const char c = *at;
    const CharKind kind = kind_of(c);
    if (kind == CharKind::Blank) {
      if (c == '\r' && block.parts.has_code && !ends_line(run, at)) [[unlikely]]
        return run.fail(ErrorCode::IllegalAddress, run.column(at), "a CR without LF ends no block");
      ++at;
      continue;
    }
    if (kind != CharKind::Letter) [[unlikely]] {
      if (is_end(run, at)) break;
      if (block.parts.kind == BlockKind::Macro && c != '(') {
        return run.fail(ErrorCode::MixedStatement, run.column(at));
      }
      if (!read_other_item(run, at)) return false;
      continue;
    }
    const char letter = upper(c);
    if (letter != c) [[unlikely]]
      note_lower_case(run, at);
    if (block.parts.kind == BlockKind::Macro) [[unlikely]]
      return run.fail(ErrorCode::MixedStatement, run.column(at));
    const char* value = skip_blanks(at + 1);
    NumberText number;
    const char* after = read_number<NumberRules{.skip_blanks = true}>(value, nullptr, number);
    if (number.fault != NumberFault::None) [[unlikely]] {
      if (number.fault != NumberFault::NoDigits) return refuse_number(run, value, number);
      if (!read_spelled_item(run, letter, at)) return false;
      block.parts.has_code = true;
      continue;
    }
    // made where it is kept: a copy would have to wait for its parts
    const auto word = [&, column = static_cast<std::uint16_t>(run.column(at))] {
      return Word{number.value, column, number.trailing,
                  number.has_point ? WordForm::Point : WordForm::Whole, number.is_negative};
    };
    at = after;
    const auto address = address_of(letter);
    if (number.is_negative) block.parts.negatives |= set_of(address);
    if (number.has_point) block.parts.points |= set_of(address);
    if (letter >= 'X' && block.parts.kind == BlockKind::Nc && !block.words.has(address))
        [[likely]] {
      block.words.set(address, word());
    } else if (!add_word(run, letter, word())) {
      return false;
    }
    block.parts.has_code = true;
  }
  block.parts.end = run.offset(at);
  if (block.parts.name_end != 0 && !check_program_name(run)) [[unlikely]]
    return false;
  if (((block.parts.negatives & kNoMinus) | (block.parts.points & kNoPoint)) != 0) [[unlikely]]
    return block.parts.kind != BlockKind::Nc || check_forms(run);
  return true;
}

}  // namespace dripline::interpreter::fanuc
