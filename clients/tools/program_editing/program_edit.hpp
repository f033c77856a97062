#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/base/result.hpp"

/// Changes of a program by its block numbers. How blocks are cut, numbered and written depends on
/// the control; `edit_lines` edits programs of controls that keep a program as its lines. Pure.

namespace dripline::program_editing {

/// All numbers are those before the edit.
struct BlockChange {
  enum class Kind : std::uint8_t { Delete, Replace, Insert };
  Kind kind = Kind::Delete;
  std::int64_t first = 0;
  std::int64_t last = 0;  ///< as `first` of Insert, which puts its blocks after that one
  std::string text;       ///< of Replace and Insert: blocks, one a line
};

struct EditedProgram {
  struct Change {
    char mark = '+';   ///< '-': deleted, '+': inserted
    std::string text;  ///< the block, without its line end
  };
  std::string text;
  std::vector<Change> changes;  ///< in the program's order
  std::size_t renumbered = 0;   ///< blocks that only have another number now
};

/// One step of an edit, in the order of the result.
struct EditStep {
  enum class Kind : std::uint8_t { Keep, Drop, Enter };
  Kind kind = Kind::Keep;
  std::size_t block = 0;     ///< Keep, Drop: which one; Enter: the one in front of it
  std::string_view entered;  ///< Enter: one line of the change's text
};

inline constexpr std::int64_t kNoNumber = -1;

/// `numbers`: of all blocks, kNoNumber where one cannot be named. Where no block has the number
/// 0, 0 is the place in front of all blocks. Errors: NotFound (no such block), Conflict (two
/// changes of one block; a number that is programmed twice), Syntax (a range from right to left,
/// nothing to put in).
Result<std::vector<EditStep>> plan_edit(std::span<const std::int64_t> numbers,
                                        std::span<const BlockChange> changes);

/// Which block has this number. Errors: NotFound, Conflict (the number is programmed twice).
Result<std::size_t> find_block(std::span<const std::int64_t> numbers, std::int64_t number);
/// The first and the last block of a range. Errors: likewise; Syntax (from right to left).
Result<std::pair<std::size_t, std::size_t>> find_blocks(std::span<const std::int64_t> numbers,
                                                        std::int64_t first, std::int64_t last);

/// Blocks are the lines of the text, numbered from 1; they keep their line ends. Errors: those of
/// plan_edit.
Result<EditedProgram> edit_lines(std::string_view text, std::span<const BlockChange> changes);

/// Those lines, without numbers of their own: as the text of an insertion. Errors: those of
/// find_block; Syntax (a range from right to left).
Result<std::string> text_of_lines(std::string_view text, std::int64_t first, std::int64_t last);

/// "\r\n" where the text's first line ends so, else "\n".
std::string_view line_end_of(std::string_view text);

struct WordChange {
  enum class Kind : std::uint8_t {
    Set,       ///< the word gets another value
    LeaveOut,  ///< the word is taken out: what is in force stays
    Shorten,   ///< the block ends in front of the word
  };
  Kind kind = Kind::Set;
  std::int64_t block = 0;  ///< its number
  std::string word;        ///< Set: address and value, "X+5"; else the address alone
};

/// The blocks that have a word with one of the addresses that were looked for.
struct WordSearch {
  struct Found {
    std::int64_t block = kNoNumber;
    std::uint64_t line = 0;  ///< it begins in
    std::string text;        ///< in one line
  };
  /// A block that cannot be read, so its words are not known.
  struct Unread {
    Found block;
    std::string reason;
  };
  std::vector<Found> found;
  std::vector<Unread> unread;
};

/// The editor of a control that keeps its programs in numbered blocks. Pure functions; any thread.
struct ProgramEditor {
  std::string_view control;  ///< name of its dialect
  /// Sets or clears the mark that protects a program from being erased or changed. Errors: Syntax.
  Result<std::string> (*protect)(std::string_view text, bool is_protected);
  /// Blocks that stay keep their text except for their numbers; inserted blocks are read as the
  /// control reads them and written as it writes them. Errors: those of plan_edit; Syntax (a block
  /// the control refuses, with its message), LimitExceeded (no block number is left).
  Result<EditedProgram> (*edit)(std::string_view text, std::span<const BlockChange> changes);
  /// Blocks without their numbers, one a line: as the text of an insertion. Errors: those of
  /// find_block; Syntax (a range from right to left; the program's form).
  Result<std::string> (*text_of)(std::string_view text, std::int64_t first, std::int64_t last);
  /// Turns changes of words into replaced blocks for `edit`. Sets are applied first. Errors: those
  /// of find_block; NotFound (the block has no such word), Conflict (a word is changed twice),
  /// Syntax (not a word of the control, or the resulting block is refused).
  Result<std::vector<BlockChange>> (*change_words)(std::string_view text,
                                                   std::span<const WordChange> changes);
  /// Finds the blocks that have a word with one of the addresses. Errors: Syntax.
  Result<WordSearch> (*search)(std::string_view text, std::span<const std::string> addresses);
  /// Numbers all blocks as the control does; `increment` applies where the control allows a choice.
  /// Errors: Syntax.
  Result<std::string> (*renumber)(std::string_view text, std::int32_t increment);
};

/// nullptr: the control keeps a program as its lines, see `edit_lines`.
const ProgramEditor* find_program_editor(std::string_view control);

// Editing of blocks (`program_editing.cpp`) and words (`word_editing.cpp`) as on the TNC 151/155.
// Contracts: `ProgramEditor`.

Result<EditedProgram> edit_program(std::string_view text, std::span<const BlockChange> changes);
Result<std::string> text_of_blocks(std::string_view text, std::int64_t first, std::int64_t last);
Result<std::vector<BlockChange>> change_words(std::string_view text,
                                              std::span<const WordChange> changes);
Result<WordSearch> search_words(std::string_view text, std::span<const std::string> addresses);

}  // namespace dripline::program_editing
