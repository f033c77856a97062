#include "protocol/base/rate_limit.hpp"

#include <gtest/gtest.h>

namespace dripline {
namespace {

TEST(RateLimit, LetsABurstPassAndCountsTheRest) {
  RateLimit limit(2, std::chrono::seconds(10));
  const RateLimit::Time start{};
  EXPECT_EQ(limit.pass(start), 0u);
  EXPECT_EQ(limit.pass(start), 0u);
  EXPECT_EQ(limit.pass(start), std::nullopt);
  EXPECT_EQ(limit.pass(start + std::chrono::seconds(9)), std::nullopt);
  EXPECT_EQ(limit.pass(start + std::chrono::seconds(10)), 2u);
  EXPECT_EQ(limit.pass(start + std::chrono::seconds(10)), 0u);
}

}  // namespace
}  // namespace dripline
