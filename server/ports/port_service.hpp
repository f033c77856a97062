#pragma once

#include <atomic>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "gateway/line/inbound/rule_set.hpp"
#include "server/library/programs.hpp"
#include "server/machines/machine_control.hpp"
#include "server/machines/worker_pool.hpp"
#include "server/ports/line_machines.hpp"
#include "server/ports/line_records.hpp"
#include "server/ports/line_transfer.hpp"
#include "server/ports/port_control.hpp"
#include "server/ports/programs/broken_program.hpp"

namespace dripline::ports {

/// The ports of the server. Wiring:
///     PortService ports(sources, programs, options, listener);
///     ports.begin(configured);        // opens what is stored, and what the settings file has
///     ... MachineRouter machines(store.runs, gateways, ports.machines());
///     ... ports.end();
/// Every enabled port is open and listens all the time. Each has the thread of its line, which
/// never waits for storage; what waits is done on a pool, machine by machine in order.
class PortService final : public PortControl, private LineDirectory {
 public:
  static constexpr std::chrono::milliseconds kTick{200};
  static constexpr unsigned kNearWorkers = 2;  ///< for what never waits for the store
  struct Options {
    unsigned workers = 2;
    std::filesystem::path recordings;  ///< folder; empty: in memory only
    LineOpener open = {};              ///< empty: serial::LineDriver::start
    /// This computer's name, where servers on several computers have one store: a port whose
    /// address is a device belongs to the one where it was set up, and is shown with a fault at the
    /// others. Empty: this is the only server.
    std::string host = {};
    /// False: another server may have the library, and with it the lines that it can reach too:
    /// nothing is sent over those. Any thread. Empty: this is the only server.
    std::function<bool()> may_send = {};
    /// Why records of a machine cannot be stored, at every try; empty: they can again.
    std::function<void(const std::string& machine, const std::string& fault)> on_fault = {};
  };
  PortService(const machines::RunSources& sources, library::Programs& programs, Options options,
              machines::MachineListener listener);
  ~PortService() override;

  /// Unfinished runs of the server before this start end Interrupted. A stored port that cannot be
  /// used is shown with its fault. Errors: those of save() for the configured ones, Io.
  Result<void> begin(const std::vector<storage::Port>& configured);
  /// Opens the ports that could not be opened because nothing could be stored.
  void open_due();
  /// Lines are closed, their runs end Interrupted, what has arrived is stored.
  void end();
  LineMachines& machines() { return line_machines_; }
  ResetGate& resets() { return resets_; }
  /// Whether its line may be closed. Errors: Busy (a run, a transfer, or the control sends; named).
  Result<void> check_idle(const std::string& name) const;
  /// The same for a server that ends: also of a program that the control was offered and reads.
  Result<void> check_free_to_end(const std::string& name) const;

  std::vector<PortView> ports() const override;
  Result<PortView> port(const std::string& name) const override;
  Result<PortView> save(const storage::Port& port) override;
  Result<void> remove(const std::string& name) override;
  Result<PortTest> test(const std::string& name) override;
  Result<PortTransfer> send(const std::string& name,
                            const std::vector<ProgramChoice>& programs) override;
  Result<std::string> confirm_reset(const std::string& name) override;
  Result<void> receive(const std::string& name) override;
  Result<void> stop_transfer(const std::string& name, const std::string& reason) override;
  Result<RuleVerdict> test_rules(const std::string& name, const std::string& text) const override;
  Result<std::vector<PortTraffic>> recording(const std::string& name) const override;
  void on_traffic(std::function<void(const PortTraffic&)> listener) override;

 private:
  /// A port with everything that follows from its configuration.
  struct Entry {
    storage::Port port;
    wire::LineSettings settings;
    std::shared_ptr<const line::RuleSet> rules = std::make_shared<line::RuleSet>();
    std::shared_ptr<PortLine> line;          ///< null: disabled, or `fault`
    std::shared_ptr<TransferLog> transfers;  ///< null: it has not been opened yet
    std::string fault;
    bool is_open_due = false;  ///< the store refused what has to be written first
  };
  /// What stays with a machine when its port is changed.
  struct Machine {
    Strand strand;
    std::shared_ptr<LineRecords> records;
  };
  std::shared_ptr<PortLine> line_of(const std::string& machine) const override;
  std::vector<std::shared_ptr<PortLine>> lines() const override;
  std::shared_ptr<LineRecords> records_of(const std::string& machine) const override;

  Result<Entry> prepare(const storage::Port& port) const;
  Result<void> check_free(const storage::Port& port) const;
  Result<PortView> save_prepared(Entry entry);
  Result<Entry> find(const std::string& name) const;
  Result<LineInUse> find_line(const std::string& name) const;
  Result<std::uint64_t> enter_machine(const storage::Port& port);
  std::uint64_t epoch_of(const storage::Machine& machine) const;
  Machine machine_of(const std::string& name, std::uint64_t epoch);
  void put(Entry entry);
  void open(Entry& entry);
  Result<void> open_transfers(Entry& entry) const;
  void note_host(storage::Port& port) const;
  /// Why the port's device is not this computer's; empty: it is, or it is no device.
  std::string host_fault(const storage::Port& port) const;
  PortListener listener_for(const Entry& entry, const Machine& machine);
  std::shared_ptr<PortLine> make_line(const Entry& entry, const Strands& strands,
                                      PortListener listener);
  bool is_program_broken(const Entry& entry) const;
  /// Of an open line, some times a second: it continues while the store is waited for.
  struct Ticking {
    std::weak_ptr<PortLine> line;
    std::shared_ptr<TransferLog> transfers;
    Strands strands;
    std::shared_ptr<std::atomic<bool>> is_saving = std::make_shared<std::atomic<bool>>(false);
  };
  void tick(const Ticking& ticking, unsigned count);
  void save_progress(const Ticking& ticking);
  void tell_traffic(const PortTraffic& traffic) const;
  void note_transfer(const std::string& machine, const SendEnd& end);
  void on_stored(const storage::RecordBatch& batch);
  void on_store_fault(const std::string& machine, const std::string& fault);
  Result<void> check_reset(const Entry& entry) const;
  static LineView reset_view(const Entry& entry);
  static PortView view_of(const Entry& entry);

  const machines::RunSources sources_;
  const storage::Store& store_;
  library::Programs& programs_;
  const Clock& clock_;
  const Options options_;
  const machines::MachineListener listener_;
  const std::uint64_t epoch_;  ///< of this process, as the clock has it: see epoch_of
  ResetGate resets_;
  LineMachines line_machines_;
  std::mutex change_mutex_;  ///< held by save, remove and test: one at a time
  mutable std::mutex mutex_;
  std::map<std::string, Entry> entries_;
  std::map<std::string, Machine> machines_;
  bool is_ended_ = false;
  mutable std::mutex traffic_mutex_;
  std::function<void(const PortTraffic&)> on_traffic_;
  machines::WorkerPool pool_, near_pool_;  // last: their tasks use the others
};

}  // namespace dripline::ports
