// Which gateway speaks for a machine: the one heard last, two at once, another one than before.
#include <algorithm>
#include <utility>

#include "protocol/process/log.hpp"
#include "server/machines/machine_registry.hpp"

namespace dripline::machines {
namespace {

constexpr std::size_t kMaxSessions = 8;

}  // namespace

/// A restarted gateway has a new session, and the old one is never heard again. If it is heard,
/// there are two.
void MachineRegistry::hear(Entry& entry, std::uint64_t session) {
  if (session == 0 || session == entry.view.session) return;
  auto& earlier = entry.earlier_sessions;
  if (std::ranges::find(earlier, session) != earlier.end()) {
    contest(entry);
    std::erase(earlier, session);
  }
  if (entry.view.session != 0) earlier.push_back(entry.view.session);
  if (earlier.size() > kMaxSessions) earlier.pop_front();
  if (entry.view.session != 0) note_lost_switches(entry.view);
  entry.view.session = session;
  entry.clocks.reset();
}

void MachineRegistry::contest(Entry& entry) {
  const SteadyTime now = parts_.clock.steady_now();
  if (now >= entry.contested_until) {
    process::log_error("two gateways claim to be machine={}: stop one of them",
                       entry.view.machine.name);
  }
  entry.contested_until = now + kContested;
}

/// A killed gateway and its successor: the first is never heard again. If it is, there are two.
void MachineRegistry::on_rival(const std::string& machine, bool is_there) {
  const std::lock_guard lock(mutex_);
  Entry& entry = entries_[machine];
  entry.has_rival = is_there;
  if (is_there || entry.unconfirmed_epoch == 0) return;
  entry.unconfirmed_epoch = 0;
  entry.view.unconfirmed_gateway.reset();
  if (is_announced(entry)) schedule(entry);
}

bool MachineRegistry::may_serve(const dds::Announce& announce, bool has_run) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(announce.machine);
  if (found == entries_.end() || !is_announced(found->second)) return true;
  Entry& entry = found->second;
  const bool shows_run = entry.view.status && !entry.view.status->run.empty();
  const bool is_same = entry.view.machine.epoch == announce.epoch;
  const bool may = is_same || entry.confirmed_epoch == announce.epoch || !(has_run || shows_run);
  const std::uint64_t before = std::exchange(entry.unconfirmed_epoch, may ? 0 : announce.epoch);
  entry.view.unconfirmed_gateway.reset();
  if (!may)
    entry.view.unconfirmed_gateway = announce.version.empty() ? "unknown" : announce.version;
  if (before == entry.unconfirmed_epoch) return may;
  if (!may)
    process::log_error("{} machine={} control={}", stranger_notice(entry.view), announce.machine,
                       announce.control);
  schedule(entry);
  return may;
}

Result<std::string> MachineRegistry::confirm_gateway(const std::string& machine) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(machine);
  if (found == entries_.end() || !is_shown(found->second))
    return fail(Errc::NotFound, "machine '{}' is not known", machine);
  Entry& entry = found->second;
  if (entry.unconfirmed_epoch == 0)
    return fail(Errc::Conflict, "machine '{}': no gateway waits to be confirmed", machine);
  entry.confirmed_epoch = entry.unconfirmed_epoch;
  return fmt::format("gateway {} with records of epoch {}",
                     entry.view.unconfirmed_gateway.value_or(""), entry.confirmed_epoch);
}

}  // namespace dripline::machines
