#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/base/clock.hpp"
#include "protocol/dds/endpoint.hpp"
#include "server/feeds/block_feed.hpp"
#include "server/feeds/feed_control.hpp"
#include "server/feeds/machine_board.hpp"
#include "server/feeds/order_desk.hpp"
#include "server/feeds/record_keeper.hpp"
#include "server/feeds/run_watch.hpp"
#include "server/feeds/worker_pool.hpp"

namespace dripline::feeds {

/// Feeds the machines and keeps what they report. Wiring:
///     FeedService feeds(store, clock, options, listener);
///     auto endpoint = ServerEndpoint::open(network, feeds.handlers());
///     feeds.begin(std::move(*endpoint));      // nothing is handled before
///     ... feeds.end();                        // leaves DDS
/// DDS threads only hand over; a pool of workers does everything that waits.
class FeedService final : public FeedControl {
 public:
  struct Options {
    unsigned workers = 4;
    OrderDesk::Options orders;
    /// A machine's records can not be stored, and why; empty: they are again. Any thread.
    std::function<void(const std::string& machine, const std::string& trouble)> on_trouble = {};
  };
  FeedService(storage::Store& store, const Clock& clock, Options options, FeedListener listener);
  ~FeedService() override;

  /// Valid while the service lives; what arrives before begin() is left out, and asked or sent
  /// again by the gateways.
  dds::ServerHandlers handlers();
  Result<void> begin(std::unique_ptr<dds::ServerEndpoint> endpoint);
  /// Whoever waits for a gateway's answer is told that the server stops. Called by end().
  void stop_waiting();
  /// In order: no more from the network, waiting orders fail, what has arrived is stored, DDS is
  /// left. Called by the destructor at the latest.
  void end();

  std::vector<MachineView> machines() const override;
  Result<MachineView> machine(const std::string& name) const override;
  Result<storage::Run> start(const StartRequest& request) override;
  Result<void> order(const OrderRequest& request) override;
  dds::Rejected rejected() const;

 private:
  /// Everything that needs the endpoint; made by begin().
  struct Parts {
    Parts(FeedService& service, dds::ServerEndpoint& endpoint);
    BlockFeed blocks;
    RecordKeeper records;
    OrderDesk orders;
    RunWatch watch;
  };
  Parts* parts() const;
  void on_stored(const storage::RecordBatch& batch);
  Result<void> order_machine(const OrderRequest& request);
  void on_late_start(const dds::Order& order);
  OrderDesk::Options order_options() const;
  void abort_unwanted(const storage::Run& run);
  void refuse_stranger(const dds::Announce& announce);
  static Result<void> check_protocol(const MachineView& view);
  static Result<void> check_order(const OrderRequest& request, const MachineView& view);
  void tick();
  void log_rejected();
  void announce_run(const std::string& run);
  Result<MachineView> connected_machine(const std::string& name) const;
  Result<storage::Run> make_run(const StartRequest& request, const MachineView& view);
  Result<std::optional<storage::SetupRevision>> setup_of(const storage::Run& run);
  Result<storage::Run> conclude_start(const storage::Run& run, const Result<void>& outcome);

  storage::Store& store_;
  const Clock& clock_;
  const Options options_;
  const FeedListener listener_;
  std::mutex state_mutex_;  ///< held while the state of a run is changed
  WorkerPool pool_;
  MachineBoard board_;
  std::unique_ptr<dds::ServerEndpoint> endpoint_;
  std::unique_ptr<Parts> owned_parts_;
  std::atomic<Parts*> parts_{nullptr};
  std::atomic<bool> is_ending_{false};
  std::uint64_t rejected_logged_ = 0;  ///< this and the next are the tick's
  SteadyTime next_rejected_log_{};
};

}  // namespace dripline::feeds
