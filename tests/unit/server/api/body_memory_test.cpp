#include "server/api/impl/body_memory.hpp"

#include <gtest/gtest.h>

namespace dripline::api {
namespace {

constexpr std::uint64_t kLimit = 1024 * 1024;

TEST(BodyMemory, ASmallBodyNeedsNone) {
  BodyMemory memory(kLimit);
  const auto one = memory.take(kLimit / 2, "anna");
  const auto other = memory.take(kLimit / 2, "ben");
  EXPECT_FALSE(memory.has(BodyMemory::kSmall + 1, "carl"));
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(memory.has(BodyMemory::kSmall, "carl"));
    const auto small = memory.take(BodyMemory::kSmall, "carl");
  }
}

TEST(BodyMemory, OneCallerHasHalfOfIt) {
  BodyMemory memory(kLimit);
  const auto first = memory.take(kLimit / 4, "anna");
  {
    const auto second = memory.take(kLimit / 4, "anna");
    EXPECT_FALSE(memory.has(kLimit / 4, "anna"));
    EXPECT_TRUE(memory.has(kLimit / 4, "ben"));
  }
  EXPECT_TRUE(memory.has(kLimit / 4, "anna"));
}

TEST(BodyMemory, TakesABodyOfMoreThanHalfByItself) {
  BodyMemory memory(kLimit);
  EXPECT_TRUE(memory.has(kLimit, "anna"));
  EXPECT_FALSE(memory.has(kLimit + 1, "anna"));
}

TEST(BodyMemory, WakesWhoWaitsWhenSomeIsReturned) {
  BodyMemory memory(kLimit);
  int woken = 0;
  const auto waiter = memory.wait([&] { ++woken; });
  {
    auto share = memory.take(kLimit, "anna");
    EXPECT_FALSE(memory.has(kLimit, "ben"));
    const auto moved = std::move(share);
  }
  EXPECT_EQ(woken, 1);
  EXPECT_TRUE(memory.has(kLimit, "ben"));
  memory.remove(waiter);
}

}  // namespace
}  // namespace dripline::api
