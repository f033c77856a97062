#include "server/machines/machine_service.hpp"

#include <algorithm>
#include <set>

#include "protocol/dds/endpoint.hpp"
#include "protocol/process/log.hpp"
#include "server/machines/machine_registry.hpp"

namespace dripline::machines {

MachineService::Parts::Parts(MachineService& service, dds::ServerEndpoint& endpoint)
    : blocks({.sources = service.sources_,
              .endpoint = endpoint,
              .near = service.near_pool_,
              .store = service.pool_,
              .on_called = service.options_.on_called}),
      records({.store = service.store_,
               .endpoint = endpoint,
               .pool = service.pool_,
               .clock = service.clock_,
               .clock_ahead =
                   [&service](const std::string& machine) {
                     return service.registry_.clock_error(machine);
                   },
               .state_mutex = service.state_mutex_,
               .on_stored = [&service](const auto& batch) { service.on_stored(batch); },
               .on_fault = service.options_.on_fault}),
      commands(endpoint, service.clock_, service.command_options(),
               [&service](const dds::Command& command) { service.on_late_start(command); }),
      lines(endpoint,
            [&service](const std::string& machine) {
              const auto view = service.registry_.view(machine);
              const bool is_there = view && view->is_connected;
              return is_there ? service.registry_.gateway(machine).session : std::uint64_t{0};
            }),
      reconciler({.runs = service.store_.runs,
                  .clock = service.clock_,
                  .commands = commands,
                  .state_mutex = service.state_mutex_,
                  .on_change = service.listener_.on_run,
                  .on_unwanted = [&service](const auto& run) { service.abort_unwanted(run); }}) {}

CommandDispatcher::Options MachineService::command_options() const {
  CommandDispatcher::Options options = options_.commands;
  options.gateway_of = [this](const std::string& machine) { return registry_.gateway(machine); };
  return options;
}

MachineService::MachineService(const RunSources& sources, Options options, MachineListener listener)
    : sources_(sources),
      store_(sources.store),
      clock_(sources.clock),
      options_(std::move(options)),
      listener_(std::move(listener)),
      pool_(options_.workers),
      near_pool_(kNearWorkers),
      registry_({.machines = store_.machines,
                 .runs = store_.runs,
                 .clock = clock_,
                 .pool = pool_,
                 .on_change = [this](const MachineView& view) { listener_.on_machine(view); }}) {}

MachineService::~MachineService() {
  end();
}

MachineService::Parts* MachineService::parts() const {
  return is_ending_ ? nullptr : parts_.load();
}

dds::ServerHandlers MachineService::handlers() {
  dds::ServerHandlers handlers;
  handlers.on_announce = [this](dds::Announce announce) {
    Parts* parts = this->parts();
    registry_.on_announce(announce);
    if (parts == nullptr) return;
    pool_.post([this, parts, announce = std::move(announce)] {
      parts->records.greet(announce.machine, announce.epoch);
      refuse_stranger(announce);
    });
  };
  handlers.on_lost = [this](const std::string& machine) { registry_.on_lost(machine); };
  handlers.on_rival = [this](const std::string& machine, bool is_there) {
    registry_.on_rival(machine, is_there);
  };
  handlers.may_serve = [this](const dds::Announce& announce) {
    Parts* parts = this->parts();
    const bool has_run = parts != nullptr && parts->reconciler.has_run(announce.machine);
    return registry_.may_serve(announce, has_run);
  };
  handlers.on_status = [this](dds::Status status) {
    if (Parts* parts = this->parts(); parts != nullptr && !status.run.empty()) {
      parts->commands.on_run_seen(status.machine, status.run);
    }
    if (status.serial_line && options_.on_line) options_.on_line(status);
    const bool lacks_setup = is_new_screen(status);
    const std::string machine = status.machine;
    registry_.on_status(std::move(status));
    if (lacks_setup) show_setup(machine);
  };
  handlers.on_line_data = [this](dds::LineData data) {
    if (Parts* parts = this->parts()) parts->lines.on_data(std::move(data));
  };
  handlers.on_record = [this](dds::Record record) {
    if (Parts* parts = this->parts()) parts->records.take(std::move(record));
  };
  handlers.on_command_result = [this](const dds::CommandResult& result) {
    if (Parts* parts = this->parts()) parts->commands.on_result(result);
  };
  handlers.on_request = [this](dds::BlockRequest request) {
    if (Parts* parts = this->parts()) parts->blocks.request(std::move(request));
  };
  return handlers;
}

Result<void> MachineService::begin(std::unique_ptr<dds::ServerEndpoint> endpoint) {
  endpoint_ = std::move(endpoint);
  owned_parts_ = std::make_unique<Parts>(*this, *endpoint_);
  if (auto loaded = registry_.load(); !loaded) return loaded;
  if (auto loaded = owned_parts_->reconciler.load(); !loaded) return loaded;
  parts_ = owned_parts_.get();
  // Machines that announced themselves between open() and now were not greeted.
  for (const auto& view : registry_.announced()) {
    if (view.is_connected) owned_parts_->records.greet(view.machine.name, view.machine.epoch);
  }
  pool_.post([this] { tick(); });
  return {};
}

void MachineService::lose_gateways() {
  for (const auto& view : registry_.announced()) registry_.on_lost(view.machine.name);
}

void MachineService::stop_waiting() {
  if (!owned_parts_) return;
  owned_parts_->commands.stop();
  owned_parts_->lines.stop();
}

void MachineService::end() {
  if (is_ending_.exchange(true)) return;
  stop_waiting();
  near_pool_.stop();
  pool_.stop();
  registry_.save();
  endpoint_.reset();
}

void MachineService::tick() {
  if (is_ending_) return;
  registry_.save();
  for (const auto& machine : registry_.note_silence()) endpoint_->renew_status(machine);
  owned_parts_->reconciler.compare(registry_.views());
  log_rejected();
  pool_.post_after(MachineRegistry::kSaveInterval, [this] { tick(); });
}

/// Dropped messages are logged at most once a minute: their sender must not fill the log.
void MachineService::log_rejected() {
  constexpr std::chrono::minutes kInterval{1};
  const SteadyTime now = clock_.steady_now();
  const dds::Rejected dropped = rejected();
  if (dropped.messages == rejected_logged_ || now < next_rejected_log_) return;
  process::log_warning("dropped {} DDS messages, the last: {}", dropped.messages - rejected_logged_,
                       dropped.last_reason);
  rejected_logged_ = dropped.messages;
  next_rejected_log_ = now + kInterval;
}

Result<dds::LineData> MachineService::ask_line(dds::LineRequest request,
                                               std::chrono::milliseconds limit) {
  Parts* parts = this->parts();
  if (parts == nullptr) return fail(Errc::Io, "the server is stopping");
  return parts->lines.ask(std::move(request), limit);
}

std::vector<MachineView> MachineService::machines() const {
  return registry_.views();
}

std::vector<MachineView> MachineService::machines_after(const MachinePage& page) const {
  return registry_.views(page);
}

Result<void> MachineService::remove(const std::string& machine, const storage::Actor& who) {
  return registry_.remove(machine, who);
}

Result<MachineView> MachineService::machine(const std::string& name) const {
  return registry_.view(name);
}

dds::Rejected MachineService::rejected() const {
  return endpoint_ ? endpoint_->rejected() : dds::Rejected{};
}

std::size_t MachineService::heard_gateways() const {
  return endpoint_ ? endpoint_->heard_gateways() : 0;
}

Result<MachineView> MachineService::connected_machine(const std::string& name) const {
  auto view = registry_.announced(name);
  if (!view || view->is_connected) return view;
  return fail(Errc::Timeout, "machine '{}' is not connected; last seen {}", name,
              to_iso8601(view->machine.last_seen));
}

Result<MachineView> MachineService::reachable_machine(const CommandRequest& request,
                                                      const std::string& name) const {
  auto view = registry_.announced(name);
  const bool is_stop = dds::is_stop(request.action, request.argument, request.value);
  if (view && is_stop && view->unconfirmed_gateway) return view;
  return connected_machine(name);
}

Result<std::string> MachineService::confirm_gateway(const std::string& machine) {
  auto confirmed = registry_.confirm_gateway(machine);
  if (!confirmed) return confirmed;
  process::log_warning("confirmed machine={}: {}", machine, *confirmed);
  endpoint_->look_again(machine);
  return confirmed;
}

Result<MachineView> MachineService::machine_for_work(const std::string& name) const {
  auto view = connected_machine(name);
  if (!view) return view;
  if (auto stored = registry_.view(name); !stored) return stored;
  if (auto alone = check_alone(*view); !alone) return fail(alone.error());
  if (auto heard = check_heard(*view); !heard) return fail(heard.error());
  if (auto same = check_protocol(*view); !same) return fail(same.error());
  return view;
}

Result<void> MachineService::check_alone(const MachineView& view) {
  if (!view.is_contested) return {};
  return fail(Errc::Busy, "two gateways claim to be machine '{}'; stop one of them",
              view.machine.name);
}

Result<void> MachineService::check_heard(const MachineView& view) {
  if (!view.is_stale) return {};
  return fail(Errc::Timeout, "machine '{}': {}", view.machine.name, silence_notice(view));
}

/// A gateway of another version keeps its run and its reports, and can only be stopped.
void MachineService::refuse_stranger(const dds::Announce& announce) {
  const std::string notice = protocol_notice(announce.protocol);
  if (notice.empty()) return;
  dds::Command command;
  command.machine = announce.machine;
  command.action = dds::CommandAction::Refuse;
  command.argument = notice;
  if (auto sent = owned_parts_->commands.send(std::move(command)); !sent)
    process::log_warning("gateway not notified machine={}: {}", announce.machine,
                         sent.error().what);
}

Result<void> MachineService::check_protocol(const MachineView& view) {
  const std::string notice = view.protocol ? protocol_notice(*view.protocol) : "";
  if (notice.empty()) return {};
  return fail(Errc::Unsupported, "machine '{}': {}", view.machine.name, notice);
}

/// Whether it makes the machine safer, whatever that does now.
bool MachineService::is_stop(const CommandRequest& request, const MachineView& view) {
  return dds::is_stop(request.action, request.argument, request.value) ||
         (view.status && dds::lowers_override(request.action, request.value, *view.status));
}

/// Also where it does not reach the machine: a resume that waits must not reach it later.
void MachineService::note_stop(const CommandRequest& request, const std::string& machine) {
  if (dds::is_stop(request.action, request.argument, request.value))
    owned_parts_->commands.note_stop(machine, request.action, request.given);
}

Result<void> MachineService::send(dds::Command command, const CommandRequest& request,
                                  const MachineView& view) {
  const bool is_stop = this->is_stop(request, view);
  if (!is_stop) {
    if (auto fits = check_protocol(view); !fits) return fits;
    if (auto alone = check_alone(view); !alone) return alone;
    if (auto heard = check_heard(view); !heard) return heard;
  }
  command.action = request.action;
  command.argument = request.argument;
  command.value = request.value;
  auto done = owned_parts_->commands.carry_out(std::move(command),
                                               {.given = request.given, .is_stop = is_stop});
  if (done || !view.is_contested) return done;
  return fail(
      done.error().code,
      "{}. Two gateways claim to be machine '{}', both got it, and one of them has answered: "
      "look at the machine, and stop one of them",
      done.error().what, view.machine.name);
}

namespace {

std::optional<std::string> machine_with(const std::vector<MachineView>& views,
                                        const std::string& run) {
  if (run.empty()) return std::nullopt;
  for (const MachineView& view : views)
    if (view.status && view.status->run == run) return view.machine.name;
  return std::nullopt;
}

}  // namespace

std::optional<std::string> MachineControl::machine_of_run(const std::string& run) const {
  return machine_with(machines(), run);
}

/// A run that a machine reports is active; else the store knows what became of it.
Result<CommandTarget> MachineService::target_of(const CommandRequest& request) const {
  if (dds::is_stop(request.action, request.argument, request.value)) {
    // Also of a machine that is not stored yet.
    if (auto machine = machine_with(registry_.announced(), request.run))
      return CommandTarget{*std::move(machine), {}};
  }
  const auto run = store_.runs.find(request.run);
  if (!run) return fail(run.error());
  if (storage::is_finished(run->state)) {
    return fail(Errc::Conflict, "run {} has ended: {}", run->id, storage::to_string(run->state));
  }
  return CommandTarget{run->machine, run->program};
}

Result<void> MachineService::command(const CommandRequest& request) {
  if (parts() == nullptr) return fail(Errc::Io, "the server is stopping");
  if (request.run.empty()) return command_machine(request);
  const auto target = target_of(request);
  if (!target) return fail(target.error());
  note_stop(request, target->machine);
  const auto view = reachable_machine(request, target->machine);
  if (!view) return fail(view.error());
  dds::Command command;
  command.machine = target->machine;
  command.run = request.run;
  process::log_info("command {} machine={} run={} program={}", dds::to_string(request.action),
                    target->machine, request.run, target->program);
  return send(std::move(command), request, *view);
}

/// For its panel: no run is needed.
Result<void> MachineService::command_machine(const CommandRequest& request) {
  note_stop(request, request.machine);
  const auto view = reachable_machine(request, request.machine);
  if (!view) return fail(view.error());
  // To an older gateway it would be the abort of its run.
  if (request.action == dds::CommandAction::Abort) {
    if (auto knows = check_knows(*view, dds::CommandAction::Jog); !knows) return knows;
  }
  dds::Command command;
  command.machine = request.machine;
  process::log_info("command {} machine={}", dds::to_string(request.action), request.machine);
  return send(std::move(command), request, *view);
}

/// The sender has got an error for this start, so it must not run.
void MachineService::on_late_start(const dds::Command& late) {
  storage::Run run;
  run.machine = late.machine;
  run.id = late.run;
  run.program = late.program;
  pool_.post([this, run] { abort_unwanted(run); });
}

void MachineService::abort_unwanted(const storage::Run& run) {
  process::log_warning("start accepted too late, aborting machine={} run={} program={}",
                       run.machine, run.id, run.program);
  owned_parts_->blocks.drop(run.machine, run.id);
  dds::Command abort;
  abort.machine = run.machine;
  abort.action = dds::CommandAction::Abort;
  abort.run = run.id;
  if (auto sent = owned_parts_->commands.send(abort); !sent) {
    process::log_error("abort not sent machine={} run={}: {}", abort.machine, abort.run,
                       sent.error().what);
  }
}

void MachineService::on_stored(const storage::RecordBatch& batch) {
  for (const auto& record : batch.records) listener_.on_record(record);
  std::set<std::string> changed;
  for (const auto& beginning : batch.beginnings) changed.insert(beginning.run);
  for (const auto& ending : batch.endings) {
    changed.insert(ending.run);
    owned_parts_->reconciler.drop(ending.run);
    owned_parts_->blocks.drop(batch.machine, ending.run);
    process::log_info("run ended machine={} run={} state={} executed={} verified={}", batch.machine,
                      ending.run, storage::to_string(ending.state), ending.counters.executed,
                      !ending.content_verified   ? "unknown"
                      : *ending.content_verified ? "yes"
                                                 : "no");
  }
  for (const auto& run : changed) announce_run(run);
}

void MachineService::announce_run(const std::string& run) {
  if (const auto stored = store_.runs.find(run)) listener_.on_run(*stored);
}

}  // namespace dripline::machines
