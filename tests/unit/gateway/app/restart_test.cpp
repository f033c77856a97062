#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/gateway_fixture.hpp"

/// A program that was interrupted and is started again in its middle, at the gateway.
namespace dripline::gateway {
namespace {

using dds::CommandAction;
using dds::Execution;
using dds::RunOutcome;
using testing::HasSubstr;

const std::string kContour =
    "0 BEGIN PGM 16 MM\n1 TOOL DEF 1 L+20 R+5\n2 TOOL CALL 1 Z S1000\n3 CYCL DEF 7.0 DATUM SHIFT\n"
    "4 CYCL DEF 7.1 X+100\n5 L X+0 Y-20 R0 F9000 M03\n6 L X+0 Y+0 RR F9000\n7 STOP\n"
    "8 L X+0 Y+50 RR\n9 L X+60 Y+50 RR F9000\n10 L X+60 Y-20 R0\n11 L X+70 Y-20\n"
    "12 END PGM 16 MM\n";

class RestartShop : public GatewayFixture {
 public:
  RestartShop() : GatewayFixture(interpreter::kTnc155Dialect, {}, "max") {}

  dds::CommandResult start_from(const std::string& program, const std::string& from) {
    dds::Command command = start_command(program);
    command.argument = from;
    return send(command);
  }
  /// Stopped, and the status reports it with this.
  bool stops(const std::string& message) {
    return run_until([&] {
      return status && status->execution == Execution::ProgramStopped &&
             status->message.starts_with(message);
    });
  }
  /// The first run up to its stop, and no further.
  void interrupt(const std::string& program) {
    ASSERT_TRUE(start(program).accepted);
    ASSERT_TRUE(stops("program stop"));
    ASSERT_TRUE(send(command(CommandAction::Abort)).accepted);
    ASSERT_EQ(ended().outcome, RunOutcome::Aborted);
  }
  std::array<double, 9> position() const { return status->position; }
};

// HD-192: in a contour: what the run has lost is named, and no axis and no spindle moves.
TEST(TncRestart, RefusesToLoseTheContour) {
  RestartShop fixture;
  fixture.push("16", kContour);
  fixture.interrupt("16");
  const auto before = fixture.position();
  const auto stops = fixture.count(dds::RecordKind::Stop);
  ASSERT_TRUE(fixture.start_from("16", "N9").accepted);
  const auto end = fixture.ended();
  EXPECT_EQ(end.outcome, RunOutcome::Alarmed);
  EXPECT_THAT(end.reason, HasSubstr("TNC-START-UNDEFINED"));
  EXPECT_THAT(end.reason, HasSubstr("block 6 on: start there"));
  EXPECT_EQ(fixture.position(), before);
  EXPECT_EQ(fixture.count(dds::RecordKind::Stop), stops) << "not even asked";
  EXPECT_EQ(fixture.status->modes->spindle, dds::SpindleState::Off);
}

// HD-192: before the contour: tool, shift and spindle are back, after the operator has looked.
TEST(TncRestart, RebuildsToolShiftAndSpindle) {
  RestartShop fixture;
  fixture.push("16", kContour);
  fixture.interrupt("16");
  ASSERT_TRUE(fixture.start_from("16", "N5").accepted);
  ASSERT_TRUE(fixture.stops("operator stop"));
  EXPECT_THAT(fixture.status->message, HasSubstr("operator stop: start at block 5: tool 1 L+20.000 "
                                                 "R+5.000, S 1000 M05, datum shift X+100.000"));
  EXPECT_EQ(fixture.status->modes->tool, 1);
  EXPECT_EQ(fixture.status->modes->spindle, dds::SpindleState::Off);
  ASSERT_TRUE(fixture.send(fixture.command(CommandAction::Resume)).accepted);
  ASSERT_TRUE(fixture.stops("program stop"));
  EXPECT_NEAR(fixture.position()[0], 105, 1e-6) << "X0 of the shifted datum, and the radius";
  EXPECT_EQ(fixture.status->modes->spindle, dds::SpindleState::Clockwise);
  ASSERT_TRUE(fixture.send(fixture.command(CommandAction::Resume)).accepted);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
  EXPECT_NEAR(fixture.position()[0], 170, 1e-6);
}

// HD-194: the machine is where it was stopped, not where a program begins.
TEST(TncRestart, LooksAtWhereTheMachineIs) {
  RestartShop fixture;
  fixture.push("17",
               "0 BEGIN PGM 17 MM\n1 L X+0 Y+0 Z+50 R0 F9000\n2 L Z-5\n3 STOP\n4 L Z+50\n"
               "5 L X+40 Y+40\n6 END PGM 17 MM\n");
  fixture.interrupt("17");
  ASSERT_TRUE(fixture.start_from("17", "N5").accepted);
  ASSERT_TRUE(fixture.stops("operator stop"));
  EXPECT_THAT(fixture.status->message,
              HasSubstr("the program is at Z+50.000, the machine at Z-5.000"));
  ASSERT_TRUE(fixture.send(fixture.command(CommandAction::Resume)).accepted);
  const auto end = fixture.ended();
  EXPECT_EQ(end.outcome, RunOutcome::Alarmed);
  EXPECT_THAT(end.reason, HasSubstr("Z is at -5.000 and the program has it at 50.000 here"));
  EXPECT_NEAR(fixture.position()[0], 0, 1e-6);
}

// HD-193: interrupted in the second of three passes, it returns into it: one more follows.
TEST(TncRestart, ReturnsIntoAnInterruptedRepeat) {
  const std::string program =
      "0 BEGIN PGM 18 MM\n1 L X+0 Y+0 R0 F9000\n2 LBL 1\n3 L IX+10 Y+0\n4 STOP\n5 L X+0 Y+5\n"
      "6 CALL LBL 1 REP 2/2\n7 L X+90 Y+0\n8 END PGM 18 MM\n";
  RestartShop fixture;
  fixture.push("18", program);
  ASSERT_TRUE(fixture.start_from("18", "N5").accepted);
  EXPECT_THAT(fixture.ended().reason, HasSubstr("how often block 6 leads back over it"));
  ASSERT_TRUE(fixture.start_from("18", "N5 pass=2").accepted);
  ASSERT_TRUE(fixture.stops("operator stop"));
  EXPECT_THAT(fixture.status->message, HasSubstr("start at block 5, pass 2: "));
  EXPECT_THAT(fixture.status->message, HasSubstr("LBL 1 1 more times"));
  ASSERT_TRUE(fixture.send(fixture.command(CommandAction::Resume)).accepted);
  ASSERT_TRUE(fixture.stops("program stop")) << "of the third pass";
  ASSERT_TRUE(fixture.send(fixture.command(CommandAction::Resume)).accepted);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed) << "there is no fourth";
  EXPECT_NEAR(fixture.position()[0], 90, 1e-6);
}

// A block that is not in the program, or that the program does not come to.
TEST(TncRestart, RefusesABlockThatIsNotThere) {
  RestartShop fixture;
  fixture.push("16", kContour);
  ASSERT_TRUE(fixture.start_from("16", "N77").accepted);
  const auto end = fixture.ended();
  EXPECT_EQ(end.outcome, RunOutcome::Alarmed);
  EXPECT_THAT(end.reason, HasSubstr("SELECTED BLOCK NOT ADDRESSED: block 77"));
}

}  // namespace
}  // namespace dripline::gateway
