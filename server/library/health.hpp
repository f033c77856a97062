#pragma once

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

namespace dripline::library {

/// The state of the server, from what its parts have reported last. Any thread; never waits.
class Health {
 public:
  enum class Level { Ok, Degraded, Failed };
  struct Finding {
    Level level = Level::Ok;
    std::string subject;  ///< store, disk, records ...
    std::string what;     ///< for any client: no path, no name
    std::string detail;   ///< for clients with the token
  };
  struct State {
    Level level = Level::Ok;  ///< the worst of the findings
    std::vector<Finding> findings;
  };
  /// The watch checks this often. When it has not come back for kPatience, the store is Degraded,
  /// and after kSilence Failed: a store that hangs reports nothing itself.
  static constexpr std::chrono::seconds kInterval{3};
  static constexpr std::chrono::seconds kPatience{6};
  static constexpr std::chrono::seconds kSilence{45};

  explicit Health(const Clock& clock) : clock_(clock) {}
  /// Replaces what was reported of this subject and this detail's owner (a machine; may be empty).
  /// Ok takes it back.
  void report(const std::string& owner, Finding finding);
  /// The watch has begun, or checked again.
  void looked();
  State state() const;

 private:
  const Clock& clock_;
  mutable std::mutex mutex_;
  std::map<std::pair<std::string, std::string>, Finding> findings_;  ///< by subject and owner
  std::optional<SteadyTime> looked_;
};

/// ok, degraded, failed
std::string_view to_string(Health::Level level);

/// Writes and reads the store and checks its disk, now and every Health::kInterval, on a thread
/// of its own.
class HealthWatch {
 public:
  struct Parts {
    Health& health;
    /// Writes something small onto the disk and reads it again.
    std::function<Result<void>()> probe;
    std::filesystem::path folder;
    /// This computer's clock, and the store's where it is another computer's.
    const Clock& clock;
    std::function<Result<std::optional<UtcTime>>()> store_time{};
  };
  /// Returns after the first check.
  explicit HealthWatch(Parts parts);
  ~HealthWatch();
  HealthWatch(const HealthWatch&) = delete;
  HealthWatch& operator=(const HealthWatch&) = delete;

 private:
  void look();
  void look_at_disk();
  void look_at_clock();
  void run();

  Parts parts_;
  bool does_clock_differ_ = false;  ///< of the watch's thread
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_stopping_ = false;
  std::thread thread_;
};

/// How a disk of `size` bytes with `free` left is: Failed when hardly a commit fits, Degraded when
/// the operator should make room. Pure.
Health::Finding judge_disk(std::uint64_t size, std::uint64_t free);

/// This computer's clock, which showed `before` and `after` the store's showed `store`: Degraded
/// from kClockTolerance of difference, until it is a second less (`did_differ`). Where the clocks
/// of servers differ, a takeover makes times go back, and tokens begin or end at the wrong time.
/// Pure.
Health::Finding judge_clock(UtcTime before, UtcTime store, UtcTime after, bool did_differ);
inline constexpr std::chrono::seconds kClockTolerance{5};

}  // namespace dripline::library
