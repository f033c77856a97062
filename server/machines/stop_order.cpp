#include "server/machines/stop_order.hpp"

#include "protocol/dds/endpoint.hpp"

namespace dripline::machines {

StopOrder::Key StopOrder::key(const std::string& machine, dds::CommandAction action) {
  return {machine, dds::is_override(action) ? action : dds::CommandAction::Hold};
}

const StopOrder::Stop* StopOrder::later(const Key& key, SteadyTime given) const {
  const auto stop = last_.find(key);
  return stop != last_.end() && stop->second.given > given ? &stop->second : nullptr;
}

void StopOrder::note(const std::string& machine, dds::CommandAction action, SteadyTime given,
                     double value) {
  const Key of = key(machine, action);
  if (later(of, given) == nullptr) last_[of] = {given, value};
}

Result<void> StopOrder::check(const std::string& machine, dds::CommandAction action,
                              SteadyTime given) const {
  if (later(key(machine, action), given) == nullptr) return {};
  return fail(Errc::Conflict,
              "machine {}: {} was given before a command that stopped it, and came after it: "
              "nothing was done",
              machine, dds::to_string(action));
}

Result<void> StopOrder::check_lowered(const std::string& machine, dds::CommandAction action,
                                      SteadyTime given, double value) const {
  const Stop* const stop = later(key(machine, action), given);
  if (stop == nullptr || stop->value >= value) return {};
  return fail(Errc::Conflict, "machine {}: {} {} was given before {}, which is less: it stays",
              machine, dds::to_string(action), value, stop->value);
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
