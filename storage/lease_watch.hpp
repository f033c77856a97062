#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace dripline::storage {

/// What in the row of a database's place changes with each taking and with each renewal.
struct LeaseRow {
  std::string holder;      ///< empty: no server has the place
  std::uint64_t term = 0;  ///< 0: of a schema without terms
  std::int64_t until = 0;  ///< of the lease, microseconds since 1970 by the database's clock
  bool operator==(const LeaseRow&) const = default;
};

/// Whether the lease of another server is over, by the watcher's own steady clock: its row was the
/// same for the lease's time and a tenth. The database's clock is not asked, because it may have
/// been set: back, and a dead server would keep the place; forward, and a server that works would
/// lose it. One thread.
///
/// A gap between two looks (a frozen watcher, a database that hung: neither could its holder renew)
/// begins the time again. A gap is half the lease, and twice as much after each gap, so that a
/// watcher on a line that is always slow is late and not kept out.
class LeaseWatch {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  struct Look {
    LeaseRow row;
    std::chrono::milliseconds left{0};  ///< until its `until`, by the database's clock
    TimePoint asked, answered;          ///< it was like this at some moment between the two
  };
  /// `lease`: the watcher's own. The holder's may be longer: `left` of the first look at a row is
  /// respected, up to kLongestLease.
  explicit LeaseWatch(std::chrono::milliseconds lease) : lease_(lease), gap_(lease / 2) {}

  /// True: it is over. A row without a holder is at once.
  bool is_over(const Look& look);
  /// The database was not reached, and neither was it by the holder: the next look is the first.
  void restart() { since_.reset(); }
  /// How long the row that was seen last is watched.
  std::chrono::milliseconds period() const { return period_; }

  static constexpr std::chrono::milliseconds kLongestLease{60'000};

 private:
  const std::chrono::milliseconds lease_;
  std::chrono::milliseconds gap_;
  std::chrono::milliseconds period_{0};
  std::optional<LeaseRow> row_;
  std::optional<TimePoint> since_;  ///< the first look of those without a gap
  TimePoint seen_{};
};

}  // namespace dripline::storage
