#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "gateway/interpreter/dialects/tnc155/reading/block_reader.hpp"

/// Finds the places that jumps lead to, in text that may still be arriving.
namespace dripline::interpreter::tnc155 {

/// The words of a block that matter to jumps. Blanks are ignored.
struct BlockHead {
  std::int64_t number = -1;  ///< the block number, N in ISO; -1: none
  std::int32_t label = -1;   ///< LBL, G98 L; -1: none
};
BlockHead read_head(std::string_view block, Form form);

/// Searches programs block by block, as they are read. A search resumes where it stopped when it is
/// called again, and returns after a bounded number of blocks. Its index is a cache: it never
/// changes the answer. The windows of other readers of the source are stale after a search.
class TextSearch {
 public:
  enum class Outcome : std::uint8_t { Found, Missing, NotYet, More, Failed };

  TextSearch(ProgramSource& source, ReaderOptions options);

  /// The first block of the program that sets this label (not 0).
  /// `name`: of a label that has one.
  Outcome find_label(ProgramIndex program, std::uint32_t label, std::string_view name,
                     TextPlace& found);

  /// Why the last call returned Failed.
  const std::string& reason() const { return reason_; }

 private:
  static constexpr unsigned kBlocksPerCall = 1u << 16;
  static constexpr std::size_t kIndexes = 5;  ///< as many programs as can be open
  static constexpr std::size_t kLabels = 255;

  /// How far a program has been searched.
  struct Progress {
    TextPlace next;
    ReadingState state;  ///< the form
  };
  /// First places of the labels of one program, as far as it has been read.
  struct Index {
    bool is_used = false;
    bool is_complete = false;
    std::uint64_t last_use = 0;
    Progress progress;
    std::array<std::optional<TextPlace>, kLabels> labels;
    /// Of later controls, as the text has them: a number, or "NAME".
    std::map<std::string, TextPlace, std::less<>> others;
  };

  /// Until `known()` has the place; `note` takes what each block on the path sets.
  template <class Known, class Note>
  Outcome search(Index& index, Known known, Note note, TextPlace& found);
  Outcome find_later_label(Index& index, const std::string& label, TextPlace& found);
  Index& index_of(ProgramIndex program);
  Outcome next_block(Progress& progress, std::string_view& text);

  BlockReader reader_;
  bool is_later_;
  std::array<Index, kIndexes> indexes_;
  std::uint64_t uses_ = 0;
  std::string reason_;
};

}  // namespace dripline::interpreter::tnc155
