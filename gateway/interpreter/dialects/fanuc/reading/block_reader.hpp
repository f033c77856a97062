#pragma once

#include "gateway/interpreter/dialects/fanuc/run.hpp"

namespace dripline::interpreter::fanuc {

/// What a block begins as, to be copied. Defined out of sight: where a compiler sees the zeros it
/// fills them in with one slow instruction.
extern const Block::Parts kFreshParts;

/// Reads the block that the text cursor shows into `run.block`, with no effect on anything else.
/// False when it pauses: the block is then read again from its beginning.
bool read_block(Run& run);

/// From `at` to the semicolon or LF that ends its block.
const char* find_block_end(const Run& run, const char* at);
/// Blanks and comments; a comment that is not closed ends with the line.
void skip_gaps(Run& run, const char*& at);

}  // namespace dripline::interpreter::fanuc
