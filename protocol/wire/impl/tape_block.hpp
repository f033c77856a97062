#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

/// The words of a block with which a tape control drives its reader. Pure; any thread.
namespace dripline::wire {

/// The number after `address`, outside comments: "N012G1" has N 12. nullopt: no such word.
std::optional<std::uint64_t> word_value(std::string_view block, char address);

enum class TapeEnd { None, Stop, Rewind };
/// M02 stops the reader after this block, M30 rewinds the tape.
TapeEnd tape_end(std::string_view block);

}  // namespace dripline::wire
