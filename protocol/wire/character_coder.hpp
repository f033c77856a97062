#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"
#include "protocol/wire/line_settings.hpp"

/// Program text as it is kept (ASCII, LF after each block) to characters on the line and back, a
/// piece at a time, however it is cut. Not thread-safe.
namespace dripline::wire {

class CharacterEncoder {
 public:
  /// `has_parentheses`: EIA has '(' and ')' as some builders punch them.
  CharacterEncoder(CharacterCode code, EndOfBlock end_of_block, bool has_parentheses = false)
      : code_(code), end_of_block_(end_of_block), has_parentheses_(has_parentheses) {}

  /// Appends the characters of `text`, at most three for each; CR before LF belongs to the LF.
  /// Errors: Syntax (a character that the code does not have, named with its line and column;
  /// `line` is then as it was, and the encoder is of no more use).
  Result<void> encode(std::string_view text, std::vector<std::byte>& line);

  std::uint64_t blocks() const { return blocks_; }  ///< ends of block so far

 private:
  Result<void> encode_character(char c, std::vector<std::byte>& line);
  CharacterCode code_;
  EndOfBlock end_of_block_;
  bool has_parentheses_;
  std::uint64_t blocks_ = 0, column_ = 0;
  bool has_carriage_return_ = false;
};

/// What one character of the line adds to the text.
struct DecodedCharacter {
  std::optional<char> text;      ///< '?' in the place of one that cannot be read
  std::optional<Error> trouble;  ///< Corrupt: wrong parity or no such character, with line, column
};

class CharacterDecoder {
 public:
  explicit CharacterDecoder(CharacterCode code) : code_(code) {}

  /// Blanks, deletes and control characters add nothing; CR, LF, CR LF, LF CR and LF CR CR each end
  /// one block, whatever the line is set to. The caller takes out what its protocol means first.
  DecodedCharacter decode(std::byte character);
  /// A character that the UART found wrong: '?' in its place.
  DecodedCharacter decode_fault(std::string_view what);
  /// The next character is that of line 1, column 1.
  void count_from_here() { blocks_ = column_ = 0; }

  std::uint64_t blocks() const { return blocks_; }  ///< ends of block so far

 private:
  DecodedCharacter add(char c);
  DecodedCharacter end_block(bool is_line_feed);
  CharacterCode code_;
  std::uint64_t blocks_ = 0, column_ = 0;
  /// Companions of the end of block just read that do not end another one.
  unsigned line_feeds_left_ = 0, carriage_returns_left_ = 0;
};

}  // namespace dripline::wire
