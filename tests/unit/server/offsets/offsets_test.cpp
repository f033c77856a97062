#include "server/offsets/offsets.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/unit/server/offsets/offsets_fixture.hpp"

namespace dripline::offsets {
namespace {

using storage::OffsetState;

TEST_F(OffsetsTest, ProposesWithReasonsAndChangesNothing) {
  use_rules();
  for (const double actual : {40.019, 40.020, 40.021}) measure(actual);
  const auto proposal = only_proposal();
  EXPECT_EQ(proposal.target, "T3.wear.X");
  EXPECT_DOUBLE_EQ(proposal.old_value, 0.1);
  EXPECT_DOUBLE_EQ(proposal.new_value, 0.09);
  EXPECT_EQ(proposal.unit, "mm");
  EXPECT_EQ(proposal.base, 1U);
  EXPECT_EQ(proposal.used, 3U);
  EXPECT_EQ(proposal.state, OffsetState::Pending);
  EXPECT_NE(proposal.reasons.find("mean deviation +0.02 mm of 3 measurements"), std::string::npos)
      << proposal.reasons;
  EXPECT_NE(proposal.reasons.find("T3.wear.X is a radius in the setup: the scale is 0.5 for a "
                                  "characteristic that is a diameter"),
            std::string::npos)
      << proposal.reasons;
  EXPECT_EQ(wear(), 0.1);
  ASSERT_EQ(changes_.size(), 1U);
  // Looking again at the same measurements is the same proposal.
  EXPECT_EQ(only_proposal().id, proposal.id);
  EXPECT_EQ(changes_.size(), 1U);
  EXPECT_EQ(all().size(), 1U);
}

TEST_F(OffsetsTest, AnApprovedOneIsTheNextSetup) {
  use_rules();
  for (const double actual : {40.02, 40.02, 40.02}) measure(actual);
  const auto proposal = only_proposal();
  const auto approved = offsets_->approve(
      {.id = proposal.id, .who = "anna", .comment = "checked by hand", .time = {}});
  ASSERT_TRUE(approved) << approved.error().what;
  const auto saved = store_->setups.find("lathe-1", std::nullopt);
  ASSERT_TRUE(saved) << saved.error().what;
  EXPECT_EQ(saved->number, 2U);
  EXPECT_EQ(store_->setups.find("lathe-1", 2)->text,
            "units = \"mm\"\n\n[[tool]]\nnumber = 3\nwear = { X = 0.09 }  # by hand\n");
  EXPECT_EQ(saved->author, "anna");
  EXPECT_NE(saved->comment.find("checked by hand"), std::string::npos);
  const auto applied = store_->offsets.find(proposal.id);
  EXPECT_EQ(applied->state, OffsetState::Applied);
  EXPECT_EQ(applied->setup, 2U);
  EXPECT_EQ(applied->who, "anna");
  const auto audit = store_->audit.list({})->front();
  EXPECT_EQ(audit.action, "offset.apply");
  EXPECT_EQ(audit.subject, "lathe-1 T3.wear.X");
  EXPECT_EQ(audit.who.name, "anna");
}

TEST_F(OffsetsTest, IsAppliedOnce) {
  use_rules();
  for (const double actual : {40.02, 40.02, 40.02}) measure(actual);
  const auto proposal = only_proposal();
  ASSERT_TRUE(offsets_->approve({.id = proposal.id, .who = "anna", .time = {}}));
  const auto again = offsets_->approve({.id = proposal.id, .who = "bert", .time = {}});
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, Errc::Conflict);
  EXPECT_FALSE(offsets_->reject({.id = proposal.id, .who = "bert", .comment = "late", .time = {}}));
  EXPECT_DOUBLE_EQ(wear(), 0.09);
  EXPECT_EQ(store_->setups.list("lathe-1", {})->size(), 2U);
}

TEST_F(OffsetsTest, WhatWasMeasuredBeforeTheCorrectionCountsNoMore) {
  use_rules();
  for (const double actual : {40.02, 40.02, 40.02}) measure(actual);
  ASSERT_TRUE(offsets_->approve({.id = only_proposal().id, .who = "anna", .time = {}}));
  auto looked = offsets_->look("lathe-1");
  ASSERT_TRUE(looked);
  EXPECT_FALSE(looked->front().proposal);
  EXPECT_EQ(looked->front().since, 2U);
  EXPECT_EQ(looked->front().outcome.reasons.front(),
            "3 measurements of D40 are left out: cut before setup 2, when T3.wear.X was 0.1 mm");
  EXPECT_EQ(looked->front().outcome.reasons.back(),
            "0 measurements under the value in force, 3 are needed");
  for (const double actual : {40.001, 39.999, 40.0}) measure(actual);
  looked = offsets_->look("lathe-1");
  EXPECT_FALSE(looked->front().proposal) << "it is within the dead band";
}

TEST_F(OffsetsTest, AnotherSetupWithTheSameValueKeepsTheMeasurements) {
  use_rules();
  measure(40.02);
  measure(40.02);
  save_setup(std::string(kSetup) + "# tool 4 is new\n[[tool]]\nnumber = 4\n");
  measure(40.02);
  const auto proposal = only_proposal();
  EXPECT_EQ(proposal.used, 3U);
  EXPECT_EQ(proposal.base, 2U);
}

TEST_F(OffsetsTest, ASetupThatSomebodySavedSinceIsNotOverwritten) {
  use_rules();
  for (const double actual : {40.02, 40.02, 40.02}) measure(actual);
  const auto proposal = only_proposal();
  save_setup("units = \"mm\"\n[[tool]]\nnumber = 3\nwear = { X = 0.2 }\n", "by hand");
  const auto applied = offsets_->approve({.id = proposal.id, .who = "anna", .time = {}});
  ASSERT_FALSE(applied);
  EXPECT_EQ(applied.error().code, Errc::Conflict);
  EXPECT_EQ(wear(), 0.2);
  // Not even where the check before the transaction came too early.
  storage::SetupRevision setup;
  setup.machine = "lathe-1";
  setup.text = "units = \"mm\"\n";
  EXPECT_EQ(
      store_->offsets
          .apply({.id = proposal.id, .who = "anna", .comment = {}, .time = clock_.now()}, setup)
          .error()
          .code,
      Errc::Conflict);
  EXPECT_EQ(store_->offsets.find(proposal.id)->state, OffsetState::Pending);
  // The value changed, so nothing follows from the old measurements.
  ASSERT_TRUE(offsets_->look("lathe-1"));
  EXPECT_EQ(store_->offsets.find(proposal.id)->state, OffsetState::Superseded);
}

TEST_F(OffsetsTest, NewMeasurementsSupersedeAPendingOne) {
  use_rules();
  for (const double actual : {40.018, 40.02, 40.022}) measure(actual);
  const auto first = only_proposal();
  measure(40.026);
  measure(40.026);
  const auto second = only_proposal();
  EXPECT_NE(second.id, first.id);
  EXPECT_EQ(store_->offsets.find(first.id)->state, OffsetState::Superseded);
  EXPECT_EQ(all(OffsetState::Pending).size(), 1U);
  EXPECT_EQ(offsets_->approve({.id = first.id, .who = "anna", .time = {}}).error().code,
            Errc::Conflict);
}

TEST_F(OffsetsTest, ThePolicyAppliesSmallStepsByItself) {
  use_rules("automatic = 0.005\n");
  for (const double actual : {40.008, 40.008, 40.008}) measure(actual);
  const auto looked = offsets_->look("lathe-1");
  ASSERT_TRUE(looked) << looked.error().what;
  ASSERT_TRUE(looked->front().proposal);
  EXPECT_EQ(looked->front().proposal->state, OffsetState::Applied);
  EXPECT_TRUE(looked->front().proposal->is_automatic);
  EXPECT_DOUBLE_EQ(wear(), 0.096);
  for (const double actual : {40.04, 40.04, 40.04}) measure(actual);
  EXPECT_EQ(only_proposal().state, OffsetState::Pending) << "the step is too large";
}

TEST_F(OffsetsTest, RejectingNeedsAReasonAndIsKept) {
  use_rules();
  for (const double actual : {40.02, 40.02, 40.02}) measure(actual);
  const auto proposal = only_proposal();
  EXPECT_EQ(
      offsets_->reject({.id = proposal.id, .who = "anna", .comment = " ", .time = {}}).error().code,
      Errc::Syntax);
  const auto rejected = offsets_->reject(
      {.id = proposal.id, .who = "anna", .comment = "chip on the probe", .time = {}});
  ASSERT_TRUE(rejected);
  EXPECT_EQ(rejected->state, OffsetState::Rejected);
  EXPECT_EQ(rejected->comment, "chip on the probe");
  EXPECT_EQ(store_->audit.list({})->front().action, "offset.reject");
  EXPECT_EQ(wear(), 0.1);
}

constexpr const char* kWrongTool =
    "[[rule]]\nname = \"L\"\ncharacteristic = \"D40\"\ntarget = \"T99.wear.X\"\n"
    "max_step = 0.05\n";

TEST_F(OffsetsTest, ARuleForAToolThatTheSetupHasNotIsRefused) {
  const auto saved = offsets_->save_rules("lathe-1", std::string(kRules) + kWrongTool, "anna");
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().code, Errc::Conflict);
  EXPECT_EQ(saved.error().what, "rule L: setup 1 of lathe-1 has no tool 99");
  EXPECT_FALSE(store_->offsets.rules("lathe-1"));
  const std::string offset =
      "[[rule]]\nname = \"Z\"\ncharacteristic = \"Z\"\ntarget = \"G59.Z\"\nmax_step = 1\n";
  EXPECT_EQ(offsets_->save_rules("lathe-1", offset, "anna").error().what,
            "rule Z: setup 1 of lathe-1 has no offset G59");
}

TEST_F(OffsetsTest, AToolThatIsGoneFromTheSetupIsNotMadeAgain) {
  use_rules();
  save_setup("units = \"mm\"\n[[tool]]\nnumber = 4\n", "tool 3 is out");
  for (const double actual : {40.02, 40.02, 40.02}) measure(actual);
  const auto looked = offsets_->look("lathe-1");
  ASSERT_TRUE(looked) << looked.error().what;
  EXPECT_FALSE(looked->front().proposal);
  EXPECT_EQ(looked->front().outcome.reasons.back(),
            "nothing is proposed: setup 2 of lathe-1 has no tool 3");
}

TEST_F(OffsetsTest, ARejectedOneComesAgainWhenManyMorePartsAskForIt) {
  use_rules();
  for (const double actual : {40.02, 40.02, 40.02}) measure(actual);
  const auto rejected = only_proposal();
  ASSERT_TRUE(offsets_->reject(
      {.id = rejected.id, .who = "anna", .comment = "a chip on the probe", .time = {}}));
  for (const int more : {0, 1, 2}) {
    if (more > 0) measure(40.02);
    const auto looked = offsets_->look("lathe-1");
    ASSERT_TRUE(looked) << looked.error().what;
    EXPECT_FALSE(looked->front().proposal) << more;
    EXPECT_EQ(looked->front().outcome.reasons.back(),
              fmt::format("nothing is proposed: anna rejected it as offset proposal 1: a chip on "
                          "the probe. It comes again with another value, or after 3 measurements "
                          "more; there are {}",
                          more));
  }
  measure(40.02);
  EXPECT_NE(only_proposal().id, rejected.id);
}

TEST_F(OffsetsTest, ARejectedOneIsNeverAppliedWithoutAPerson) {
  use_rules();
  for (const double actual : {40.02, 40.02, 40.02}) measure(actual);
  ASSERT_TRUE(offsets_->reject(
      {.id = only_proposal().id, .who = "anna", .comment = "a chip on the probe", .time = {}}));
  use_rules("automatic = 0.05\n");
  for (const double actual : {40.02, 40.02, 40.02}) measure(actual);
  const auto looked = offsets_->look("lathe-1");
  ASSERT_TRUE(looked) << looked.error().what;
  ASSERT_TRUE(looked->front().proposal);
  EXPECT_EQ(looked->front().proposal->state, OffsetState::Pending);
  EXPECT_EQ(looked->front().outcome.reasons.back(),
            "it was rejected before, so it waits for a person");
}

TEST_F(OffsetsTest, ARejectedOneComesAgainWithAnotherValue) {
  use_rules();
  for (const double actual : {40.018, 40.02, 40.022}) measure(actual);
  const auto rejected = only_proposal();
  ASSERT_TRUE(offsets_->reject({.id = rejected.id, .who = "anna", .comment = "wait", .time = {}}));
  measure(40.024);
  EXPECT_LT(only_proposal().new_value, rejected.new_value);
}

/// Its setup may come after its rules.
TEST_F(OffsetsTest, WithoutASetupNothingIsApproved) {
  add_machine("lathe-2");
  ASSERT_TRUE(offsets_->save_rules("lathe-2", kWrongTool, "anna"));
  storage::OffsetProposal proposal;
  proposal.machine = "lathe-2";
  proposal.rule = "L";
  proposal.target = "T99.wear.X";
  proposal.unit = "in";
  proposal.new_value = -0.001;
  proposal.created = clock_.now();
  proposal.reasons = "[]";
  const auto kept = store_->offsets.propose(proposal);
  ASSERT_TRUE(kept) << kept.error().what;
  const auto approved = offsets_->approve({.id = kept->proposal.id, .who = "anna", .time = {}});
  ASSERT_FALSE(approved);
  EXPECT_EQ(approved.error().code, Errc::Conflict);
  EXPECT_NE(approved.error().what.find("has no setup on the server, so there is no tool 99"),
            std::string::npos)
      << approved.error().what;
  EXPECT_FALSE(store_->setups.find("lathe-2", std::nullopt));
}

TEST_F(OffsetsTest, WhatARemovedRuleProposedIsWithdrawn) {
  use_rules();
  for (const double actual : {40.02, 40.02, 40.02}) measure(actual);
  const auto proposal = only_proposal();
  ASSERT_TRUE(offsets_->save_rules("lathe-1", "# none\n", "anna"));
  EXPECT_EQ(store_->offsets.find(proposal.id)->state, OffsetState::Superseded);
  EXPECT_FALSE(offsets_->approve({.id = proposal.id, .who = "anna", .time = {}}));
  EXPECT_EQ(wear(), 0.1);
}

/// Saved by a server that did not withdraw it, or between the two.
TEST_F(OffsetsTest, WhatARemovedRuleProposedIsNotApproved) {
  use_rules();
  for (const double actual : {40.02, 40.02, 40.02}) measure(actual);
  const auto proposal = only_proposal();
  const auto save = [&](const std::string& text) {
    ASSERT_TRUE(store_->offsets.save_rules({.machine = "lathe-1",
                                            .version = 0,
                                            .text = text,
                                            .author = "anna",
                                            .created = clock_.now()},
                                           "anna"));
  };
  const auto refusal = [&] {
    const auto approved = offsets_->approve({.id = proposal.id, .who = "anna", .time = {}});
    if (approved) return std::string("approved");
    EXPECT_EQ(approved.error().code, Errc::Conflict);
    return approved.error().what;
  };
  save("# none\n");
  EXPECT_NE(refusal().find("was made by rule D40 for T3.wear.X, which is not among the rules"),
            std::string::npos)
      << refusal();
  std::string narrow = kRules;
  save(narrow.replace(narrow.find("max_step = 0.05"), 15, "max_step = 0.005"));
  EXPECT_NE(refusal().find("beyond the largest step of rule D40"), std::string::npos) << refusal();
  save(std::string(kRules) + "lowest = 0.095\n");
  EXPECT_NE(refusal().find("outside of the bounds of rule D40"), std::string::npos) << refusal();
  save("# again\n");
  ASSERT_TRUE(offsets_->look("lathe-1"));
  EXPECT_EQ(store_->offsets.find(proposal.id)->state, OffsetState::Superseded);
}

TEST_F(OffsetsTest, HistoryShowsEveryValueWithItsRunsAndParts) {
  use_rules();
  const std::string first = measure(40.02);
  measure(40.02);
  measure(40.02);
  const auto proposal = only_proposal();
  ASSERT_TRUE(offsets_->approve({.id = proposal.id, .who = "anna", .time = {}}));
  const std::string after = measure(40.0);
  const auto history = offsets_->history().list("lathe-1", "T3", {});
  ASSERT_TRUE(history) << history.error().what;
  ASSERT_EQ(history->size(), 2U);
  const HistoryEntry& now = history->front();
  EXPECT_DOUBLE_EQ(now.value, 0.09);
  EXPECT_EQ(now.setup.author, "anna");
  ASSERT_TRUE(now.proposal);
  EXPECT_EQ(now.proposal->id, proposal.id);
  ASSERT_EQ(now.runs.size(), 1U);
  EXPECT_EQ(now.runs[0].id, after);
  EXPECT_EQ(now.parts, 1U);
  const HistoryEntry& before = history->back();
  EXPECT_DOUBLE_EQ(before.value, 0.1);
  EXPECT_EQ(before.setup.author, "meyer");
  EXPECT_FALSE(before.proposal);
  ASSERT_EQ(before.runs.size(), 3U);
  EXPECT_EQ(before.runs[0].id, first);
  EXPECT_EQ(before.good, 3U);
  EXPECT_TRUE(offsets_->history().list("lathe-1", "T4", {})->empty());
  EXPECT_FALSE(offsets_->history().list("lathe-9", "T3", {}));
}

TEST_F(OffsetsTest, ValuesInForceAreThoseOfTheRunsSetup) {
  use_rules();
  const std::string first = measure(40.02);
  measure(40.02);
  measure(40.02);
  ASSERT_TRUE(offsets_->approve({.id = only_proposal().id, .who = "anna", .time = {}}));
  const std::string after = measure(40.0);
  const auto then = offsets_->history().in_force(first);
  ASSERT_TRUE(then);
  ASSERT_EQ(then->values.size(), 1U);
  EXPECT_DOUBLE_EQ(then->values[0].value, 0.1);
  EXPECT_DOUBLE_EQ(offsets_->history().in_force(after)->values[0].value, 0.09);
  EXPECT_FALSE(offsets_->history().in_force("no-run"));
}

TEST_F(OffsetsTest, TheWorkerLooksWhenSomethingWasMeasured) {
  use_rules();
  for (const double actual : {40.02, 40.02, 40.02}) measure(actual);
  std::mutex mutex;
  std::condition_variable changed;
  bool is_proposed = false;
  Offsets working(
      {.store = *store_, .setups = *setups_, .clock = clock_, .on_change = [&](const auto&) {
         const std::scoped_lock lock(mutex);
         is_proposed = true;
         changed.notify_all();
       }});
  working.begin();
  std::unique_lock lock(mutex);
  EXPECT_TRUE(changed.wait_for(lock, std::chrono::seconds(60), [&] { return is_proposed; }));
}

TEST_F(OffsetsTest, RulesAreCheckedAndKeptInVersions) {
  EXPECT_EQ(offsets_->save_rules("lathe-9", kRules, "anna").error().code, Errc::NotFound);
  EXPECT_FALSE(offsets_->save_rules("lathe-1", "rule = 1", "anna"));
  use_rules();
  EXPECT_EQ(store_->offsets.rules("lathe-1")->version, 1U);
  use_rules();
  EXPECT_EQ(store_->offsets.rules("lathe-1")->version, 1U) << "the same text";
  use_rules("automatic = 0.001\n");
  EXPECT_EQ(store_->offsets.rules("lathe-1")->version, 2U);
  EXPECT_TRUE(offsets_->look("lathe-9").value().empty());
}

}  // namespace
}  // namespace dripline::offsets
