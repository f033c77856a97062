#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "protocol/base/result.hpp"
#include "protocol/wire/line_settings.hpp"

/// The codes of eight-track punched tape, which serial lines of these controls carry unchanged.
/// Track 1 is bit 0; the sprocket hole is no bit. Pure; any thread.
/// Sources: EIA RS-244-A; EIA RS-358-A and ISO 840, which agree.
namespace dripline::wire {

enum class RowKind : std::uint8_t {
  Text,            ///< a character of the program, TAB and the blank included
  BlockEnd,        ///< EIA: track 8 alone; ISO and ASCII: LF
  CarriageReturn,  ///< ISO and ASCII: CR, which belongs to an LF beside it
  RewindStop,      ///< EIA: EOR; ISO and ASCII: '%'
  Blank,           ///< no hole: leader, tape feed
  Delete,          ///< all holes, punched over a wrong character: no character
  Ignored,         ///< has a meaning, but none for a program (BS, BEL, case shifts, DC1)
  Unassigned,      ///< right parity, but the code has no such character
  WrongParity,
};

/// The meaning of one row of tape (one character on the line).
struct TapeRow {
  RowKind kind = RowKind::Blank;
  char character = 0;  ///< of Text; '%' for RewindStop, LF for BlockEnd
  friend bool operator==(const TapeRow&, const TapeRow&) = default;
};

/// `Ascii` drops the eighth bit and has no parity; EIA letters are read as capitals.
/// RS-244-A has no parentheses (1A and 4A): some builders' tapes have them, so they are read.
TapeRow decode_row(CharacterCode code, std::uint8_t row);

/// LF gives the end of block, '%' the rewind stop. nullopt: the code does not have this character.
/// `Ascii` and `Iso` have TAB and the printable characters; EIA no small letters, and parentheses
/// only when `has_parentheses`.
std::optional<std::uint8_t> encode_row(CharacterCode code, char character,
                                       bool has_parentheses = false);

/// EIA: an odd number of holes; ISO: even; ASCII: any.
bool has_right_parity(CharacterCode code, std::uint8_t row);

std::uint8_t delete_row(CharacterCode code);
/// The end of a block on the line; EIA has one such character whatever `end_of_block` is.
std::string_view end_of_block_rows(CharacterCode code, EndOfBlock end_of_block);
std::string_view code_name(CharacterCode code);

/// The code of a tape of unknown origin.
struct CodeVerdict {
  CharacterCode code = CharacterCode::Ascii;
  double confidence = 0;        ///< 0..1: the share of rows that fit, less what few rows can say
  std::size_t first_block = 0;  ///< offset of the end of block before the first block
};

/// Enough rows of a tape to detect its code.
inline constexpr std::size_t kDetectionWindow = 1 << 20;

/// Detects the code from the first `kDetectionWindow` rows: an end of block of one code, followed
/// by rows of which 98 in 100 have that code's parity and which begin like a block. A leader may
/// have any punching. Text of mixed parity is ASCII, with UTF-8 or a few Latin-1 characters in its
/// comments. Errors: Corrupt (code not recognized; with the counts of both parities).
Result<CodeVerdict> detect_code(std::span<const std::byte> rows);

}  // namespace dripline::wire
