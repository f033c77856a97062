// When a server that hears no gateway hands over, and when it stays.
#include "server/app/impl/cut_off_rule.hpp"

#include <gtest/gtest.h>

namespace dripline::app {
namespace {

using namespace std::chrono_literals;
using Step = CutOffRule::Step;

/// Two servers as the rule of the active one sees them, looked at four times a second.
class CutOffRuleTest : public testing::Test {
 protected:
  void begin(storage::OwnHandOvers before = {}, std::chrono::milliseconds silence = 4s) {
    began_ = now_;
    rule_.emplace(
        CutOffRule::Options{.silence = silence, .lease = 2s, .before = before, .began = now_});
  }
  /// The row of the standby has changed since the last look, unless it is frozen.
  CutOffRule::Judgment look() {
    now_ += 250ms;
    if (!is_frozen_) row_.seen += 1s;
    rule_->note(is_gone_ ? std::vector<storage::WaitingServer>{} : std::vector{row_}, now_);
    return rule_->judge({.now = now_, .heard = heard_, .is_machine_known = is_known_});
  }
  /// The first step that is not Nothing within this time, and after how long.
  std::pair<Step, std::chrono::milliseconds> step_within(std::chrono::milliseconds limit) {
    const SteadyTime from = now_;
    while (now_ - from < limit) {
      last_ = look();
      if (last_.step != Step::Nothing)
        return {last_.step, std::chrono::duration_cast<std::chrono::milliseconds>(now_ - from)};
    }
    return {Step::Nothing, limit};
  }
  void expect_it_stays(const std::string& why) {
    EXPECT_EQ(step_within(1h).first, Step::Nothing);
    EXPECT_NE(last_.reason.find(why), std::string::npos) << last_.reason;
    EXPECT_FALSE(last_.finding.empty());
  }
  void hear_for(std::chrono::milliseconds time) {
    heard_ = 3;
    EXPECT_EQ(step_within(time).first, Step::Nothing);
    heard_ = 0;
  }

  SteadyTime now_{std::chrono::hours(1)}, began_;
  storage::WaitingServer row_{.described = "dncd 7 on srv-2", .seen = {}, .gateways = 3};
  std::size_t heard_ = 0;
  bool is_known_ = true, is_frozen_ = false, is_gone_ = false;
  std::optional<CutOffRule> rule_;
  CutOffRule::Judgment last_;
};

TEST_F(CutOffRuleTest, HandsOverWhenItHearsNoneAndAServerThatWaitsDoes) {
  begin();
  hear_for(60s);
  const auto [step, after] = step_within(1min);
  EXPECT_EQ(step, Step::HandOver);
  EXPECT_EQ(after, 2250ms) << "a gateway that is not heard was silent for the lease of 2 s before";
  EXPECT_EQ(rule_->after_hand_over(), (storage::OwnHandOvers{1, false}));
}

TEST_F(CutOffRuleTest, StaysWhenTheMachinesAreSwitchedOff) {
  begin();
  hear_for(60s);
  row_.gateways = 0;
  EXPECT_EQ(step_within(1h).first, Step::Nothing);
  EXPECT_EQ(last_.finding, "") << "a shop at night is in order";
}

/// Forged announcements at the standby change nothing while one gateway is heard here.
TEST_F(CutOffRuleTest, StaysWhileItHearsOneAndSaysThatOthersAreHeardElsewhere) {
  begin();
  heard_ = 1;
  row_.gateways = 4096;
  EXPECT_EQ(step_within(1h).first, Step::Nothing);
  EXPECT_NE(last_.finding.find("hears 1 gateways, and one that waits hears 4096"),
            std::string::npos)
      << last_.finding;
  heard_ = 4096;
  look();
  EXPECT_EQ(look().finding, "");
}

TEST_F(CutOffRuleTest, APartOfTheGatewaysThatIsLateIsNoFinding) {
  begin();
  heard_ = 2;
  for (auto time = 0ms; time < 9s; time += 250ms) EXPECT_EQ(look().finding, "");
}

TEST_F(CutOffRuleTest, AShortSilenceIsNone) {
  begin();
  for (int i = 0; i < 20; ++i) {
    hear_for(10s);
    EXPECT_EQ(step_within(1500ms).first, Step::Nothing);
  }
}

TEST_F(CutOffRuleTest, AStandbyThatDoesNotLookAnyMoreIsNotHandedItHoweverManyItHeard) {
  begin();
  hear_for(60s);
  is_frozen_ = true;
  EXPECT_EQ(step_within(2s).first, Step::Nothing);
  EXPECT_EQ(step_within(1h).first, Step::Nothing);
  is_gone_ = true;
  EXPECT_EQ(step_within(1h).first, Step::Nothing);
}

TEST_F(CutOffRuleTest, ARowThatWasThereBeforeProvesNothingUntilItChanges) {
  begin();
  is_gone_ = true;
  hear_for(60s);
  step_within(10s);
  is_gone_ = false;
  is_frozen_ = true;
  EXPECT_EQ(step_within(1min).first, Step::Nothing);
  is_frozen_ = false;
  EXPECT_EQ(step_within(1min).first, Step::HandOver);
}

TEST_F(CutOffRuleTest, AServerThatHasJustBegunGivesGatewaysTenSeconds) {
  begin();
  const auto [step, after] = step_within(1min);
  EXPECT_EQ(step, Step::HandOver);
  EXPECT_EQ(after, CutOffRule::kFirstSilence);
}

TEST_F(CutOffRuleTest, ALibraryWithoutMachinesExpectsNone) {
  is_known_ = false;
  begin();
  expect_it_stays("no machine of this library");
  hear_for(1s);
  EXPECT_EQ(step_within(1min).first, Step::HandOver) << "what it has heard it may expect";
}

TEST_F(CutOffRuleTest, OnlyPeopleHandOverWhenItIsSwitchedOff) {
  begin({}, 0ms);
  hear_for(60s);
  expect_it_stays("handover-s is 0");
}

TEST_F(CutOffRuleTest, AfterAHandOverThatHelpedNothingItStaysUntilAPersonActs) {
  begin({.count = 1, .has_helped = false});
  expect_it_stays("a person decides (dnc server drain)");
}

/// Two servers do not swap for ever.
TEST_F(CutOffRuleTest, EachFurtherOneNeedsTwiceTheTimeSinceTheLast) {
  for (const std::uint64_t count : {1U, 2U, 3U, 20U}) {
    const auto pause =
        std::min<std::chrono::seconds>(60s * (1LL << std::min<std::uint64_t>(count - 1, 30)), 1h);
    begin({.count = count, .has_helped = false});
    heard_ = 1;
    EXPECT_EQ(step_within(10s).first, Step::Keep) << "it has helped";
    EXPECT_EQ(rule_->kept(), (storage::OwnHandOvers{count, true}));
    heard_ = 0;
    const auto [step, after] = step_within(2h);
    EXPECT_EQ(step, Step::HandOver);
    EXPECT_GE(now_ - began_, pause);
    EXPECT_LE(now_ - began_, pause + 1s);
    EXPECT_EQ(rule_->after_hand_over(), (storage::OwnHandOvers{count + 1, false}));
  }
}

TEST_F(CutOffRuleTest, GatewaysThatAreHeardForLongEndTheCount) {
  begin({.count = 2, .has_helped = true});
  heard_ = 2;
  const auto [step, after] = step_within(1h);
  EXPECT_EQ(step, Step::Keep);
  EXPECT_EQ(after, 120s + 250ms);
  EXPECT_EQ(rule_->kept(), storage::OwnHandOvers{});
}

}  // namespace
}  // namespace dripline::app
