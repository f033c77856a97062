#pragma once

#include <functional>
#include <mutex>
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

}  // namespace dripline::serial
