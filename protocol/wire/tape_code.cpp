#include "protocol/wire/tape_code.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace dripline::wire {
namespace {

using enum RowKind;

struct EiaRow {
  std::uint8_t row;
  RowKind kind;
  char character;
};

/// Digits 1-9 use tracks 1-4, 0 is track 6 alone; letters add tracks 6 and 7, 7 alone or 6 alone;
/// track 5 makes the number of holes odd.
constexpr std::array kEiaRows{
    EiaRow{0x00, Blank, 0},       EiaRow{0x20, Text, '0'},       EiaRow{0x01, Text, '1'},
    EiaRow{0x02, Text, '2'},      EiaRow{0x13, Text, '3'},       EiaRow{0x04, Text, '4'},
    EiaRow{0x15, Text, '5'},      EiaRow{0x16, Text, '6'},       EiaRow{0x07, Text, '7'},
    EiaRow{0x08, Text, '8'},      EiaRow{0x19, Text, '9'},       EiaRow{0x61, Text, 'A'},
    EiaRow{0x62, Text, 'B'},      EiaRow{0x73, Text, 'C'},       EiaRow{0x64, Text, 'D'},
    EiaRow{0x75, Text, 'E'},      EiaRow{0x76, Text, 'F'},       EiaRow{0x67, Text, 'G'},
    EiaRow{0x68, Text, 'H'},      EiaRow{0x79, Text, 'I'},       EiaRow{0x51, Text, 'J'},
    EiaRow{0x52, Text, 'K'},      EiaRow{0x43, Text, 'L'},       EiaRow{0x54, Text, 'M'},
    EiaRow{0x45, Text, 'N'},      EiaRow{0x46, Text, 'O'},       EiaRow{0x57, Text, 'P'},
    EiaRow{0x58, Text, 'Q'},      EiaRow{0x49, Text, 'R'},       EiaRow{0x32, Text, 'S'},
    EiaRow{0x23, Text, 'T'},      EiaRow{0x34, Text, 'U'},       EiaRow{0x25, Text, 'V'},
    EiaRow{0x26, Text, 'W'},      EiaRow{0x37, Text, 'X'},       EiaRow{0x38, Text, 'Y'},
    EiaRow{0x29, Text, 'Z'},      EiaRow{0x70, Text, '+'},       EiaRow{0x40, Text, '-'},
    EiaRow{0x6B, Text, '.'},      EiaRow{0x3B, Text, ','},       EiaRow{0x31, Text, '/'},
    EiaRow{0x0E, Text, '&'},      EiaRow{0x10, Text, ' '},       EiaRow{0x3E, Text, '\t'},
    EiaRow{0x1A, Text, '('},      EiaRow{0x4A, Text, ')'},       EiaRow{0x2A, Ignored, 0},
    EiaRow{0x7C, Ignored, 0},     EiaRow{0x7A, Ignored, 0},      EiaRow{0x7F, Delete, 0},
    EiaRow{0x80, BlockEnd, '\n'}, EiaRow{0x0B, RewindStop, '%'},
};

constexpr bool is_odd(std::uint8_t row) {
  return std::popcount(row) % 2 != 0;
}

constexpr std::array<TapeRow, 256> make_eia_decoding() {
  std::array<TapeRow, 256> table{};
  for (std::size_t row = 0; row < table.size(); ++row) {
    table[row].kind = is_odd(static_cast<std::uint8_t>(row)) ? Unassigned : WrongParity;
  }
  for (const auto& known : kEiaRows) table[known.row] = {known.kind, known.character};
  return table;
}

constexpr std::array<std::uint8_t, 128> make_eia_encoding() {
  std::array<std::uint8_t, 128> table{};  // 0: none, as no character is written as a blank
  for (const auto& known : kEiaRows) {
    if (known.character != 0) table[static_cast<unsigned char>(known.character)] = known.row;
  }
  return table;
}

constexpr auto kEiaDecoding = make_eia_decoding();
constexpr auto kEiaEncoding = make_eia_encoding();

TapeRow decode_seven_bits(std::uint8_t row) {
  switch (row) {
    case 0x00:
      return {Blank, 0};
    case 0x0A:
      return {BlockEnd, '\n'};
    case 0x0D:
      return {CarriageReturn, 0};
    case 0x7F:
      return {Delete, 0};
    case '%':
      return {RewindStop, '%'};
    default:
      const bool is_text = row >= 0x20 || row == '\t';
      return is_text ? TapeRow{Text, static_cast<char>(row)} : TapeRow{Ignored, 0};
  }
}

/// Rows after a position, counted while walking toward the tape's beginning.
struct RowsAfter {
  std::size_t odd = 0, even = 0, blanks = 0;
  std::optional<std::uint8_t> next;  ///< the first that is not blank

  void put_before(std::uint8_t row) {
    constexpr std::size_t kEndOfText = 50;  // this many blanks are a trailer
    if (row == 0) {
      if (++blanks >= kEndOfText) *this = RowsAfter{0, 0, blanks, std::nullopt};
      return;
    }
    blanks = 0;
    next = row;
    ++(is_odd(row) ? odd : even);
  }
};

bool begins_a_block(TapeRow row) {
  constexpr std::string_view kOther = "(/";
  if (row.kind == BlockEnd || row.kind == CarriageReturn || row.kind == RewindStop) return true;
  if (row.kind != Text) return row.kind == Delete;
  const char c = row.character;
  return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || kOther.find(c) != kOther.npos;
}

std::optional<CodeVerdict> judge(std::size_t at, std::uint8_t row, const RowsAfter& after) {
  const bool is_eia = row == 0x80;
  if (!is_eia && row != 0x0A && row != 0x8D) return std::nullopt;
  const auto code = is_eia ? CharacterCode::Eia : CharacterCode::Iso;
  const std::size_t right = is_eia ? after.odd : after.even, all = after.odd + after.even;
  if (!after.next || right * 100 < all * 98) return std::nullopt;
  if (!begins_a_block(decode_row(code, *after.next))) return std::nullopt;
  const double share = static_cast<double>(right) / static_cast<double>(all);
  return CodeVerdict{code, share * (1 - std::pow(0.5, static_cast<double>(all))), at};
}

struct Census {
  std::size_t odd = 0, even = 0, high = 0, eia_ends = 0, line_ends = 0;
  std::size_t low_odd = 0, low_even = 0;  ///< without an eighth hole
  std::size_t first_line_end = 0;
};

Census count(std::span<const std::byte> rows) {
  Census census;
  for (std::size_t at = 0; at < rows.size(); ++at) {
    const auto row = static_cast<std::uint8_t>(rows[at]);
    if (row == 0) continue;
    ++(is_odd(row) ? census.odd : census.even);
    if (row >= 0x80) {
      ++census.high;
    } else {
      ++(is_odd(row) ? census.low_odd : census.low_even);
    }
    if (row == 0x80) ++census.eia_ends;
    if (row == 0x0A || row == 0x0D) {
      if (census.line_ends++ == 0) census.first_line_end = at;
    }
  }
  return census;
}

/// Whether this is text without parity: on a tape, rows without an eighth hole all have the same
/// parity; in text they have both, whatever umlauts its comments hold.
bool is_plain_ascii(const Census& census) {
  const std::size_t low = census.low_odd + census.low_even;
  const bool is_mixed = census.low_odd * 5 >= low && census.low_even * 5 >= low;
  return is_mixed && census.line_ends > census.eia_ends && census.high * 4 <= low;
}

/// Whether rows with an eighth hole form whole UTF-8 characters, which those of a tape do not. One
/// may be cut off at the end.
bool is_utf8(std::span<const std::byte> rows) {
  std::size_t left = 0;  // of a character
  for (const std::byte each : rows) {
    const auto row = std::to_integer<std::uint8_t>(each);
    const bool continues = (row & 0xC0) == 0x80;
    if (continues != (left > 0)) return false;
    if (left > 0) {
      --left;
    } else if (row >= 0x80) {
      if (row < 0xC2 || row > 0xF4) return false;
      left = row < 0xE0 ? 1 : row < 0xF0 ? 2 : 3;
    }
  }
  return true;
}

CodeVerdict ascii_verdict(const Census& census) {
  const double all = static_cast<double>(census.odd + census.even);
  const double fitting = 1 - static_cast<double>(census.high) / all;
  return {CharacterCode::Ascii, fitting * (1 - std::pow(0.5, all)), census.first_line_end};
}

}  // namespace

TapeRow decode_row(CharacterCode code, std::uint8_t row) {
  if (code == CharacterCode::Eia) return kEiaDecoding[row];
  if (code == CharacterCode::Iso && is_odd(row)) return {WrongParity, 0};
  return decode_seven_bits(row & 0x7F);
}

std::optional<std::uint8_t> encode_row(CharacterCode code, char character, bool has_parentheses) {
  const auto byte = static_cast<std::uint8_t>(character);
  if (byte >= 0x7F || (byte < 0x20 && character != '\n' && character != '\t')) return std::nullopt;
  if (code == CharacterCode::Eia) {
    if (!has_parentheses && (character == '(' || character == ')')) return std::nullopt;
    const std::uint8_t row = kEiaEncoding[byte];
    return row == 0 ? std::nullopt : std::optional(row);
  }
  const bool needs_parity = code == CharacterCode::Iso && is_odd(byte);
  return static_cast<std::uint8_t>(needs_parity ? byte | 0x80 : byte);
}

bool has_right_parity(CharacterCode code, std::uint8_t row) {
  if (code == CharacterCode::Ascii || row == 0) return true;
  return is_odd(row) == (code == CharacterCode::Eia);
}

std::uint8_t delete_row(CharacterCode code) {
  return code == CharacterCode::Iso ? 0xFF : 0x7F;
}

std::string_view end_of_block_rows(CharacterCode code, EndOfBlock end_of_block) {
  static constexpr std::array<std::string_view, 5> kAscii{"\n", "\r", "\r\n", "\n\r", "\n\r\r"};
  static constexpr std::array<std::string_view, 5> kIso{"\n", "\x8D", "\x8D\n", "\n\x8D",
                                                        "\n\x8D\x8D"};
  const auto at = static_cast<std::size_t>(end_of_block);
  if (code == CharacterCode::Eia) return "\x80";
  return code == CharacterCode::Iso ? kIso[at] : kAscii[at];
}

std::string_view code_name(CharacterCode code) {
  static constexpr std::array<std::string_view, 3> kNames{"ASCII", "ISO", "EIA"};
  return kNames[static_cast<std::size_t>(code)];
}

Result<CodeVerdict> detect_code(std::span<const std::byte> rows) {
  rows = rows.first(std::min(rows.size(), kDetectionWindow));
  const Census census = count(rows);
  const bool has_text = census.low_odd != 0 && census.line_ends != 0;
  if (is_plain_ascii(census) || (has_text && is_utf8(rows))) return ascii_verdict(census);
  std::optional<CodeVerdict> verdict;
  RowsAfter after;
  for (std::size_t at = rows.size(); at-- > 0;) {
    const auto row = static_cast<std::uint8_t>(rows[at]);
    if (const auto judged = judge(at, row, after)) verdict = judged;
    after.put_before(row);
  }
  if (verdict) return *verdict;
  return fail(Errc::Corrupt,
              "code not recognized: of {} rows that are not blank, {} have the odd parity of EIA "
              "and {} the even one of ISO, and no block follows an end of block",
              census.odd + census.even, census.odd, census.even);
}

}  // namespace dripline::wire
