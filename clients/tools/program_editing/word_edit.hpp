#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "clients/tools/program_editing/program_edit.hpp"

/// Changes within blocks, as an operator makes them word by word at the control. The control
/// defines its words.
namespace dripline::program_editing {

struct WordChange {
  enum class Kind : std::uint8_t {
    Set,       ///< the word gets another value
    LeaveOut,  ///< the word is taken out: what is in force stays
    Shorten,   ///< the block ends in front of the word
  };
  Kind kind = Kind::Set;
  std::int64_t block = 0;  ///< its number
  std::string word;        ///< Set: address and value, "X+5"; else the address alone
};

/// The blocks that have a word with one of the addresses that were looked for.
struct WordSearch {
  struct Found {
    std::int64_t block = kNoNumber;
    std::uint64_t line = 0;  ///< it begins in
    std::string text;        ///< in one line
  };
  /// A block that cannot be read, so its words are not known.
  struct Unread {
    Found block;
    std::string reason;
  };
  std::vector<Found> found;
  std::vector<Unread> unread;
};

}  // namespace dripline::program_editing
