#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"

namespace dripline::interpreter {

/// Looks for a block whose axis words do nothing. Of every block that was executed without a
/// message, other numbers are put into its axis words, one after the other, and the block is
/// executed again from the state before it: of one of them at least the events, the question, the
/// alarm or the state after it must be others. Knows no code of any control. Looks at the first
/// `max_blocks` blocks, at those of the main program. Gives the block; nothing when there is none.
std::optional<std::string> find_vanished_word(const Dialect& dialect, std::string_view text,
                                              const Setup& setup, std::uint64_t max_blocks,
                                              const MemorySource::Loader& loader = {});

}  // namespace dripline::interpreter
