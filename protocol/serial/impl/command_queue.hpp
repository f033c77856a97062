#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "protocol/base/descriptor.hpp"
#include "protocol/wire/discipline.hpp"

namespace dripline::serial {

/// Work that other threads leave for a line's thread. Bounded: a line's owner has a handful of
/// works in progress, so more than kMax are a defect and end the process.
class CommandQueue {
 public:
  using Work = std::function<void(wire::Discipline&, wire::LineTime)>;
  static constexpr std::size_t kMax = 65'536;

  CommandQueue();
  /// Any thread.
  void push(Work work);
  void wake();
  /// The line's thread: returns all works and resets `descriptor`.
  std::vector<Work> take();
  int descriptor() const { return event_.get(); }  ///< readable: there is work

 private:
  Descriptor event_;
  std::mutex mutex_;
  std::vector<Work> waiting_;
};

/// Computes how many characters may go to a driver so that it never holds more than kWindow
/// character times and never runs empty. Each character leaves at the line's rate; if the driver
/// reports how many it still has, the larger number applies. Pure.
class Pacer {
 public:
  static constexpr std::size_t kWindow = 2;

  explicit Pacer(std::chrono::nanoseconds character_time) : time_(character_time) {}

  /// Characters that may go to the driver now. `unsent`: the number that the driver reports.
  std::size_t allowance(wire::LineTime now, std::optional<std::size_t> unsent) const;
  void handed_over(std::size_t count, wire::LineTime now);
  /// The time at which more characters may go.
  wire::LineTime next(wire::LineTime now, std::optional<std::size_t> unsent) const;
  std::chrono::nanoseconds character_time() const { return time_; }

 private:
  std::size_t computed(wire::LineTime now) const;

  std::chrono::nanoseconds time_;
  wire::LineTime empty_at_{};  ///< when the last character in the driver will have left
};

}  // namespace dripline::serial
