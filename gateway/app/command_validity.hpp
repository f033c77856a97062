#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "protocol/base/clock.hpp"
#include "protocol/dds/message.hpp"

namespace dripline::gateway {

/// May an order that moves something still be carried out? Judged by this gateway's steady clock
/// and by the order's number alone: the time of day of two machines differs by whatever it likes.
/// What stops is never asked about. One thread.
class CommandValidity {
 public:
  /// `session`: of this gateway.
  explicit CommandValidity(std::uint64_t session) : session_(session) {}

  /// Why it is refused; nothing when it holds.
  std::optional<std::string> refusal(const dds::Command& command, SteadyTime now) const;
  /// Orders that were given before this one and come after it move nothing any more: a repeated
  /// resume must not undo a hold.
  void note_stop(const dds::Command& command);

 private:
  std::uint64_t session_;
  std::uint64_t server_ = 0, last_stop_ = 0;
};

}  // namespace dripline::gateway
