#include "server/app/impl/lost_machines.hpp"

#include <algorithm>

#include "protocol/process/log.hpp"

namespace dripline::app {
namespace {

constexpr const char* kLostSubject = "connection";

/// A machine on a line of the server's own has no gateway.
bool is_away(const machines::MachineView& view) {
  return !view.is_connected && !view.machine.gateway_version.empty();
}

}  // namespace

bool LostMachines::is_any_away(const std::vector<machines::MachineView>& machines) {
  return std::ranges::any_of(machines, is_away);
}

void LostMachines::look(const std::vector<machines::MachineView>& machines,
                        const std::vector<storage::Run>& active) {
  std::map<std::string, Away> now_away;
  for (const auto& view : machines) {
    if (!is_away(view)) continue;
    const auto run = std::ranges::find(active, view.machine.name, &storage::Run::machine);
    if (run == active.end()) continue;
    const auto known = away_.find(view.machine.name);
    Away away = known == away_.end() ? Away{clock_.steady_now()} : known->second;
    if (clock_.steady_now() - away.since >= kGrace) report(*run, away);
    now_away.emplace(view.machine.name, away);
  }
  for (const auto& [machine, away] : away_)
    if (!now_away.contains(machine)) clear(machine, away);
  away_ = std::move(now_away);
}

void LostMachines::report(const storage::Run& run, Away& away) {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(clock_.steady_now() - away.since);
  health_.report(
      run.machine,
      {.level = library::Health::Level::Degraded,
       .subject = kLostSubject,
       .what = "a machine with a run in progress is not connected to this server",
       .detail = fmt::format("machine={}: not connected for {} s in run {} of {}. Where its "
                             "gateway runs, and the other server of this database reaches it: "
                             "dnc server drain",
                             run.machine, seconds.count(), run.id, run.program)});
  if (std::exchange(away.is_reported, true)) return;
  process::log_warning("machine={} run={}: not connected for {} s in the middle of a run",
                       run.machine, run.id, seconds.count());
}

void LostMachines::clear(const std::string& machine, const Away& away) {
  if (!away.is_reported) return;
  health_.report(
      machine,
      {.level = library::Health::Level::Ok, .subject = kLostSubject, .what = {}, .detail = {}});
}

}  // namespace dripline::app
