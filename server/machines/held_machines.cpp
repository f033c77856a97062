#include "server/machines/held_machines.hpp"

#include <utility>

#include "protocol/process/log.hpp"

namespace dripline::machines {
namespace {

bool is_interrupted(dds::Execution execution) {
  using enum dds::Execution;
  return execution == FeedHold || execution == Interrupted || execution == ProgramStopped ||
         execution == OptionalStop;
}

bool shows(const dds::Status& status, const storage::MachineHold& hold) {
  return is_interrupted(status.execution) && (hold.run.empty() || status.run == hold.run);
}

void log_failure(const Result<void>& done, const std::string& machine) {
  if (done) return;
  process::log_warning("why machine={} is held is not kept over a restart: {}", machine,
                       done.error().what);
}

}  // namespace

Result<void> HoldReasons::load() {
  const auto queues = parts_.store.jobs.holds();
  if (!queues) return fail(queues.error());
  const auto holds = parts_.store.machines.holds();
  if (!holds) return fail(holds.error());
  const std::lock_guard lock(mutex_);
  for (const auto& hold : *queues) queues_[hold.machine] = hold;
  // What its status shows now decides whether it still is.
  for (const auto& hold : *holds)
    entries_[hold.machine] = {.hold = hold, .given = parts_.clock.steady_now(), .is_seen = true};
  return {};
}

std::optional<storage::MachineHold> HoldReasons::expect(storage::MachineHold hold) {
  hold.since = parts_.clock.now();
  const std::lock_guard lock(mutex_);
  Entry& entry = entries_[hold.machine];
  const bool is_new = entry.hold.machine.empty();
  std::optional<storage::MachineHold> before;
  if (!is_new) before = entry.hold;
  const bool hides_reason =
      !is_new && hold.reason.empty() && entry.hold.run == hold.run && !entry.hold.reason.empty();
  if (!hides_reason) entry = {.hold = std::move(hold), .given = parts_.clock.steady_now()};
  return before;
}

void HoldReasons::keep(const std::string& machine) {
  {
    const std::lock_guard lock(mutex_);
    if (!entries_.contains(machine)) return;  // it continues already
  }
  save(machine);
  changed(machine);
}

void HoldReasons::take_back(const std::string& machine,
                            std::optional<storage::MachineHold> before) {
  const std::lock_guard lock(mutex_);
  entries_.erase(machine);
  if (!before) return;
  entries_[machine] = {
      .hold = *std::move(before), .given = parts_.clock.steady_now(), .is_seen = true};
}

void HoldReasons::release(const std::string& machine) {
  {
    const std::lock_guard lock(mutex_);
    if (entries_.erase(machine) == 0) return;
  }
  save(machine);
  changed(machine);
}

void HoldReasons::set_queue_hold(const std::string& machine, std::optional<storage::JobHold> hold) {
  {
    const std::lock_guard lock(mutex_);
    if (hold) {
      queues_[machine] = *std::move(hold);
    } else {
      queues_.erase(machine);
    }
  }
  changed(machine);
}

void HoldReasons::note(const storage::Run& run) {
  if (!storage::is_finished(run.state)) return;
  {
    const std::lock_guard lock(mutex_);
    const auto known = entries_.find(run.machine);
    if (known == entries_.end() || known->second.hold.run != run.id) return;
    entries_.erase(known);
  }
  save(run.machine);
  changed(run.machine);
}

bool HoldReasons::drop_if_over(const MachineView& view) {
  const auto known = entries_.find(view.machine.name);
  if (known == entries_.end() || !view.status) return false;
  Entry& entry = known->second;
  if (shows(*view.status, entry.hold)) {
    entry.is_seen = true;
    return false;
  }
  if (!view.is_heard()) return false;  // the status is an old one
  if (!entry.is_seen && parts_.clock.steady_now() - entry.given < kTakesEffect) return false;
  entries_.erase(known);
  return true;
}

void HoldReasons::add_to(MachineView& view) {
  const std::string& machine = view.machine.name;
  bool is_over = false;
  {
    const std::lock_guard lock(mutex_);
    if (const auto queue = queues_.find(machine); queue != queues_.end())
      view.queue_hold = queue->second;
    is_over = drop_if_over(view);
    const auto known = entries_.find(machine);
    if (known != entries_.end() && (!view.status || shows(*view.status, known->second.hold)))
      view.held = known->second.hold;
  }
  if (is_over) save(machine);
}

void HoldReasons::save(const std::string& machine) {
  if (!parts_.late) return log_failure(save_now(machine), machine);
  parts_.late("why machine=" + machine + " is held", [this, machine] { return save_now(machine); });
}

Result<void> HoldReasons::save_now(const std::string& machine) {
  std::optional<storage::MachineHold> hold;
  {
    const std::lock_guard lock(mutex_);
    if (const auto known = entries_.find(machine); known != entries_.end())
      hold = known->second.hold;
  }
  return hold ? parts_.store.machines.hold(*hold) : parts_.store.machines.release(machine);
}

void HoldReasons::changed(const std::string& machine) const {
  if (parts_.on_change) parts_.on_change(machine);
}

std::vector<MachineView> HeldMachines::machines() const {
  auto views = inner_.machines();
  for (MachineView& view : views) reasons_.add_to(view);
  return views;
}

std::vector<MachineView> HeldMachines::machines_after(const MachinePage& page) const {
  auto views = inner_.machines_after(page);
  for (MachineView& view : views) reasons_.add_to(view);
  return views;
}

Result<MachineView> HeldMachines::machine(const std::string& name) const {
  auto view = inner_.machine(name);
  if (view) reasons_.add_to(*view);
  return view;
}

Result<void> HeldMachines::hold(const CommandRequest& request, const std::string& machine) {
  auto before = reasons_.expect({.machine = machine,
                                 .run = request.run,
                                 .who = request.who,
                                 .reason = request.reason,
                                 .since = {}});
  auto done = inner_.command(request);
  if (done || done.error().code == Errc::Timeout) {
    reasons_.keep(machine);
  } else {
    reasons_.take_back(machine, std::move(before));
  }
  return done;
}

Result<void> HeldMachines::command(const CommandRequest& request) {
  using enum dds::CommandAction;
  std::string machine = request.machine;
  if (!request.run.empty()) {
    // A machine that reports the run needs no store: a stop reaches it while there is none.
    if (auto reporting = inner_.machine_of_run(request.run)) {
      machine = *std::move(reporting);
    } else {
      const auto run = runs_.find(request.run);
      if (!run) return fail(run.error());
      machine = run->machine;
    }
  }
  if (request.action == Hold) return hold(request, machine);
  auto done = inner_.command(request);
  if (done && (request.action == Resume || request.action == Abort)) reasons_.release(machine);
  return done;
}

}  // namespace dripline::machines
