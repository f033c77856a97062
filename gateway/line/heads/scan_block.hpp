#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace dripline::line {

inline constexpr std::size_t kMaxScannedBlock = 4096;  ///< bytes; the rest of one is not searched

/// A letter and everything up to the next one, as it is written.
struct ScannedWord {
  char letter = 0;
  std::string value;
  bool is_number = false;
  std::string text() const { return letter + value; }
};
using ScannedBlock = std::vector<ScannedWord>;

/// The words at depth 0 of a block; comments are left out. Any thread.
ScannedBlock scan_block(std::string_view text);

}  // namespace dripline::line
