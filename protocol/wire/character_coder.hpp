#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"
#include "protocol/wire/line_settings.hpp"

/// Converts program text as it is stored (ASCII, LF after each block) to characters on the line and
/// back, in pieces of any size. Not thread-safe.
namespace dripline::wire {

class CharacterEncoder {
 public:
  /// `has_parentheses`: the EIA code has '(' and ')' as some builders punch them.
  CharacterEncoder(CharacterCode code, EndOfBlock end_of_block, bool has_parentheses = false)
      : code_(code), end_of_block_(end_of_block), has_parentheses_(has_parentheses) {}

  /// Appends the characters of `text`, at most three for each; CR before LF belongs to the LF.
  /// Errors: Syntax (a character that the code does not have, named with its line and column;
  /// `line` is then unchanged, and the encoder must not be used again).
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

/// The text that one character of the line adds.
struct DecodedCharacter {
  std::optional<char> text;    ///< '?' for a character that cannot be read
  std::optional<Error> error;  ///< Corrupt: wrong parity or no such character, with line, column
};

class CharacterDecoder {
 public:
  explicit CharacterDecoder(CharacterCode code) : code_(code) {}

  /// Blanks, deletes and control characters add nothing; CR, LF, CR LF, LF CR and LF CR CR each end
  /// one block, whatever the settings of the line. The caller removes its protocol's characters
  /// first.
  DecodedCharacter decode(std::byte character);
  /// Replaces a character with a line fault by '?'.
  DecodedCharacter decode_fault(std::string_view what);
  /// The next character is line 1, column 1.
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
