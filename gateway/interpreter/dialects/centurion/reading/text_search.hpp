#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include "gateway/interpreter/dialects/centurion/modal_state.hpp"
#include "gateway/interpreter/dialects/centurion/reading/text_cursor.hpp"

/// Finds the places a program jumps to, in a program of any size, as far as it has arrived.
namespace dripline::interpreter::centurion {

/// How a block begins, as far as jumps use it.
struct BlockHead {
  enum class Kind : std::uint8_t { Empty, Program, Label, Other };
  Kind kind = Kind::Empty;
  std::uint32_t number = 0;  ///< of O or N
};
/// `begin` must end with an end-of-block character. Empty: blanks, comments or only %.
BlockHead read_head(const char* begin);

/// WHILE and WEND of one block, in order, outside comments and output text: +1 and -1 are added to
/// `depth` until it is 0. True when it got there.
bool count_loops(const char* begin, int& depth);

/// A place in the text: the first block from a line, or from a byte on.
struct BlockPlace {
  bool is_line = false;
  std::uint64_t number = 0;
};

/// Places it has found are kept in bounded tables, which only save searching again. A search that
/// was interrupted resumes where it stopped. Moves the cursor.
class TextSearch {
 public:
  using Outcome = language::SearchOutcome;

  explicit TextSearch(TextCursor& cursor) : cursor_(cursor) {}

  /// The first block labeled N `label` in the program that `from` is in (manual: GOTO).
  Outcome find_label(const TextPosition& from, std::uint32_t label, TextPosition& found);
  /// The program O `number` in the text that was started: a file may hold several.
  Outcome find_program(std::uint32_t number, TextPosition& found);
  /// The first block from `place` on, in the text that was started, that has content; `offset`: of
  /// its first byte. For one place only.
  Outcome find_block(const BlockPlace& place, std::uint64_t& offset);
  /// The first block with content from `from` on that begins before `end`; Missing: there is none.
  Outcome find_content(const TextPosition& from, std::uint64_t end, std::uint64_t& line);
  /// The first block from `from` on that may jump back over it: a GOTO to a label of its program
  /// that is at `from` or before it, or one whose label is computed. Missing: none in the next
  /// kBlocksLookedAt blocks. `line`: of that block.
  Outcome find_jump_back(const TextPosition& from, std::uint64_t& line);
  static constexpr std::uint64_t kBlocksLookedAt = 1u << 20;  ///< longer loops are not found
  /// The end of the loop whose WHILE block is at `head`; `after` is the place after that block.
  Outcome find_wend(const TextPosition& head, const TextPosition& after, LoopFrame& loop);

 private:
  static constexpr std::size_t kIndexes = 4;
  static constexpr std::size_t kKnownLoops = 16;
  static constexpr unsigned kBlocksPerCall = 1u << 16;

  struct Place {
    std::uint64_t offset = 0;
    std::uint64_t line = 0;
  };
  /// First places of the labels in one program, as far as it has been read.
  struct LabelIndex {
    TextPosition next;
    bool is_used = false;
    bool is_complete = false;
    std::uint64_t last_use = 0;
    std::unordered_map<std::uint32_t, Place> places;  ///< labels go up to 99999
  };

  LabelIndex& index_of(const TextPosition& from);
  Outcome load(const TextPosition& at) { return language::outcome_of(cursor_.load(at)); }

  TextCursor& cursor_;
  std::array<LabelIndex, kIndexes> indexes_;
  std::uint64_t uses_ = 0;
  std::unordered_map<std::uint32_t, Place> programs_;  ///< numbers go up to 9999
  TextPosition programs_next_;
  bool programs_complete_ = false;
  std::array<LoopFrame, kKnownLoops> known_loops_{};
  std::size_t next_known_loop_ = 0;
  TextPosition place_next_;                   ///< of find_block
  TextPosition content_from_, content_next_;  ///< of the search that was interrupted
  TextPosition back_from_, back_next_;        ///< of the search that was interrupted
  std::uint64_t back_blocks_ = 0;
  std::optional<std::uint32_t> back_label_;  ///< of the last GOTO, while its label is searched
  TextPosition loop_head_;                   ///< of the search that was interrupted
  TextPosition loop_next_;
  int loop_depth_ = 0;
};

}  // namespace dripline::interpreter::centurion
