#include "protocol/serial/impl/command_queue.hpp"

#include <gtest/gtest.h>

namespace dripline::serial {
namespace {

using namespace std::chrono_literals;
constexpr wire::LineTime kT = 1000us;

TEST(Pacer, GivesTwoCharactersToAnIdleDriver) {
  const Pacer pacer(kT);
  EXPECT_EQ(pacer.allowance(0us, std::nullopt), 2U);
  EXPECT_EQ(pacer.next(0us, std::nullopt), 0us);
}

TEST(Pacer, GivesTheNextWhenOneHasLeft) {
  Pacer pacer(kT);
  pacer.handed_over(2, 0us);
  EXPECT_EQ(pacer.allowance(999us, std::nullopt), 0U);
  EXPECT_EQ(pacer.next(0us, std::nullopt), kT);
  EXPECT_EQ(pacer.allowance(kT, std::nullopt), 1U);
  pacer.handed_over(1, kT);
  EXPECT_EQ(pacer.allowance(kT, std::nullopt), 0U);
  EXPECT_EQ(pacer.next(kT, std::nullopt), 2 * kT);
}

TEST(Pacer, KeepsTheRateWhenItsOwnerIsLateByLessThanACharacter) {
  Pacer pacer(kT);
  pacer.handed_over(2, 0us);
  wire::LineTime now = 0us;
  for (int character = 0; character < 1000; ++character) {
    now = pacer.next(now, std::nullopt) + 900us;
    const std::size_t count = pacer.allowance(now, std::nullopt);
    ASSERT_GE(count, 1U);
    pacer.handed_over(count, now);
  }
  EXPECT_LT(now, 1002 * kT);
}

TEST(Pacer, NeverCatchesUpWhatTheLineCannot) {
  Pacer pacer(kT);
  pacer.handed_over(2, 0us);
  EXPECT_EQ(pacer.allowance(50 * kT, std::nullopt), 2U);
}

TEST(Pacer, BelievesADriverThatHasMore) {
  Pacer pacer(kT);
  pacer.handed_over(2, 0us);
  EXPECT_EQ(pacer.allowance(2 * kT, 2U), 0U);
  EXPECT_EQ(pacer.next(2 * kT, 2U), 3 * kT);
  EXPECT_EQ(pacer.allowance(2 * kT, 1U), 1U);
}

TEST(Pacer, DoesNotBelieveADriverThatHasLess) {
  Pacer pacer(kT);
  pacer.handed_over(2, 0us);
  EXPECT_EQ(pacer.allowance(10us, 0U), 0U);
}

}  // namespace
}  // namespace dripline::serial
