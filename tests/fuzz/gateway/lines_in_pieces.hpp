#pragma once

#include <cstdlib>
#include <span>
#include <string>
#include <vector>

/// For targets whose input is lines of a device.
namespace dripline::fuzz {

inline void require(bool holds) {
  if (!holds) std::abort();
}

/// The lines of `bytes`, cut by a `Splitter`. The pieces in which they come make no difference, and
/// no line is longer than its bound.
template <class Splitter>
std::vector<std::string> lines_in_pieces(std::span<const std::byte> bytes) {
  Splitter whole, pieces;
  const std::vector<std::string> lines = whole.feed(bytes);
  std::vector<std::string> same;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    for (std::string& line : pieces.feed(bytes.subspan(i, 1))) same.push_back(std::move(line));
  require(lines == same);
  for (const std::string& line : lines) require(line.size() <= Splitter::kMaxLine);
  return lines;
}

}  // namespace dripline::fuzz
