#include "server/identity/attempt_limits.hpp"

#include <algorithm>
#include <cmath>

namespace dripline::identity {

double AttemptLimits::drained(const Level& level, unsigned limit, SteadyTime now) const {
  const std::chrono::duration<double> passed = now - level.at;
  const std::chrono::duration<double> window = options_.window;
  return std::max(0.0, level.attempts - passed / window * limit);
}

AttemptLimits::Level& AttemptLimits::level_of(Levels& levels, const std::string& key,
                                              unsigned limit, SteadyTime now) {
  auto found = levels.find(key);
  if (found == levels.end()) {
    // The least tried one makes room, so that a stranger's thousand names hide no attack on one.
    if (levels.size() >= options_.entries) {
      levels.erase(
          std::min_element(levels.begin(), levels.end(), [&](const auto& a, const auto& b) {
            return drained(a.second, limit, now) < drained(b.second, limit, now);
          }));
    }
    found = levels.emplace(key, Level{0, now}).first;
  }
  found->second.attempts = drained(found->second, limit, now);
  found->second.at = now;
  return found->second;
}

std::optional<std::chrono::seconds> AttemptLimits::wait_for(const Level& level,
                                                            unsigned limit) const {
  const double over = level.attempts + 1 - limit;
  if (over <= 0) return std::nullopt;
  const std::chrono::duration<double> window = options_.window;
  return std::chrono::seconds(
      static_cast<std::int64_t>(std::ceil((window * over / limit).count())));
}

std::optional<std::chrono::seconds> AttemptLimits::begin(const std::string& user,
                                                         const std::string& address,
                                                         SteadyTime now) {
  const std::lock_guard lock(mutex_);
  Level& of_user = level_of(users_, user, options_.of_user, now);
  Level& from_address = level_of(addresses_, address, options_.from_address, now);
  const auto user_wait = wait_for(of_user, options_.of_user);
  const auto address_wait = wait_for(from_address, options_.from_address);
  if (user_wait || address_wait) return std::max(user_wait, address_wait);
  of_user.attempts += 1;
  from_address.attempts += 1;
  return std::nullopt;
}

void AttemptLimits::succeed(const std::string& user, const std::string& address) {
  give_back(user, address);
  const std::lock_guard lock(mutex_);
  users_.erase(user);
}

void AttemptLimits::give_back(const std::string& user, const std::string& address) {
  const std::lock_guard lock(mutex_);
  for (auto& [levels, key] : {std::pair(&users_, &user), std::pair(&addresses_, &address)}) {
    const auto found = levels->find(*key);
    if (found == levels->end()) continue;
    found->second.attempts = std::max(0.0, found->second.attempts - 1);
  }
}

}  // namespace dripline::identity
