#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/base/clock.hpp"
#include "protocol/dds/endpoint.hpp"
#include "server/machines/block_feed.hpp"
#include "server/machines/command_dispatcher.hpp"
#include "server/machines/line_queries.hpp"
#include "server/machines/machine_control.hpp"
#include "server/machines/machine_registry.hpp"
#include "server/machines/record_ingest.hpp"
#include "server/machines/run_reconciler.hpp"
#include "server/machines/run_sources.hpp"
#include "server/machines/worker_pool.hpp"

namespace dripline::machines {

/// Feeds the machines and keeps what they report. Wiring:
///     MachineService feeds(sources, options, listener);
///     auto endpoint = ServerEndpoint::open(network, feeds.handlers());
///     feeds.begin(std::move(*endpoint));      // nothing is handled before
///     ... feeds.end();                        // leaves DDS
/// DDS threads only enqueue; a pool of workers does everything that waits.
class MachineService final : public MachineControl {
 public:
  struct Options {
    unsigned workers = 4;
    CommandDispatcher::Options commands;
    /// At every try: why a machine's records cannot be stored; empty: they can again. Any thread.
    std::function<void(const std::string& machine, const std::string& fault)> on_fault = {};
    /// The status of a gateway beside a control, on a DDS thread: must return at once.
    std::function<void(const dds::Status&)> on_line = {};
    /// A run has got a program that it called. Any thread, must return soon.
    std::function<void(const std::string& run, const Digest& content)> on_called = {};
  };
  MachineService(const RunSources& sources, Options options, MachineListener listener);
  ~MachineService() override;

  /// Valid while the service lives; what arrives before begin() is dropped, and the gateways
  /// request or send it again.
  dds::ServerHandlers handlers();
  Result<void> begin(std::unique_ptr<dds::ServerEndpoint> endpoint);
  /// DDS ended every connection without a word: the server's own certificate has expired. Any
  /// thread, after begin.
  void lose_gateways();
  /// Callers that wait for a gateway's answer get an error. Called by end().
  void stop_waiting();
  /// In order: no more from the network, waiting commands fail, what is being stored is stored (the
  /// gateways keep the rest), DDS is left. Called by the destructor at the latest.
  void end();

  std::vector<MachineView> machines() const override;
  std::vector<MachineView> machines_after(const MachinePage& page) const override;
  Result<MachineView> machine(const std::string& name) const override;
  Result<storage::Run> start(const StartRequest& request) override;
  Result<void> command(const CommandRequest& request) override;
  Result<std::string> values(const ValueQuery& query) override;
  Result<PositionAnswer> position(const PositionRequest& request) override;
  Result<JogAnswer> jog(const JogRequest& request) override;
  Result<std::string> confirm_gateway(const std::string& machine) override;
  Result<void> remove(const std::string& machine, const storage::Actor& who) override;
  /// The machine's screen shows by its newest setup from now on, if its gateway is there. It does
  /// not wait.
  void show_setup(const std::string& machine);
  dds::Rejected rejected() const;
  /// As of dds::ServerEndpoint; 0 before `begin`.
  std::size_t heard_gateways() const;
  /// Promises: LineQueries::ask.
  Result<dds::LineData> ask_line(dds::LineRequest request,
                                 std::chrono::milliseconds limit = LineQueries::kLimit);

 private:
  /// Everything that needs the endpoint; made by begin().
  struct Parts {
    Parts(MachineService& service, dds::ServerEndpoint& endpoint);
    BlockFeed blocks;
    RecordIngest records;
    CommandDispatcher commands;
    LineQueries lines;
    RunReconciler reconciler;
  };
  Parts* parts() const;
  void on_stored(const storage::RecordBatch& batch);
  Result<void> command_machine(const CommandRequest& request);
  void on_late_start(const dds::Command& command);
  bool is_new_screen(const dds::Status& status);
  void give_setup(const std::string& machine);
  CommandDispatcher::Options command_options() const;
  void abort_unwanted(const storage::Run& run);
  void refuse_stranger(const dds::Announce& announce);
  static Result<void> check_protocol(const MachineView& view);
  /// Errors: Busy (two gateways claim to be the machine).
  static Result<void> check_alone(const MachineView& view);
  /// Errors: Timeout (what is known of the machine is old).
  static Result<void> check_heard(const MachineView& view);
  Result<CommandTarget> target_of(const CommandRequest& request) const;
  static bool is_stop(const CommandRequest& request, const MachineView& view);
  void note_stop(const CommandRequest& request, const std::string& machine);
  Result<void> send(dds::Command command, const CommandRequest& request, const MachineView& view);
  void tick();
  void log_rejected();
  void announce_run(const std::string& run);
  Result<MachineView> connected_machine(const std::string& name) const;
  /// For what is no stop, connected; a stop is also for a gateway that waits to be confirmed.
  Result<MachineView> reachable_machine(const CommandRequest& request,
                                        const std::string& name) const;
  /// Connected, by one gateway of this protocol: it takes more than a stop.
  Result<MachineView> machine_for_work(const std::string& name) const;
  Result<storage::Run> make_run(const StartRequest& request, const MachineView& view);
  Result<std::optional<storage::SetupRevision>> setup_of(const MachineView& view);
  /// With the setup that a start would get.
  Result<dds::Command> command_with_setup(const MachineView& view, dds::CommandAction action);
  /// Whether its gateway is not older than the command. Errors: Unsupported.
  static Result<void> check_knows(const MachineView& view, dds::CommandAction action);
  /// For a machine without a run, with the setup that a start would get.
  Result<dds::Command> command_at_rest(const std::string& machine, dds::CommandAction action);
  static Result<void> check_test(const StartRequest& request, const MachineView& view);
  Result<void> check_restart(const StartRequest& request, const storage::Run& run);
  Result<storage::Run> conclude_start(const storage::Run& run, const Result<void>& outcome);

  static constexpr unsigned kNearWorkers = 2;

  const RunSources sources_;
  const storage::Store& store_;
  const Clock& clock_;
  const Options options_;
  const MachineListener listener_;
  std::mutex state_mutex_;  ///< held while the state of a run is changed
  WorkerPool pool_;
  WorkerPool near_pool_;  ///< nothing on it waits for the store (BlockFeed)
  MachineRegistry registry_;
  std::unique_ptr<dds::ServerEndpoint> endpoint_;
  std::unique_ptr<Parts> owned_parts_;
  std::atomic<Parts*> parts_{nullptr};
  std::atomic<bool> is_ending_{false};
  std::mutex screens_mutex_;
  std::map<std::string, std::uint64_t> screens_;  ///< sessions of gateways that have the setup
  std::uint64_t rejected_logged_ = 0;             ///< this and the next are the tick's
  SteadyTime next_rejected_log_{};
};

}  // namespace dripline::machines
