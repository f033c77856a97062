#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "gateway/interpreter/dialects/tnc155/reading/block_reader.hpp"

/// Places that jumps go to, found in text that may still be arriving.
namespace dripline::interpreter::tnc155 {

/// What jumps care about in a block. Blanks mean nothing.
struct BlockHead {
  std::int64_t number = -1;  ///< the block number, N in ISO; -1: none
  std::int32_t label = -1;   ///< LBL, G98 L; -1: none
};
BlockHead read_head(std::string_view block, Form form);

/// Looks through programs block by block, as they are read. A search goes on where it stopped when
/// it is called again, and gives back after a bounded number of blocks. What it learns is only ever
/// a faster way to the same answer. The windows of other readers of the source are stale after a
/// search.
class TextSearch {
 public:
  enum class Outcome : std::uint8_t { Found, Missing, NotYet, More, Failed };

  TextSearch(ProgramSource& source, ReaderOptions options);

  /// The first block of the program that sets this label (not 0).
  Outcome find_label(ProgramIndex program, std::uint32_t label, TextPlace& found);

  /// Why the last call said Failed.
  const std::string& reason() const { return reason_; }

 private:
  static constexpr unsigned kBlocksPerCall = 1u << 16;
  static constexpr std::size_t kIndexes = 5;  ///< as many programs as can be open
  static constexpr std::size_t kLabels = 255;

  /// How far a program has been looked through.
  struct Way {
    TextPlace next;
    ReadingState state;  ///< the form
  };
  /// First places of the labels of one program, as far as it has been read.
  struct Index {
    bool is_used = false;
    bool is_complete = false;
    std::uint64_t last_use = 0;
    Way way;
    std::array<std::optional<TextPlace>, kLabels> labels;
  };

  Index& index_of(ProgramIndex program);
  Outcome next_block(Way& way, std::string_view& text);

  BlockReader reader_;
  std::array<Index, kIndexes> indexes_;
  std::uint64_t uses_ = 0;
  std::string reason_;
};

}  // namespace dripline::interpreter::tnc155
