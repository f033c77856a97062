#pragma once

#include <chrono>
#include <set>
#include <span>

#include "protocol/base/clock.hpp"

namespace dripline::backup {

/// Which backups stay: every one of the last days, then the newest of each week, and always the
/// newest of all.
struct Retention {
  std::chrono::days every{14};
  std::chrono::weeks weekly{26};
};

/// The times of `made` (in any order) that may go. A backup of the future,
/// made before the clock was set, stays. Pure.
std::set<UtcTime> expired(std::span<const UtcTime> made, const Retention& retention, UtcTime now);

}  // namespace dripline::backup
