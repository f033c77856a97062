#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "protocol/dds/endpoint.hpp"
#include "server/feeds/worker_pool.hpp"
#include "storage/store.hpp"

namespace dripline::feeds {

/// Puts what the machines report on disk, then acknowledges it. What arrives while a commit runs
/// is the next commit. While the store refuses (a full disk) nothing is acknowledged and nothing is
/// lost: the gateways keep their records, and the ones that are here already are tried again.
class RecordKeeper {
 public:
  static constexpr std::size_t kMaxWaiting = 4096;  ///< records of one machine; more are left to
                                                    ///< the gateway, which sends them again
  static constexpr std::size_t kMaxBatch = 1024;

  struct Parts {
    storage::Store& store;
    dds::ServerEndpoint& endpoint;
    WorkerPool& pool;
    /// Held while run states are changed.
    std::mutex& state_mutex;
    /// After a commit, on a worker; one call at a time per machine.
    std::function<void(const storage::RecordBatch&)> on_stored;
    /// A machine's records can not be stored, and why; empty: they are again.
    std::function<void(const std::string& machine, const std::string& trouble)> on_trouble = {};
  };
  /// All parts must outlive the keeper's last task, that is, the pool must be stopped first.
  explicit RecordKeeper(Parts parts) : parts_(std::move(parts)) {}

  /// Any thread; returns at once.
  void take(dds::Record record);
  /// Tells a machine that has just come what is on disk of this epoch.
  void greet(const std::string& machine, std::uint64_t epoch);

 private:
  struct Lane {
    std::deque<dds::Record> waiting;
    bool is_scheduled = false;
    bool is_failing = false;
    std::chrono::milliseconds pause{0};
    dds::RecordAck ack;  ///< the last one to be sent
    bool ack_is_owed = false;
  };
  void commit(const std::string& machine);
  std::vector<dds::Record> take_batch(Lane& lane);
  void put_back(const std::string& machine, std::vector<dds::Record> records, const Error& error);
  void succeed(const std::string& machine, std::uint64_t epoch, std::uint64_t number);
  void acknowledge(const std::string& machine);
  storage::RecordBatch to_batch(const std::vector<dds::Record>& records);
  Result<std::uint64_t> store(const storage::RecordBatch& batch);

  Parts parts_;
  std::mutex mutex_;
  std::map<std::string, Lane> lanes_;
};

}  // namespace dripline::feeds
