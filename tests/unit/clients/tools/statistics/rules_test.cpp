#include "clients/tools/statistics/rules.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <string>
#include <vector>

namespace dripline::statistics {
namespace {

struct RuleCase {
  const char* name;
  RuleSet set;
  int rule;
  std::vector<double> matching;  ///< the last point completes the pattern, in sigma
  std::vector<double> almost;    ///< one step less of it
};
class Rules : public testing::TestWithParam<RuleCase> {};

bool completes(const RuleCase& of, const std::vector<double>& points) {
  // Another center and sigma than 0 and 1, which would hide a mix-up.
  std::vector<double> scaled(points);
  for (double& point : scaled) point = 40 + 0.02 * point;
  const auto found = find_violations(scaled, 40, 0.02, of.set);
  return std::ranges::any_of(found, [&](const Violation& violation) {
    return violation.rule == of.rule && violation.point + 1 == points.size();
  });
}
std::vector<double> mirrored(std::vector<double> points) {
  for (double& point : points) point = -point;
  return points;
}

TEST_P(Rules, FindItsPatternOnBothSidesAndNotLess) {
  const RuleCase& of = GetParam();
  EXPECT_TRUE(completes(of, of.matching));
  EXPECT_TRUE(completes(of, mirrored(of.matching)));
  EXPECT_FALSE(completes(of, of.almost));
  EXPECT_FALSE(completes(of, mirrored(of.almost)));
}

constexpr auto kWe = RuleSet::WesternElectric;
constexpr auto kNelson = RuleSet::Nelson;
INSTANTIATE_TEST_SUITE_P(
    , Rules,
    testing::Values(
        RuleCase{"WesternElectric1", kWe, 1, {0, 3.01}, {0, 2.99}},
        RuleCase{"WesternElectric2", kWe, 2, {2.1, 0, 2.1}, {2.1, 0, 0, 2.1}},
        RuleCase{"WesternElectric2OneSide", kWe, 2, {0, 2.1, 2.1}, {0, -2.1, 2.1}},
        RuleCase{"WesternElectric3", kWe, 3, {1.1, 1.1, 0, 1.1, 1.1}, {1.1, 1.1, 0, 0.9, 1.1}},
        RuleCase{"WesternElectric4", kWe, 4, {1, 1, 1, 1, 1, 1, 1, 0.1}, {1, 1, 1, 1, 1, 1, 0.1}},
        RuleCase{"Nelson1", kNelson, 1, {3.01}, {2.99}},
        RuleCase{"Nelson2",
                 kNelson,
                 2,
                 {.1, .1, .1, .1, .1, .1, .1, .1, .1},
                 {0, .1, .1, .1, .1, .1, .1, .1, .1}},
        RuleCase{"Nelson3", kNelson, 3, {-2, -1, 0, .1, .2, .3}, {-1, -1, 0, .1, .2, .3}},
        RuleCase{"Nelson4",
                 kNelson,
                 4,
                 {0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1},
                 {1, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1}},
        RuleCase{"Nelson5", kNelson, 5, {2.1, 2.1}, {2.1, 1.9}},
        RuleCase{"Nelson6", kNelson, 6, {0, 1.1, 1.1, 1.1, 1.1}, {1.1, 0, 1.1, -1.1, 1.1}},
        RuleCase{"Nelson7",
                 kNelson,
                 7,
                 {.9, -.9, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, .9},
                 {1, -.9, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, .9}},
        RuleCase{"Nelson8",
                 kNelson,
                 8,
                 {1.1, -1.1, 1.1, -1.1, 1.1, -1.1, 1.1, -1.1},
                 {1, -1.1, 1.1, -1.1, 1.1, -1.1, 1.1, -1.1}}),
    [](const auto& i) { return std::string{i.param.name}; });

TEST(RuleTexts, NameThePointAndWhatItMeans) {
  const std::vector<double> points{0, 0.5, 3.5};
  const auto found = find_violations(points, 0, 1, RuleSet::Nelson);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].point, 2U);
  EXPECT_EQ(describe(found[0]), "Nelson 1: a point beyond three sigma");
  EXPECT_EQ(parse_rule_set("nelson").value(), RuleSet::Nelson);
  EXPECT_FALSE(parse_rule_set("nelsen"));
  EXPECT_TRUE(find_violations(points, 0, 0, RuleSet::Nelson).empty());
}

}  // namespace
}  // namespace dripline::statistics
