#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/dds/endpoint.hpp"
#include "server/machines/worker_pool.hpp"
#include "storage/record_store.hpp"
#include "storage/store.hpp"

namespace dripline::machines {

/// Stores the records of one machine. While the store refuses (a full disk), the caller keeps what
/// it could not store and tries again after a pause that grows from try to try; the log gets one
/// line when that begins and one when it ends. Any thread.
class RecordWriter {
 public:
  static constexpr std::chrono::milliseconds kFirstPause{250};  ///< doubled up to kLongestPause
  static constexpr std::chrono::milliseconds kLongestPause{5000};

  struct Parts {
    storage::RecordStore& store;
    std::string machine;
    std::string consequence;  ///< of a store that refuses, for the log
    /// At every try: why nothing can be stored; empty: it can again.
    std::function<void(const std::string& fault)> on_fault = {};
  };
  explicit RecordWriter(Parts parts) : parts_(std::move(parts)) {}

  /// Promises and errors: RecordStore::store.
  Result<std::uint64_t> store(const storage::RecordBatch& batch) {
    return note(parts_.store.store(batch));
  }
  /// How a try ended that the caller has made; returns it.
  Result<std::uint64_t> note(Result<std::uint64_t> stored);
  /// Before the next try; 0: the last one succeeded.
  std::chrono::milliseconds pause() const;

 private:
  Parts parts_;
  mutable std::mutex mutex_;
  std::chrono::milliseconds pause_{0};
};

/// No later try can store these: something in them is not what a gateway writes.
inline bool is_hopeless(const Error& error) {
  return error.code == Errc::Syntax || error.code == Errc::LimitExceeded;
}

/// Puts what the machines report on disk, then acknowledges it. What arrives of all machines while
/// a commit runs, and kGather after it, is the next commit; records that begin or end a run have
/// one of their own. While the store refuses (a full disk) nothing is acknowledged and nothing is
/// lost: the gateways keep their records, and those that have arrived are tried again.
class RecordIngest {
 public:
  static constexpr std::size_t kMaxWaiting = 4096;  ///< records of one machine; more are left to
                                                    ///< the gateway, which sends them again
  static constexpr std::size_t kMaxBatch = 1024;
  static constexpr std::size_t kMaxGroup = 256;  ///< machines in a commit
  /// A single record is on disk at once; of a stream of them, a hundred commits a second are.
  static constexpr std::chrono::milliseconds kGather{10};
  static constexpr std::size_t kWorthACommit = 64;  ///< so many records are not waited for

  struct Parts {
    const storage::Store& store;
    dds::ServerEndpoint& endpoint;
    WorkerPool& pool;
    const Clock& clock;
    /// How far the machine's time of day is ahead of the server's, where that is known and
    /// significant.
    std::function<std::chrono::microseconds(const std::string& machine)> clock_ahead;
    /// Held while run states are changed.
    std::mutex& state_mutex;
    /// After a commit, on a worker; one call at a time per machine. Without the records that name
    /// another machine's run: those are kept and nothing else.
    std::function<void(const storage::RecordBatch&)> on_stored;
    /// At every try: why a machine's records cannot be stored; empty: they can again.
    std::function<void(const std::string& machine, const std::string& fault)> on_fault = {};
  };
  /// All parts must outlive the last task, so the pool must be stopped first.
  explicit RecordIngest(Parts parts) : parts_(std::move(parts)) {}

  /// Any thread; returns at once.
  void take(dds::Record record);
  /// Notifies a machine that has just connected of what is on disk of this epoch.
  void greet(const std::string& machine, std::uint64_t epoch);
  /// Records so far that named another machine's run.
  std::uint64_t foreign() const { return foreign_; }

 private:
  struct Lane {
    std::unique_ptr<RecordWriter> writer;
    std::deque<dds::Record> waiting;
    bool is_scheduled = false;
    std::string own_run;      ///< of this machine, by the store
    std::string foreign_run;  ///< of another machine, named last
    dds::RecordAck ack;       ///< the last one to be sent
    bool ack_is_owed = false;
  };
  /// What is taken from a lane to be stored.
  struct Taken {
    std::string machine;
    std::vector<dds::Record> records;
    std::set<std::string> foreign;
  };
  Lane& lane(const std::string& machine);
  void commit_all();
  std::vector<Taken> take_group();
  void commit(const std::string& machine);
  void conclude(Taken taken, storage::RecordBatch batch, const Result<std::uint64_t>& stored);
  std::vector<dds::Record> take_batch(Lane& lane);
  void put_back(const std::string& machine, std::vector<dds::Record> records);
  void succeed(const std::string& machine, std::uint64_t epoch, std::uint64_t number);
  void acknowledge(const std::string& machine);
  bool is_own(const std::string& machine, const std::string& id);
  /// The runs among these that are another machine's.
  std::set<std::string> foreign_runs(const std::vector<dds::Record>& records);
  storage::RecordBatch to_batch(const std::vector<dds::Record>& records,
                                const std::set<std::string>& foreign);
  UtcTime our_time(const dds::Record& record) const;
  Result<std::uint64_t> store(const storage::RecordBatch& batch);

  Parts parts_;
  std::mutex mutex_;
  std::map<std::string, Lane> lanes_;
  std::deque<std::string> due_;  ///< machines whose records wait for the next commit of all
  bool is_gathering_ = false;    ///< commit_all is posted
  std::atomic<std::uint64_t> foreign_ = 0;
};

}  // namespace dripline::machines
