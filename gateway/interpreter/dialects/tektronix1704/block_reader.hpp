#pragma once

#include <cstdint>
#include <string_view>

#include "gateway/interpreter/dialects/tektronix1704/run.hpp"

namespace dripline::interpreter::tektronix1704 {

inline constexpr char kRewindStop = '%';

enum class ReadOutcome : std::uint8_t {
  Block,    ///< `state.block` holds a whole block
  GoesOn,   ///< the end of block stood in a comment: the next line belongs to it
  EndCode,  ///< the rewind stop code was met
  Alarm,
};

/// Reads the characters of one line, its end of block included, into `state.block` (manual: tape,
/// blocks and words).
ReadOutcome read_line(Run& run, std::string_view line);

/// Whether a line of a leader could be a block: it has an axis word, a block number after the
/// rewind stop code, or nothing but words beside that code. Titles and comments are none.
bool looks_like_block(std::string_view line);

}  // namespace dripline::interpreter::tektronix1704
