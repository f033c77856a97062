// When a lease is over by the watcher's own clock, whatever the database's clock says.
#include <gtest/gtest.h>

#include "storage/lease_watch.hpp"

namespace dripline::storage {
namespace {

using namespace std::chrono_literals;

class LeaseWatchTest : public testing::Test {
 protected:
  /// A look at this moment, which took no time.
  bool look(std::chrono::milliseconds at, std::int64_t until, std::uint64_t term = 7) {
    const LeaseWatch::TimePoint now{at};
    return watch_.is_over({{"srv-1", term, until}, left_, now, now});
  }
  /// Looks every 150 ms; when it is over for the first time.
  std::optional<std::chrono::milliseconds> over_from(std::chrono::milliseconds from,
                                                     std::int64_t until) {
    for (auto at = from; at < from + 120s; at += 150ms)
      if (look(at, until)) return at - from;
    return std::nullopt;
  }
  std::chrono::milliseconds left_{3000};
  LeaseWatch watch_{3s};
};

TEST_F(LeaseWatchTest, ARowThatDoesNotChangeIsOverAfterTheLeaseAndATenth) {
  EXPECT_EQ(over_from(0ms, 1), 3300ms);
}

TEST_F(LeaseWatchTest, EachRenewalBeginsTheTimeAgainWhateverTheDatabasesClockIs) {
  std::int64_t until = 1'000'000;
  for (auto at = 0ms; at < 60s; at += 150ms) {
    if (at % 2250ms == 0ms) until += at < 30s ? -3'600'000'000 : 7'200'000'000;
    left_ = at < 30s ? -1h : 1h;
    EXPECT_FALSE(look(at, until)) << at.count();
  }
}

TEST_F(LeaseWatchTest, ATermOfTheSameHolderIsAnotherLease) {
  EXPECT_FALSE(look(0ms, 1, 7));
  EXPECT_FALSE(look(1400ms, 1, 7));
  EXPECT_FALSE(look(2800ms, 1, 8));
  EXPECT_FALSE(look(4200ms, 1, 8));
}

/// A watcher that was frozen, or had no database, has not seen what its holder did.
TEST_F(LeaseWatchTest, AGapBetweenLooksBeginsTheTimeAgain) {
  EXPECT_FALSE(look(0ms, 1));
  EXPECT_FALSE(look(150ms, 1));
  EXPECT_EQ(over_from(10min, 1), 3300ms);
}

TEST_F(LeaseWatchTest, AnAnswerThatTookLongIsOfTheMomentWhenItWasAskedFor) {
  using At = LeaseWatch::TimePoint;
  EXPECT_FALSE(look(0ms, 1));
  EXPECT_FALSE(look(1400ms, 1));
  EXPECT_FALSE(look(2800ms, 1));
  EXPECT_FALSE(watch_.is_over({{"srv-1", 7, 1}, left_, At(2950ms), At(4000ms)}));
  EXPECT_TRUE(look(4150ms, 1));
}

TEST_F(LeaseWatchTest, AnotherConnectionBeginsTheTimeAgain) {
  EXPECT_FALSE(look(0ms, 1));
  EXPECT_FALSE(look(1400ms, 1));
  EXPECT_FALSE(look(2800ms, 1));
  watch_.restart();
  EXPECT_EQ(over_from(2950ms, 1), 3300ms);
}

/// Late, and not never.
TEST_F(LeaseWatchTest, AWatcherWhoseLineIsAlwaysSlowTakesOverAllTheSame) {
  using At = LeaseWatch::TimePoint;
  bool is_over = false;
  auto at = 0ms;
  for (; at < 60s && !is_over; at += 5s)
    is_over = watch_.is_over({{"srv-1", 7, 1}, left_, At(at), At(at + 4900ms)});
  EXPECT_TRUE(is_over);
}

TEST_F(LeaseWatchTest, ALongerLeaseOfTheHolderIsRespected) {
  left_ = 20s;
  EXPECT_EQ(over_from(0ms, 1), 22050ms);
}

/// Of a row that was never seen before the clock was set.
TEST_F(LeaseWatchTest, AnUntilThatIsFarAheadIsRespectedForTheLongestLease) {
  left_ = 5h;
  EXPECT_EQ(over_from(0ms, 1), 66s);
}

/// Seen before the clock was set back by an hour, and the connection was lost then.
TEST_F(LeaseWatchTest, ARowKeepsTheTimeOfItsFirstLook) {
  EXPECT_FALSE(look(0ms, 1));
  left_ = 1h;
  watch_.restart();
  EXPECT_EQ(over_from(1s, 1), 3300ms);
}

TEST_F(LeaseWatchTest, ARowWithoutAHolderIsFree) {
  EXPECT_TRUE(watch_.is_over({{"", 7, 1}, 1h, {}, {}}));
}

}  // namespace
}  // namespace dripline::storage
