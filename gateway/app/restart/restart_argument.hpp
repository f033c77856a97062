#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

namespace dripline::gateway {

/// Where a run that was cut off is to continue. Of a block that was executed more than once the
/// last time counts.
struct RestartPlace {
  enum class Kind : std::uint8_t {
    Executed,  ///< after the block executed last
    Block,     ///< at this block, by its ordinal
    Line,      ///< at the block on this line
    Sequence,  ///< at the block with this N number
    Tool,      ///< at the change to this tool
    Time,      ///< after what was executed by then
  };
  Kind kind = Kind::Executed;
  std::uint64_t number = 0;
  UtcTime time{};
  std::string text = "executed";  ///< as it was written
  friend bool operator==(const RestartPlace&, const RestartPlace&) = default;
};
/// "executed", "block=1234", "L7", "N120", "T3", "time=2026-11-23T15:04:05Z". Errors: Syntax.
Result<RestartPlace> parse_restart_place(std::string_view text);

/// "2026-11-23T15:04:05Z", with up to six decimals. Errors: Syntax.
Result<UtcTime> parse_utc_time(std::string_view text);

/// What a start command asks for: "restart=RUN at=PLACE".
struct RestartArgument {
  std::string run;
  RestartPlace at;
  friend bool operator==(const RestartArgument&, const RestartArgument&) = default;
};

}  // namespace dripline::gateway
