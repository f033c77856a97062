#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "protocol/base/clock.hpp"
#include "protocol/dds/message.hpp"

namespace dripline::gateway {

/// Decides whether a command that moves something may still be carried out: by this gateway's
/// steady clock and the command's number alone, because the time of day of two machines differs.
/// Stops are always valid. One thread.
class CommandValidity {
 public:
  /// `session`: of this gateway.
  explicit CommandValidity(std::uint64_t session) : session_(session) {}

  /// Why it is refused; nothing when it is valid.
  std::optional<std::string> refusal(const dds::Command& command, SteadyTime now) const;
  /// A command that was given before this one and arrives after it moves nothing any more: a
  /// repeated resume must not undo a hold.
  void note_stop(const dds::Command& command);

 private:
  std::uint64_t session_;
  std::uint64_t server_ = 0, last_stop_ = 0;
};

}  // namespace dripline::gateway
