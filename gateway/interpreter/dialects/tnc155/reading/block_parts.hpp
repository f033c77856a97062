#pragma once

#include "gateway/interpreter/dialects/tnc155/itnc/itnc_words.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/block.hpp"

namespace dripline::interpreter::tnc155 {

/// The parts of one block of text: one for a plain-language block, one or more for an ISO block.
/// The room is fixed, so that reading does not allocate.
struct BlockParts {
  static constexpr std::size_t kMax = 16;

  void clear() {
    count = 0;
    sorts_distances = false;
  }
  Block& add(BlockKind kind) {
    Block& block = blocks[count++];
    block.clear(kind);
    return block;
  }
  const Block* begin() const { return blocks.data(); }
  const Block* end() const { return blocks.data() + count; }

  std::size_t count = 0;
  /// Of G90 and G91 in the block another one stays in force than the last one of the text.
  bool sorts_distances = false;
  std::array<Block, kMax> blocks;
  ItncWords itnc;  ///< of a later control's one block
};

}  // namespace dripline::interpreter::tnc155
