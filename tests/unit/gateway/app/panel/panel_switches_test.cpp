// The switches of the panel that decide how a program runs, set while it runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/gateway_fixture.hpp"
#include "tests/unit/gateway/app/toy_motion.hpp"

namespace dripline::gateway {
namespace {

using dds::CommandAction;
using dds::Execution;
using dds::RunOutcome;
using dds::SwitchState;
using testing::Contains;
using testing::HasSubstr;

class SwitchFixture : public GatewayFixture {
 public:
  explicit SwitchFixture(const interpreter::Dialect& control, const std::string& toml = "",
                         const std::string& speed = "1x")
      : GatewayFixture(control, setup_from(toml), speed) {}
  dds::CommandResult turn(const std::string& name, bool is_on) {
    dds::Command asked = command(CommandAction::Switch);
    asked.argument = name;
    asked.value = is_on ? 1 : 0;
    return send(asked);
  }
  bool give(CommandAction action) { return send(command(action)).accepted; }
  bool shows(Execution execution) {
    return run_until([&] { return status && status->execution == execution; });
  }
  /// Until the next run has ended and its status has come.
  RunOutcome ends() {
    ++ended_runs_;
    (void)run_until([&] {
      return count(dds::RecordKind::RunEnded) == ended_runs_ && gateway->status().run.empty();
    });
    status = gateway->status();  // the last that was sent may be older
    return dds::decode_run_end(records.back().text)->outcome;
  }
  double feed() const { return status->feed_mm_per_min; }
  /// As of now: the status is sent a few times a second.
  dds::PanelSwitches switches() const { return *gateway->status().switches; }
  std::vector<std::string> messages() const {
    std::vector<std::string> texts;
    for (const auto& record : records)
      if (record.kind == dds::RecordKind::Message && record.device.empty())
        texts.push_back(record.text);
    return texts;
  }

 private:
  std::size_t ended_runs_ = 0;
};

struct OptionalStopCase {
  std::string name;
  const interpreter::Dialect& control;
  std::string program;
};
void PrintTo(const OptionalStopCase& shown, std::ostream* out) {
  *out << shown.name;
}
class OptionalStopAtTheGateway : public testing::TestWithParam<OptionalStopCase> {};

// The whole program is interpreted long before its M01 is executed.
TEST_P(OptionalStopAtTheGateway, TakesEffectUntilTheStopIsReached) {
  SwitchFixture fixture(GetParam().control);
  fixture.push("1", GetParam().program);
  ASSERT_TRUE(fixture.start("1").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status && fixture.feed() > 0; }));
  EXPECT_EQ(fixture.switches().optional_stop, SwitchState::Off);
  ASSERT_TRUE(fixture.turn("optional_stop", true).accepted);
  ASSERT_TRUE(fixture.shows(Execution::OptionalStop));
  EXPECT_EQ(fixture.switches().optional_stop, SwitchState::On);
  ASSERT_TRUE(fixture.turn("optional_stop", false).accepted);
  ASSERT_TRUE(fixture.give(CommandAction::Resume));
  EXPECT_EQ(fixture.ends(), RunOutcome::Completed) << "the second M01 does not stop";
  EXPECT_EQ(fixture.count(dds::RecordKind::Stop), 1U);
  EXPECT_THAT(fixture.messages(), Contains("switch optional_stop on"));
}

INSTANTIATE_TEST_SUITE_P(
    , OptionalStopAtTheGateway,
    testing::Values(OptionalStopCase{"centurion", interpreter::kCenturionDialect,
                                     "O1\nG20 G98 F100\nG1 Z-2\nM1\nZ0\nM1\nM30\n"},
                    OptionalStopCase{"fanuc", interpreter::kFanucDialect,
                                     "O1\nG21 G90 G1 Z-50. F2000\nM01\nZ0.\nM01\nM30\n"},
                    OptionalStopCase{"rs274ngc", interpreter::kRs274NgcDialect,
                                     "G21 G90 G1 Z-50 F2000\nM1\nZ0\nM1\nM2\n"},
                    OptionalStopCase{"tektronix", interpreter::kTektronix1704Dialect,
                                     "lost\nN1G00X20000F2000\nN2M01\nN3X0\nN4M01\nN5M02\n"}),
    [](const auto& i) { return i.param.name; });

std::string moves(int count, const std::string& last) {
  std::string text = "G21 G90 F6000\nG1 X1\n";
  for (int i = 1; i <= count; ++i) text += "X" + std::to_string(i % 2) + "\n";
  return text + last;
}

// What is read ahead was read with the switch as it was; the record states up to where.
TEST(BlockSkip, TakesEffectForTheBlocksThatAreNotReadYet) {
  SwitchFixture fixture(interpreter::kRs274NgcDialect, "", "1000x");
  fixture.push("1", moves(40'000, "/Y55\nX5\nM2\n"));
  ASSERT_TRUE(fixture.start("1").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status && fixture.status->executed > 10; }));
  ASSERT_TRUE(fixture.turn("block_skip", true).accepted);
  EXPECT_EQ(fixture.switches().block_skip, SwitchState::On);
  EXPECT_EQ(fixture.ends(), RunOutcome::Completed);
  EXPECT_EQ(fixture.status->position[0], 5);
  EXPECT_EQ(fixture.status->position[1], 0) << "/Y55 was skipped";
  EXPECT_THAT(fixture.messages(),
              Contains(HasSubstr("switch block_skip on: takes effect after block ")));
}

TEST(BlockSkip, IsForTheNextStartWhereTheProgramIsReadToItsEnd) {
  SwitchFixture fixture(interpreter::kRs274NgcDialect);
  fixture.push("1", "G21 G90 G1 F6000 X50\n/Y5\nM2\n");
  ASSERT_TRUE(fixture.start("1").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status && fixture.feed() > 0; }));
  const auto reply = fixture.turn("block_skip", true);
  EXPECT_TRUE(reply.accepted);
  EXPECT_THAT(reply.reason, HasSubstr("takes effect at the next start"));
  EXPECT_EQ(fixture.ends(), RunOutcome::Completed);
  EXPECT_EQ(fixture.status->position[1], 5);
  fixture.push("2", "G21 G90 G1 F6000 X0 Y0\n/Y5\nM2\n");
  ASSERT_TRUE(fixture.start("2").accepted);
  EXPECT_EQ(fixture.ends(), RunOutcome::Completed);
  EXPECT_EQ(fixture.status->position[1], 0);
}

TEST(BlockSkip, HasTheLevelsOfTheControl) {
  SwitchFixture fixture(interpreter::kFanucDialect, "[control]\nskip_levels = [3]\n", "max");
  EXPECT_EQ(fixture.switches().skip_levels, "3") << "as the setup has it";
  ASSERT_TRUE(fixture.turn("block_skip_2", true).accepted);
  ASSERT_TRUE(fixture.turn("block_skip_3", false).accepted);
  EXPECT_FALSE(fixture.turn("block_skip_10", true).accepted);
  fixture.push("1", "O1\nG21 G90 G1 F6000 X1. Y1. Z1.\n/X10.\n/2 Y10.\n/3 Z10.\nM30\n");
  ASSERT_TRUE(fixture.start("1").accepted);
  EXPECT_EQ(fixture.ends(), RunOutcome::Completed);
  EXPECT_EQ(fixture.status->position[0], 10);
  EXPECT_EQ(fixture.status->position[1], 1);
  EXPECT_EQ(fixture.status->position[2], 10);
  EXPECT_EQ(fixture.switches().skip_levels, "2");
  SwitchFixture one_level(interpreter::kCenturionDialect);
  EXPECT_FALSE(one_level.turn("block_skip_2", true).accepted);
}

// CEN-224, error 605: changed only while halted; 75 in/min and no spindle.
TEST(DryRun, OfACenturionIsChangedWhileHalted) {
  SwitchFixture fixture(interpreter::kCenturionDialect);
  fixture.push("1", "O1\nG20 G98 F10 G97 S500 M3\nG1 Z-4\nM30\n");
  ASSERT_TRUE(fixture.start("1").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status && fixture.feed() > 250; }));
  EXPECT_EQ(fixture.turn("dry_run", true).reason,
            "dry run is changed only while the program is halted: hold it first");
  EXPECT_EQ(fixture.switches().dry_run, SwitchState::Off);
  ASSERT_TRUE(fixture.give(CommandAction::Hold));
  ASSERT_TRUE(fixture.run_until(
      [&] { return fixture.status->execution == Execution::FeedHold && fixture.feed() == 0; }));
  EXPECT_EQ(fixture.status->spindle_rpm, 500);
  ASSERT_TRUE(fixture.turn("dry_run", true).accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->spindle_rpm == 0; }));
  EXPECT_EQ(fixture.switches().dry_run, SwitchState::On);
  ASSERT_TRUE(fixture.give(CommandAction::Resume));
  ASSERT_TRUE(fixture.run_until([&] { return fixture.feed() > 1904; }));
  EXPECT_NEAR(fixture.feed(), 75 * 25.4, 1e-6);
  EXPECT_EQ(fixture.status->spindle_rpm, 0);
  EXPECT_FALSE(fixture.turn("dry_run", false).accepted);
  EXPECT_EQ(fixture.ends(), RunOutcome::Completed);
  EXPECT_THAT(fixture.messages(), Contains("switch dry_run on"));
}

TEST(DryRun, GivesTheSpindleBackBeforeTheNextMove) {
  SwitchFixture fixture(interpreter::kCenturionDialect);
  ASSERT_TRUE(fixture.turn("dry_run", true).accepted);
  fixture.push("1", "O1\nG20 G98 F10 G97 S500 M3\nG1 Z-1\nM0\nZ0\nM30\n");
  ASSERT_TRUE(fixture.start("1").accepted);
  ASSERT_TRUE(fixture.shows(Execution::ProgramStopped));
  EXPECT_EQ(fixture.status->spindle_rpm, 0);
  ASSERT_TRUE(fixture.turn("dry_run", false).accepted);
  (void)fixture.run_until([] { return true; });
  EXPECT_EQ(fixture.status->spindle_rpm, 0) << "not before cycle start";
  ASSERT_TRUE(fixture.give(CommandAction::Resume));
  ASSERT_TRUE(fixture.run_until([&] { return fixture.feed() > 253; }));
  EXPECT_NEAR(fixture.feed(), 254, 1e-6);
  EXPECT_EQ(fixture.status->spindle_rpm, 500);
  EXPECT_EQ(fixture.ends(), RunOutcome::Completed);
  EXPECT_THAT(fixture.messages(), Contains("dry run"));
}

TEST(DryRun, OfAFanucControlTakesEffectInTheMoveThatRuns) {
  SwitchFixture fixture(interpreter::kFanucDialect, "[control]\ndry_run_feed = 1200\n");
  fixture.push("1", "O1\nG21 G90 S500 M03\nG1 X100. F300\nM30\n");
  ASSERT_TRUE(fixture.start("1").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status && fixture.feed() > 299; }));
  ASSERT_TRUE(fixture.turn("dry_run", true).accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.feed() > 1199; }));
  EXPECT_LT(fixture.status->position[0], 50) << "the same move";
  EXPECT_EQ(fixture.status->spindle_rpm, 500) << "the spindle runs";
  ASSERT_TRUE(fixture.turn("dry_run", false).accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.feed() < 301; }));
  EXPECT_EQ(fixture.ends(), RunOutcome::Completed);
}

TEST(DryRun, IsRefusedWhereThereIsNone) {
  SwitchFixture fanuc(interpreter::kFanucDialect);
  EXPECT_EQ(fanuc.turn("dry_run", true).reason,
            "no dry run: [control] dry_run_feed of the setup gives the panel one");
  EXPECT_EQ(fanuc.switches().dry_run, SwitchState::Unknown);
  SwitchFixture tnc(interpreter::kTnc155Dialect);
  EXPECT_EQ(tnc.turn("dry_run", true).reason, "control tnc155 has no dry run");
  EXPECT_EQ(tnc.turn("block_skip", true).reason,
            "no switch 'block_skip': single_block, test_run, emergency_stop");
}

// A device is given what the program does: there the feeds of the program change, at a start.
TEST(DryRun, OfADeviceBeginsWithTheNextStart) {
  SwitchFixture fixture(interpreter::kFanucDialect, "[control]\ndry_run_feed = 1200\n", "1x");
  std::vector<double> feeds;
  class Recording final : public interpreter::EventFilter {
   public:
    Recording(interpreter::EventSink& out, std::vector<double>& feeds)
        : EventFilter(out), feeds_(feeds) {}
    void on_line(const interpreter::Line& line) override {
      feeds_.push_back(line.feed.length().mm());
      out().on_line(line);
    }

   private:
    std::vector<double>& feeds_;
  };
  class Device final : public ToyMotion {
   public:
    Device(machine::ExecutionSink& sink, std::vector<double>& feeds)
        : ToyMotion(sink), front_(ToyMotion::events(), feeds) {}
    interpreter::EventSink& events() override { return front_; }

   private:
    Recording front_;
  };
  fixture.motion = [&feeds](machine::ExecutionSink& sink) {
    return std::make_unique<Device>(sink, feeds);
  };
  fixture.restart_gateway();
  fixture.push("1", "O1\nG21 G90\nG1 X1. F300\nM30\n");
  ASSERT_TRUE(fixture.start("1").accepted);
  EXPECT_EQ(fixture.turn("dry_run", true).reason, "takes effect at the next start");
  EXPECT_EQ(fixture.ends(), RunOutcome::Completed);
  fixture.push("2", "O2\nG21 G90\nG1 X2. F300\nM30\n");
  ASSERT_TRUE(fixture.start("2").accepted);
  EXPECT_EQ(fixture.ends(), RunOutcome::Completed);
  EXPECT_EQ(feeds, (std::vector<double>{300, 1200}));
}

TEST(MachineLock, RunsProgramsAndLeavesTheAxes) {
  SwitchFixture fixture(interpreter::kFanucDialect, "", "10x");
  fixture.push("1", "O1\nG21 G90 G1 X7. F2000\nM30\n");
  ASSERT_TRUE(fixture.start("1").accepted);
  ASSERT_EQ(fixture.ends(), RunOutcome::Completed);
  ASSERT_TRUE(fixture.turn("machine_lock", true).accepted);
  fixture.push("2", "O2\nG21 G90 G1 X90. F2000\nDPRNT[ON]\nM30\n");
  ASSERT_TRUE(fixture.start("2").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->position[0] > 20; }))
      << "the display follows the program";
  EXPECT_THAT(fixture.turn("machine_lock", false).reason, HasSubstr("run-2 is active"));
  ASSERT_EQ(fixture.ends(), RunOutcome::Completed);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->run.empty(); }));
  EXPECT_EQ(fixture.status->position[0], 7);
  EXPECT_EQ(fixture.switches().machine_lock, SwitchState::On);
  EXPECT_THAT(fixture.messages(), Contains("machine lock: the axes do not move"));
  EXPECT_EQ(fixture.lines(), std::vector<std::string>{"ON"});
  ASSERT_TRUE(fixture.turn("machine_lock", false).accepted);
}

TEST(MachineLock, IsRefusedWhereADeviceMovesTheAxes) {
  SwitchFixture fixture(interpreter::kFanucDialect);
  fixture.motion = [](machine::ExecutionSink& sink) { return std::make_unique<ToyMotion>(sink); };
  fixture.restart_gateway();
  EXPECT_EQ(fixture.turn("machine_lock", true).reason,
            "no machine lock: the axes of this machine are moved by a device");
  EXPECT_EQ(fixture.switches().machine_lock, SwitchState::Unknown);
}

}  // namespace
}  // namespace dripline::gateway
