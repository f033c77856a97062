#include "server/measurements/measurements.hpp"

#include <algorithm>

#include "protocol/process/log.hpp"
#include "server/measurements/hold_reason.hpp"

namespace dripline::measurements {
namespace {

constexpr std::uint64_t kPiece = 1000;  ///< records of a transaction
constexpr std::size_t kMaxDue = 1024;   ///< actions that wait

/// Another time it may go well.
bool is_passing(const Error& error) {
  return error.code == Errc::Busy || error.code == Errc::Io;
}

}  // namespace

Measurements::Measurements(Parts parts)
    : parts_(std::move(parts)), cache_(parts_.store.report_templates) {}

Measurements::~Measurements() {
  end();
}

void Measurements::end() {
  for (std::jthread* thread : {&worker_, &actor_}) {
    thread->request_stop();
    if (thread->joinable()) thread->join();
  }
}

void Measurements::begin() {
  take_all_due();
  actor_ = std::jthread([this](const std::stop_token& stop) { act(stop); });
  worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

void Measurements::note() {
  wake();
}

void Measurements::wake() {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(is_woken_, true)) return;
  }
  changed_.notify_all();
}

Result<void> Measurements::wait(std::chrono::milliseconds limit) {
  const auto deadline = std::chrono::steady_clock::now() + limit;
  std::unique_lock lock(mutex_);
  is_woken_ = true;
  changed_.notify_all();
  // A round that is in progress may have passed what was stored just now: the next one has not.
  const std::uint64_t round = begun_ + 1;
  if (changed_.wait_until(lock, deadline, [&] { return done_ >= round; })) return {};
  return fail(Errc::Timeout, "records are not derived within {} ms", limit.count());
}

void Measurements::work(const std::stop_token& stop) {
  bool is_sound = true;
  while (!stop.stop_requested()) {
    std::uint64_t round = 0;
    {
      std::unique_lock lock(mutex_);
      if (is_sound) {
        changed_.wait(lock, stop, [this] { return is_woken_; });
      } else {
        changed_.wait_for(lock, stop, parts_.retry, [&stop] { return stop.stop_requested(); });
      }
      if (stop.stop_requested()) return;
      is_woken_ = false;
      round = ++begun_;
    }
    is_sound = derive_all(stop);
    if (!is_sound) continue;
    {
      const std::lock_guard lock(mutex_);
      done_ = round;
    }
    changed_.notify_all();
  }
}

bool Measurements::derive_all(const std::stop_token& stop) {
  const auto has_any = cache_.has_assignments();
  if (!has_any) return false;
  if (!*has_any) return true;
  bool is_sound = true;
  while (!stop.stop_requested()) {
    const auto underived = parts_.store.measurements.underived();
    if (!underived) return false;
    bool has_progress = false;
    for (const auto& records : *underived) {
      if (stop.stop_requested()) return true;
      const auto done = derive_piece(records);
      has_progress = has_progress || done.has_value();
      if (done) {
        failed_.erase(records.machine);
        continue;
      }
      is_sound = false;
      if (!is_passing(done.error()) && failed_.insert(records.machine).second) {
        process::log_error("reports are not derived machine={} epoch={} after={}: {}",
                           records.machine, records.epoch, records.derived, done.error().what);
      }
    }
    if (!has_progress) return is_sound;
  }
  return true;
}

Derivation::Sources Measurements::sources() {
  return {.run = [this](const std::string& id) -> Result<std::optional<RunFacts>> {
            const auto run = parts_.store.runs.find(id);
            if (!run && run.error().code == Errc::NotFound) return std::optional<RunFacts>();
            if (!run) return fail(run.error());
            return std::optional(RunFacts{run->machine, run->program, run->revision, run->state});
          },
          .templates =
              [this](const std::string& name, const std::string& program) {
                return cache_.templates_of(name, program);
              }};
}

/// A state that cannot be read (of another version of this program) is dropped: the parts that were
/// open stay as they are.
Result<MachineState> Measurements::state_of(const std::string& machine) {
  const auto text = parts_.store.measurements.state(machine);
  if (!text) return fail(text.error());
  auto state = parse_machine_state(*text, [this](const std::string& name, std::uint64_t version) {
    return cache_.find(name, version);
  });
  if (state) return state;
  if (is_passing(state.error())) return state;
  process::log_error("reports begin again machine={}: {}", machine, state.error().what);
  return MachineState{};
}

Result<void> Measurements::derive_piece(const storage::UnderivedRecords& records) {
  std::vector<Judged> judged;
  std::vector<DueAction> due;
  {
    const std::lock_guard lock(derive_mutex_);
    auto state = state_of(records.machine);
    if (!state) return fail(state.error());
    const auto next = parts_.store.measurements.next_part_id();
    if (!next) return fail(next.error());
    const auto piece = parts_.store.records.of_machine_after(
        records.machine, {records.epoch, records.derived}, kPiece);
    if (!piece) return fail(piece.error());
    const std::vector<DueAction> known = state->due;
    Derivation derivation(records.machine, *std::move(state), sources(), *next);
    if (auto begun = derivation.begin(); !begun) return begun;
    for (const storage::Record& record : *piece) {
      if (auto taken = derivation.take(record); !taken) return taken;
    }
    storage::DerivedBatch batch = derivation.batch();
    batch.epoch = records.epoch;
    batch.after = records.derived;
    // More may have come since; and retention may have taken what was never derived.
    const std::uint64_t read = piece->empty() ? 0 : piece->back().number;
    batch.through = piece->size() < kPiece ? std::max(records.last, read) : read;
    batch.state = to_json(derivation.state());
    if (auto committed = parts_.store.measurements.commit(batch); !committed) return committed;
    judged = derivation.judged();
    due = derivation.state().due;
    due.erase(due.begin(), due.begin() + static_cast<std::ptrdiff_t>(known.size()));
  }
  announce(judged);
  take_due(records.machine, due);
  return {};
}

void Measurements::announce(const std::vector<Judged>& judged) {
  for (const Judged& one : judged) {
    if (one.part.verdict >= measurement::Verdict::Rework) {
      process::log_info("part={} machine={} run={} verdict={}", one.part.id, one.part.machine,
                        one.part.run, measurement::to_string(one.part.verdict));
    }
    if (parts_.on_part) parts_.on_part(one.part);
  }
}

void Measurements::take_due(const std::string& machine, const std::vector<DueAction>& due) {
  if (due.empty()) return;
  {
    const std::lock_guard lock(due_mutex_);
    for (const DueAction& one : due) {
      if (due_.size() >= kMaxDue) due_.pop_front();  // a later one holds the machine as well
      due_.push_back({machine, one});
    }
  }
  due_changed_.notify_all();
}

void Measurements::act(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    Due due;
    {
      std::unique_lock lock(due_mutex_);
      if (!due_changed_.wait(lock, stop, [this] { return !due_.empty(); })) return;
      due = due_.front();
      due_.pop_front();
    }
    carry_out(due.action);
    resolve_due(due.machine, due.action);
  }
}

void Measurements::resolve_due(const std::string& machine, const DueAction& due) {
  const std::lock_guard lock(derive_mutex_);
  auto state = state_of(machine);
  if (!state) return;  // it is carried out again after a restart
  std::erase(state->due, due);
  const auto saved = parts_.store.measurements.save_state(machine, to_json(*state));
  if (!saved)
    process::log_warning("part={}: a restart repeats its {}: {}", due.part,
                         report_template::to_string(due.action), saved.error().what);
}

void Measurements::take_all_due() {
  const auto machines = parts_.store.machines.list();
  if (!machines) return;
  for (const auto& machine : *machines) {
    const std::lock_guard lock(derive_mutex_);
    const auto state = state_of(machine.name);
    if (state) take_due(machine.name, state->due);
  }
}

void Measurements::carry_out(const DueAction& due) {
  const auto part = parts_.store.measurements.part(due.part);
  if (!part) return;
  const Hold& hold =
      due.action == report_template::Action::HoldMachine ? parts_.hold_machine : parts_.hold_queue;
  const std::string reason = hold_reason(parts_.store.measurements, *part);
  const auto held =
      hold ? hold(*part, reason) : Result<void>(fail(Errc::Unsupported, "this server holds none"));
  if (held) {
    process::log_info("{} machine={}: {}", report_template::to_string(due.action), part->machine,
                      reason);
  } else {
    process::log_error("{} failed machine={}: {}: {}", report_template::to_string(due.action),
                       part->machine, reason, held.error().what);
  }
}

Result<storage::ReportTemplateVersion> Measurements::push(const std::string& name,
                                                          const std::string& text,
                                                          const storage::Actor& who) {
  if (const auto read = report_template::read_template(text); !read) return fail(read.error());
  auto pushed = parts_.store.report_templates.push(
      {.name = name, .version = 0, .text = text, .author = who.name, .created = parts_.clock.now()},
      who);
  cache_.drop();
  return pushed;
}

Result<void> Measurements::remove(const std::string& name, const storage::Actor& who) {
  auto removed = parts_.store.report_templates.remove(name, who, parts_.clock.now());
  cache_.drop();
  return removed;
}

Result<void> Measurements::assign(storage::TemplateAssignment assignment,
                                  const storage::Actor& who) {
  assignment.author = who.name;
  assignment.created = parts_.clock.now();
  auto assigned = parts_.store.report_templates.assign(assignment, who);
  cache_.drop();
  return assigned;
}

Result<void> Measurements::unassign(storage::TemplateAssignment assignment,
                                    const storage::Actor& who) {
  assignment.created = parts_.clock.now();
  auto done = parts_.store.report_templates.unassign(assignment, who);
  cache_.drop();
  return done;
}

}  // namespace dripline::measurements
