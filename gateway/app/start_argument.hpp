#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"

namespace dripline::gateway {

/// With which memory of the control the part before a start in the middle is gone through, where
/// that part changes what it has read before.
enum class StartMemory : std::uint8_t {
  Ask,    ///< an alarm, which names what would be lost
  Begin,  ///< as it was when the last run of the revision began at its first block
  Now,    ///< as it is
};

/// Where a run begins, as the order to start it says: "N120", "N120 pass=3 memory=begin"; empty:
/// at the first block.
struct StartArgument {
  std::string place;  ///< for the dialect to read
  std::optional<std::uint32_t> pass;
  StartMemory memory = StartMemory::Ask;
  friend bool operator==(const StartArgument&, const StartArgument&) = default;
};
/// Errors: Syntax (something that is not known here: nothing is started then).
Result<StartArgument> parse_start_argument(std::string_view text);

}  // namespace dripline::gateway
