#include "storage/backup/retention.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace dripline::backup {
namespace {

using std::chrono::days;

const UtcTime kStart{days(20'000)};

TEST(BackupRetention, KeepsTheNewestHoweverOldItIs) {
  const std::vector<UtcTime> made{kStart, kStart + days(1)};
  EXPECT_EQ(expired(made, {}, kStart + days(5000)), std::set{kStart});
  EXPECT_TRUE(expired({}, {}, kStart).empty());
}

/// A backup a day for two years, and each day what has had its time goes: as a server does it.
TEST(BackupRetention, LeavesEveryDayThenEveryWeek) {
  std::vector<UtcTime> kept;
  UtcTime now = kStart;
  for (int day = 0; day < 730; ++day, now += days(1)) {
    kept.push_back(now);
    const auto out = expired(kept, {.every = days(14), .weekly = std::chrono::weeks(26)}, now);
    std::erase_if(kept, [&](UtcTime time) { return out.contains(time); });
  }
  const UtcTime last = now - days(1);
  int young = 0, old = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const auto age = last - kept[i];
    EXPECT_LE(age, days(26 * 7));
    (age <= days(14) ? young : old)++;
    if (i > 0 && age > days(14)) {
      EXPECT_EQ(kept[i] - kept[i - 1], days(7));
    }
  }
  EXPECT_EQ(young, 15);
  EXPECT_GE(old, 23);
}

TEST(BackupRetention, LeavesBackupsOfTheFuture) {
  const std::vector<UtcTime> made{kStart, kStart + days(300), kStart + days(301)};
  EXPECT_TRUE(expired(made, {}, kStart + days(1)).empty());
}

}  // namespace
}  // namespace dripline::backup
