#include "server/api/request_times.hpp"

#include <algorithm>

namespace dripline::api {

void RequestTimes::add(const std::string& route, Duration taken) {
  const double seconds = std::chrono::duration<double>(taken).count();
  const auto bucket = std::ranges::lower_bound(kBounds, seconds) - kBounds.begin();
  const std::lock_guard lock(mutex_);
  Times& times = times_[route];
  ++times.counts[static_cast<std::size_t>(bucket)];
  times.sum += seconds;
}

std::map<std::string, RequestTimes::Times> RequestTimes::all() const {
  const std::lock_guard lock(mutex_);
  return times_;
}

}  // namespace dripline::api
