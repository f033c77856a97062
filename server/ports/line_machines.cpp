#include "server/ports/line_machines.hpp"

#include <future>
#include <map>
#include <utility>

#include "gateway/line/inbound/program_head.hpp"
#include "gateway/line/line_words.hpp"
#include "gateway/line/port_transfer.hpp"
#include "protocol/process/log.hpp"
#include "server/ports/gateways/gateway_view.hpp"
#include "server/ports/port_settings.hpp"

namespace dripline::ports {

namespace {

/// Waits for the answer of another thread. The promise is shared: an answer that comes too
/// late still has where to go.
template <class T>
Result<T> wait_for(std::future<Result<T>> answer, const std::string& what) {
  if (answer.wait_for(LineMachines::kAnswerLimit) == std::future_status::ready) return answer.get();
  return fail(Errc::Timeout, "{}: the line did not answer within {} s; the outcome is unknown",
              what, LineMachines::kAnswerLimit.count());
}

dds::Execution execution_of(line::LineActivity activity) {
  switch (activity) {
    case line::LineActivity::Held:
      return dds::Execution::FeedHold;
    case line::LineActivity::Waiting:
      return dds::Execution::Waiting;
    case line::LineActivity::Active:
      return dds::Execution::Active;
    case line::LineActivity::Ready:
      break;
  }
  return dds::Execution::Ready;
}

}  // namespace

LineMachines::LineMachines(const machines::RunSources& sources, const LineDirectory& directory,
                           const machines::MachineListener& listener, const ResetGate& resets)
    : store_(sources.store),
      clock_(sources.clock),
      directory_(directory),
      listener_(listener),
      resets_(resets),
      runs_(sources) {}

void LineMachines::enter(const storage::Machine& stored) {
  const std::lock_guard lock(mutex_);
  storage::Machine& machine = shown_[stored.name].machine;
  machine = stored;
  machine.gateway_version.clear();  // it may have had one before it had a port
}

LineMachines::Shown LineMachines::shown(const std::string& machine) const {
  const std::lock_guard lock(mutex_);
  const auto found = shown_.find(machine);
  return found == shown_.end() ? Shown{} : found->second;
}

void LineMachines::show_run(const storage::Run& run) {
  const std::lock_guard lock(mutex_);
  Shown& shown = shown_[run.machine];
  shown.run = run.id;
  shown.program = run.program;
}

machines::MachineView LineMachines::view_of(const PortLine& line) const {
  const LineView port = line.view();
  const auto progress = line.progress();
  Shown known = shown(port.names.machine);
  machines::MachineView view;
  view.machine = std::move(known.machine);
  view.machine.name = port.names.machine;
  view.is_connected = port.is_open;
  dds::Status status;
  status.machine = port.names.machine;
  status.time = clock_.now();
  status.execution = execution_of(line::activity_of(port, progress));
  status.message = line::message_of(port, progress);
  if (progress) {
    if (progress->kind == JobKind::Run) status.run = progress->id;
    if (progress->id == known.run) status.program = std::move(known.program);
    status.sent = progress->sent.bytes;
    status.accepted = progress->is_checked ? progress->sent.blocks : 0;
    status.total_bytes = progress->size;
    status.offset = progress->sent.bytes;
  }
  view.status = std::move(status);
  return view;
}

std::vector<machines::MachineView> LineMachines::machines() const {
  std::vector<machines::MachineView> views;
  for (const auto& line : directory_.lines()) views.push_back(view_of(*line));
  return views;
}

Result<machines::MachineView> LineMachines::machine(const std::string& name) const {
  const auto line = directory_.line_of(name);
  if (!line) return fail(Errc::NotFound, "machine '{}' has no port", name);
  return view_of(*line);
}

std::optional<std::string> LineMachines::machine_of_run(const std::string& run) const {
  for (const auto& line : directory_.lines()) {
    const auto progress = line->progress();
    if (progress && progress->kind == JobKind::Run && progress->id == run)
      return line->names().machine;
  }
  return std::nullopt;
}

Result<storage::Run> LineMachines::start(const machines::StartRequest& request) {
  auto promise = std::make_shared<std::promise<Result<storage::Run>>>();
  auto answer = promise->get_future();
  post_start({.request = request,
              .started = [promise](const Result<storage::Run>& run) { promise->set_value(run); },
              .given = request.given.value_or(clock_.steady_now())});
  return wait_for<storage::Run>(std::move(answer), "start on machine '" + request.machine + "'");
}

void LineMachines::start_later(const machines::StartRequest& request, Started started,
                               const std::string& wire_name) {
  post_start({.request = request,
              .started = std::move(started),
              .given = request.given.value_or(clock_.steady_now()),
              .wire_name = wire_name,
              .is_awaited = !request.given});
}

void LineMachines::post_start(Start start) {
  const auto line = directory_.line_of(start.request.machine);
  if (!line) {
    return start.started(fail(Errc::NotFound, "machine '{}' has no port", start.request.machine));
  }
  line->post([this, line, start = std::move(start)] { begin(line, start); });
}

void LineMachines::begin(const std::shared_ptr<PortLine>& line, const Start& start) {
  const auto& [request, started, given, wire_name, is_awaited] = start;
  const LineView port = line->view();
  if (!port.is_open) {
    return started(fail(Errc::Timeout, "machine '{}' is not connected: port {} is not open: {}",
                        request.machine, port.names.name,
                        port.fault.empty() ? "not yet" : port.fault));
  }
  if (auto free = line->drop_answer(); !free) return started(fail(free.error()));
  if (line->is_busy()) {
    return started(
        fail(Errc::Busy, "port {} is busy: it is {}", port.names.name, what_it_does(port)));
  }
  if (auto ready = resets_.check(port, port.names.name); !ready)
    return started(fail(ready.error()));
  if (auto fits = check_protocol(store_.setups, request.machine, port.settings.flow); !fits) {
    return started(fail(fits.error()));
  }
  const auto machine = store_.machines.find(request.machine);
  if (!machine) return started(fail(machine.error()));
  const auto run = runs_.create(request, *machine);
  if (!run) return started(run);
  show_run(*run);
  announce(run->id);
  auto job = runs_.job(*run, request);
  if (!job) return started(conclude(*run, fail(job.error())));
  if (!job->head.empty()) line->note("sent before the program: " + job->head);
  if (!wire_name.empty()) {
    job->name = wire_name;
  } else if (line::has_numbered_programs(port.settings.flow)) {
    job->name = line::program_number(run->program);
  }
  if (auto ready = send(*line, start, *run, *std::move(job)); !ready)
    started(conclude(*run, fail(ready.error())));
}

Result<void> LineMachines::send(PortLine& line, const Start& start, const storage::Run& run,
                                SendJob job) {
  using dds::CommandAction;
  if (!start.is_awaited) {
    // After this time its sender has got "the outcome is unknown".
    auto soon = machines::check_age(run.machine, CommandAction::Start, start.given,
                                    clock_.steady_now(), kAnswerLimit);
    if (!soon) return soon;
  }
  const std::lock_guard lock(order_mutex_);
  if (auto first = stops_.check(run.machine, CommandAction::Start, start.given); !first)
    return first;
  line.begin(std::move(job), [this, run, started = start.started](const Result<void>& begun) {
    started(conclude(run, begun));
  });
  return {};
}

Result<storage::Run> LineMachines::conclude(const storage::Run& run, const Result<void>& begun) {
  if (begun) {
    runs_.started(run, *directory_.records_of(run.machine));
    return store_.runs.find(run.id);
  }
  runs_.refused(run, begun.error());
  announce(run.id);
  return fail(begun.error());
}

/// A run that a line reports is active, and needs no store; else the store knows what became of it.
Result<LineMachines::CommandTarget> LineMachines::target_of(const std::string& id) const {
  if (auto machine = machine_of_run(id)) return CommandTarget{*std::move(machine), {}};
  const auto run = store_.runs.find(id);
  if (!run) return fail(run.error());
  if (storage::is_finished(run->state))
    return fail(Errc::Conflict, "run {} has ended: {}", run->id, storage::to_string(run->state));
  return CommandTarget{run->machine, run->program};
}

Result<void> LineMachines::command(const machines::CommandRequest& request) {
  if (request.run.empty()) {
    return fail(Errc::Unsupported, "machine '{}' is on a serial line: its panel cannot be reached",
                request.machine);
  }
  const auto target = target_of(request.run);
  if (!target) return fail(target.error());
  const auto& [machine, program] = *target;
  const auto line = directory_.line_of(machine);
  if (!line) return fail(Errc::NotFound, "machine '{}' has no port", machine);
  auto promise = std::make_shared<std::promise<Result<void>>>();
  auto answer = promise->get_future();
  const auto answered = [promise](const Result<void>& result) { promise->set_value(result); };
  if (auto ordered = order(*line, request, answered); !ordered) return ordered;
  process::log_info("command {} machine={} run={} program={}", dds::to_string(request.action),
                    machine, request.run, program);
  auto done = wait_for<void>(std::move(answer), "run " + request.run);
  line->post([this, name = machine] { on_change(name); });  // in the order of what it reports
  return done;
}

/// They are carried out in the order in which they are posted here.
Result<void> LineMachines::order(PortLine& line, const machines::CommandRequest& request,
                                 const PortLine::Answer& answered) {
  using enum dds::CommandAction;
  const std::string machine = line.names().machine;
  const SteadyTime now = clock_.steady_now();
  const SteadyTime given = request.given.value_or(now);
  const std::lock_guard lock(order_mutex_);
  if (request.action == Resume) {
    auto ready = machines::check_age(machine, Resume, given, now);
    if (ready) ready = stops_.check(machine, Resume, given);
    if (ready) line.resume(request.run, answered);
    return ready;
  }
  if (request.action != Hold && request.action != Abort) {
    return fail(Errc::Unsupported,
                "machine '{}' is on a serial line: it takes hold, resume and abort, not {}",
                machine, dds::to_string(request.action));
  }
  stops_.note(machine, request.action, given);
  if (request.action == Hold) {
    line.hold(request.run, answered);
  } else {
    line.abort(request.run, "aborted by command", answered);
  }
  return {};
}

void LineMachines::on_sent(const std::string& machine, const SendEnd& end,
                           std::function<void()> stored) {
  runs_.ended(end, *directory_.records_of(machine), std::move(stored));
  on_change(machine);
}

void LineMachines::on_change(const std::string& machine) {
  if (const auto view = this->machine(machine)) listener_.on_machine(*view);
}

void LineMachines::save_progress(const PortLine& line) {
  const auto progress = line.progress();
  if (!progress || progress->kind != JobKind::Run) return;
  runs_.progressed(line.names().machine, *progress);
  on_change(line.names().machine);
}

void LineMachines::announce(const std::string& run) const {
  if (const auto stored = store_.runs.find(run)) listener_.on_run(*stored);
}

Result<std::string> LineMachines::values(const machines::ValueQuery& query) {
  return fail(Errc::Unsupported,
              "machine {}: its control is at the end of a line, and its values are there",
              query.machine);
}

Result<machines::PositionAnswer> LineMachines::position(const machines::PositionRequest& request) {
  return fail(
      Errc::Unsupported,
      "machine {}: its control is at the end of a line: set it there, where the position is",
      request.machine);
}

Result<machines::JogAnswer> LineMachines::jog(const machines::JogRequest& request) {
  return fail(Errc::Unsupported,
              "machine {}: its control is at the end of a line: jog it there, in sight of the axes",
              request.machine);
}

}  // namespace dripline::ports
