#include "server/ports/port_service.hpp"

#include <algorithm>
#include <cstdint>
#include <future>

#include "gateway/line/inbound/rule_reader.hpp"
#include "gateway/line/line_words.hpp"
#include "gateway/line/port_transfer.hpp"
#include "protocol/base/names.hpp"
#include "protocol/process/log.hpp"
#include "protocol/serial/channel.hpp"
#include "server/ports/port_settings.hpp"

namespace dripline::ports {
namespace {

constexpr std::chrono::seconds kDrainLimit{10};

/// Later than every epoch these lines have used, also when the time of day was set back meanwhile:
/// records are listed in the order of their epochs.
std::uint64_t next_epoch(const storage::Store& store, const Clock& clock) {
  auto epoch = static_cast<std::uint64_t>(clock.now().time_since_epoch().count());
  const auto ports = store.ports.list();
  if (!ports) return epoch;
  for (const auto& port : *ports) {
    const auto machine = store.machines.find(port.machine);
    if (machine && machine->epoch < INT64_MAX) epoch = std::max(epoch, machine->epoch + 1);
  }
  return epoch;
}

/// The line knows how far the present one is, the log what was before, and when.
void add_transfers(PortView& view, const TransferLog& log) {
  if (const auto received = log.latest(storage::TransferDirection::Receive))
    view.reception = transfer_view(*received);
  const auto sent = log.latest(storage::TransferDirection::Send);
  if (!sent) return;
  const PortTransfer kept = transfer_view(*sent);
  if (!view.transfer) view.transfer = kept;
  if (view.transfer->id != kept.id) return;
  view.transfer->began = kept.began;
  view.transfer->ended = kept.ended;
}

}  // namespace

PortService::PortService(const machines::RunSources& sources, library::Programs& programs,
                         Options options, machines::MachineListener listener)
    : sources_(sources),
      store_(sources.store),
      programs_(programs),
      clock_(sources.clock),
      options_(std::move(options)),
      listener_(std::move(listener)),
      epoch_(next_epoch(store_, clock_)),
      resets_(store_),
      line_machines_(sources, *this, listener_, resets_),
      pool_(options_.workers),
      near_pool_(kNearWorkers) {}

PortService::~PortService() {
  end();
}

Result<void> PortService::begin(const std::vector<storage::Port>& configured) {
  const auto stored = store_.ports.list();
  if (!stored) return fail(stored.error());
  for (const auto& port : *stored) {
    auto entry = prepare(port);
    if (!entry) {
      const std::string why = entry.error().what;
      process::log_error("port={} cannot be used: {}", port.name, why);
      entry = Entry{};
      entry->port = port;
      entry->fault = fmt::format("cannot be used as it is stored: {}", why);
    }
    put(*std::move(entry));
  }
  // A setup that rules out a port's protocol is reported at a start there: the server begins.
  for (const auto& port : configured) {
    const std::lock_guard changing(change_mutex_);
    const auto known = find(port.name);
    if (known && known->port.address == port.address && !host_fault(known->port).empty()) {
      process::log_warning("port={} of the settings is left as it is stored: {}", port.name,
                           host_fault(known->port));
      continue;
    }
    auto entry = prepare(port);
    const auto saved =
        entry ? save_prepared(*std::move(entry)) : Result<PortView>(fail(entry.error()));
    if (!saved) return fail(saved.error());
  }
  std::vector<std::string> names;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [name, entry] : entries_) names.push_back(name);
  }
  for (const auto& name : names) {
    auto entry = find(name);
    if (!entry || entry->line) continue;
    open(*entry);
    put(*std::move(entry));
  }
  return {};
}

void PortService::end() {
  std::map<std::string, Entry> entries;
  std::map<std::string, Machine> machines;
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(is_ended_, true)) return;  // the pool has stopped: nothing would be drained
    entries = entries_;
    machines = machines_;
  }
  for (const auto& [name, entry] : entries) {
    if (entry.line) entry.line->close("the server stopped");
  }
  near_pool_.stop();
  // Everything posted before is done when this is.
  std::vector<std::future<void>> drained;
  for (const auto& [name, machine] : machines) {
    const auto done = std::make_shared<std::promise<void>>();
    drained.push_back(done->get_future());
    machine.strand.post([done] { done->set_value(); });
  }
  for (const auto& done : drained) done.wait_for(kDrainLimit);
  pool_.stop();
  for (const auto& [name, machine] : machines) {
    if (const std::size_t lost = machine.records->drop(); lost > 0)
      process::log_error("machine={}: the server ends, {} records of its line are not stored", name,
                         lost);
  }
}

/// Everything that can be wrong with a port by itself.
Result<PortService::Entry> PortService::prepare(const storage::Port& port) const {
  if (auto checked = check_port_name(port.name); !checked) return fail(checked.error());
  if (auto checked = check_machine_name(port.machine); !checked) return fail(checked.error());
  Entry entry;
  entry.port = port;
  if (auto address = serial::parse_address(port.address); !address) {
    return fail(address.error().code, "port '{}': {}", port.name, address.error().what);
  }
  auto settings = effective_settings(port);
  if (!settings) return fail(settings.error());
  entry.settings = *std::move(settings);
  if (auto fits = wire::make_discipline(entry.settings, wire::Role::Host); !fits) {
    return fail(fits.error().code, "port '{}': {}", port.name, fits.error().what);
  }
  auto rules = line::read_rules(port.rules);
  if (!rules)
    return fail(rules.error().code, "port '{}': rules: {}", port.name, rules.error().what);
  entry.rules = std::make_shared<const line::RuleSet>(*std::move(rules));
  return entry;
}

/// One writer for a line, one line for a machine.
Result<void> PortService::check_free(const storage::Port& port) const {
  const std::string identity = line_identity(port.address);
  const std::lock_guard lock(mutex_);
  for (const auto& [name, other] : entries_) {
    if (name == port.name) continue;
    if (line_identity(other.port.address) == identity) {
      return fail(Errc::Busy, "{} is port '{}' of machine '{}'", port.address, name,
                  other.port.machine);
    }
    if (port.is_enabled && other.port.is_enabled && other.port.machine == port.machine) {
      return fail(Errc::Busy, "machine '{}' has port '{}' at {}", port.machine, name,
                  other.port.address);
    }
  }
  return {};
}

Result<void> PortService::check_idle(const std::string& name) const {
  const auto entry = find(name);
  if (!entry || !entry->line || !entry->line->is_busy()) return {};
  const LineView view = entry->line->view();
  return fail(Errc::Busy, "port '{}' of machine '{}' is {}", name, view.names.machine,
              what_it_does(view));
}

Result<void> PortService::check_free_to_end(const std::string& name) const {
  if (auto idle = check_idle(name); !idle) return idle;
  const auto entry = find(name);
  const auto progress = entry && entry->line ? entry->line->progress() : std::nullopt;
  if (!progress) return {};
  const bool is_read = line::sends_at_once(entry->settings) || progress->sent.bytes > 0;
  if (!is_read) return {};
  return fail(Errc::Busy,
              "port '{}' of machine '{}' is sending what its control asked for (dnc port stop {} "
              "ends that)",
              name, entry->port.machine, name);
}

Result<PortService::Entry> PortService::find(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(name);
  if (found == entries_.end()) return fail(Errc::NotFound, "port '{}' is not known", name);
  return found->second;
}

void PortService::put(Entry entry) {
  const std::lock_guard lock(mutex_);
  const std::string name = entry.port.name;
  entries_.insert_or_assign(name, std::move(entry));
}

void PortService::open_due() {
  const std::lock_guard changing(change_mutex_);
  std::vector<Entry> due;
  {
    const std::lock_guard lock(mutex_);
    if (is_ended_) return;
    for (const auto& [name, entry] : entries_) {
      if (entry.is_open_due) due.push_back(entry);
    }
  }
  for (auto& entry : due) {
    entry.fault.clear();
    open(entry);
    put(std::move(entry));
  }
}

PortView PortService::view_of(const Entry& entry) {
  PortView view;
  if (entry.line) {
    static_cast<LineView&>(view) = entry.line->view();
  } else {
    view.settings = entry.settings;
    view.fault = entry.fault;
  }
  view.port = entry.port;
  if (entry.transfers) add_transfers(view, *entry.transfers);
  return view;
}

std::vector<PortView> PortService::ports() const {
  std::vector<PortView> views;
  const std::lock_guard lock(mutex_);
  for (const auto& [name, entry] : entries_) views.push_back(view_of(entry));
  return views;
}

Result<PortView> PortService::port(const std::string& name) const {
  const auto entry = find(name);
  if (!entry) return fail(entry.error());
  return view_of(*entry);
}

Result<PortView> PortService::save(const storage::Port& port) {
  const std::lock_guard changing(change_mutex_);
  auto entry = prepare(port);
  if (!entry) return fail(entry.error());
  if (auto fits = check_protocol(store_.setups, port.machine, entry->settings.flow); !fits) {
    return fail(fits.error().code, "port '{}': {}", port.name, fits.error().what);
  }
  return save_prepared(*std::move(entry));
}

Result<PortView> PortService::save_prepared(Entry entry) {
  entry.port.host.clear();
  note_host(entry.port);
  const storage::Port& port = entry.port;
  if (auto free = check_free(port); !free) return fail(free.error());
  if (auto idle = check_free_to_end(port.name); !idle) return fail(idle.error());
  const auto before = find(port.name);
  if (before && before->port.machine != port.machine) {
    if (auto ready = check_reset(*before); !ready) return fail(ready.error());
  }
  if (auto saved = store_.ports.save(port); !saved) return fail(saved.error());
  if (before) {
    entry.transfers = before->transfers;
    if (before->line) before->line->close("the port was changed");
  }
  open(entry);
  const PortView view = view_of(entry);
  put(std::move(entry));
  return view;
}

/// What is known of its control goes with a port, and is not that of another machine.
Result<void> PortService::check_reset(const Entry& entry) const {
  return resets_.check(reset_view(entry), entry.port.name);
}

LineView PortService::reset_view(const Entry& entry) {
  if (entry.line) return entry.line->view();
  LineView view;
  view.names = {entry.port.name, entry.port.machine, entry.port.address};
  view.settings = entry.settings;
  return view;
}

Result<void> PortService::remove(const std::string& name) {
  const std::lock_guard changing(change_mutex_);
  const auto entry = find(name);
  if (!entry) return fail(entry.error());
  if (auto idle = check_free_to_end(name); !idle) return idle;
  if (auto ready = check_reset(*entry); !ready) return ready;
  if (auto removed = store_.ports.remove(name); !removed) return removed;
  {
    const std::lock_guard lock(mutex_);
    entries_.erase(name);
  }
  if (entry->line) entry->line->close("the port was removed");
  return {};
}

void PortService::on_traffic(std::function<void(const PortTraffic&)> listener) {
  const std::lock_guard lock(traffic_mutex_);
  on_traffic_ = std::move(listener);
}

std::shared_ptr<PortLine> PortService::line_of(const std::string& machine) const {
  const std::lock_guard lock(mutex_);
  for (const auto& [name, entry] : entries_) {
    if (entry.line && entry.port.machine == machine) return entry.line;
  }
  return nullptr;
}

std::vector<std::shared_ptr<PortLine>> PortService::lines() const {
  std::vector<std::shared_ptr<PortLine>> lines;
  const std::lock_guard lock(mutex_);
  for (const auto& [name, entry] : entries_) {
    if (entry.line) lines.push_back(entry.line);
  }
  return lines;
}

std::shared_ptr<LineRecords> PortService::records_of(const std::string& machine) const {
  const std::lock_guard lock(mutex_);
  const auto found = machines_.find(machine);
  return found == machines_.end() ? nullptr : found->second.records;
}

}  // namespace dripline::ports
