#pragma once

#include <mutex>

#include "protocol/dds/endpoint.hpp"

namespace dripline::dds {

/// Counts the messages an endpoint dropped. Any thread.
class Rejections {
 public:
  void add(const char* topic, std::string_view reason) {
    std::lock_guard lock(mutex_);
    ++rejected_.messages;
    rejected_.last_reason = fmt::format("{}: {}", topic, reason);
  }
  Rejected get() const {
    std::lock_guard lock(mutex_);
    return rejected_;
  }

 private:
  mutable std::mutex mutex_;
  Rejected rejected_;
};

}  // namespace dripline::dds
