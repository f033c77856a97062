#include "gateway/interpreter/dialects/rs274ngc/reading/block_reader.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/rs274ngc/memory/parameter_access.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/comments.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/expression_reader.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/number_reader.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/words.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

constexpr AddressSet kNistLetters = set_of("ABCDFHIJKLPQRSTXYZ");
constexpr AddressSet kLaterLetters = set_of("ABCDEFHIJKLPQRSTUVWXYZ@^");

/// Letters with rules on their values.
constexpr AddressSet kChecked = set_of("DFHLPQST");

struct LowestValue {
  char letter;
  DiagnosticRow code;
};
/// Letters whose negative values are refused while reading.
constexpr std::array kNotNegative{
    LowestValue{'F', ErrorCode::NegativeF}, LowestValue{'H', ErrorCode::NegativeH},
    LowestValue{'L', ErrorCode::NegativeL}, LowestValue{'S', ErrorCode::NegativeS},
    LowestValue{'T', ErrorCode::NegativeT}, LowestValue{'D', ErrorCode::NegativeD}};

bool is_whole(Run& run, char letter) {
  if (letter == 'H' || letter == 'D') return !run.is_linuxcnc();
  return letter == 'L' || letter == 'T';
}

/// Rules on the value of one letter: whole, not negative.
bool check_value(Run& run, char letter, double& value, std::uint32_t column) {
  if (is_whole(run, letter)) {
    const double whole = std::round(value);
    if (!(std::fabs(value - whole) <= 0.0001)) {
      return run.fail(ErrorCode::NotInteger, column, fmt::format("{}{}", letter, value));
    }
    value = whole;
  }
  for (const LowestValue& each : kNotNegative) {
    // D of G41.1 is a diameter: below 0 it is that of a tool on the other side.
    if (each.letter == 'D' && run.is_linuxcnc()) continue;
    if (each.letter == letter && value < 0) {
      return run.fail(each.code, column, fmt::format("{}{}", letter, value));
    }
  }
  if (run.is_linuxcnc()) return true;
  if (letter == 'P' && value < 0) {
    return run.fail(ErrorCode::NegativeP, column, fmt::format("P{}", value));
  }
  if (letter == 'Q' && value <= 0) {
    return run.fail(ErrorCode::NegativeQ, column, fmt::format("Q{}", value));
  }
  return true;
}

/// In the contour of a lathe cycle A, C, U and W are none of the machine's axes.
AddressSet axes_or_corners(const Run& run) {
  if (run.state.turning.code == 0) [[likely]]
    return run.options.axes;
  return run.options.axes | set_of("ACUW");
}

/// Letters whose values are taken as they are read.
AddressSet plain_letters(const Run& run, AddressSet letters) {
  AddressSet plain = letters & ~kChecked & ~(kAxisWords & ~axes_or_corners(run));
  if (run.state.modes.is_diameter) [[unlikely]]
    plain &= ~set_of("X");
  return plain;
}

bool add_word(Run& run, Address address, const char* start, const char*& at) {
  Words& words = run.block.words;
  const AddressSet word = AddressSet{1} << address;
  if (words.has_any(word)) [[unlikely]] {
    return run.fail(ErrorCode::DuplicateWord, run.column(start),
                    fmt::format("{}", letter_of(address)));
  }
  double value = 0;
  if (!read_value(run, at, value)) return false;
  if ((word & kChecked) != 0) {
    if (!check_value(run, letter_of(address), value, run.column(start))) return false;
  } else if ((word & kAxisWords & ~axes_or_corners(run)) != 0) [[unlikely]] {
    if (run.options.ignores_missing_axes) return true;
    return run.fail(ErrorCode::NoSuchAxis, run.column(start),
                    fmt::format("{}", letter_of(address)));
  }
  if (address == address_of('X') && run.state.modes.is_diameter) [[unlikely]]
    value /= 2;
  words.set(address, value, run.column(start));
  return true;
}

/// A code of one digit, as those of most moves are; false and nothing read when there is more.
bool read_short_g(const char*& at, std::int16_t& tenths) {
  if (!is_digit(*at)) return false;
  const char* after = skip_blanks(at + 1);
  if (is_digit(*after) || *after == '.') return false;
  tenths = static_cast<std::int16_t>((*at - '0') * 10);
  at = after;
  return true;
}

bool read_any_g(Run& run, const char* start, const char*& at, std::int16_t& code) {
  double value = 0;
  if (!read_value(run, at, value)) return false;
  const double tenths = std::floor(value * 10 + 0.5);
  if (!(std::fabs(value * 10 - tenths) <= 0.001) || !(tenths <= 999)) {
    return run.fail(ErrorCode::GRange, run.column(start), fmt::format("G{}", value));
  }
  if (tenths < 0)
    return run.fail(ErrorCode::GNegative, run.column(start), fmt::format("G{}", value));
  code = static_cast<std::int16_t>(tenths);
  return true;
}

void put_g(Run& run, const GRow& row) {
  Block& block = run.block;
  const auto group = static_cast<unsigned>(row.group);
  block.g_groups = static_cast<std::uint16_t>(block.g_groups | 1u << group);
  block.g_codes[group] = row.code;
  block.words_taken |= words_of(row, run.options.profile);
  if (row.takes_axes) block.axis_user = &row;
}

/// The later program accepts G80 beside a motion code, before or after it: the motion is made.
bool is_overruled(Run& run, const GRow& row) {
  constexpr std::int16_t kMotionOff = 800;
  if (!run.is_linuxcnc() || row.group != GGroup::Motion) return false;
  if (row.code == kMotionOff) return true;
  if (run.block.g(GGroup::Motion) != kMotionOff) return false;
  put_g(run, row);
  return true;
}

bool add_g(Run& run, const char* start, const char*& at) {
  std::int16_t code = 0;
  if (!read_short_g(at, code) && !read_any_g(run, start, at, code)) return false;
  const GRow* row = g_row(code, run.options.profile);
  if (row == nullptr) [[unlikely]] {
    return run.fail(ErrorCode::GUnknown, run.column(start), fmt::format("G{}", code / 10.0));
  }
  Block& block = run.block;
  if (block.has(row->group)) [[unlikely]] {
    if (is_overruled(run, *row)) return true;
    return run.fail(ErrorCode::GGroup, run.column(start),
                    fmt::format("G{} and G{}", block.g(row->group) / 10.0, code / 10.0));
  }
  put_g(run, *row);
  return true;
}

bool add_m(Run& run, const char* start, const char*& at) {
  constexpr std::uint8_t kMax = 4;
  int code = 0;
  if (!read_integer(run, at, code)) return false;
  const auto refuse = [&](const DiagnosticRow& why) {
    return run.fail(why, run.column(start), fmt::format("M{}", code));
  };
  if (code < 0) return refuse(ErrorCode::MNegative);
  if (code > (run.is_linuxcnc() ? 199 : 99)) return refuse(ErrorCode::MRange);
  const MRow* row = m_row(code, run.options.profile);
  if (row == nullptr) return refuse(ErrorCode::MUnknown);
  Block& block = run.block;
  if (block.has(row->group)) return refuse(ErrorCode::MGroup);
  if (block.m_count == kMax) return refuse(ErrorCode::MMany);
  ++block.m_count;
  const auto group = static_cast<unsigned>(row->group);
  block.m_groups = static_cast<std::uint8_t>(block.m_groups | 1u << group);
  block.m_codes[group] = static_cast<std::int16_t>(code);
  block.words_taken |= row->words;
  return true;
}

bool add_setting(Run& run, Setting setting, const char* start) {
  Block& block = run.block;
  if (block.setting_count == Block::kMaxSettings) {
    return run.fail(ErrorCode::TooManySettings, run.column(start),
                    fmt::format("more than {}", Block::kMaxSettings));
  }
  for (std::uint8_t i = 0; i < block.setting_count; ++i) {
    if (block.settings[i].index == setting.index) {
      run.warn(kDuplicateSetting, "a parameter is set twice on one line; the last value applies");
      break;
    }
  }
  block.settings[block.setting_count++] = setting;
  return true;
}

/// `#5=...`, `#<name>=...`; the # is after `at`.
bool read_setting(Run& run, const char* start, const char*& at) {
  Setting setting;
  at = skip_blanks(at);
  if (*at == '<' && run.is_linuxcnc()) {
    NameId id = kNoName;
    if (!read_name(run, at, run.scratch)) return false;
    if (!name_to_set(run, run.scratch, run.column(start), id)) return false;
    setting.index = -1 - std::int32_t{id};
  } else {
    int index = 0;
    if (!read_integer(run, at, index)) return false;
    if (!check_settable(run, index, run.column(start))) return false;
    setting.index = index;
  }
  at = skip_blanks(at);
  if (*at != '=') return run.fail(ErrorCode::EqualSign, run.column(at));
  ++at;
  return read_value(run, at, setting.value) && add_setting(run, setting, start);
}

/// `at` is on the bracket. The last of several comments of a line applies.
bool read_comment(Run& run, const char*& at) {
  const char* start = at;
  Block& block = run.block;
  for (++at; *at != ')'; ++at) {
    if (*at == '(') return run.fail(ErrorCode::NestedComment, run.column(at));
    if (is_end_of_line(*at)) return run.fail(ErrorCode::UnclosedComment, run.column(start));
  }
  if (block.comment_begin != nullptr && is_message(block.comment_begin, block.comment_end)) {
    run.warn(kCommentLost, "a message is followed by another comment, which applies instead");
  }
  block.comment_begin = start + 1;
  block.comment_end = at;
  ++at;
  return true;
}

void read_rest_as_comment(Run& run, const char*& at) {
  Block& block = run.block;
  const char* begin = at + 1;
  while (!is_end_of_line(*at)) ++at;
  block.comment_begin = begin;
  block.comment_end = at;
}

bool refuse_character(Run& run, const char* at) {
  const unsigned char c = static_cast<unsigned char>(*at);
  return run.fail(ErrorCode::BadCharacter, run.column(at),
                  c >= ' ' && c < 127 ? fmt::format("'{}'", *at) : fmt::format("code {}", c));
}

bool read_other(Run& run, const char*& at) {
  switch (*at) {
    case '(':
      return read_comment(run, at);
    case '#':
      ++at;
      return read_setting(run, at - 1, at);
    case ';':
      if (!run.is_linuxcnc()) break;
      read_rest_as_comment(run, at);
      return true;
    case '@':
    case '^':
      if (!run.is_linuxcnc()) break;
      ++at;
      return add_word(run, address_of(at[-1]), at - 1, at);
    default:
      break;
  }
  return refuse_character(run, at);
}

/// Any item of a line; `address` is the letter's, 26 and more where there is none.
bool read_item(Run& run, Address address, AddressSet letters, const char*& at) {
  if (address >= 26) return read_other(run, at);
  const char* start = at;
  ++at;
  if ((letters >> address & 1u) != 0) return add_word(run, address, start, at);
  if (address == address_of('G')) return add_g(run, start, at);
  if (address == address_of('M')) return add_m(run, start, at);
  return refuse_character(run, start);
}

}  // namespace

bool read_items(Run& run, const char* line) {
  const AddressSet letters = run.is_linuxcnc() ? kLaterLetters : kNistLetters;
  const AddressSet plain = plain_letters(run, letters);
  Words& words = run.block.words;
  for (const char* at = skip_blanks(line);; at = skip_blanks(at)) {
    constexpr char kSmall = 'a' - 'A';
    const auto address = static_cast<Address>((*at | kSmall) - 'a');
    if (address < 26 && (plain & ~words.present()) >> address & 1u) [[likely]] {
      // Most words of a program: a letter that is new on the line, and a number.
      double value = 0;
      if (const char* after = take_plain_number(at + 1, value)) [[likely]] {
        words.set(address, value, run.column(at));
        at = after;
        continue;
      }
    }
    if (is_end_of_line(*at)) return true;
    const char* after = at;
    if (!read_item(run, address, letters, after)) return false;
    at = after;
  }
}

bool read_line_head(Run& run, const char*& at, bool& is_skip) {
  constexpr std::int64_t kMaxNist = 99999;
  at = skip_blanks(at);
  is_skip = *at == '/';
  if (is_skip) at = skip_blanks(at + 1);
  if (upper(*at) != 'N') return true;
  const char* start = at;
  std::int64_t number = 0;
  at = skip_blanks(at + 1);
  if (!is_digit(*at)) return run.fail(ErrorCode::BadUnsigned, run.column(start));
  for (; is_digit(*at); at = skip_blanks(at + 1)) {
    if (number < 1'000'000'000'000'000) number = number * 10 + (*at - '0');
  }
  if (run.is_linuxcnc()) {
    if (*at == '.') {
      for (++at; is_digit(*at) || is_blank(*at);) ++at;
    }
  } else if (number > kMaxNist) {
    return run.fail(ErrorCode::LineNumberRange, run.column(start), fmt::format("{}", number));
  }
  run.origin.sequence = number;
  return true;
}

bool skip_comments(Run& run, const char*& at) {
  for (;;) {
    at = skip_blanks(at);
    if (*at == '(') {
      if (!read_comment(run, at)) return false;
    } else if (*at == ';') {
      read_rest_as_comment(run, at);
    } else {
      return true;
    }
  }
}

}  // namespace dripline::interpreter::rs274ngc
