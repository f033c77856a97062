#pragma once

#include <map>
#include <string>
#include <utility>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"
#include "protocol/dds/message.hpp"

namespace dripline::machines {

/// A command may wait in the server, as for its audit entry while the store is away, and one that
/// stops does not. So what was given before a stop may come after it: that must not move
/// the machine any more. Not synchronized: a command is checked, and goes out, under the lock
/// under which a stop is noted and goes out.
class StopOrder {
 public:
  /// Who gave a command expects it now, and has walked on when a store that hung answers.
  static constexpr std::chrono::seconds kMaxWait{10};

  /// A stop: hold, abort, emergency stop; or an override that is lowered to `value`, which stops
  /// only the earlier ones of its kind.
  void note(const std::string& machine, dds::CommandAction action, SteadyTime given,
            double value = 0);
  /// Errors: Conflict (a stop was given later).
  Result<void> check(const std::string& machine, dds::CommandAction action, SteadyTime given) const;
  /// Of an override that is lowered. Errors: Conflict (a later one has lowered it further).
  Result<void> check_lowered(const std::string& machine, dds::CommandAction action,
                             SteadyTime given, double value) const;

 private:
  using Key = std::pair<std::string, dds::CommandAction>;
  struct Stop {
    SteadyTime given{};
    double value = 0;  ///< of an override
  };
  static Key key(const std::string& machine, dds::CommandAction action);
  /// The last one, if it was given after that.
  const Stop* later(const Key& key, SteadyTime given) const;
  std::map<Key, Stop> last_;
};

/// Errors: Busy (`given` is longer ago than `limit`).
Result<void> check_age(const std::string& machine, dds::CommandAction action, SteadyTime given,
                       SteadyTime now, std::chrono::milliseconds limit = StopOrder::kMaxWait);

}  // namespace dripline::machines
