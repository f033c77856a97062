#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/base/clock.hpp"

namespace dripline::identity {

/// Limits how often a password may be tried, of a user and from an address; names that no user has
/// are limited like those of users. An attempt counts when it begins, so that a thousand at once
/// do not help, and is given back when the password was right. Any thread.
class AttemptLimits {
 public:
  struct Options {
    unsigned of_user = 10;       ///< within `window`
    unsigned from_address = 30;  ///< within `window`
    std::chrono::seconds window{300};
    std::size_t entries = 4096;  ///< users and addresses that are remembered, each
  };
  explicit AttemptLimits(const Options& options) : options_(options) {}

  /// nullopt: the attempt may be made. Else the time until the next one may.
  std::optional<std::chrono::seconds> begin(const std::string& user, const std::string& address,
                                            SteadyTime now);
  /// The password was right: the user's attempts are reset, the address gets this one back alone,
  /// so that one right password does not let it try others without limit.
  void succeed(const std::string& user, const std::string& address);
  /// The password was not looked at.
  void give_back(const std::string& user, const std::string& address);

 private:
  /// Attempts that have not expired; each takes window / limit to do so.
  struct Level {
    double attempts = 0;
    SteadyTime at;
  };
  using Levels = std::map<std::string, Level>;
  Level& level_of(Levels& levels, const std::string& key, unsigned limit, SteadyTime now);
  std::optional<std::chrono::seconds> wait_for(const Level& level, unsigned limit) const;
  double drained(const Level& level, unsigned limit, SteadyTime now) const;

  const Options options_;
  std::mutex mutex_;
  Levels users_, addresses_;
};

}  // namespace dripline::identity
