#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "gateway/app/restart/restart_argument.hpp"
#include "gateway/line/heads/head_scan.hpp"
#include "protocol/base/result.hpp"

namespace dripline::gateway {

/// The memory of the control under which the blocks before a start in the middle are read, where
/// they change what they have read before.
enum class StartMemory : std::uint8_t {
  Ask,    ///< an alarm, which names what would be lost
  Begin,  ///< as it was when the last run of the revision began at its first block
  Now,    ///< as it is
};

/// Where a run begins, as its start command states: "N120", "N120 pass=3 memory=begin",
/// "N120 head=send", "test=yes", "restart=RUN at=executed"; empty: at the first block.
struct StartArgument {
  std::string place;  ///< for the dialect to read
  std::optional<std::uint32_t> pass;
  StartMemory memory = StartMemory::Ask;
  /// Over a line: what becomes of the words before the place that the rest relies on.
  line::HeadChoice head = line::HeadChoice::Ask;
  std::optional<RestartArgument> restart = {};  ///< then there is nothing else
  /// Which program of a tape, where the reader is not at its beginning.
  std::optional<std::uint32_t> part = {};
  bool is_mdi = false;   ///< the text is keyed in at the control; then there is nothing else
  bool is_test = false;  ///< a test run, whatever the panel's switch says
  friend bool operator==(const StartArgument&, const StartArgument&) = default;
};
/// Errors: Syntax (an unknown word; nothing is started then).
Result<StartArgument> parse_start_argument(std::string_view text);

}  // namespace dripline::gateway
