#include "storage/backup/retention.hpp"

#include <algorithm>
#include <map>

namespace dripline::backup {

std::set<UtcTime> expired(std::span<const UtcTime> made, const Retention& retention, UtcTime now) {
  std::set<UtcTime> out(made.begin(), made.end());
  if (out.empty()) return out;
  out.erase(std::prev(out.end()));
  std::map<std::chrono::sys_time<std::chrono::weeks>, UtcTime> newest_of_week;
  for (const UtcTime time : made) {
    const auto age = now - time;
    if (age <= retention.every) out.erase(time);
    if (age > retention.weekly) continue;
    // Fixed weeks, not counted from now: otherwise each day would choose others.
    const auto week = std::chrono::floor<std::chrono::weeks>(time);
    auto& newest = newest_of_week.try_emplace(week, time).first->second;
    newest = std::max(newest, time);
  }
  for (const auto& [week, time] : newest_of_week) out.erase(time);
  return out;
}

}  // namespace dripline::backup
