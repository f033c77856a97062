#include "gateway/interpreter/dialects/centurion/reading/block_reader.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/codes/m_codes.hpp"
#include "gateway/interpreter/dialects/centurion/flow/macro_calls.hpp"
#include "gateway/interpreter/dialects/centurion/flow/statements.hpp"
#include "gateway/interpreter/dialects/centurion/motion/corner_words.hpp"
#include "gateway/interpreter/dialects/centurion/reading/expression_reader.hpp"
#include "gateway/interpreter/dialects/centurion/reading/text_cursor.hpp"
#include "gateway/interpreter/dialects/centurion/reading/text_search.hpp"

namespace dripline::interpreter::centurion {
namespace {

Address address_of(char letter) {
  return static_cast<Address>(upper(letter) - 'A');
}

/// A value, with what is needed to check it.
struct WordText {
  const char* start;  ///< of the address
  double value;
  unsigned digits;  ///< 0 for an expression
};

bool refuse_number(Run& run, const char* start, const Number& number) {
  switch (number.fault) {
    case NumberFault::TooManyDigits:
      return run.fail(ErrorCode::TooManyDigits, run.column(start));
    case NumberFault::SecondPoint:
      return run.fail(ErrorCode::TwoPoints, run.column(start));
    default:
      return run.fail(ErrorCode::BadNumber, run.column(start), "a number is expected here");
  }
}

bool add_word(Run& run, Address address, const WordText& word) {
  Words& words = run.block.words;
  if (words.has(address)) [[unlikely]] {
    return run.fail(ErrorCode::DuplicateAddress, run.column(word.start), to_string(address));
  }
  words.set(address, word.value, run.column(word.start));
  return true;
}

/// The time of G4 is the word that directly follows it (manual: G4).
bool read_dwell(Run& run, const char*& at) {
  constexpr double kLeast = 0.01;
  constexpr double kMax = 9999.99;
  if (!skip_gaps(run, at)) return false;
  const char* start = at;
  const char letter = kind_of(*at) == CharKind::Letter ? upper(*at) : '\0';
  if (letter != 'F' && letter != 'P' && letter != 'X') {
    return run.fail(ErrorCode::IllegalDwell, run.column(start), "G4 must be followed by F, P or X");
  }
  ++at;
  double seconds = 0;
  unsigned digits = 0;
  if (!read_word_value(run, at, seconds, digits)) return false;
  if (!(seconds >= kLeast && seconds <= kMax)) {
    return run.fail(ErrorCode::DwellOutOfRange, run.column(start),
                    fmt::format("{} is not in {} to {} s", seconds, kLeast, kMax));
  }
  run.block.parts.dwell = seconds;
  return true;
}

bool refuse_g(Run& run, const WordText& word, const char* why) {
  return run.fail(ErrorCode::UnknownGCode, run.column(word.start),
                  fmt::format("G{}{}", word.value, why));
}

bool add_g(Run& run, const WordText& word, const char*& at) {
  Block& block = run.block;
  const bool is_whole =
      word.value >= 0 && word.value < 1000 && word.value == std::trunc(word.value);
  std::uint8_t index = is_whole ? g_row_index(static_cast<unsigned>(word.value)) : kNoRow;
  if (is_whole && run.options.has_custom_codes) [[unlikely]] {
    const auto program = custom_program_of_g(run, static_cast<unsigned>(word.value));
    if (program != 0) {
      if (!request_macro(run, program, MacroCaller::CustomCode, run.column(word.start)))
        return false;
      index = g_row_index(65);
    }
  }
  if (index == kNoRow) [[unlikely]]
    return refuse_g(run, word, "");
  if (run.options.is_dnc_fast && word.value == 90) [[unlikely]]
    index = g_row_index(93);  // in FAST G90 is "absolute" (manual: DNC)
  const GRow& row = g_row(index);
  if (row.kind != GKind::Motion) [[unlikely]] {
    if (row.act != nullptr) {
      if (block.parts.axis_row != kNoRow) {
        return run.fail(ErrorCode::IllegalStatement, run.column(word.start),
                        fmt::format("G{} and G{} both use the axis words", row.code,
                                    g_row(block.parts.axis_row).code));
      }
      block.parts.axis_row = index;
    }
    if (row.kind == GKind::ThreadLine)
      block.parts.thread_code = static_cast<std::uint8_t>(row.code);
    if (row.kind == GKind::Dwell && !read_dwell(run, at)) return false;
    block.parts.taken |= row.words;
  }
  if (block.parts.g_count == Block::kMaxCodes) [[unlikely]] {
    return run.fail(ErrorCode::IllegalStatement, run.column(word.start), "too many G codes");
  }
  block.g[block.parts.g_count++] = index;
  return true;
}

bool add_m(Run& run, const WordText& word) {
  Block& block = run.block;
  if (!(word.value >= 0 && word.value <= kHighestM) || word.value != std::trunc(word.value) ||
      word.digits == 0) {
    return run.fail(ErrorCode::IllegalStatement, run.column(word.start),
                    fmt::format("M{} is not a whole number from 0 to {}", word.value, kHighestM));
  }
  if (run.options.has_custom_codes) [[unlikely]] {
    const auto program = custom_program_of_m(run, static_cast<unsigned>(word.value));
    if (program != 0)
      return request_macro(run, program, MacroCaller::CustomCode, run.column(word.start));
  }
  if (block.parts.m_count == Block::kMaxCodes) {
    return run.fail(ErrorCode::IllegalStatement, run.column(word.start), "too many M codes");
  }
  block.m[block.parts.m_count++] = static_cast<std::uint8_t>(word.value);
  return true;
}

/// T2 names a tool, T0215 a tool and an offset (manual: T word).
bool add_tool(Run& run, const WordText& word) {
  Block::Parts& parts = run.block.parts;
  if (parts.tool) return run.fail(ErrorCode::DuplicateAddress, run.column(word.start), "T");
  const bool has_offset = word.digits == 0 || word.digits > 2;
  const double most = has_offset ? 9999 : 99;
  if (!(word.value >= 0 && word.value <= most) || word.value != std::trunc(word.value) ||
      word.digits > 4) {
    return run.fail(ErrorCode::IllegalTool, run.column(word.start), fmt::format("T{}", word.value));
  }
  const int value = static_cast<int>(word.value);
  parts.tool = has_offset ? value / 100 : value;
  if (*parts.tool > kOffsetCount) {
    return run.fail(ErrorCode::IllegalTool, run.column(word.start),
                    fmt::format("{} is above {}", *parts.tool, kOffsetCount));
  }
  if (!has_offset) return true;
  parts.tool_offset = value % 100;
  if (parts.tool_offset <= kOffsetCount) return true;
  return run.fail(ErrorCode::IllegalOffset, run.column(word.start),
                  fmt::format("{} is above {}", parts.tool_offset, kOffsetCount));
}

bool set_sequence(Run& run, const WordText& word) {
  constexpr double kMax = 99999;
  if (!(word.value >= 0 && word.value <= kMax) || word.value != std::trunc(word.value)) {
    return run.fail(ErrorCode::ParameterOutOfRange, run.column(word.start),
                    fmt::format("N{} is not a whole number from 0 to {}", word.value, kMax));
  }
  run.origin.sequence = static_cast<std::int64_t>(word.value);
  return true;
}

/// An O word begins a program and ends the one before it (manual: RS-232, data format).
bool begin_program(Run& run, const WordText& word) {
  if (run.axis_code() == 65) return add_word(run, Address::O, word);
  if (read_head(run.text.begin()).kind != BlockHead::Kind::Program) {
    return run.fail(ErrorCode::IllegalStatement, run.column(word.start),
                    "O must be the first word");
  }
  if (!(word.value >= 1 && word.value <= 9999) || word.value != std::trunc(word.value)) {
    return run.fail(ErrorCode::InvalidProgramNumber, run.column(word.start),
                    fmt::format("O{} is not in 1 to 9999", word.value));
  }
  if (run.state.at.program == kMainProgram && !run.is_name_final) {
    run.name = fmt::format("O{:04}", static_cast<int>(word.value));
  }
  return true;
}

/// P before = is an assignment, else a word.
bool add_p(Run& run, const WordText& word, const char*& at) {
  const char* next = skip_blanks(at);
  if (*next != '=' || word.digits == 0) return add_word(run, Address::P, word);
  at = next + 1;
  return assign_parameter(run, word.value, word.start, at);
}

bool read_byte_assignment(Run& run, const char* start, const char*& at) {
  double number = 0;
  unsigned digits = 0;
  if (!read_word_value(run, at, number, digits)) return false;
  at = skip_blanks(at);
  if (*at != '=') return run.fail(ErrorCode::IllegalStatement, run.column(start), "PB needs =");
  ++at;
  return assign_byte(run, number, start, at);
}

bool add_item(Run& run, const WordText& word, const char*& at) {
  Block::Parts& parts = run.block.parts;
  const Address address = address_of(*word.start);
  switch (address) {
    case Address::G:
      parts.is_assignment_only = false;
      return add_g(run, word, at);
    case Address::M:
      parts.is_assignment_only = false;
      return add_m(run, word);
    case Address::N:
      return set_sequence(run, word);
    case Address::O:
      return begin_program(run, word);
    case Address::P:
      return add_p(run, word, at);
    case Address::T:
      parts.is_assignment_only = false;
      return add_tool(run, word);
    default:
      return add_word(run, address, word);
  }
}

/// XC, ZC, AA, AB with a value; `at` is on the first letter.
bool read_two_letter_word(Run& run, const char*& at, bool& found) {
  struct Spelling {
    std::string_view text;
    Address address;
  };
  static constexpr Spelling kSpellings[] = {
      {"AA", Address::AA}, {"AB", Address::AB}, {"XC", Address::XC}, {"ZC", Address::ZC}};
  const char* start = at;
  for (const Spelling& spelling : kSpellings) {
    found = take_word(at, spelling.text);
    if (!found) continue;
    WordText word{start, 0, 0};
    return read_word_value(run, at, word.value, word.digits) &&
           add_word(run, spelling.address, word);
  }
  return true;
}

/// A letter that is followed by neither a digit, a sign nor a point.
bool read_spelled_item(Run& run, const char*& at) {
  const char* start = at;
  run.begin_item(start);
  const char* next = skip_blanks(at + 1);
  if (*next == '[') {
    if (const char letter = upper(*at); letter == 'G' || letter == 'M') {
      return run.fail(ErrorCode::BadNumber, run.column(at), "G and M take no expression");
    }
    WordText word{start, 0, 0};
    at = next;
    if (!read_word_value(run, at, word.value, word.digits) || !add_item(run, word, at)) {
      return false;
    }
    run.item_done();
    return true;
  }
  bool found = false;
  if (!read_two_letter_word(run, at, found)) return false;
  if (!found) {
    if (const Keyword keyword = take_keyword(at); keyword != Keyword::None) {
      if (!read_statement(run, keyword, start, at)) return false;
    } else if (take_word(at, "PB")) {
      if (!read_byte_assignment(run, start, at)) return false;
    } else {
      return run.fail(ErrorCode::IllegalAddress, run.column(start), std::string_view(start, 1));
    }
  }
  run.item_done();
  return true;
}

bool read_comment(Run& run, const char*& at) {
  const char* start = at;
  for (++at; *at != ')'; ++at) {
    if (is_end_of_block(*at)) return run.fail(ErrorCode::CommentNotClosed, run.column(start));
    if (*at == '\0') return run.fail(ErrorCode::BadCharacter, run.column(at), "NUL");
  }
  TextRange& comment = run.block.parts.comment;
  if (comment.empty()) comment = {run.offset(start + 1), run.offset(at)};
  ++at;
  return true;
}

bool refuse_character(Run& run, const char* at) {
  if (kind_of(*at) == CharKind::Bad) {
    return run.fail(ErrorCode::BadCharacter, run.column(at),
                    fmt::format("code {}", static_cast<unsigned char>(*at)));
  }
  return run.fail(ErrorCode::IllegalStatement, run.column(at), std::string_view(at, 1));
}

/// % alone on its line is a mark of punched tapes.
bool is_lone_percent(const char* begin, const char* at) {
  return skip_blanks(begin) == at && is_end_of_block(*skip_blanks(at + 1));
}

/// Everything that does not begin with a letter.
bool read_other_item(Run& run, const char*& at) {
  switch (kind_of(*at)) {
    case CharKind::OpenComment:
      return read_comment(run, at);
    case CharKind::Other:
      if (*at == '%' && is_lone_percent(run.text.begin(), at)) {
        ++at;
        return true;
      }
      if (*at == '/' && !run.block.parts.has_code) {  // block skip, with the switch off
        run.block.parts.has_code = true;
        ++at;
        return true;
      }
      if (*at == ',') return read_corner_word(run, at);
      [[fallthrough]];
    default:
      return refuse_character(run, at);
  }
}

}  // namespace

bool read_items(Run& run) {
  Block::Parts& parts = run.block.parts;
  const char* at = run.text.begin() + parts.resume;
  for (;;) {
    const CharKind kind = kind_of(*at);
    if (kind == CharKind::Blank) {
      ++at;
      continue;
    }
    if (kind != CharKind::Letter) [[unlikely]] {
      if (kind == CharKind::EndOfBlock) return true;
      if (!read_other_item(run, at)) return false;
      continue;
    }
    parts.has_code = true;
    const char* value = skip_blanks(at + 1);
    const CharKind value_kind = kind_of(*value);
    if (value_kind != CharKind::Digit && value_kind != CharKind::Sign &&
        value_kind != CharKind::Point) [[unlikely]] {
      if (!read_spelled_item(run, at)) return false;
      continue;
    }
    const char* start = at;
    const char* after = value;
    const Number number = read_number(after);
    if (number.fault != NumberFault::None) [[unlikely]]
      return refuse_number(run, value, number);
    const char letter = upper(*start);
    at = after;
    if (letter == 'X' || letter == 'Z') [[likely]] {
      if (!add_word(run, address_of(letter), {start, number.value, digits_of(number)}))
        return false;
      continue;
    }
    if (letter == 'P' || letter == 'G') run.begin_item(start);  // may hold an expression
    if (!add_item(run, {start, number.value, digits_of(number)}, at)) return false;
    run.item_done();
  }
}

}  // namespace dripline::interpreter::centurion
