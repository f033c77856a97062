#include <algorithm>

#include "gateway/line/port_transfer.hpp"
#include "protocol/process/log.hpp"
#include "server/ports/line_runs.hpp"
#include "server/ports/port_service.hpp"
#include "server/ports/port_settings.hpp"
#include "server/ports/programs/broken_program.hpp"
#include "server/ports/programs/inbound_handler.hpp"

/// The part of PortService that puts an open port together: its machine, its line and what they
/// report.
namespace dripline::ports {
namespace {

constexpr unsigned kTicksPerSave = 5;

/// Not the address of a device server, or of another stream.
bool is_device(const std::string& address) {
  return address.starts_with('/');
}

/// The port that the machine has at the time.
class PortAtControl final : public RequestedLine {
 public:
  PortAtControl(LineMachines& machines, const LineDirectory& directory, std::string machine,
                std::shared_ptr<TransferLog> transfers)
      : machines_(machines),
        directory_(directory),
        machine_(std::move(machine)),
        transfers_(std::move(transfers)) {}
  void note(const std::string& words) override {
    if (const auto line = directory_.line_of(machine_)) line->note(words);
  }
  void refuse(const std::string& why) override {
    if (const auto line = directory_.line_of(machine_)) line->refuse(why);
  }
  bool is_asked() const override {
    const auto line = directory_.line_of(machine_);
    return line && line->view().request.has_value();
  }
  Result<void> check_reset() const override {
    const auto line = directory_.line_of(machine_);
    if (!line) return {};
    const LineView port = line->view();
    return machines_.resets().check(port, port.names.name);
  }
  void accept_receive(const std::string& name) override {
    if (const auto line = directory_.line_of(machine_)) line->accept_receive(name);
  }
  void send(SendJob job) override {
    const auto line = directory_.line_of(machine_);
    if (!line) return;
    if (line::sends_at_once(line->view().settings)) transfers_->begin_answer(job);
    line->begin(std::move(job), [machine = machine_, transfers = transfers_,
                                 id = job.id](const Result<void>& begun) {
      if (begun) return;
      transfers->take_back_send(id);
      process::log_warning("answer not sent machine={}: {}", machine, begun.error().what);
    });
  }
  void start_later(const machines::StartRequest& request, Started started,
                   const std::string& wire_name) override {
    machines_.start_later(request, std::move(started), wire_name);
  }

 private:
  LineMachines& machines_;
  const LineDirectory& directory_;
  const std::string machine_;
  const std::shared_ptr<TransferLog> transfers_;
};

}  // namespace

/// Records are in order of their epochs, also when the clock was put back between two starts of the
/// server: later than the last one that the store knows.
std::uint64_t PortService::epoch_of(const storage::Machine& machine) const {
  const std::lock_guard lock(mutex_);
  const auto found = machines_.find(machine.name);
  if (found != machines_.end()) return found->second.records->epoch();
  return std::max(epoch_, machine.epoch + 1);
}

/// A run needs its machine in the store, and its records an epoch, which is returned.
Result<std::uint64_t> PortService::enter_machine(const storage::Port& port) {
  storage::Machine machine;
  machine.name = port.machine;
  machine.first_seen = clock_.now();
  if (auto known = store_.machines.find(port.machine)) machine = *std::move(known);
  if (machine.control.empty()) machine.control = template_control(port);
  machine.epoch = epoch_of(machine);
  machine.last_seen = clock_.now();
  if (auto saved = store_.machines.save(machine); !saved) return fail(saved.error());
  line_machines_.enter(machine);
  return machine.epoch;
}

PortService::Machine PortService::machine_of(const std::string& name, std::uint64_t epoch) {
  const std::lock_guard lock(mutex_);
  if (const auto found = machines_.find(name); found != machines_.end()) return found->second;
  const Strand strand(pool_);
  LineRecords::Parts parts{
      .store = store_.records,
      .clock = clock_,
      .strand = strand,
      .machine = name,
      .epoch = epoch,
      .on_stored = [this](const auto& batch) { on_stored(batch); },
      .on_fault = [this, name](const std::string& fault) { on_store_fault(name, fault); }};
  const Machine machine{.strand = strand,
                        .records = std::make_shared<LineRecords>(std::move(parts))};
  strand.post([this, name, records = machine.records] {
    if (auto ended = line_machines_.runs().give_up_unfinished(name, *records); !ended) {
      process::log_error("unfinished runs not ended machine={}: {}", name, ended.error().what);
    }
  });
  return machines_.emplace(name, machine).first->second;
}

void PortService::note_host(storage::Port& port) const {
  if (is_device(port.address)) port.host = options_.host;
}

std::string PortService::host_fault(const storage::Port& port) const {
  if (options_.host.empty() || port.host.empty() || port.host == options_.host) return "";
  if (!is_device(port.address)) return "";
  return fmt::format(
      "{} is a device of computer {}, and this server is on {}: it cannot move. It is used again "
      "when a server there has the library; or connect the line through a device server "
      "(rfc2217://HOST:PORT), or set the port up again if the device is here now",
      port.address, port.host, options_.host);
}

Result<void> PortService::open_transfers(Entry& entry) const {
  if (entry.transfers) return {};
  auto log = std::make_shared<TransferLog>(TransferLog::Parts{
      .ports = store_.ports, .audit = store_.audit, .clock = clock_, .port = entry.port.name});
  auto opened = log->open();
  if (opened) entry.transfers = std::move(log);
  return opened;
}

/// A run of it that another server has begun has ended all the same.
void PortService::open(Entry& entry) {
  if (!entry.port.is_enabled || !entry.fault.empty()) return;
  const auto epoch = enter_machine(entry.port);
  entry.is_open_due = !epoch;
  if (!epoch) {
    entry.fault = epoch.error().what;
    return;
  }
  if (auto opened = open_transfers(entry); !opened) {
    entry.fault = opened.error().what;
    entry.is_open_due = true;
    return;
  }
  const Machine machine = machine_of(entry.port.machine, *epoch);
  entry.fault = host_fault(entry.port);
  if (!entry.fault.empty()) {
    process::log_error("port={} machine={}: {}", entry.port.name, entry.port.machine, entry.fault);
    return;
  }
  if (entry.port.host.empty()) {
    note_host(entry.port);
    if (!entry.port.host.empty()) {
      if (auto saved = store_.ports.save(entry.port); !saved)
        process::log_warning("port={}: {}", entry.port.name, saved.error().what);
    }
  }
  const Strands strands{machine.strand, Strand(near_pool_)};
  entry.line = make_line(entry, strands, listener_for(entry, machine));
  entry.line->open();
  const Ticking ticking{.line = entry.line, .transfers = entry.transfers, .strands = strands};
  strands.near.post([this, ticking] { tick(ticking, 0); });
}

PortListener PortService::listener_for(const Entry& entry, const Machine& machine) {
  const std::string& name = entry.port.machine;
  RemoteRequestHandler::Parts calls{
      .store = store_,
      .releases = sources_.releases,
      .line = std::make_shared<PortAtControl>(
          line_machines_, static_cast<const LineDirectory&>(*this), name, entry.transfers),
      .clock = clock_,
      .machine = name,
      .port = entry.port.name,
      .reply = entry.rules->reply(),
      .offer = entry.settings.offer,
      .refuses = entry.settings.flow == wire::Flow::HeidenhainBcc,
      .tells_aborts = entry.settings.flow == wire::Flow::Heidenhain ||
                      entry.settings.flow == wire::Flow::HeidenhainBcc ||
                      entry.settings.flow == wire::Flow::Xmodem,
      .follows_answers = true};
  const auto inbound = std::make_shared<InboundHandler>(InboundHandler::Parts{
      .machines = store_.machines,
      .programs = programs_,
      .directory = *this,
      .records = machine.records,
      .transfers = entry.transfers,
      .machine = name,
      .port = entry.port.name,
      .rules = entry.rules,
      .extracts_programs = entry.settings.extracts_programs,
      .sends_programs_only = entry.settings.control.kind == wire::ControlKind::ProtoTrak,
      .calls = std::move(calls)});
  return {
      .on_incoming = [inbound](
                         const Incoming& incoming,
                         std::function<void()> kept) { inbound->take(incoming, std::move(kept)); },
      .on_sent =
          [this, inbound, name, transfers = entry.transfers](const SendEnd& end) {
            if (end.progress.kind == JobKind::Transfer) {
              transfers->end_send(end);
              note_transfer(name, end);
              if (end.outcome == SendOutcome::Completed) inbound->on_transfer_completed();
            }
            if (end.progress.kind == JobKind::Answer) {
              transfers->end_answer(end);
              inbound->on_answer_over(end);
            }
            if (end.progress.kind != JobKind::Run) return;
            inbound->on_run(end.progress.id);
            if (end.outcome == SendOutcome::Completed) inbound->on_run_completed();
            line_machines_.on_sent(name, end, [inbound] { inbound->on_run_stored(); });
          },
      .on_request = [inbound](const wire::TransferRequest& request) { inbound->answer(request); },
      .on_change = [this, name] { line_machines_.on_change(name); },
      .on_release_refused = [inbound] { inbound->on_release_refused(); }};
}

std::shared_ptr<PortLine> PortService::make_line(const Entry& entry, const Strands& strands,
                                                 PortListener listener) {
  return PortLine::make(
      {.names = {entry.port.name, entry.port.machine, entry.port.address},
       .settings = entry.settings,
       .clock = clock_,
       .post = [strand = strands.store](line::Task task) { strand.post(std::move(task)); },
       .post_near = [strand = strands.near](line::Task task) { strand.post(std::move(task)); },
       .open = options_.open,
       .may_send = is_device(entry.port.address) ? std::function<bool()>() : options_.may_send,
       .recording = {.port = entry.port.name, .folder = options_.recordings},
       .on_traffic = [this](const PortTraffic& traffic) { tell_traffic(traffic); },
       .listener = std::move(listener),
       .is_upload_broken = entry.transfers && entry.transfers->take_broken_upload(),
       .before = {.may_be_in_text = is_program_broken(entry)}});
}

/// A control may be in the middle of a run, of programs sent without one, or of an offered program.
bool PortService::is_program_broken(const Entry& entry) const {
  const auto sent = broken_program(
      store_, {.machine = entry.port.machine, .port = entry.port.name, .are_aborts_told = true});
  if (sent && sent->has_value()) return true;
  if (entry.settings.offer != wire::Offer::All) return false;
  const auto offer = broken_offer(store_.audit, entry.port.machine);
  return offer && offer->has_value();
}

void PortService::tick(const Ticking& ticking, unsigned count) {
  const auto line = ticking.line.lock();
  if (!line) return;
  line->tick();
  if (count % kTicksPerSave == 0 && !ticking.is_saving->exchange(true)) {
    ticking.strands.store.post([this, ticking] { save_progress(ticking); });
  }
  ticking.strands.near.post_after(kTick, [this, ticking, count] { tick(ticking, count + 1); });
}

/// On the machine's strand. Text that had to wait for the store is asked for again.
void PortService::save_progress(const Ticking& ticking) {
  if (const auto line = ticking.line.lock()) {
    line_machines_.save_progress(*line);
    const auto progress = line->progress();
    if (progress && progress->kind == JobKind::Transfer) ticking.transfers->note_sent(*progress);
    ticking.transfers->save();
    line->on_text();
  }
  *ticking.is_saving = false;
}

void PortService::tell_traffic(const PortTraffic& traffic) const {
  const std::lock_guard lock(traffic_mutex_);
  if (on_traffic_) on_traffic_(traffic);
}

void PortService::on_store_fault(const std::string& machine, const std::string& fault) {
  if (const auto line = line_of(machine)) {
    line->note_store_fault(fault.empty() ? "" : "what comes in cannot be stored: " + fault);
  }
  if (options_.on_fault) options_.on_fault(machine, fault);
}

void PortService::on_stored(const storage::RecordBatch& batch) {
  for (const auto& record : batch.records) listener_.on_record(record);
  for (const auto& beginning : batch.beginnings) line_machines_.announce(beginning.run);
  for (const auto& ending : batch.endings) line_machines_.announce(ending.run);
}

}  // namespace dripline::ports
