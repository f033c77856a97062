#pragma once

#include <string>

#include "gateway/feed/line_feed.hpp"
#include "gateway/interpreter/core/event.hpp"

namespace dripline::gateway {

/// Texts of the blocks around a place of a program, in the order of the program; empty where there
/// is none, or its text is not at hand.
struct BlockTexts {
  std::string previous, block, next, further;
};

/// A block is a line that is not blank. Before the first block (`at.block` is 0) the program's
/// first blocks are the next ones.
BlockTexts block_texts(const feed::ProgramFeed& feed, const interpreter::Origin& at);

}  // namespace dripline::gateway
