#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "protocol/base/digest.hpp"
#include "storage/store.hpp"

namespace dripline::machines {

/// Brings the programs of unfinished runs into the server's own cache before their machines ask for
/// them (ProgramStore::fetch_ahead): of each run its program, what its release pins, and what it
/// has called so far. One thread, one chunk at a time, the runs in turn. All of them together get
/// at most `room` bytes of the cache; of a program for which that is not enough the rest is left to
/// the feed. Thread-safe; no one but that thread waits for the store.
class ProgramFetcher {
 public:
  /// The store must outlive it. Nothing is fetched before begin().
  ProgramFetcher(const storage::Store& store, std::uint64_t room) : store_(store), room_(room) {}
  ~ProgramFetcher() { end(); }

  /// With the runs that are unfinished now. Errors: those of the store.
  Result<void> begin();
  /// Of an unfinished run, once; a finished one is forgotten.
  void note(const storage::Run& run);
  /// A program that an unfinished run has called.
  void add(const std::string& run, const Digest& content);
  void end();

 private:
  static constexpr std::size_t kMostJobs = 4096;  ///< programs; what is more is left to the feed
  static constexpr std::chrono::seconds kAwayPause{1};

  struct Job {
    std::string run;
    std::optional<Digest> content = {};  ///< absent: what the run calls is to be found
    std::optional<std::uint64_t> approval = {};
    std::uint64_t position = 0;
  };
  enum class Outcome : std::uint8_t { Done, GoesOn, Away };

  void work(const std::stop_token& stop);
  std::optional<Job> take(const std::stop_token& stop);
  Outcome advance(Job& job);
  Outcome look_for_called(const Job& job);
  Outcome fetch_chunk(Job& job);
  static Outcome outcome_of(const Job& job, const Error& error);
  /// False: there is no room for more, or the run has ended.
  bool count(const std::string& run, std::uint64_t bytes);
  void put(Job job);

  const storage::Store& store_;
  const std::uint64_t room_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Job> jobs_;
  std::map<std::string, std::uint64_t> bytes_of_;  ///< of the unfinished runs
  std::uint64_t bytes_ = 0;
  std::jthread worker_;
};

}  // namespace dripline::machines
