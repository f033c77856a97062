#include "clients/cli/text/value_text.hpp"

#include <gtest/gtest.h>
#include <cstdlib>
#include <ctime>

namespace dripline::cli {
namespace {

TEST(BytesText, UsesSiUnits) {
  EXPECT_EQ(bytes_text(0), "0 B");
  EXPECT_EQ(bytes_text(999), "999 B");
  EXPECT_EQ(bytes_text(1000), "1.0 kB");
  EXPECT_EQ(bytes_text(999'960), "1.0 MB");
  EXPECT_EQ(bytes_text(1ull << 30), "1.07 GB");
  EXPECT_EQ(bytes_text(5'000'000'000'000'000), "5000.00 TB");
}

TEST(DurationText, RoundsDown) {
  EXPECT_EQ(duration_text(-1), "0:00");
  EXPECT_EQ(duration_text(7.9), "0:07");
  EXPECT_EQ(duration_text(754), "12:34");
  EXPECT_EQ(duration_text(3723), "1:02:03");
}

TEST(TimeText, ShowsLocalTime) {
  ::setenv("TZ", "CET-1", 1);
  ::tzset();
  EXPECT_EQ(time_text("2026-11-21T07:40:06.123456Z"), "2026-11-21 08:40:06");
  EXPECT_EQ(time_text("yesterday"), "yesterday");
  EXPECT_EQ(time_text(""), "");
}

TEST(SecondsBetween, CountsFractions) {
  EXPECT_DOUBLE_EQ(seconds_between("2026-11-21T07:40:06.5Z", "2026-11-21T07:41:06.75Z"), 60.25);
  EXPECT_EQ(seconds_between("", "2026-11-21T07:41:06Z"), 0);
}

}  // namespace
}  // namespace dripline::cli
