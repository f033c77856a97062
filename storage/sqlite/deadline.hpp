#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>
#include <thread>

#include "storage/sqlite/database.hpp"

namespace dripline::storage::sqlite {

/// While it lives, what runs on the database is interrupted once the time is over or `stop` was
/// requested. The database must outlive it.
class Deadline {
 public:
  Deadline(Database& database, std::chrono::milliseconds limit, std::stop_token stop)
      : stop_(std::move(stop)), watch_([this, &database, limit](const std::stop_token& over) {
          watch(database, std::chrono::steady_clock::now() + limit, over);
        }) {}
  bool has_passed() const { return has_passed_; }

 private:
  void watch(Database& database, std::chrono::steady_clock::time_point limit,
             const std::stop_token& over) {
    constexpr std::chrono::milliseconds kLook{20};
    std::unique_lock lock(mutex_);
    while (!over.stop_requested()) {
      if (stop_.stop_requested() || std::chrono::steady_clock::now() >= limit) {
        has_passed_ = true;
        database.interrupt();  // again at every look: one between two statements is lost
      }
      changed_.wait_for(lock, over, kLook, [] { return false; });
    }
  }

  const std::stop_token stop_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::atomic<bool> has_passed_ = false;
  std::jthread watch_;  // last: it uses the others
};

}  // namespace dripline::storage::sqlite
