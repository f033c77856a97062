#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>

#include "gateway/interpreter/dialects/tnc155/reading/block_reader.hpp"

/// Finds the places that jumps lead to, in text that may still be arriving.
namespace dripline::interpreter::tnc155 {

/// The words of a block that matter to jumps. Blanks are ignored.
struct BlockHead {
  std::int64_t number = -1;  ///< the block number, N in ISO; -1: none
  std::int32_t label = -1;   ///< LBL, G98 L; -1: none
  bool is_end = false;       ///< END PGM: of plain language
  /// A slash before the words or the number: block skip. With its switch off the control has them.
  bool is_skipped = false;
  /// Of a later control: what follows LBL, where that is a name in quotes.
  std::string_view name = {};
};
BlockHead read_head(std::string_view block, Form form);

/// A block that sets a label.
struct LabelSet {
  TextPlace at;
  std::int64_t block = -1;  ///< its number; -1: none
  /// "block 12 (line 13)", or the line alone.
  std::string text() const;
};

/// Searches programs block by block, as they are read. A search resumes where it stopped when it is
/// called again, and returns after a bounded number of blocks. Its index is a cache: it never
/// changes the answer. The windows of other readers of the source are stale after a search.
///
/// A label that is set twice makes every jump of its program ambiguous, so a label is only found in
/// a program that was searched to its end. Memory: kMaxNames and kLastItncLabel labels of a
/// program.
class TextSearch {
 public:
  enum class Outcome : std::uint8_t { Found, Missing, NotYet, More, Failed, Doubled };

  TextSearch(ProgramSource& source, ReaderOptions options);

  /// The block of the program that sets this label (not 0).
  /// `name`: of a label that has one.
  Outcome find_label(ProgramIndex program, std::uint32_t label, std::string_view name,
                     TextPlace& found);
  /// Looks for a label that is set twice among the first blocks of a program. Found: there is none.
  Outcome check_labels(ProgramIndex program, std::uint64_t blocks);

  /// Why the last call returned Failed.
  const std::string& reason() const { return reason_; }
  /// After Doubled: LBL 5 is set in block 12 (line 13) and in block 40 (line 41).
  const std::string& doubled() const { return reason_; }
  /// After Doubled: the second block that sets it.
  const LabelSet& second() const { return second_; }

  static constexpr std::size_t kMaxNames = 10'000;          ///< of labels, in one program
  static constexpr std::size_t kMaxNameBytes = 512 * 1024;  ///< all of them

 private:
  static constexpr unsigned kBlocksPerCall = 1u << 16;
  static constexpr std::size_t kIndexes = 5;         ///< as many programs as can be open
  static constexpr std::size_t kLargeIndex = 8'192;  ///< labels: only one index has more

  /// How far a program has been searched.
  struct Progress {
    TextPlace next;
    ReadingState state;  ///< the form
  };
  /// The labels of one program, as far as it has been read.
  struct Index {
    bool is_used = false;
    bool is_complete = false;
    std::uint64_t last_use = 0;
    std::uint64_t blocks = 0;
    Progress progress;
    std::unordered_map<std::uint32_t, LabelSet> numbers;
    std::map<std::string, LabelSet, std::less<>> names;
    std::size_t name_bytes = 0;
    std::string doubled;  ///< the first label that is set twice, or too many of them
    LabelSet second;
  };

  Outcome search(Index& index, std::uint64_t blocks);
  void note(Index& index, std::string_view text);
  void note_label(Index& index, const BlockHead& head, const LabelSet& set);
  void make_room(const Index& index);
  Index& index_of(ProgramIndex program);
  Outcome next_block(Progress& progress, std::string_view& text);

  BlockReader reader_;
  bool is_itnc_;
  std::array<Index, kIndexes> indexes_;
  std::uint64_t uses_ = 0;
  std::string reason_;
  LabelSet second_;
};

}  // namespace dripline::interpreter::tnc155
