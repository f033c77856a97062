#include "server/machines/stop_order.hpp"

#include <algorithm>

#include "protocol/dds/endpoint.hpp"

namespace dripline::machines {

StopOrder::Key StopOrder::key(const std::string& machine, dds::CommandAction action) {
  return {machine, dds::is_override(action) ? action : dds::CommandAction::Hold};
}

void StopOrder::note(const std::string& machine, dds::CommandAction action, SteadyTime given) {
  SteadyTime& last = last_[key(machine, action)];
  last = std::max(last, given);
}

Result<void> StopOrder::check(const std::string& machine, dds::CommandAction action,
                              SteadyTime given) const {
  const auto stop = last_.find(key(machine, action));
  if (stop == last_.end() || stop->second <= given) return {};
  return fail(Errc::Conflict,
              "machine {}: {} was given before a command that stopped it, and came after it: "
              "nothing was done",
              machine, dds::to_string(action));
}

Result<void> check_age(const std::string& machine, dds::CommandAction action, SteadyTime given,
                       SteadyTime now, std::chrono::milliseconds limit) {
  const auto waited = now - given;
  if (waited <= limit) return {};
  return fail(Errc::Busy,
              "machine {}: {} waited {:.1f} s in the server, {:.0f} are allowed: nothing was done",
              machine, dds::to_string(action), std::chrono::duration<double>(waited).count(),
              std::chrono::duration<double>(limit).count());
}

}  // namespace dripline::machines
