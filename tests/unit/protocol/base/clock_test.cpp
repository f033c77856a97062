#include <gtest/gtest.h>

#include "protocol/base/clock.hpp"

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

UtcTime at(std::int64_t microseconds) {
  return UtcTime{std::chrono::microseconds{microseconds}};
}

TEST(ToIso8601, ShowsMicrosecondsOfUtc) {
  EXPECT_EQ(to_iso8601(at(0)), "1970-01-01T00:00:00.000000Z");
  EXPECT_EQ(to_iso8601(at(1'700'000'000'000'001)), "2023-11-14T22:13:20.000001Z");
  EXPECT_EQ(to_iso8601(at(-1)), "1969-12-31T23:59:59.999999Z");
  EXPECT_EQ(to_iso8601(at(951'827'696'000'123)), "2000-02-29T12:34:56.000123Z");
  EXPECT_EQ(to_iso8601(at(-2'203'891'200'000'000)), "1900-03-01T00:00:00.000000Z");
}

TEST(ToIso8601, TakesEveryTimeThatAMessageCanHold) {
  EXPECT_EQ(to_iso8601(at(253'402'300'799'999'999)), "9999-12-31T23:59:59.999999Z");
  EXPECT_EQ(to_iso8601(at(253'402'300'800'000'000)), "10000-01-01T00:00:00.000000Z");
  EXPECT_EQ(to_iso8601(at(-30'610'224'000'000'000)), "1000-01-01T00:00:00.000000Z");
  EXPECT_EQ(to_iso8601(at(INT64_MAX)), "294247-01-10T04:00:54.775807Z");
  EXPECT_TRUE(to_iso8601(at(INT64_MIN)).ends_with("-12-21T19:59:05.224192Z"));
}

}  // namespace

}  // namespace dripline
