#include "protocol/base/units.hpp"

#include <gtest/gtest.h>
#include <type_traits>

#include "protocol/base/clock.hpp"

namespace dripline {
namespace {

static_assert(!std::is_convertible_v<double, Length> && !std::is_convertible_v<Length, double>);
static_assert(!std::is_convertible_v<Length, Angle>);

TEST(Length, AnInchIsExactly25Point4Millimeters) {
  EXPECT_EQ(Length::inch(1), Length::mm(25.4));
  EXPECT_DOUBLE_EQ((Length::inch(0.1) + Length::mm(2)).mm(), 4.54);
}

TEST(Angle, ConvertsToRadians) {
  EXPECT_DOUBLE_EQ(Angle::degrees(180).radians(), Angle::kPi);
}

TEST(Feed, KeepsItsMeaningApart) {
  EXPECT_NE(Feed::per_minute(Length::mm(1)), Feed::per_revolution(Length::mm(1)));
  EXPECT_EQ(Feed::inverse_time(2).moves_per_minute(), 2);
}

TEST(Iso8601, PrintsMicrosecondsInUtc) {
  EXPECT_EQ(to_iso8601(UtcTime{std::chrono::microseconds{1'500'000}}),
            "1970-01-01T00:00:01.500000Z");
}

}  // namespace
}  // namespace dripline
