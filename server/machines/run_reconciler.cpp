#include "server/machines/run_reconciler.hpp"

#include <algorithm>
#include "protocol/process/log.hpp"

namespace dripline::machines {

Result<void> RunReconciler::load() {
  for (const auto state : {storage::RunState::Ordered, storage::RunState::Active}) {
    constexpr std::uint64_t kPage = 500;
    for (std::uint64_t offset = 0;; offset += kPage) {
      storage::RunFilter filter;
      filter.state = state;
      const auto runs = parts_.runs.list(filter, {.limit = kPage, .offset = offset});
      if (!runs) return fail(runs.error());
      for (const auto& run : *runs) watch(run.machine, run.id);
      if (runs->size() < kPage) break;
    }
  }
  return {};
}

void RunReconciler::watch(const std::string& machine, const std::string& run) {
  const std::lock_guard lock(mutex_);
  runs_[run] = {.machine = machine, .absent_since = {}};
}

void RunReconciler::drop(const std::string& run) {
  const std::lock_guard lock(mutex_);
  runs_.erase(run);
}

bool RunReconciler::has_run(const std::string& machine) const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(runs_,
                             [&](const auto& entry) { return entry.second.machine == machine; });
}

void RunReconciler::compare(const std::vector<MachineView>& machines) {
  std::map<std::string, Watched> runs;
  {
    const std::lock_guard lock(mutex_);
    runs = runs_;
  }
  for (const auto& entry : runs) {
    const std::string& machine = entry.second.machine;
    const auto view = std::ranges::find_if(
        machines, [&](const MachineView& m) { return m.machine.name == machine; });
    if (view != machines.end()) judge(entry.first, *view);
  }
  for (const auto& view : machines) {
    const bool shows_run = view.is_connected && view.status && !view.status->run.empty();
    if (shows_run && !runs.contains(view.status->run)) look_for_unwanted(view);
  }
}

/// The start was accepted, but neither its result nor a status arrived in time.
void RunReconciler::look_for_unwanted(const MachineView& view) {
  const auto run = parts_.runs.find(view.status->run);
  if (!run || run->state != storage::RunState::Refused) return;
  if (run->machine == view.machine.name) parts_.on_unwanted(*run);
}

void RunReconciler::judge(const std::string& run, const MachineView& view) {
  if (view.is_connected && view.status && view.status->run == run) {
    is_absent_for_long(run, false);
    auto resolved = resolve_ordered(run, storage::RunState::Active, "");
    if (resolved && resolved->state != storage::RunState::Active) drop(run);
    return;
  }
  // Of two gateways that claim the machine, the one that is not heard may have the run.
  const bool is_absent = view.is_heard() && !view.is_contested && view.status &&
                         view.status->outbox == 0 && !parts_.commands.is_waiting_for(run);
  if (is_absent_for_long(run, is_absent)) give_up(run);
}

bool RunReconciler::is_absent_for_long(const std::string& run, bool is_absent) {
  const std::lock_guard lock(mutex_);
  const auto found = runs_.find(run);
  if (found == runs_.end()) return false;
  auto& since = found->second.absent_since;
  if (!is_absent) {
    since.reset();
    return false;
  }
  if (!since) since = parts_.clock.steady_now();
  return parts_.clock.steady_now() - *since >= kAbsence;
}

void RunReconciler::give_up(const std::string& id) {
  const std::lock_guard lock(parts_.state_mutex);
  const auto run = parts_.runs.find(id);
  if (!run && run.error().code != Errc::NotFound) return;  // tried again at the next comparison
  const bool was_commanded = run && run->state == storage::RunState::Ordered;
  const bool was_active = run && run->state == storage::RunState::Active;
  if (!was_commanded && !was_active) return drop(id);
  const auto state = was_commanded ? storage::RunState::Refused : storage::RunState::Interrupted;
  const std::string reason = was_commanded ? "the gateway never confirmed the start"
                                           : "the gateway does not know this run any more";
  process::log_warning("run given up machine={} run={} program={}: {}", run->machine, id,
                       run->program, reason);
  if (auto set = parts_.runs.set_state(id, state, reason); !set) {
    // Still watched, so this is tried again; otherwise the machine would be busy forever.
    process::log_error("run state not stored machine={} run={}: {}", run->machine, id,
                       set.error().what);
    return;
  }
  drop(id);
  if (const auto changed = parts_.runs.find(id)) parts_.on_change(*changed);
}

Result<storage::Run> RunReconciler::resolve_ordered(const std::string& id, storage::RunState state,
                                                    const std::string& reason) {
  const std::lock_guard lock(parts_.state_mutex);
  auto run = parts_.runs.find(id);
  if (!run || run->state != storage::RunState::Ordered) return run;
  if (auto set = parts_.runs.set_state(id, state, reason); !set) return fail(set.error());
  run = parts_.runs.find(id);
  if (run) parts_.on_change(*run);
  return run;
}

}  // namespace dripline::machines
