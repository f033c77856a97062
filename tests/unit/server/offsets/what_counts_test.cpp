// Which deviations are those of the value in force, and which are left out: by a wrong one the next
// part is cut wrongly.
#include "tests/unit/server/offsets/offsets_fixture.hpp"

namespace dripline::offsets {
namespace {

using storage::OffsetState;

class WhatCounts : public OffsetsTest {
 protected:
  void measure_three(double actual = 40.02) {
    for (int i = 0; i < 3; ++i) measure(actual);
  }
  static void expect(const std::string& text, const std::vector<std::string>& words) {
    for (const std::string& word : words)
      EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
  }
  static std::string setup(const std::string& tool, const std::string& more = "") {
    return fmt::format("units = \"mm\"\n[[tool]]\nnumber = 3\n{}wear = {{ X = 0.1 }}\n{}", tool,
                       more);
  }
  std::string refusal_of(const std::string& added) {
    const auto saved = offsets_->save_rules("lathe-1", kRules + added, "anna");
    return saved ? "saved" : saved.error().what;
  }
  static std::string rule(const std::string& characteristic, const std::string& target) {
    return fmt::format(
        "[[rule]]\nname = \"second\"\ncharacteristic = \"{}\"\ntarget = \"{}\"\nmax_step = 1\n",
        characteristic, target);
  }
};

struct Change {
  const char* name;
  const char *before, *after;  ///< of tool 3
  const char *more_before, *more_after;
  const char* change;  ///< empty: the measurements count on
};
class ChangesOfASetup : public WhatCounts, public testing::WithParamInterface<Change> {};

TEST_P(ChangesOfASetup, KeepOrDropWhatWasMeasuredBefore) {
  const Change& change = GetParam();
  save_setup(setup(change.before, change.more_before));
  use_rules();
  measure_three();
  save_setup(setup(change.after, change.more_after), "a change");
  if (*change.change == 0) {
    EXPECT_EQ(only_proposal().used, 3U);
    return;
  }
  expect(why_nothing(), {"3 measurements of D40 are left out: cut before setup 3, when ",
                         change.change, "0 measurements under the value in force"});
}
INSTANTIATE_TEST_SUITE_P(
    , ChangesOfASetup,
    testing::Values(Change{"geometry", "X = 5.0\n", "X = 5.05\n", "", "", "T3.X was 5 mm"},
                    Change{"nose", "radius = 0.4\n", "radius = 0.8\n", "", "",
                           "T3.radius was 0.4 mm"},
                    Change{"other_axis", "Z = 5.0\n", "Z = 5.05\n", "", "", ""},
                    Change{"offset", "", "", "[[offset]]\nname = \"G54\"\nX = 1.0\n",
                           "[[offset]]\nname = \"G54\"\nX = 1.5\n", "G54.X was 1 mm"},
                    Change{"new_offset", "", "", "", "[[offset]]\nname = \"G55\"\nX = 1.5\n",
                           "G55.X was not given"},
                    Change{"offset_along_z", "", "", "[[offset]]\nname = \"G54\"\nZ = 1.0\n",
                           "[[offset]]\nname = \"G54\"\nZ = 1.5\n", ""},
                    Change{"other_tool", "", "", "[[tool]]\nnumber = 4\nX = 1.0\n",
                           "[[tool]]\nnumber = 4\nX = 1.5\n", ""},
                    Change{"variable", "", "", "[[variable]]\nname = \"P625\"\nvalue = 0.1\n",
                           "[[variable]]\nname = \"P625\"\nvalue = 0.2\n", "variable P625 was 0.1"},
                    Change{"options", "", "", "[control]\nstored_x = \"radius\"\n",
                           "[control]\nstored_x = \"diameter\"\n", "[control] was another one"}),
    [](const auto& param) { return std::string(param.param.name); });

TEST_F(WhatCounts, ThereAndBackIsAChange) {
  use_rules();
  measure_three();
  save_setup(setup("X = 0.5\n"), "there");
  save_setup(setup(""), "and back");
  expect(why_nothing(), {"cut before setup 3, when T3.X was 0.5 mm"});
}

TEST_F(WhatCounts, TheSameNumberInAnotherUnitIsAnotherValue) {
  use_rules();
  measure_three();
  save_setup("units = \"in\"\n[[tool]]\nnumber = 3\nwear = { X = 0.1 }\n", "in inches");
  expect(why_nothing(), {"cut before setup 2, when T3.wear.X was 0.1 mm"});
  const auto history = offsets_->history().list("lathe-1", "T3.wear.X", {});
  ASSERT_EQ(history->size(), 2U);
  EXPECT_EQ(history->front().unit, "in");
}

TEST_F(WhatCounts, AndAnotherNumberTheSameValue) {
  save_setup("units = \"mm\"\n[[tool]]\nnumber = 3\nwear = { X = 2.54 }\n");
  use_rules();
  measure_three(40.2);
  save_setup("units = \"in\"\n[[tool]]\nnumber = 3\nwear = { X = 0.1 }\n", "in inches");
  const auto proposal = only_proposal();
  EXPECT_EQ(proposal.used, 3U);
  EXPECT_NEAR(proposal.mean, 0.2 / 25.4, 1e-9);
  EXPECT_EQ(offsets_->history().list("lathe-1", "T3.wear.X", {})->size(), 2U)
      << "those of setups 1 and 2";
}

TEST_F(WhatCounts, OneDeviationIsNotCorrectedByTwoRules) {
  save_setup(setup("", "[[offset]]\nname = \"G54\"\nX = 0.0\nZ = 0.0\n"));
  EXPECT_EQ(refusal_of(rule("D40", "T3.X")),
            "rule second: T3.X moves what T3.wear.X of rule D40 moves, and both would correct D40: "
            "one deviation would be corrected twice");
  expect(refusal_of(rule("D40", "T03.wear.X")), {"T03.wear.X is corrected by another rule"});
  expect(refusal_of(rule("D40", "G54.X")), {"corrected twice"});
  EXPECT_EQ(refusal_of(rule("D40", "T3.wear.Z")), "saved");
  EXPECT_EQ(refusal_of(rule("D41", "T3.X")), "saved");
}

/// Of different characteristics they are allowed; what one did, the other one sees.
TEST_F(WhatCounts, TheSecondRulesMeasurementsAreOfBeforeTheFirstOnesStep) {
  auto second = std::string(kRules);
  second.replace(second.find("name = \"D40\""), 12, "name = \"geo\"");
  second.replace(second.find("T3.wear.X"), 9, "T3.X");
  second += "automatic = 0.05\n";
  // As they were stored before they were refused.
  ASSERT_TRUE(
      store_->offsets.save_rules({.machine = "lathe-1",
                                  .version = 0,
                                  .text = std::string(kRules) + "automatic = 0.05\n" + second,
                                  .author = "anna",
                                  .created = clock_.now()},
                                 "anna"));
  measure_three();
  ASSERT_TRUE(offsets_->look("lathe-1"));
  ASSERT_TRUE(offsets_->look("lathe-1"));
  EXPECT_EQ(all(OffsetState::Applied).size(), 1U);
  EXPECT_DOUBLE_EQ(wear(), 0.09);
  const auto now = store_->setups.find("lathe-1", std::nullopt);
  EXPECT_EQ(value_in_setup(now->text, parse_setup_target("T3.X").value()).value(), 0);
}

TEST_F(WhatCounts, RunsWithoutASetupOfTheServerNever) {
  save_setup("units = \"mm\"\n[[tool]]\nnumber = 3\nwear = { X = 0.0 }\n");
  use_rules();
  has_setup_ = false;
  measure_three();
  expect(why_nothing(), {"3 measurements of D40 are left out: of runs without a setup of the "
                         "server, so what was in force is not known"});
}

TEST_F(WhatCounts, APartInDoubtNever) {
  use_rules();
  verdict_ = measurement::Verdict::Unknown;
  findings_ = 1;
  measure(40.02);
  verdict_ = measurement::Verdict::Rework;  // and what is unknown is hidden by it
  findings_ = 1;
  measure(40.2);
  findings_ = 0;
  measure(40.2);
  expect(why_nothing(),
         {"2 measurements of D40 are left out: the reports of their parts have findings",
          "1 measurements under the value in force"});
  verdict_ = measurement::Verdict::Good;
  findings_ = 1;  // a line that was not understood
  measure(40.2);
  expect(why_nothing(), {"2 measurements under the value in force"});
}

TEST_F(WhatCounts, APartWithALineThatNoTemplateKnowsDoes) {
  use_rules();
  verdict_ = measurement::Verdict::Scrap;
  findings_ = 1;
  finding_ = "unmatched";
  measure(40.2);
  expect(why_nothing(), {"1 measurements under the value in force"});
}

TEST_F(WhatCounts, APartWithoutLimitsDoes) {
  use_rules();
  verdict_ = measurement::Verdict::Unknown;
  measure(40.02);
  expect(why_nothing(), {"1 measurements under the value in force"});
}

TEST_F(WhatCounts, NorOneThatHasNotEnded) {
  use_rules();
  is_ended_ = false;
  measure_three();
  expect(why_nothing(), {"3 measurements of D40 are left out: their parts have not ended"});
}

TEST_F(WhatCounts, OnePartCountsOnce) {
  use_rules("window = 3\n");
  part_ = "P7";
  const std::string run = measure(40.01);
  measure_in(run, 40.03);
  measure_in(run, 40.02);
  expect(why_nothing(), {"2 measurements of D40 are left out: each part counts once",
                         "1 measurements under the value in force"});
  measure(40.02);
  part_ = "";
  measure(40.02);
  EXPECT_NEAR(only_proposal().mean, 0.02, 1e-9) << "the last one of part P7";
}

TEST_F(WhatCounts, AUnitThatIsNoLengthIsLeftOut) {
  use_rules();
  for (const char* unit : {"um", "deg", "um"}) {
    unit_ = unit;
    measure(40.02);
  }
  expect(why_nothing(), {"3 measurements of D40 are left out: they are in deg, um, which is not "
                         "converted to the mm of T3.wear.X"});
  unit_ = "inch";
  measure_three(40.001);
  const auto proposal = only_proposal();
  EXPECT_NEAR(proposal.mean, 0.0254, 1e-9);
  expect(proposal.reasons, {"mean deviation +0.0254 mm of 3 measurements"});
}

TEST_F(WhatCounts, WhatWasDerivedAgainIsNotApproved) {
  use_rules();
  measure(40.02);
  measure(40.02);
  const std::string run = measure(40.02);
  const auto proposal = only_proposal();
  derive_again(run, 39.9);
  const auto approved = offsets_->approve({.id = proposal.id, .who = "anna", .time = {}});
  ASSERT_FALSE(approved);
  EXPECT_EQ(approved.error().code, Errc::Conflict);
  expect(approved.error().what, {"is superseded: its measurements are not the current ones"});
  EXPECT_EQ(wear(), 0.1);
  const auto then = store_->offsets.find(proposal.id);
  EXPECT_EQ(then->state, OffsetState::Superseded);
  expect(then->comment, {"its measurements are not the current ones"});
}

TEST_F(WhatCounts, NorWhatGivesTheSameStepByOtherMeasurements) {
  use_rules();
  const std::string run = measure(40.02);
  measure(40.02);
  measure(40.02);
  const auto proposal = only_proposal();
  derive_again(run, 40.02);
  EXPECT_FALSE(offsets_->approve({.id = proposal.id, .who = "anna", .time = {}}));
  const auto again = only_proposal();
  EXPECT_NE(again.id, proposal.id);
  EXPECT_TRUE(offsets_->approve({.id = again.id, .who = "anna", .time = {}}));
}

/// At the end of a line: what is in the control, not what is the newest, was in force.
TEST_F(WhatCounts, IsNamedWhereTheControlWaitsForTheNewestSetup) {
  const auto first = save_setup(setup("")).number;
  ASSERT_TRUE(store_->setups.note_loaded("lathe-1", first, "olga"));
  use_rules();
  measure_three();
  EXPECT_EQ(only_proposal().used, 3U);
  const auto second = save_setup(setup("radius = 0.8\n"), "another insert").number;
  expect(why_nothing(),
         {fmt::format("setup {} is recorded as loaded in the control, and setup {} is the newest",
                      first, second),
          fmt::format("`dnc setup loaded lathe-1 {}`", second)});
  ASSERT_TRUE(store_->setups.note_loaded("lathe-1", std::nullopt, "olga"));
  expect(why_nothing(), {"no known setup is recorded as loaded in the control"});
}

TEST_F(WhatCounts, AValueThatIsTakenOutOfTheSetupEndsInTheHistory) {
  save_setup(setup("radius = 0.4\n"));
  measure(40.0);
  save_setup(setup(""), "no radius");
  measure(40.0);
  const auto history = offsets_->history().list("lathe-1", "T3.radius", {});
  ASSERT_TRUE(history) << history.error().what;
  ASSERT_EQ(history->size(), 1U);
  EXPECT_EQ(history->front().runs.size(), 1U) << "the second run had none";
}

}  // namespace
}  // namespace dripline::offsets
