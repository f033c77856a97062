#pragma once

#include <cstdint>

#include "gateway/interpreter/core/program_source.hpp"

namespace dripline::interpreter {

/// The place in the program that an event comes from.
struct Origin {
  /// Ordinal of the executed block, from 1; every pass of a loop has new ones.
  std::uint64_t block = 0;
  std::uint64_t offset = 0;       ///< of the block's first byte in its program
  std::uint64_t line = 0;         ///< 1-based line of the source text
  std::int64_t sequence = kNone;  ///< the N or block number last seen on this block, or kNone
  ProgramIndex program = kMainProgram;

  static constexpr std::int64_t kNone = -1;
  friend bool operator==(const Origin&, const Origin&) = default;
};

}  // namespace dripline::interpreter
