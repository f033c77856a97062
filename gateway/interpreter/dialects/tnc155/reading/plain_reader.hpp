#pragma once

#include "gateway/interpreter/dialects/tnc155/reading/text_cursor.hpp"

namespace dripline::interpreter::tnc155 {

/// Reads one block of plain language, [begin, end) with all its lines; `*end` can be read and is a
/// line end. False: `fault` has the reason, and `block` is unspecified. Does not change `state`.
bool read_plain_block(const char* begin, const char* end, const ReadingState& state, Block& block,
                      Fault& fault);

/// Updates the reading state after a plain-language block.
void note_plain_block(const Block& block, ReadingState& state);

}  // namespace dripline::interpreter::tnc155
