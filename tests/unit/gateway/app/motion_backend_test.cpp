#include <gtest/gtest.h>

#include "tests/unit/gateway/app/gateway_fixture.hpp"
#include "tests/unit/gateway/app/toy_control.hpp"
#include "tests/unit/gateway/app/toy_motion.hpp"

/// The gateway on a back end that is not the simulated machine and can do less.
namespace dripline::gateway {
namespace {

using dds::CommandAction;
using dds::RunOutcome;

class MotionBackendTest : public testing::Test {
 protected:
  MotionBackendTest() {
    fixture.motion = [](machine::ExecutionSink& sink) { return std::make_unique<ToyMotion>(sink); };
    fixture.restart_gateway();
  }
  dds::RunEndText run(const std::string& text) {
    fixture.push("O1", text);
    const auto started = fixture.start("O1");
    EXPECT_TRUE(started.accepted) << started.reason;
    return fixture.ended();
  }
  std::string refusal_of(CommandAction action, const std::string& argument, double value) {
    dds::Command command = fixture.command(action);
    command.argument = argument;
    command.value = value;
    return fixture.send(command).reason;
  }
  GatewayFixture fixture{"1x"};  // a machine in real time
};

TEST_F(MotionBackendTest, RunsAProgramAndCountsWhatTheBackEndHasExecuted) {
  const auto end = run("X1\nOUT A\nX4\nOUT B\nEND\n");
  EXPECT_EQ(end.outcome, RunOutcome::Completed);
  EXPECT_EQ(end.executed, 5U);
  EXPECT_EQ(fixture.lines(), (std::vector<std::string>{"A", "B"}));
  EXPECT_TRUE(fixture.run_until([&] { return fixture.status->position[0] == 4; }));
  EXPECT_EQ(fixture.status->axes, 1U) << "X alone";
}

TEST_F(MotionBackendTest, EndsARunAtABlockThatTheBackEndCannotExecute) {
  const auto probed = run("X1\nPROBE\nEND\n");
  EXPECT_EQ(probed.outcome, RunOutcome::Alarmed);
  EXPECT_EQ(probed.reason, "MCH0008 this machine cannot probe");
  EXPECT_EQ(probed.executed, 1U) << "everything before it";
}

TEST_F(MotionBackendTest, EndsARunAtAnArcAFeedOrAThreadThatTheBackEndCannotExecute) {
  EXPECT_EQ(run("ARC\nEND\n").reason, "MCH0008 this machine cannot move on arcs");
  EXPECT_EQ(run("THREAD\nEND\n").reason, "MCH0008 this machine cannot cut threads");
  EXPECT_EQ(run("X1 PER REVOLUTION\nEND\n").reason,
            "MCH0008 this machine cannot feed per revolution");
}

TEST_F(MotionBackendTest, AnswersTheProgramsQuestionsForAnInput) {
  EXPECT_EQ(run("PIN 3\nEND\n").outcome, RunOutcome::Completed);
  EXPECT_EQ(fixture.lines(), std::vector<std::string>{"high"});
}

TEST_F(MotionBackendTest, BeginsWhereTheAxesAreWithoutAStartInTheSetup) {
  ASSERT_EQ(run("X7\nEND\n").outcome, RunOutcome::Completed);
  EXPECT_EQ(run("X9\nEND\n").outcome, RunOutcome::Completed);
}

TEST_F(MotionBackendTest, RefusesASetupThatDisagreesWithTheMachine) {
  fixture.setup.start.set(interpreter::Axis::X, Length::mm(0));
  fixture.restart_gateway();
  ASSERT_EQ(run("X7\nEND\n").outcome, RunOutcome::Completed);
  const auto second = fixture.start("O1");
  EXPECT_FALSE(second.accepted);
  EXPECT_EQ(second.reason, "X is at 7 mm, the setup begins at 0 mm");
}

/// A device that reads programs of the control by itself, in inches.
class InchMotion final : public ToyMotion {
 public:
  explicit InchMotion(machine::ExecutionSink& sink)
      : ToyMotion(sink), capabilities_(ToyMotion::capabilities()) {
    capabilities_.reader = {toy_control().name, interpreter::Units::Inch};
  }
  const machine::MotionCapabilities& capabilities() const override { return capabilities_; }

 private:
  machine::MotionCapabilities capabilities_;
};

TEST_F(MotionBackendTest, RefusesASetupInAnotherUnitThanTheDevices) {
  fixture.motion = [](machine::ExecutionSink& sink) { return std::make_unique<InchMotion>(sink); };
  fixture.restart_gateway();
  fixture.push("O1", "X7\nEND\n");
  const auto refused = fixture.start("O1");
  EXPECT_FALSE(refused.accepted);
  EXPECT_TRUE(refused.reason.starts_with("the machine's unit is in, that of the setup mm: "))
      << refused.reason;
  fixture.setup.units = interpreter::Units::Inch;
  fixture.restart_gateway();
  EXPECT_EQ(run("X7\nEND\n").outcome, RunOutcome::Completed);
}

TEST_F(MotionBackendTest, RefusesCommandsThatTheBackEndCannotCarryOut) {
  EXPECT_EQ(refusal_of(CommandAction::FeedOverride, "", 0.5), "this machine has no feed_override");
  EXPECT_EQ(refusal_of(CommandAction::RapidOverride, "", 0.5),
            "this machine has no rapid_override");
  EXPECT_EQ(refusal_of(CommandAction::SpindleOverride, "", 1.1),
            "this machine has no spindle_override");
  EXPECT_EQ(refusal_of(CommandAction::Switch, "single_block", 1),
            "this machine has no single_block");
  EXPECT_EQ(refusal_of(CommandAction::Switch, "optional_stop", 1), "");
}

TEST_F(MotionBackendTest, HoldsResumesAndAborts) {
  fixture.serves_text = false;
  fixture.push("O1", "X1\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  EXPECT_TRUE(fixture.send(fixture.command(CommandAction::Hold)).accepted);
  EXPECT_TRUE(
      fixture.run_until([&] { return fixture.status->execution == dds::Execution::FeedHold; }));
  EXPECT_TRUE(fixture.send(fixture.command(CommandAction::Resume)).accepted);
  EXPECT_TRUE(fixture.send(fixture.command(CommandAction::Abort)).accepted);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Aborted);
}

/// A back end whose programs are looked through before their first move.
class ProgramCheckTest : public MotionBackendTest {
 protected:
  ProgramCheckTest() {
    fixture.motion = [](machine::ExecutionSink& sink) {
      return std::make_unique<ToyMotion>(sink, true);
    };
    fixture.restart_gateway();
  }
};

TEST_F(ProgramCheckTest, RefusesWhatTheMachineCannotDoBeforeTheFirstMove) {
  const auto end = run("X1\nOUT A\nTHREAD\nEND\n");
  EXPECT_EQ(end.outcome, RunOutcome::Alarmed);
  EXPECT_EQ(end.reason,
            "MCH0008 this machine cannot cut threads (line 3, found before the first move)");
  EXPECT_EQ(end.executed, 0U);
  EXPECT_EQ(fixture.count(dds::RecordKind::Alarm), 1U);
  EXPECT_TRUE(fixture.lines().empty());
  EXPECT_EQ(fixture.status->position[0], 0);
}

TEST_F(ProgramCheckTest, RunsWhatItHasLookedThroughOnce) {
  const auto end = run("X1\nOUT A\nX4\nOUT B\nEND\n");
  EXPECT_EQ(end.outcome, RunOutcome::Completed) << end.reason;
  EXPECT_EQ(end.executed, 5U);
  EXPECT_EQ(fixture.lines(), (std::vector<std::string>{"A", "B"}));
}

TEST_F(ProgramCheckTest, EndsAtAQuestionWhoseAnswerIsNotKnown) {
  const auto end = run("X1\nPIN 3\nTHREAD\nEND\n");
  EXPECT_EQ(end.reason, "MCH0008 this machine cannot cut threads");
  EXPECT_EQ(end.executed, 2U);
}

TEST_F(ProgramCheckTest, DoesNotWaitForTextForever) {
  fixture.push("O1", "X1\nTHREAD\nEND\n");
  fixture.serves_text = false;
  ASSERT_TRUE(fixture.start("O1").accepted);
  const auto is_looking = [&] {
    return fixture.status->message.find("looking through the program") != std::string::npos;
  };
  EXPECT_TRUE(fixture.run_until(is_looking)) << fixture.status->message;
  EXPECT_TRUE(fixture.run_until([&] { return !is_looking(); }));
  fixture.serves_text = true;
  EXPECT_EQ(fixture.ended().executed, 1U) << "an alarm at its place";
}

TEST_F(ProgramCheckTest, IsOverBeforeCycleStart) {
  fixture.make_attended();
  fixture.restart_gateway();
  fixture.push("O1", "X1\nEND\n");
  fixture.serves_text = false;
  ASSERT_TRUE(fixture.start("O1").accepted);
  EXPECT_NE(fixture.panel("cycle-start").find("still looked through"), std::string::npos);
  fixture.serves_text = true;
  EXPECT_TRUE(fixture.run_until(
      [&] { return fixture.panel("cycle-start").find("looked") == std::string::npos; }));
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
}

TEST(MotionChoice, NamesTheBackEndsItKnows) {
  EXPECT_TRUE(check_motion("simulated"));
  EXPECT_TRUE(check_motion("grbl:/dev/ttyACM0"));
  EXPECT_TRUE(check_motion("grbl:tcp://board:23"));
  EXPECT_TRUE(check_motion("linuxcnc:deploy/examples/linuxcnc/mill.ini"));
  EXPECT_TRUE(check_motion("grbl:/dev/ttyUSB0,57600"));
  EXPECT_TRUE(check_motion("line:/dev/ttyUSB0"));
  EXPECT_FALSE(check_motion("line:"));
  EXPECT_EQ(check_motion("real").error().what,
            "motion 'real' is not known: simulated, linuxcnc:INI, grbl:ADDRESS, line:ADDRESS");
}

TEST(MotionChoice, RefusesAnAddressThatIsNone) {
  EXPECT_EQ(check_motion("grbl").error().code, Errc::Syntax);
  EXPECT_EQ(check_motion("grbl:board").error().code, Errc::Syntax);
  EXPECT_EQ(check_motion("linuxcnc:").error().code, Errc::Syntax);
  EXPECT_EQ(check_motion("linuxcnc:/no/mill.ini").error().code, Errc::NotFound);
  EXPECT_EQ(check_motion("grbl:/dev/ttyUSB0,fast").error().code, Errc::Syntax);
  EXPECT_EQ(check_motion("simulated:/dev/ttyUSB0").error().code, Errc::Syntax);
}

TEST(MotionChoice, ARealMachineIsAttendedUnlessItsOptionsSayOtherwise) {
  EXPECT_FALSE(is_real_motion("simulated"));
  EXPECT_TRUE(is_real_motion("grbl:/dev/ttyACM0"));
  GatewayOptions options;
  options.machine = "mill-1";
  options.control = "fanuc";
  options.state = "/tmp/none";
  ASSERT_TRUE(complete(options));
  EXPECT_TRUE(options.is_unattended);
  options.motion = "grbl:/dev/ttyACM0";
  ASSERT_TRUE(complete(options));
  EXPECT_FALSE(options.is_unattended);
}

TEST(MotionChoice, RefusesAnotherSpeedForAMachineInRealTime) {
  machine::MotionCapabilities real;
  EXPECT_TRUE(check_speed(real, Speed{1}));
  EXPECT_FALSE(check_speed(real, Speed{100}));
  EXPECT_FALSE(check_speed(real, Speed{std::nullopt}));
  real.simulated_time = true;
  EXPECT_TRUE(check_speed(real, Speed{100}));
}

}  // namespace
}  // namespace dripline::gateway
