#include <algorithm>

#include "tests/unit/server/offsets/offsets_fixture.hpp"

namespace dripline::offsets {
namespace {

/// Rules for one program, one tool or one report template.
class RuleScopeTest : public OffsetsTest {
 protected:
  Evaluation only_evaluation() {
    const auto looked = offsets_->look("lathe-1");
    EXPECT_TRUE(looked) << looked.error().what;
    EXPECT_EQ(looked->size(), 1U);
    return looked->front();
  }
  /// Three parts of each kind in turn, the rule's own ones with +0.02, others with +0.04.
  void measure_both(std::string& member, const std::string& other) {
    const std::string own = member;
    for (int i = 0; i < 3; ++i) {
      member = own;
      measure(40.02);
      member = other;
      measure(40.04);
    }
    member = own;
  }
  void expect_own_ones(const Evaluation& found, const std::string& left_out) {
    ASSERT_TRUE(found.proposal);
    EXPECT_EQ(found.outcome.used, 3U);
    EXPECT_NEAR(found.outcome.mean, 0.02, 1e-9);
    EXPECT_EQ(found.outcome.reasons.front(),
              "2 measurements of D40 under the value in force are left out: " + left_out);
  }
};

TEST_F(RuleScopeTest, AnotherProgramsMeasurementsNeverEnterTheWindow) {
  use_rules("program = \"O0100\"\nwindow = 3\n");
  measure_both(program_, "O0200");
  measure(40.02);
  expect_own_ones(only_evaluation(), "not of program O0100");
}

TEST_F(RuleScopeTest, NorThoseOfAnotherTool) {
  use_rules("tool = 3\nwindow = 3\n");
  measure_both(tool_, "T4");
  tool_ = "T03";
  measure(40.02);
  expect_own_ones(only_evaluation(), "not by tool T3");
}

TEST_F(RuleScopeTest, NorThoseThatAnotherTemplateRead) {
  use_rules("template = \"bore\"\nwindow = 3\n");
  measure_both(template_, "gauge");
  measure(40.02);
  expect_own_ones(only_evaluation(), "not read by template bore");
}

TEST_F(RuleScopeTest, AreTogetherAndNothingFollowsFromOthers) {
  use_rules("program = \"O0100\"\ntool = \"T7\"\n");
  for (int i = 0; i < 4; ++i) measure(40.02);
  const auto found = only_evaluation();
  EXPECT_FALSE(found.proposal);
  EXPECT_EQ(found.outcome.reasons.back(),
            "0 measurements of program O0100 by tool T7 under the value in force, 3 are needed");
}

/// What followed from all programs is not what follows from one.
TEST_F(RuleScopeTest, AProposalOfBeforeTheRuleWasLimitedIsWithdrawnAtOnce) {
  use_rules();
  for (int i = 0; i < 3; ++i) measure(40.02);
  const auto pending = only_proposal();
  use_rules("program = \"O0200\"\n");
  EXPECT_EQ(store_->offsets.find(pending.id)->state, storage::OffsetState::Superseded);
  EXPECT_FALSE(offsets_->approve({.id = pending.id, .who = "anna", .time = {}}));
  EXPECT_EQ(wear(), 0.1);
}

TEST_F(RuleScopeTest, AChangeOfItsNumbersLeavesAProposalPending) {
  use_rules();
  for (int i = 0; i < 3; ++i) measure(40.02);
  const auto pending = only_proposal();
  use_rules("automatic = 0.001\n");
  EXPECT_EQ(store_->offsets.find(pending.id)->state, storage::OffsetState::Pending);
}

}  // namespace
}  // namespace dripline::offsets
