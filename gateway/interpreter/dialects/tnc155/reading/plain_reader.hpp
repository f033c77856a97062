#pragma once

#include "gateway/interpreter/dialects/tnc155/reading/text_cursor.hpp"

namespace dripline::interpreter::tnc155 {

/// Reads one block of plain language, [begin, end) with all its lines; `*end` can be read and is a
/// line end. False: `fault` says why, `block` is worth nothing. Does not change `state`.
bool read_plain_block(const char* begin, const char* end, const ReadingState& state, Block& block,
                      Fault& fault);

/// What a block of plain language leaves after for the reading of the next ones.
void note_plain_block(const Block& block, ReadingState& state);

}  // namespace dripline::interpreter::tnc155
