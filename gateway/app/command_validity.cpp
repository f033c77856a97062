#include "gateway/app/command_validity.hpp"

#include <fmt/format.h>
#include <algorithm>

namespace dripline::gateway {

std::optional<std::string> CommandValidity::refusal(const dds::Command& command,
                                                    SteadyTime now) const {
  using std::chrono::microseconds;
  if (command.deadline == microseconds{0} || command.server == 0 || command.session != session_) {
    return fmt::format(
        "the command names no session and deadline: the server is older than protocol {}",
        dds::kProtocolVersion);
  }
  const auto time = std::chrono::duration_cast<microseconds>(now.time_since_epoch());
  if (time > command.deadline) {
    return fmt::format("the command came {:.1f} s after its deadline",
                       std::chrono::duration<double>(time - command.deadline).count());
  }
  if (command.server == server_ && command.number < last_stop_)
    return "a later command has stopped the machine meanwhile";
  return std::nullopt;
}

void CommandValidity::note_stop(const dds::Command& command) {
  if (command.server != server_) last_stop_ = 0;
  server_ = command.server;
  last_stop_ = std::max(last_stop_, command.number);
}

}  // namespace dripline::gateway
