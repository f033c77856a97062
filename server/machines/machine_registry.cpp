#include "server/machines/machine_registry.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "protocol/process/log.hpp"

namespace dripline::machines {

namespace {

storage::RunProgress progress_of(const dds::Status& status) {
  return {
      .machine = status.machine,
      .run = status.run,
      .counters = {.sent = status.sent, .accepted = status.accepted, .executed = status.executed},
      .line = status.line,
      .sequence = status.sequence};
}

}  // namespace

/// Of the switches with which a program moves nothing those that are on: "test_run, machine_lock".
std::string MachineRegistry::still_switches(const dds::Status& status) {
  if (!status.switches) return {};
  std::string names;
  if (status.switches->test_run == dds::SwitchState::On) names = "test_run";
  if (status.switches->machine_lock == dds::SwitchState::On)
    names += names.empty() ? "machine_lock" : ", machine_lock";
  return names;
}

/// They were in the memory of the gateway that is gone.
void MachineRegistry::note_lost_switches(MachineView& view) {
  if (!view.status) return;
  std::string lost = still_switches(*view.status);
  if (lost.empty()) return;
  view.lost_switches = std::move(lost);
  process::log_warning("{} machine={}", switch_notice(view), view.machine.name);
}

/// A status may come before the announcement.
bool MachineRegistry::is_announced(const Entry& entry) {
  return !entry.view.machine.name.empty() && !entry.is_removed;
}

bool MachineRegistry::is_shown(const Entry& entry) {
  return is_announced(entry) && entry.is_stored;
}

Result<void> MachineRegistry::load() {
  auto machines = parts_.machines.list();
  if (!machines) return fail(machines.error());
  const std::lock_guard lock(mutex_);
  for (auto& machine : *machines) {
    const std::string name = machine.name;
    Entry& entry = entries_[name];
    MachineView& view = entry.view;
    entry.is_stored = true;
    if (view.is_connected) {  // it announced itself meanwhile: that is newer
      view.machine.first_seen = machine.first_seen;
    } else {
      view.machine = std::move(machine);
    }
  }
  return {};
}

void MachineRegistry::on_announce(const dds::Announce& announce) {
  const std::lock_guard lock(mutex_);
  Entry& entry = entries_[announce.machine];
  storage::Machine& machine = entry.view.machine;
  const UtcTime now = parts_.clock.now();
  if (machine.name.empty()) {
    machine.name = announce.machine;
    machine.first_seen = now;
  }
  entry.is_removed = false;
  machine.control = announce.control;
  machine.description = announce.description;
  machine.gateway_version = announce.version;
  machine.epoch = announce.epoch;
  machine.last_seen = now;
  entry.view.is_connected = true;
  entry.heard = parts_.clock.steady_now();
  entry.view.protocol = announce.protocol;
  entry.view.commands = announce.commands;
  entry.view.certificate_expires = announce.certificate_expires;
  hear(entry, announce.session);
  entry.machine_is_dirty = true;
  process::log_info("machine connected machine={} control={} gateway_version={}", announce.machine,
                    announce.control, announce.version);
  if (const auto notice = protocol_notice(announce.protocol); !notice.empty())
    process::log_error("machine refused machine={}: {}", announce.machine, notice);
  schedule(entry);
}

void MachineRegistry::on_status(dds::Status status) {
  const std::lock_guard lock(mutex_);
  Entry& entry = entries_[status.machine];
  entry.view.machine.last_seen = parts_.clock.now();
  const bool is_back = !is_repeated(entry, status) && note_status(entry);
  hear(entry, status.session);
  if (entry.has_rival) contest(entry);
  compare_clocks(entry, status);
  entry.counters_are_dirty = entry.counters_are_dirty || !status.run.empty();
  const bool is_urgent = is_back || !entry.view.status || is_news(*entry.view.status, status);
  if (!status.run.empty() || !still_switches(status).empty()) entry.view.lost_switches.clear();
  entry.view.status = std::move(status);
  if (!is_announced(entry)) return;
  if (is_urgent) {
    schedule(entry);
  } else {
    schedule_in_round(entry);
  }
}

/// The latest one, which a renewed reader gets again, is no sign of life. An older one may be:
/// without DDS Security what was taken before it may be forged, with any time.
bool MachineRegistry::is_repeated(const Entry& entry, const dds::Status& status) {
  const bool has_time = status.steady != std::chrono::microseconds{0};
  return has_time && entry.view.status && *entry.view.status == status;
}

bool MachineRegistry::note_status(Entry& entry) {
  entry.heard = parts_.clock.steady_now();
  entry.view.status_taken = parts_.clock.now();
  if (!std::exchange(entry.is_stale, false)) return false;
  process::log_info("statuses arrive again machine={}", entry.view.machine.name);
  return true;
}

bool MachineRegistry::is_silent(const Entry& entry) const {
  return entry.view.is_connected && parts_.clock.steady_now() - entry.heard > kStale;
}

std::vector<std::string> MachineRegistry::note_silence() {
  std::vector<std::string> due;
  const std::lock_guard lock(mutex_);
  const SteadyTime now = parts_.clock.steady_now();
  for (auto& [name, entry] : entries_) {
    if (!is_silent(entry)) {
      entry.is_stale = false;
      continue;
    }
    if (!std::exchange(entry.is_stale, true)) {
      process::log_error("{} machine={}", silence_notice(shown(entry)), name);
      entry.renewal = now;
      if (is_announced(entry)) schedule(entry);
    }
    if (now < entry.renewal) continue;
    entry.renewal = now + kRenewal;
    due.push_back(name);
  }
  return due;
}

void MachineRegistry::compare_clocks(Entry& entry, const dds::Status& status) {
  entry.clocks.compare(status, parts_.clock.now(), parts_.clock.steady_now());
  entry.view.clock_ahead = entry.clocks.time_ahead();
  if (!entry.view.clock_ahead) return;
  const auto notice = clock_notice(*entry.view.clock_ahead);
  // Clocks that differ by just the tolerance do not fill the log.
  const bool is_near = std::chrono::abs(*entry.view.clock_ahead) > GatewayClocks::kTolerance / 2;
  const bool is_off = !notice.empty() || (entry.clock_is_off && is_near);
  if (std::exchange(entry.clock_is_off, is_off) == is_off) return;
  if (is_off) {
    process::log_warning("{} machine={}", notice, status.machine);
  } else {
    process::log_info("the clocks of gateway and server agree again machine={}", status.machine);
  }
}

std::chrono::microseconds MachineRegistry::clock_error(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(name);
  if (found == entries_.end()) return {};
  const auto ahead = found->second.clocks.time_ahead().value_or(std::chrono::microseconds{0});
  return std::chrono::abs(ahead) > GatewayClocks::kTolerance ? ahead : std::chrono::microseconds{0};
}

CommandDispatcher::Options::Gateway MachineRegistry::gateway(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(name);
  if (found == entries_.end()) return {};
  return {found->second.view.session, found->second.clocks.steady_ahead()};
}

MachineView MachineRegistry::shown(const Entry& entry) const {
  MachineView view = entry.view;
  view.is_contested = parts_.clock.steady_now() < entry.contested_until;
  view.is_stale = is_silent(entry);
  return view;
}

void MachineRegistry::on_lost(const std::string& machine) {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(machine);
  if (found == entries_.end() || !found->second.view.is_connected) return;
  Entry& entry = found->second;
  entry.view.is_connected = false;
  entry.machine_is_dirty = true;
  process::log_warning("machine lost machine={}", machine);
  schedule(entry);
}

std::vector<MachineView> MachineRegistry::views() const {
  return views_of(is_shown);
}

std::vector<MachineView> MachineRegistry::views(const MachinePage& page) const {
  const std::lock_guard lock(mutex_);
  std::vector<MachineView> views;
  for (auto at = entries_.upper_bound(page.after);
       at != entries_.end() && views.size() < page.limit; ++at) {
    if (is_shown(at->second)) views.push_back(shown(at->second));
  }
  return views;
}

std::vector<MachineView> MachineRegistry::announced() const {
  return views_of(is_announced);
}

std::vector<MachineView> MachineRegistry::views_of(bool (*is_wanted)(const Entry&)) const {
  const std::lock_guard lock(mutex_);
  std::vector<MachineView> views;
  views.reserve(entries_.size());
  for (const auto& [name, entry] : entries_) {
    if (is_wanted(entry)) views.push_back(shown(entry));
  }
  return views;
}

Result<MachineView> MachineRegistry::view(const std::string& name) const {
  return view_of(name, is_shown);
}

Result<MachineView> MachineRegistry::announced(const std::string& name) const {
  return view_of(name, is_announced);
}

Result<MachineView> MachineRegistry::view_of(const std::string& name,
                                             bool (*is_wanted)(const Entry&)) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(name);
  if (found == entries_.end() || !is_wanted(found->second)) {
    return fail(Errc::NotFound, "machine '{}' is not known", name);
  }
  return shown(found->second);
}

/// However many changes arrive meanwhile, one task per machine publishes the latest.
void MachineRegistry::schedule(Entry& entry) {
  if (std::exchange(entry.is_scheduled, true) || entry.is_telling) return;
  parts_.pool.post([this, &entry] { publish(entry); });
}

/// One task for all machines whose positions or counters have changed meanwhile.
void MachineRegistry::schedule_in_round(Entry& entry) {
  if (entry.is_scheduled || std::exchange(entry.is_in_round, true)) return;
  if (round_.empty()) parts_.pool.post_after(round(), [this] { publish_round(); });
  round_.push_back(&entry);
}

std::chrono::milliseconds MachineRegistry::round() const {
  return std::clamp(std::chrono::milliseconds(entries_.size() / kMachinesAMillisecond),
                    kShortestRound, kLongestRound);
}

void MachineRegistry::publish_round() {
  std::vector<Entry*> entries;
  {
    const std::lock_guard lock(mutex_);
    entries.swap(round_);
    // One that is about to be published, or is being published, follows by itself.
    std::erase_if(entries, [](Entry* entry) {
      entry->is_in_round = false;
      return std::exchange(entry->is_scheduled, true) || entry->is_telling;
    });
  }
  for (Entry* entry : entries) publish(*entry);
}

void MachineRegistry::publish(Entry& entry) {
  MachineView view;
  bool is_dirty = false;
  {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(entry.is_scheduled, false)) return;
    entry.is_telling = true;
    is_dirty = entry.machine_is_dirty;
    view = shown(entry);
  }
  if (is_dirty) save_machine(entry);
  bool is_told = false;
  {
    const std::lock_guard lock(mutex_);
    is_told = entry.is_stored;
  }
  if (is_told) parts_.on_change(view);
  const std::lock_guard lock(mutex_);
  entry.is_telling = false;
  if (entry.is_scheduled) parts_.pool.post([this, &entry] { publish(entry); });
}

bool MachineRegistry::save_machine(Entry& entry) {
  storage::Machine machine;
  {
    const std::lock_guard lock(mutex_);
    if (entry.is_removed || std::exchange(entry.is_saving, true)) return false;
    entry.machine_is_dirty = false;
    machine = entry.view.machine;
  }
  auto saved = parts_.machines.save(machine);
  const std::lock_guard lock(mutex_);
  entry.is_saving = false;
  if (!saved) {
    process::log_warning("machine not saved machine={}: {}", machine.name, saved.error().what);
    entry.machine_is_dirty = true;
    return false;
  }
  return !std::exchange(entry.is_stored, true);
}

void MachineRegistry::save() {
  std::vector<storage::RunProgress> progressed;
  std::vector<Entry*> dirty;
  {
    const std::lock_guard lock(mutex_);
    for (auto& [name, entry] : entries_) {
      if (entry.machine_is_dirty) dirty.push_back(&entry);
      if (std::exchange(entry.counters_are_dirty, false))
        progressed.push_back(progress_of(*entry.view.status));
    }
  }
  for (Entry* entry : dirty) {
    if (!save_machine(*entry)) continue;
    const std::lock_guard lock(mutex_);
    schedule(*entry);  // nothing of it was published
  }
  if (progressed.empty()) return;
  const auto saved = parts_.runs.update_all_counters(progressed);
  for (std::size_t i = 0; i < saved.size(); ++i) {
    if (saved[i] || saved[i].error().code == Errc::NotFound) continue;
    process::log_debug("progress not saved machine={} run={}: {}", progressed[i].machine,
                       progressed[i].run, saved[i].error().what);
  }
}

using std::chrono::microseconds;

void GatewayClocks::compare(const dds::Status& status, UtcTime now, SteadyTime steady_now) {
  if (status.steady == microseconds{0}) return;  // from a gateway that does not report it
  steady_ahead_ =
      status.steady - std::chrono::duration_cast<microseconds>(steady_now.time_since_epoch());
  time_ahead_[count_++ % kSamples] = status.time - now;
}

std::optional<microseconds> GatewayClocks::time_ahead() const {
  if (count_ < kSamples) return std::nullopt;
  return *std::max_element(time_ahead_.begin(), time_ahead_.end());
}

}  // namespace dripline::machines
