#include "protocol/measurement/measurement.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace dripline::measurement {
namespace {

const Characteristic kBore{.name = "bore", .nominal = 40, .lower = 39.98, .upper = 40 + 0.02};

struct JudgeCase {
  std::string name;
  double actual;
  ReworkSide rework;
  Verdict expected;
};
class Judge : public testing::TestWithParam<JudgeCase> {};

TEST_P(Judge, ComparesWithTheLimits) {
  EXPECT_EQ(judge(kBore, GetParam().actual, GetParam().rework), GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    , Judge,
    testing::Values(JudgeCase{"nominal", 40, ReworkSide::None, Verdict::Good},
                    JudgeCase{"at_the_upper_limit", 40.02, ReworkSide::None, Verdict::Good},
                    JudgeCase{"at_the_lower_limit", 39.98, ReworkSide::None, Verdict::Good},
                    JudgeCase{"above", 40.021, ReworkSide::None, Verdict::Scrap},
                    JudgeCase{"too_small_can_be_bored", 39.979, ReworkSide::Below, Verdict::Rework},
                    JudgeCase{"too_large_cannot", 40.021, ReworkSide::Below, Verdict::Scrap},
                    JudgeCase{"too_large_shaft", 40.021, ReworkSide::Above, Verdict::Rework},
                    JudgeCase{"too_small_shaft", 39.979, ReworkSide::Above, Verdict::Scrap},
                    JudgeCase{"both_sides", 39.979, ReworkSide::Both, Verdict::Rework},
                    JudgeCase{"not_a_number", std::numeric_limits<double>::quiet_NaN(),
                              ReworkSide::None, Verdict::Unknown}),
    [](const auto& i) { return i.param.name; });

TEST(Verdict, IsUnknownWithoutLimits) {
  EXPECT_EQ(judge({.name = "x", .nominal = 1, .lower = {}, .upper = {}}, 1, ReworkSide::None),
            Verdict::Unknown);
}

TEST(Verdict, NeedsOneLimitOnly) {
  const Characteristic flatness{.name = "flatness", .nominal = {}, .lower = {}, .upper = 0.01};
  EXPECT_EQ(judge(flatness, 0.002, ReworkSide::None), Verdict::Good);
  EXPECT_EQ(judge(flatness, 0.02, ReworkSide::None), Verdict::Scrap);
}

TEST(Verdict, HasNamesThatAreRead) {
  for (const Verdict verdict : {Verdict::Good, Verdict::Unknown, Verdict::Rework, Verdict::Scrap})
    EXPECT_EQ(parse_verdict(to_string(verdict)).value(), verdict);
  EXPECT_EQ(parse_verdict("fine").error().code, Errc::Syntax);
}

TEST(Verdict, OfAPartIsItsWorst) {
  EXPECT_EQ(worse(Verdict::Good, Verdict::Unknown), Verdict::Unknown);
  EXPECT_EQ(worse(Verdict::Rework, Verdict::Unknown), Verdict::Rework);
  EXPECT_EQ(worse(Verdict::Rework, Verdict::Scrap), Verdict::Scrap);
}

}  // namespace
}  // namespace dripline::measurement
