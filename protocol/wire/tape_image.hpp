#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"
#include "protocol/wire/character_coder.hpp"
#include "protocol/wire/tape_code.hpp"

/// Whole tapes as files of rows: leader, title, rewind stop, end of block, blocks, trailer. Between
/// them and program text as it is stored (ASCII, LF after each block, '%' for the rewind stop), in
/// pieces: a tape of any length needs constant memory. Not thread-safe.
namespace dripline::wire {

/// Rows to an inch; 10 to 20 inches of leader and trailer are usual.
inline constexpr unsigned kRowsPerInch = 10;
inline constexpr unsigned kMaxTapeFeed = 100'000;  ///< leader and trailer, rows
inline constexpr std::size_t kMaxTapeTitle = 64;

struct TapeForm {
  CharacterCode code = CharacterCode::Iso;
  EndOfBlock end_of_block = EndOfBlock::CrLf;  ///< of ISO and ASCII
  unsigned leader = 100, trailer = 100;        ///< blank rows
  std::string title;                           ///< readable punching after the leader
  bool has_rewind_stop = true;   ///< punch one before the first block where the text has none
  bool has_parentheses = false;  ///< EIA: punch '(' and ')' as some builders do
};

/// Text to tape. Call `begin` once, `punch` for each piece, `finish` once.
class TapePunch {
 public:
  /// Errors (of `begin`): LimitExceeded, Syntax (leader, trailer, title).
  explicit TapePunch(TapeForm form);
  Result<void> begin(std::vector<std::byte>& rows);
  /// Errors: Syntax (a character without a code, named with line and column; the tape must then be
  /// discarded).
  Result<void> punch(std::string_view text, std::vector<std::byte>& rows);
  void finish(std::vector<std::byte>& rows);
  std::uint64_t blocks() const { return encoder_.blocks(); }

 private:
  TapeForm form_;
  CharacterEncoder encoder_;
  bool has_begun_text_ = false, is_line_begun_ = false;
};

struct TapeReading {
  CharacterCode code = CharacterCode::Iso;
  /// The text begins after the first end of block, as a control reads; or all rows are text.
  bool skips_head = true;
  bool replaces_wrong_rows = false;      ///< '?' for a row that cannot be read, instead of an error
  bool blank_is_wrong_in_block = false;  ///< EIA: zero holes are not an odd number
};

/// The parts of a tape.
struct TapeSummary {
  std::uint64_t rows = 0, blocks = 0, deletes = 0, wrong = 0;
  std::uint64_t leader = 0;   ///< blank rows before the first punching
  std::uint64_t skipped = 0;  ///< rows before the first end of block that are not blank
  std::uint64_t trailer = 0;  ///< blank rows at the end
  bool has_rewind_stop = false;
  /// The skipped rows read like a block: the tape has no end of block before its first block.
  std::string lost_block;
  std::optional<Error> first_wrong;
};

/// Tape to text.
class TapeReader {
 public:
  explicit TapeReader(TapeReading reading);
  /// Appends to `text` at most one character for each row, and one. Errors: Corrupt (wrong parity
  /// or no such character, with row, line and column).
  Result<void> read(std::span<const std::byte> rows, std::string& text);
  /// Ends a last block without an end. Errors: Corrupt (no end of block on the tape).
  Result<void> finish(std::string& text);
  const TapeSummary& summary() const { return summary_; }

 private:
  Result<void> read_row(std::uint8_t row, std::string& text);
  void hunt(std::uint8_t row, TapeRow meaning, std::string& text);
  Result<void> read_data(std::uint8_t row, TapeRow meaning, std::string& text);
  void note_head(TapeRow meaning);

  TapeReading reading_;
  CharacterDecoder decoder_;
  TapeSummary summary_;
  bool is_hunting_;
  bool has_seen_block_end_ = false, is_stop_last_ = false, is_line_begun_ = false;
  std::string head_;  ///< the first of what is skipped, as text
  bool is_head_text_ = true;
};

/// Appends a title that people read on the tape itself: each character is five rows of hole
/// patterns in tracks 1-7 and one blank row. None of these rows is an end of block of any code, so
/// a control skips the title. Errors: Syntax (not A-Z, 0-9, blank, '-', '.' or '/').
Result<void> punch_title(std::string_view title, std::vector<std::byte>& rows);

}  // namespace dripline::wire
