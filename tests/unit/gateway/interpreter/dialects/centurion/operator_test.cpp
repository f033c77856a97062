#include <gtest/gtest.h>

#include "gateway/interpreter/core/setup.hpp"
#include "gateway/interpreter/dialects/centurion/memory/panel_tables.hpp"
#include "gateway/interpreter/dialects/centurion/options.hpp"
#include "tests/unit/gateway/interpreter/dialects/centurion/program_run.hpp"

/// What a program reports to the panel, the panel's tables, and data mode.
namespace dripline::interpreter::centurion {
namespace {

using ControlSetup = interpreter::Setup;  // gtest keeps a private member named Setup
using Lines = std::vector<std::string>;

ControlSetup with_control(const std::string& options) {
  auto setup = parse_setup("[control]\n" + options, Units::Inch);
  EXPECT_TRUE(setup) << setup.error().what;
  return *setup;
}

/// Feed, spindle and single block inhibited; when a feed hold acts (0 at once, 1 later, 2 an
/// earlier one later too); a tapping cycle.
Lines locks_of(const std::string& text, const ControlSetup& setup = {}) {
  ProgramRun run(text, setup);
  EXPECT_EQ(run.step(), StepState::Ended) << run.alarm();
  return run.events("lock");
}

/// CEN-058
TEST(OverrideInhibit, IsThatOfTappingModeUntilAnotherMode) {
  EXPECT_EQ(locks_of("G0 X1\nG63\nX2\nG64\n"), (Lines{"111 1 0", "000 0 0"}));
  EXPECT_EQ(locks_of("G0 X1\nG63\nG61\n"), (Lines{"111 1 0", "000 0 0"}));
}

TEST(OverrideInhibit, BeforeTheFirstEventLeavesTheUnitsOpen) {
  ProgramRun run("G63\nG21\nG0 X1\n");
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_EQ(run.events("units"), Lines{});
  EXPECT_EQ(run.events("lock"), Lines{"111 1 0"});
}

/// CEN-137: operations 3 to 5, the retraction, and no more.
TEST(OverrideInhibit, OfATapEndsAfterTheRetraction) {
  const std::string before = "G97 G99 S500 M3\nG0 Z1\n";
  EXPECT_EQ(locks_of(before + "G84 F.1 R.5 Z-.5 G38\n"), (Lines{"111 1 1", "000 2 0", "000 0 0"}));
  EXPECT_EQ(locks_of(before + "G63\nG84 F.1 R.5 Z-.5 G39\nG64\n"),
            (Lines{"111 1 0", "111 1 1", "111 1 0", "111 1 0", "000 0 0"}));
}

/// After a feed hold in the thread the tool still leaves it.
TEST(OverrideInhibit, OfAThreadPassLastsUntilItsRetraction) {
  EXPECT_EQ(locks_of("G97 S500 M3\nG0 X2 Z1\nG92 X1 Z-1 F.1\n"), (Lines{"000 2 0", "000 0 0"}));
}

TEST(OverrideInhibit, OfTheModeIsReportedAtAStartInTheMiddle) {
  EXPECT_EQ(locks_of("G0 X1\nG63\nN5 X2\n", with_control("start_at = \"N5\"")), Lines{"111 1 0"});
}

/// CEN-217
TEST(PanelTables, HaveTheControlsPositionsUnlessTheSetupHasItsOwn) {
  const auto usual = read_panel_tables({});
  ASSERT_TRUE(usual);
  EXPECT_EQ(usual->feed.size(), 16U);
  EXPECT_DOUBLE_EQ(usual->feed.back(), 1.5);
  EXPECT_EQ(usual->spindle.size(), 15U);
  EXPECT_DOUBLE_EQ(usual->spindle.back(), 1.75);
  // 10 of 400 pulses of a revolution that passes a thousandth of a minute
  EXPECT_DOUBLE_EQ(usual->click_seconds.at(10), 0.0015);
  const auto own =
      read_panel_tables(with_control("feed_overrides = [0, 199]\nspindle_overrides = [255]\n"
                                     "handwheel_pulses = [0, 40]\ncranking_minutes = 0.01\n"));
  ASSERT_TRUE(own);
  EXPECT_EQ(own->feed, (std::vector<double>{0, 1.99}));
  EXPECT_DOUBLE_EQ(own->spindle.at(0), 2.55);
  EXPECT_DOUBLE_EQ(own->click_seconds.at(1), 0.06);
}

TEST(PanelTables, AreRefusedWithTheOptionTheValueAndTheLimit) {
  const auto verdict = [](const std::string& options) {
    const auto tables = read_panel_tables(with_control(options));
    return tables ? std::string() : tables.error().what;
  };
  EXPECT_EQ(verdict("feed_overrides = [0, 200]"), "[control] feed_overrides: 200 is not 0 to 199");
  EXPECT_EQ(verdict("spindle_overrides = [-1]"), "[control] spindle_overrides: -1 is not 0 to 255");
  EXPECT_EQ(verdict("handwheel_pulses = [1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17]"),
            "[control] handwheel_pulses: 17 entries, the switch has 16 positions");
  EXPECT_EQ(verdict("cranking_minutes = 0"),
            "[control] cranking_minutes: 0 is not above 0 and up to 1");
}

/// CEN-060: a written value reads back; it is in force from G11 on.
TEST(DataMode, ChangesAreInForceFromG11On) {
  ProgramRun run(
      "T0101 M6\nG10\nP600=.5\nP10=P240\nP11=P600\nP600=P600*3\nG11\nP12=P240\n"
      "PRINT [#10[12] #11[12] #12[12]]\n");
  EXPECT_EQ(run.step(), StepState::Ended) << run.alarm();
  EXPECT_EQ(run.printed(), Lines{"0.00 0.50 1.50"});
}

/// CEN-203: what FAST does without is not done, a flag for it is not needed.
TEST(DncFast, HasNoTrigHelp) {
  const std::string text = "G98 F90\nG0 X12 Z10\nG1 Z-15\nG3 XC0 ZC-20 R10 X16 Z-26\n";
  ProgramRun helped(text);
  EXPECT_EQ(helped.step(), StepState::Ended) << helped.alarm();
  ProgramRun fast(text, with_control("dnc_mode = \"fast\""));
  EXPECT_EQ(fast.step(), StepState::Alarmed);
  ProgramRun off(text, with_control("special_flags = 2"));
  EXPECT_EQ(off.step(), StepState::Alarmed);
  EXPECT_EQ(fast.alarm(), off.alarm());
}

/// CEN-142
TEST(ToolChange, PulsesTheMachinesOutputAndStopsItsSpindleWhereItIsSetUpSo) {
  const std::string text = "G97 S500 M3\nT0202 M6 (NEXT)\n";
  ProgramRun plain(text);
  EXPECT_EQ(plain.step(), StepState::Ended);
  EXPECT_EQ(plain.events("pin"), Lines{});
  EXPECT_EQ(plain.events("spindle").size(), 1U);
  ProgramRun locked(text, with_control("m6_pin = 2018\nm6_spindle = \"stop\"\n"));
  EXPECT_EQ(locked.step(), StepState::Ended);
  EXPECT_EQ(locked.events("pin").size(), 1U);
  EXPECT_EQ(locked.events("spindle").size(), 2U);
  EXPECT_EQ(locked.events("stop").size(), 1U);
  const auto refused = read_options(with_control("m6_pin = 2005"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().what,
            "[control] m6_pin: 2005 is no output, 1012 to 1023 (Z) or 2012 to 2023 (X)");
}

/// CEN-142: a changer signals that the change is complete; without one the program waits.
TEST(ToolChange, WaitsUnlessThereIsAChanger) {
  const std::string text = "T0202 M6 (NEXT)\n";
  ProgramRun by_hand(text);
  EXPECT_EQ(by_hand.step(), StepState::Ended);
  EXPECT_EQ(by_hand.events("stop").size(), 1U);
  for (const char* changer : {"tool_changer = true\n", "[control.machine]\natc_pockets = 8\n"}) {
    ProgramRun run(text, with_control(changer));
    EXPECT_EQ(run.step(), StepState::Ended);
    EXPECT_EQ(run.events("stop"), Lines{}) << changer;
    EXPECT_EQ(run.events("tool").size(), 1U) << changer;
  }
}

}  // namespace
}  // namespace dripline::interpreter::centurion
