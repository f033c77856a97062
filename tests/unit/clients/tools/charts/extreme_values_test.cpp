#include <gtest/gtest.h>
#include <cmath>
#include <limits>
#include <string>

#include "clients/tools/charts/measurement_chart.hpp"
#include "clients/tools/charts/svg_canvas.hpp"
#include "tests/support/svg_check.hpp"

namespace dripline::charts {
namespace {

constexpr const char* kKinds[]{"individuals", "xbar-r",    "xbar-s", "ewma",
                               "cusum",       "histogram", "trend"};

std::vector<measurement::Measurement> measured(const std::vector<double>& values) {
  std::vector<measurement::Measurement> all;
  for (const double value : values) {
    auto& one = all.emplace_back();
    one.characteristic = {"D12", 40.0, 39.98, 40.02, "mm", 3};
    one.machine = "lathe-1";
    one.actual = value;
  }
  return all;
}

Result<std::string> drawn(const std::vector<measurement::Measurement>& all, const char* kind) {
  return measurements_svg(all, parse_chart_request({{"kind", kind}}).value());
}

struct ValuesCase {
  const char* name;
  std::vector<double> values;
};
class Drawable : public testing::TestWithParam<ValuesCase> {};

// What varies less than a double can tell may be refused with a reason; it never becomes a picture
// with numbers that are none.
TEST_P(Drawable, BecomesAPictureThatCanBeReadInEveryKind) {
  for (const char* kind : kKinds) {
    for (const bool has_limits : {true, false}) {
      auto all = measured(GetParam().values);
      if (!has_limits) {
        for (auto& one : all) one.characteristic = {"D12", {}, {}, {}, "mm", 3};
      }
      const auto svg = drawn(all, kind);
      if (svg) {
        EXPECT_EQ(test::SvgCheck::fault_of(*svg), "") << kind;
      } else {
        EXPECT_FALSE(svg.error().what.empty()) << kind;
        EXPECT_STRNE(kind, "histogram") << svg.error().what;
        EXPECT_STRNE(kind, "trend") << svg.error().what;
      }
    }
  }
}
INSTANTIATE_TEST_SUITE_P(
    , Drawable,
    testing::Values(
        ValuesCase{"smallest", {1e-308, 2e-308, 5e-324, 0, 1e-308, 3e-308, 1e-308, 0, 2e-308, 0}},
        ValuesCase{"equal_and_small", std::vector<double>(10, 1e-308)},
        ValuesCase{"both_signs", {1e15, -1e15, 1e15, -1e15, 0, 0, 1e15, -1e15, 1, 1e-300}},
        ValuesCase{"next_to_each_other",
                   {9e14, 9e14 + 0.125, 9e14, 9e14 + 0.25, 9e14, 9e14, 9e14, 9e14, 9e14, 9e14}},
        ValuesCase{"one_bit_apart",
                   {1, std::nextafter(1.0, 2.0), 1, 1, 1, 1, std::nextafter(1.0, 2.0), 1, 1, 1}},
        ValuesCase{"far_apart", {1e-12, 1e12, 1e-9, 1e9, 1e-6, 1e6, 1e-3, 1e3, 1, 40}},
        ValuesCase{"one_outlier", {40, 40, 40, 40, 40, 40, 40, 40, 40, 1e14}},
        ValuesCase{"one", {40}}),
    [](const auto& i) { return std::string{i.param.name}; });

TEST(ExtremeValues, AreRefusedByNameBeforeAnythingIsDrawn) {
  for (const double value : {1e308, -1e308, 1e16, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
    for (const char* kind : kKinds) {
      std::vector<double> values(10, 40.0);
      values[3] = value;
      const auto refused = drawn(measured(values), kind);
      ASSERT_FALSE(refused) << kind << " " << value;
      EXPECT_NE(refused.error().what.find("D12 4 of 10: value is "), std::string::npos)
          << refused.error().what;
    }
  }
  auto all = measured(std::vector<double>(10, 40.0));
  all[9].characteristic.upper = 1e308;
  const auto refused = drawn(all, "trend");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().what,
            "D12 10 of 10: upper limit is 1e+308: a picture has numbers from -1e+15 to 1e+15");
  EXPECT_FALSE(parse_chart_request({{"center", "1e300"}}));
}

ProfilePicture profile(std::vector<ContourPoint> nominal, std::vector<ContourPoint> actual) {
  ProfilePicture picture;
  picture.nominal = std::move(nominal);
  picture.actual = std::move(actual);
  return picture;
}

TEST(ExtremeValues, OfAProfileAreRefusedOrDrawn) {
  const auto draw = [](const ProfilePicture& picture) -> std::string {
    SvgCanvas canvas(800, 500, "p");
    if (const auto drawn = draw_profile(canvas, picture, {"p", "", "mm"}); !drawn)
      return drawn.error().what;
    return test::SvgCheck::fault_of(std::move(canvas).finish());
  };
  const ProfilePicture plain = profile({{0, 0}, {10, 0}}, {{1, 0.1}, {5, -0.1}});
  EXPECT_EQ(draw(plain), "");
  EXPECT_EQ(draw(profile({{0, 0}, {1e-300, 0}}, {{0, 0}, {1e-300, 1e-300}})), "");
  EXPECT_EQ(draw(profile({{-1e15, 0}, {1e15, 1e-9}}, {{0, 1e15}, {5, 1e-300}})), "");
  EXPECT_EQ(draw(profile({{0, 0}, {1, 0}}, {{0, 0}})), "");
  EXPECT_EQ(draw(profile({{0, 0}, {1, 0}}, {{0, 0}, {1e308, 0}})),
            "actual point 2 is 1e+308: a picture has numbers from -1e+15 to 1e+15");
  ProfilePicture magnified = plain;
  magnified.magnification = 1e300;
  EXPECT_EQ(draw(magnified), "deviations magnified 1e+300 times: above 0, at most 1e+09");
  ProfilePicture limited = plain;
  limited.lower = -1e200;
  EXPECT_EQ(draw(limited),
            "the lower limit is -1e+200: a picture has numbers from -1e+15 to 1e+15");
}

}  // namespace
}  // namespace dripline::charts
