#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <type_traits>
#include <vector>

#include "protocol/base/result.hpp"

namespace dripline::storage {

/// Hands out connections, each to one thread at a time. Thread-safe.
template <class Connection>
class ConnectionPool {
 public:
  explicit ConnectionPool(std::chrono::milliseconds wait) : wait_(wait) {}
  void add(Connection connection) { free_.push_back(std::move(connection)); }

  /// Runs `action(connection)` with one of its own. Errors: Busy (none came free in time), and the
  /// action's.
  template <class Action>
  auto with(Action action) -> std::invoke_result_t<Action, Connection&> {
    auto taken = take();
    if (!taken) return fail(taken.error());
    Lease lease{*this, std::move(*taken)};
    return action(lease.connection);
  }

 private:
  struct Lease {
    ConnectionPool& pool;
    Connection connection;
    ~Lease() { pool.give_back(std::move(connection)); }
  };

  Result<Connection> take() {
    std::unique_lock lock(mutex_);
    const auto deadline = std::chrono::steady_clock::now() + wait_;
    if (!freed_.wait_until(lock, deadline, [this] { return !free_.empty(); })) {
      return fail(Errc::Busy, "no database connection came free within {} ms", wait_.count());
    }
    Connection connection = std::move(free_.back());
    free_.pop_back();
    return connection;
  }

  void give_back(Connection connection) {
    {
      const std::lock_guard lock(mutex_);
      free_.push_back(std::move(connection));
    }
    freed_.notify_one();
  }

  const std::chrono::milliseconds wait_;
  std::mutex mutex_;
  std::condition_variable freed_;
  std::vector<Connection> free_;
};

}  // namespace dripline::storage
