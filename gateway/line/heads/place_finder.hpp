#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "gateway/line/heads/tool_finder.hpp"

namespace dripline::line {

/// A place in a program.
struct ProgramPlace {
  std::uint64_t byte = 0;
  std::uint64_t line = 1;  ///< 1-based; the block that holds the byte
};

/// Where a run is to begin, as it was asked for: one of these, or none for the first byte.
struct WantedPlace {
  std::optional<std::uint64_t> byte = std::nullopt;
  std::optional<std::uint64_t> line = std::nullopt;      ///< 1-based
  std::optional<std::uint64_t> sequence = std::nullopt;  ///< the first block with this N number
  std::optional<std::uint64_t> tool = std::nullopt;      ///< the first block that changes to it
  bool is_beginning() const { return !byte && !line && !sequence && !tool; }
};
/// "byte 4096", "line 7", "block N120", "change to tool 3".
std::string to_text(const WantedPlace& wanted);

/// Finds a place in a program's text while it arrives, piece by piece, in bounded memory. Pure.
class PlaceFinder {
 public:
  /// `control`: the machine's dialect, which decides what changes a tool.
  PlaceFinder(const WantedPlace& wanted, std::string_view control);

  /// True: it is in this piece, and `place` has it; no more text is needed.
  bool look(std::string_view piece);
  /// After the last piece: the block without a line end may be the one.
  bool look_at_end();
  const ProgramPlace& place() const { return place_; }

 private:
  bool look(char c);
  bool end_block();

  const WantedPlace wanted_;
  const std::size_t kept_;  ///< of each block
  std::optional<ToolFinder> tools_;
  ProgramPlace place_;  ///< where the block begins
  std::uint64_t at_ = 0;
  std::string head_;
  bool ends_in_block_ = false;
};

}  // namespace dripline::line
