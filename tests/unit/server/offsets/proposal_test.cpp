#include "server/offsets/proposal.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace dripline::offsets {
namespace {

OffsetRule rule() {
  OffsetRule of;
  of.name = "D40";
  of.characteristic = "D40";
  of.target = "T3.wear.X";
  of.scale = 0.5;
  of.gain = 0.8;
  of.dead_band = 0.003;
  of.max_step = 0.01;
  of.min_count = 3;
  return of;
}

std::vector<Deviation> deviations(const std::vector<double>& values) {
  std::vector<Deviation> all;
  std::uint64_t id = 100;
  for (const double value : values) all.push_back({++id, value});
  return all;
}

bool says(const Outcome& outcome, const std::string& words) {
  for (const auto& reason : outcome.reasons) {
    if (reason.find(words) != std::string::npos) return true;
  }
  return false;
}

TEST(Proposal, StepIsGainTimesScaleTimesMean) {
  const auto outcome = propose(deviations({0.009, 0.010, 0.011}), 0.1, rule());
  ASSERT_TRUE(outcome.new_value);
  EXPECT_DOUBLE_EQ(*outcome.new_value, 0.096);  // 0.1 - 0.8 * 0.5 * 0.01
  EXPECT_EQ(outcome.used, 3U);
  EXPECT_EQ(outcome.first, 101U);
  EXPECT_EQ(outcome.last, 103U);
  EXPECT_NEAR(outcome.mean, 0.01, 1e-12);
  EXPECT_FALSE(outcome.is_within_policy);
  EXPECT_TRUE(says(outcome, "mean deviation +0.01 of 3 measurements"));
  EXPECT_TRUE(says(outcome, "0.1000 becomes 0.0960"));
}

TEST(Proposal, OneDeviationTooFewProposesNothing) {
  const auto outcome = propose(deviations({0.02, 0.02}), 0, rule());
  EXPECT_FALSE(outcome.new_value);
  EXPECT_TRUE(says(outcome, "2 measurements under the value in force, 3 are needed"));
}

TEST(Proposal, DeadBandIsLeftAlone) {
  const auto outcome = propose(deviations({0.002, 0.003, 0.0025}), 0, rule());
  EXPECT_FALSE(outcome.new_value);
  EXPECT_TRUE(says(outcome, "within the dead band of 0.003"));
}

TEST(Proposal, LargestStepLimitsBothWays) {
  EXPECT_DOUBLE_EQ(*propose(deviations({0.2, 0.2, 0.2}), 0, rule()).new_value, -0.01);
  const auto outcome = propose(deviations({-0.2, -0.2, -0.2}), 0, rule());
  EXPECT_DOUBLE_EQ(*outcome.new_value, 0.01);
  EXPECT_TRUE(says(outcome, "limited to the largest step, 0.01"));
}

TEST(Proposal, OutliersAreLeftOutAndCounted) {
  const auto outcome = propose(deviations({0.010, 0.011, 0.5, 0.009, 0.010}), 0, rule());
  ASSERT_TRUE(outcome.new_value);
  EXPECT_EQ(outcome.left_out, 1U);
  EXPECT_EQ(outcome.used, 4U);
  EXPECT_NEAR(outcome.mean, 0.01, 1e-9);
  // What is left must still be enough.
  auto strict = rule();
  strict.min_count = 5;
  EXPECT_FALSE(propose(deviations({0.010, 0.011, 0.5, 0.009, 0.010}), 0, strict).new_value);
}

TEST(Proposal, EqualDeviationsAreNoOutliersOfEachOther) {
  const auto outcome = propose(deviations({0.01, 0.01, 0.01, 0.0101}), 0, rule());
  EXPECT_EQ(outcome.left_out, 0U);
  EXPECT_TRUE(outcome.new_value);
}

TEST(Proposal, WindowTakesTheNewest) {
  auto of = rule();
  of.window = 3;
  const auto outcome = propose(deviations({5, 5, 5, 0.01, 0.01, 0.01}), 0, of);
  EXPECT_NEAR(outcome.mean, 0.01, 1e-12);
  EXPECT_EQ(outcome.first, 104U);
}

TEST(Proposal, BoundsAskForAPerson) {
  auto of = rule();
  of.lowest = -0.005;
  const auto outcome = propose(deviations({0.02, 0.02, 0.02}), 0, of);
  EXPECT_FALSE(outcome.new_value);
  EXPECT_TRUE(says(outcome, "would leave the bounds"));
}

/// A value by hand may have more digits than the rule writes.
TEST(Proposal, RoundingGoesNotBeyondTheLargestStep) {
  OffsetRule of = rule();
  of.decimals = 2;
  of.max_step = 0.015;
  const auto down = propose(deviations({0.5, 0.5, 0.5}), 0.0166, of);  // 0.0016 is 0.00
  ASSERT_TRUE(down.new_value);
  EXPECT_DOUBLE_EQ(*down.new_value, 0.01);
  EXPECT_TRUE(says(down, "becomes 0.01"));
  of.max_step = 0.01;
  EXPECT_FALSE(propose(deviations({-0.5, -0.5, -0.5}), 0.0166, of).new_value) << "0.03 is too far";
  of.max_step = 0.002;
  EXPECT_FALSE(propose(deviations({-0.5, -0.5, -0.5}), 0.0166, of).new_value) << "0.02 is its own";
}

/// 0.1 - 0.09 is a little more than 0.01 in binary.
TEST(Proposal, PolicyAllowsAStepOfExactlyItsLimit) {
  for (const double step : {0.01, 0.02}) {
    OffsetRule of = rule();
    of.max_step = of.automatic = step;
    for (int hundredths = -30; hundredths <= 30; ++hundredths) {
      const double value = hundredths / 100.0;
      for (const double off : {step / 0.4, -step / 0.4}) {
        const auto outcome = propose(deviations({off, off, off}), value, of);
        EXPECT_TRUE(outcome.is_within_policy) << value << " by " << step;
      }
    }
    of.automatic = step - 0.0001;
    const double off = step / 0.4;
    EXPECT_FALSE(propose(deviations({off, off, off}), 0.1, of).is_within_policy);
  }
}

/// A misprint of 99999 is limited to a small step in the wrong direction.
TEST(Proposal, AStepThatHadToBeLimitedIsForAPerson) {
  OffsetRule of = rule();
  of.automatic = of.max_step;
  of.outlier = 0;
  const auto outcome = propose(deviations({0.0, 0.0, 99999.0}), 0, of);
  ASSERT_TRUE(outcome.new_value);
  EXPECT_DOUBLE_EQ(*outcome.new_value, -0.01);
  EXPECT_FALSE(outcome.is_within_policy);
  EXPECT_TRUE(says(outcome, "limited to the largest step, 0.01: so a person decides"));
}

TEST(Proposal, PolicyAllowsSmallSteps) {
  auto of = rule();
  of.automatic = 0.004;
  EXPECT_TRUE(propose(deviations({0.009, 0.009, 0.009}), 0, of).is_within_policy);
  EXPECT_FALSE(propose(deviations({0.02, 0.02, 0.02}), 0, of).is_within_policy);
}

TEST(Proposal, AChangeBelowTheLastDigitIsNone) {
  auto of = rule();
  of.decimals = 2;
  const auto outcome = propose(deviations({0.006, 0.006, 0.006}), 0.1, of);
  EXPECT_FALSE(outcome.new_value);
  EXPECT_TRUE(says(outcome, "changes no digit of 0.10"));
}

TEST(Proposal, WhatIsNotFiniteIsLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(propose(deviations({nan, 0.01, 0.01}), 0, rule()).new_value);
  EXPECT_FALSE(propose({}, 0, rule()).new_value);
}

}  // namespace
}  // namespace dripline::offsets
