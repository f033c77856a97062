#include "protocol/measurement/cut_line.hpp"
#include "tests/unit/server/measurements/measurements_fixture.hpp"

namespace dripline::measurements {
namespace {

using measurement::Verdict;
using Texts = std::vector<std::string>;

TEST_F(MeasurementsTest, FollowTheRecords) {
  start();
  use(kBore);
  make_run("r1");
  print({"run_started", "PART 1", "D 40.010", "D 40.015"});
  print({"PART 2", "D 39.999", "run_ended"});
  wait_until_derived();
  const auto rows = all();
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].actual, 40.01);
  EXPECT_EQ(rows[0].serial, "1");
  EXPECT_EQ(rows[0].program, "O0100");
  EXPECT_EQ(rows[0].revision, 1u);
  EXPECT_EQ(rows[0].record.number, 3u);
  EXPECT_EQ(rows[2].serial, "2");
  EXPECT_EQ(judged(), (Texts{"1 good", "2 good"}));
  const auto parts = store_->measurements.parts({.run = "r1"}, {});
  ASSERT_EQ(parts->size(), 2u);
  EXPECT_EQ(parts->at(1).measurements, 2u);
  EXPECT_TRUE(parts->at(0).ended);
}

TEST_F(MeasurementsTest, KnowNoVerdictOfAPartThatItsRunBrokeOff) {
  start();
  use(kBore);
  for (const auto state :
       {storage::RunState::Alarmed, storage::RunState::Aborted, storage::RunState::Interrupted}) {
    const std::string run(storage::to_string(state));
    make_run(run);
    print({"PART 1", "D 40", "PART 2", "D 40", "run_ended"}, run, "lathe-1", state);
    wait_until_derived();
    const auto parts = store_->measurements.parts({.run = run}, {});
    ASSERT_EQ(parts->size(), 2u);
    EXPECT_EQ(parts->at(1).verdict, Verdict::Good) << "the next part began: it was whole";
    EXPECT_EQ(parts->at(0).verdict, Verdict::Unknown) << run;
    EXPECT_EQ(findings({.run = run}),
              (Texts{"incomplete: the part's end did not come: its run ended " + run}));
    derived_again_.clear();
    const auto again = measurements_->derive(run, {}, {});
    ASSERT_TRUE(again) << again.error().what;
    EXPECT_EQ(again->back().verdict, Verdict::Unknown) << "also derived again";
    EXPECT_EQ(derived_again_, Texts{"lathe-1"}) << "corrections look again";
  }
}

/// The end of a run may never be reported: its gateway is gone, and the server gave it up.
TEST_F(MeasurementsTest, KnowNoVerdictOfAPartWhoseRunWasGivenUp) {
  start();
  use(kBore);
  make_run("r1");
  print({"PART 1", "D 40"});
  ASSERT_TRUE(store_->runs.set_state("r1", storage::RunState::Interrupted, "lost"));
  make_run("r2");
  print({"PART 2", "D 40", "run_ended"}, "r2");
  wait_until_derived();
  EXPECT_EQ(judged(), (Texts{"1 unknown", "2 good"}));
}

/// Another version is in force before the part's end came.
TEST_F(MeasurementsTest, KnowNoVerdictOfAPartWhoseTemplateIsReplaced) {
  const std::string ended = std::string(kBore) +
                            "unknown = \"none\"\n[[line]]\nform = \"END\"\n"
                            "ends_part = true\n";
  start();
  use(ended, storage::TemplateScope::Machine, "lathe-1");
  print({"PART 1", "D 40"}, "");
  wait_until_derived();
  use(ended + "ignore = false\n", storage::TemplateScope::Machine, "lathe-1");
  print({"PART 2", "D 40", "END"}, "");
  wait_until_derived();
  const auto parts = store_->measurements.parts({}, {});
  ASSERT_EQ(parts->size(), 2u);
  EXPECT_EQ(parts->at(1).verdict, Verdict::Unknown);
  EXPECT_EQ(parts->at(0).verdict, Verdict::Good);
}

/// A control paused in 40.09, or its line was lost.
TEST_F(MeasurementsTest, TakeNothingFromALineThatIsNotWhole) {
  start();
  use(kBore);
  make_run("r1");
  print({"PART 1", measurement::cut_line("D 40"), "9", "PART 2", "D 40", "run_ended"});
  wait_until_derived();
  EXPECT_EQ(all().size(), 1u);
  EXPECT_EQ(judged(), (Texts{"1 unknown", "2 good"}));
  EXPECT_EQ(findings({.run = "r1"}),
            (Texts{"incomplete: 'D 40' is not whole: it ended without its end of block, nothing is "
                   "taken from it",
                   "unmatched: 9"}));
}

TEST_F(MeasurementsTest, ListLinesThatNothingKnows) {
  start();
  use(kBore);
  make_run("r1");
  print({"PART 1", "D 40", "LOAD 12", "", "run_ended"});
  wait_until_derived();
  EXPECT_EQ(findings({.run = "r1"}), (Texts{"unmatched: LOAD 12"}));
  EXPECT_EQ(store_->measurements.parts({}, {})->at(0).findings, 1u);
}

TEST_F(MeasurementsTest, LeaveOtherProgramsAlone) {
  start();
  use(kBore, storage::TemplateScope::Program, "O0200");
  make_run("r1");
  print({"PART 1", "D 40", "run_ended"});
  wait_until_derived();
  EXPECT_TRUE(all().empty());
  EXPECT_TRUE(findings().empty());
  EXPECT_TRUE(store_->measurements.underived()->empty()) << "but they are passed";
}

TEST_F(MeasurementsTest, TakeWhatAMachinePrintsOutsideRuns) {
  start();
  use(kBore, storage::TemplateScope::Machine, "lathe-1");
  print({"PART 1", "D 40", "PART 2"}, "");
  print({"PART 9", "D 40"}, "", "lathe-2");
  wait_until_derived();
  ASSERT_EQ(all().size(), 1u);
  EXPECT_EQ(all()[0].run, "");
  EXPECT_EQ(all()[0].machine, "lathe-1");
  EXPECT_EQ(judged(), (Texts{"1 good"}));
}

TEST_F(MeasurementsTest, OfAMacroMindOnlyItsOwnLines) {
  start();
  use(kBore, storage::TemplateScope::Macro, "O9712");
  make_run("r1");
  print({"SOMETHING ELSE", "PART 1", "D 40", "GARBLED", "run_ended"});
  wait_until_derived();
  EXPECT_EQ(all().size(), 1u);
  EXPECT_EQ(findings(), (Texts{"unmatched: GARBLED"})) << "only while a part of it is open";
}

TEST_F(MeasurementsTest, TakeTheProgramsTemplateFirst) {
  start();
  use(kBore, storage::TemplateScope::Machine, "lathe-1");
  ASSERT_TRUE(
      measurements_->push("own", "[[line]]\nform='D {actual}'\ncharacteristic='own'\n", "anna"));
  ASSERT_TRUE(measurements_->assign(
      {.scope = storage::TemplateScope::Program, .subject = "O0100", .name = "own"}, "anna"));
  make_run("r1");
  print({"D 40", "PART 1", "run_ended"});
  wait_until_derived();
  ASSERT_EQ(all().size(), 1u);
  EXPECT_EQ(all()[0].characteristic.name, "own");
  EXPECT_TRUE(findings().empty()) << "the machine's template knows PART";
}

TEST_F(MeasurementsTest, JudgeAPartAtOnceAndHold) {
  start();
  use(kBore);
  make_run("r1");
  print({"PART 1", "D 39.9"});
  wait_until_derived();
  EXPECT_EQ(judged(), (Texts{"1 rework so far"}));
  EXPECT_EQ(held(1),
            (Texts{"queue of lathe-1: part 1, serial 1, is rework: D is 39.9 mm, 0.08 below the "
                   "lower limit 39.98"}));
  print({"D 40.5", "D 40.6", "run_ended"});
  wait_until_derived();
  EXPECT_EQ(judged(), (Texts{"1 rework so far", "1 scrap so far", "1 scrap"}));
  EXPECT_EQ(held(2).at(1),
            "machine of lathe-1: part 1, serial 1, is scrap: D is 40.5 mm, 0.48 above the upper "
            "limit 40.02; 1 more value is scrap");
  EXPECT_EQ(store_->measurements.parts({}, {})->at(0).verdict, Verdict::Scrap);
}

/// What was found wrong with the report is why a part is unknown.
TEST_F(MeasurementsTest, AHoldForAnUnknownPartSaysWhatIsMissing) {
  start();
  use("expected = 2\n[[line]]\nform = \"D {actual}\"\ncharacteristic = \"D\"\nnominal = "
      "40\ntolerance = 1\n[verdict]\nunknown = \"hold_queue\"\n");
  make_run("r1");
  print({"D 40", "run_ended"});
  wait_until_derived();
  const std::string why = held(1).at(0);
  EXPECT_TRUE(why.starts_with("queue of lathe-1: part 1 is unknown: missing: ")) << why;
}

/// A kill between the commit and the hold: it is carried out by the next server.
TEST_F(MeasurementsTest, HoldAfterARestart) {
  start();
  use(kBore);
  make_run("r1");
  print({"PART 1", "D 40.5"});
  wait_until_derived();
  held(1);
  measurements_.reset();
  start();
  wait_until_derived();
  print({"D 40.5"});
  wait_until_derived();
  EXPECT_EQ(held(1).size(), 1u) << "carried out once";
  measurements_.reset();
  auto state = store_->measurements.state("lathe-1").value();
  const std::string none = R"("due":[])";
  ASSERT_NE(state.find(none), std::string::npos) << state;
  state.replace(state.find(none), none.size(), R"("due":[{"part":1,"action":"hold_machine"}])");
  ASSERT_TRUE(store_->measurements.save_state("lathe-1", state));
  start();
  EXPECT_EQ(held(2).size(), 2u);
}

TEST_F(MeasurementsTest, ContinueAPartOverARestart) {
  start();
  use(kBore);
  make_run("r1");
  print({"PART 1", "D 40"});
  wait_until_derived();
  measurements_.reset();
  print({"D 40.001", "run_ended"});
  reopen();
  start();
  wait_until_derived();
  EXPECT_EQ(all().size(), 2u);
  const auto parts = store_->measurements.parts({}, {});
  ASSERT_EQ(parts->size(), 1u);
  EXPECT_EQ(parts->at(0).measurements, 2u);
}

TEST_F(MeasurementsTest, KeepOneVersionForARun) {
  start();
  use(kBore);
  make_run("r1");
  print({"PART 1", "D 40"});
  wait_until_derived();
  use("[[line]]\nform='D {actual}'\ncharacteristic='new'\n");
  print({"D 40", "run_ended"});
  make_run("r2");
  print({"D 40", "run_ended"}, "r2");
  wait_until_derived();
  const auto rows = all();
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1].characteristic.name, "D");
  EXPECT_EQ(rows[2].characteristic.name, "new");
}

TEST_F(MeasurementsTest, CanBeDerivedAgain) {
  start();
  use(kBore);
  make_run("r1");
  print({"PART 1", "D 40", "LOAD 12"});
  wait_until_derived();
  EXPECT_EQ(measurements_->derive("r1", {}, {}).error().code, Errc::Conflict) << "it continues";
  print({"run_ended"});
  wait_until_derived();
  use(std::string(kBore) + "[[line]]\nform='LOAD {actual}'\ncharacteristic='load'\n",
      storage::TemplateScope::Program);
  const auto again = measurements_->derive("r1", {}, {});
  ASSERT_TRUE(again) << again.error().what;
  ASSERT_EQ(again->size(), 1u);
  EXPECT_EQ(again->at(0).template_version, 2u);
  EXPECT_EQ(all({.run = "r1"}).size(), 2u);
  EXPECT_EQ(all({.run = "r1", .with_superseded = true}).size(), 3u);
  EXPECT_TRUE(findings({.run = "r1"}).empty());
  const auto first = measurements_->derive("r1", "bore", 1);
  ASSERT_TRUE(first) << first.error().what;
  EXPECT_EQ(all({.run = "r1"}).size(), 1u);
  EXPECT_EQ(measurements_->derive("r9", {}, {}).error().code, Errc::NotFound);
  EXPECT_EQ(measurements_->derive("r1", "other", {}).error().code, Errc::NotFound);
}

TEST_F(MeasurementsTest, TakeNothingOfAnotherMachinesRun) {
  start();
  use(kBore, storage::TemplateScope::Macro, "O9712");
  make_run("r1", "lathe-1");
  print({"PART 1", "D 40"}, "r1", "lathe-2");
  wait_until_derived();
  EXPECT_TRUE(all().empty());
}

TEST_F(MeasurementsTest, RefuseABadTemplate) {
  start();
  EXPECT_EQ(measurements_->push("bore", "[[line]]\n", "anna").error().code, Errc::Syntax);
  EXPECT_TRUE(store_->report_templates.list()->empty());
}

}  // namespace
}  // namespace dripline::measurements
