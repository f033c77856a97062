#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <mutex>
#include <thread>

#include "protocol/base/result.hpp"
#include "server/library/health.hpp"

namespace dripline::library {

/// Writes and reads the store and checks its disk, now and every Health::kInterval, on a thread
/// of its own.
class HealthWatch {
 public:
  struct Parts {
    Health& health;
    /// Writes something small onto the disk and reads it again.
    std::function<Result<void>()> probe;
    std::filesystem::path folder;
  };
  /// Returns after the first check.
  explicit HealthWatch(Parts parts);
  ~HealthWatch();
  HealthWatch(const HealthWatch&) = delete;
  HealthWatch& operator=(const HealthWatch&) = delete;

 private:
  void look();
  void look_at_disk();
  void run();

  Parts parts_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_stopping_ = false;
  std::thread thread_;
};

/// How a disk of `size` bytes with `free` left is: Failed when hardly a commit fits, Degraded when
/// the operator should make room. Pure.
Health::Finding judge_disk(std::uint64_t size, std::uint64_t free);

}  // namespace dripline::library
