#include <fmt/core.h>

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/jog_fixture.hpp"

/// TK-59: a tape of several programs stays in the reader of a gateway's control, and each start
/// reads the program that comes next.
namespace dripline::gateway {
namespace {

using dds::RunOutcome;
using testing::AllOf;
using testing::HasSubstr;

const std::string kTape = "%\nN1F9000X10000\nN2M02\n%\nN1Y20000\nN2M02\n(TRAILER)\n(END)\n";

class TapeShop : public GatewayFixture {
 public:
  TapeShop() : GatewayFixture(interpreter::kTektronix1704Dialect, {}, "max") {}

  dds::RunEndText run(const std::string& program = "TK") {
    status.reset();
    EXPECT_TRUE(start(program).accepted);
    const auto end = ended();
    EXPECT_TRUE(
        run_until([&] { return status && status->execution == dds::Execution::ProgramCompleted; }));
    return end;
  }
  double at(std::size_t axis) const { return status->position[axis]; }
};

TEST(TapeInTheReader, IsReadOnAtTheNextStart) {
  TapeShop shop;
  shop.push("TK", kTape);
  EXPECT_EQ(shop.run().outcome, RunOutcome::Completed);
  EXPECT_NEAR(shop.at(0), 25.4, 1e-6);
  EXPECT_NEAR(shop.at(1), 0, 1e-6);
  EXPECT_THAT(shop.status->message, HasSubstr("the next start reads program 2 of the tape"));
  EXPECT_EQ(shop.run().outcome, RunOutcome::Completed) << "F is still in force";
  EXPECT_NEAR(shop.at(0), 25.4, 1e-6) << "the axes went on from where they were";
  EXPECT_NEAR(shop.at(1), 50.8, 1e-6);
  EXPECT_EQ(shop.run().outcome, RunOutcome::Completed) << "after the last program the first one";
  EXPECT_NEAR(shop.at(1), 0, 1e-6);
}

/// By its start and by the switch: the program that is next, and the reader stays before it.
TEST(TapeInTheReader, IsTestedFromWhereTheNextStartReads) {
  TapeShop shop;
  shop.push("TK", "%\nN1F9000X10000\nN2M02\n%\nN1Y20000\nN2X30000\nN3M02\n");
  EXPECT_EQ(shop.run().outcome, RunOutcome::Completed);
  for (const bool by_switch : {false, true}) {
    dds::Command turned = shop.command(dds::CommandAction::Switch);
    turned.run.clear();
    turned.argument = "test_run";
    turned.value = by_switch ? 1 : 0;
    ASSERT_TRUE(shop.send(turned).accepted);
    dds::Command start = shop.start_command("TK");
    if (!by_switch) start.argument = "test=yes";
    ASSERT_TRUE(shop.send(start).accepted);
    const auto end = shop.ended();
    EXPECT_EQ(end.outcome, RunOutcome::Tested) << end.reason;
    EXPECT_EQ(end.accepted, 3U) << end.reason;
    EXPECT_EQ(shop.gateway->status().message,
              end.reason + "; the next start reads program 2 of the tape");
    turned.value = 0;
    turned.id += "-off";
    ASSERT_TRUE(shop.send(turned).accepted);
  }
  EXPECT_EQ(shop.run().outcome, RunOutcome::Completed);
  EXPECT_NEAR(shop.at(1), 50.8, 1e-6) << "a test has wound nothing on";
}

TEST(TapeInTheReader, IsAnotherTapeForAnotherProgram) {
  TapeShop shop;
  shop.push("TK", kTape);
  shop.push("TK2", "%\nN1F9000X30000\nN2M02\n");
  EXPECT_EQ(shop.run().outcome, RunOutcome::Completed);
  EXPECT_EQ(shop.run("TK2").outcome, RunOutcome::Completed);
  EXPECT_EQ(shop.run().outcome, RunOutcome::Completed);
  EXPECT_NEAR(shop.at(1), 0, 1e-6) << "it was put in again, and begins with its first program";
}

TEST(TapeInTheReader, IsRewoundAtThePanel) {
  TapeShop shop;
  shop.push("TK", kTape);
  EXPECT_EQ(shop.run().outcome, RunOutcome::Completed);
  EXPECT_EQ(shop.panel("rewind"), "ok");
  EXPECT_TRUE(shop.run_until([&] { return shop.status->message.empty(); }));
  EXPECT_EQ(shop.run().outcome, RunOutcome::Completed);
  EXPECT_NEAR(shop.at(1), 0, 1e-6);
}

TEST(TapeInTheReader, StaysThereWhenTheGatewayIsRestarted) {
  TapeShop shop;
  shop.push("TK", "%\nN1F9000X10000\nN2M02\n%\nN1F9000Y20000\nN2M02\n");
  EXPECT_EQ(shop.run().outcome, RunOutcome::Completed);
  shop.restart_gateway();
  shop.status.reset();
  ASSERT_TRUE(shop.run_until([&] { return shop.status.has_value(); }));
  EXPECT_EQ(shop.status->message, "the next start reads program 2 of the tape");
  const auto refused = shop.start("TK");
  EXPECT_FALSE(refused.accepted) << "the zero, the feed and the registers are those of power on";
  EXPECT_THAT(refused.reason, AllOf(HasSubstr("program 2 of the tape"), HasSubstr("zero (G94)"),
                                    HasSubstr("nothing has run since the gateway was started")));
  shop.push("MDI", "G94\n");
  auto command = shop.start_command("MDI");
  command.argument = dds::kMdiStart;
  ASSERT_TRUE(shop.send(command).accepted);
  EXPECT_EQ(shop.ended().outcome, RunOutcome::Completed);
  ASSERT_TRUE(shop.run_until([&] { return shop.gateway->status().run.empty(); }));
  const auto begun = shop.start("TK");
  EXPECT_EQ(begun.reason,
            "program 2 of the tape begins with the modes of power on, and what MDI has set since");
  EXPECT_EQ(shop.ended().outcome, RunOutcome::Completed);
  ASSERT_TRUE(shop.run_until([&] { return shop.gateway->status().run.empty(); }));
  EXPECT_NEAR(shop.at(1), 50.8, 1e-6);
}

TEST(TapeInTheReader, StatesNothingAfterARestartBeforeTheFirstProgram) {
  TapeShop shop;
  shop.push("TK", "%\nN1F9000X10000\nN2M30\n");
  EXPECT_EQ(shop.run().outcome, RunOutcome::Completed);
  shop.restart_gateway();
  shop.status.reset();
  ASSERT_TRUE(shop.run_until([&] { return shop.status.has_value(); }));
  EXPECT_EQ(shop.status->message, "");
}

/// A block directly after M02, which an end of block and no rewind stop code precede: the reader
/// would take it for the leader of the next program.
class BlockAfterM02 : public testing::TestWithParam<const char*> {};

TEST_P(BlockAfterM02, AlarmsTheNextStart) {
  TapeShop shop;
  shop.push("TK", std::string("%\nN1F9000X10000\nN2M02\n") + GetParam());
  EXPECT_EQ(shop.run().outcome, RunOutcome::Completed);
  EXPECT_THAT(shop.status->message, HasSubstr("the next start reads program 2 of the tape"));
  ASSERT_TRUE(shop.start("TK").accepted);
  const auto end = shop.ended();
  EXPECT_EQ(end.outcome, RunOutcome::Alarmed);
  EXPECT_THAT(end.reason, HasSubstr("TEK0114"));
  EXPECT_THAT(end.reason, HasSubstr("N040X30000"));
  EXPECT_NEAR(shop.at(0), 25.4, 1e-6) << "nothing was moved";
  EXPECT_EQ(shop.panel("rewind"), "ok");
  EXPECT_EQ(shop.run().outcome, RunOutcome::Completed) << "the first program, from a wound tape";
}

INSTANTIATE_TEST_SUITE_P(, BlockAfterM02,
                         testing::Values("N040X30000\nN050M02\n", "N040X30000\n",
                                         "N040X30000\n%\nN050M02\n"));

// A program that was broken off is begun again, and not passed over.
TEST(TapeInTheReader, StaysBeforeAProgramThatWasAborted) {
  TapeShop shop;
  shop.push("TK", "%\nN1F9000X10000\nN2M02\n%\nN1Y20000\nN2M00\nN3X0\nN4M02\n");
  EXPECT_EQ(shop.run().outcome, RunOutcome::Completed);
  ASSERT_TRUE(shop.start("TK").accepted);
  ASSERT_TRUE(shop.run_until(
      [&] { return shop.status && shop.status->execution == dds::Execution::ProgramStopped; }));
  ASSERT_TRUE(shop.send(shop.command(dds::CommandAction::Abort)).accepted);
  EXPECT_EQ(shop.ended().outcome, RunOutcome::Aborted);
  const auto again = shop.start("TK");
  ASSERT_TRUE(again.accepted) << again.reason;
  EXPECT_EQ(again.reason,
            "program 2 of the tape begins with the zero (G94), the feed and the registers that the "
            "program of the tape began with, which was cut off");
  ASSERT_TRUE(shop.run_until([&] {
    return shop.status && shop.status->execution == dds::Execution::ProgramStopped;
  })) << "F is still in force";
}

/// Two parts on one table: G94 of the first program makes the zero of the second, X1.5 Y1.
const std::string kTwoParts =
    "%\nN001G00X10000Y10000F1000M03\nN002X15000\nN003G94\nN004M02\n%\n"
    "N011G90X1000F1000\nN012X2000Y1000\nN013X1000M00\nN014Y5000\nN015X3000\nN016M02\n";

class TwoParts : public JogShop {
 public:
  TwoParts() : JogShop(interpreter::kTektronix1704Dialect, "", "max") {
    push("TK", kTwoParts);
    EXPECT_TRUE(start("TK").accepted);
    EXPECT_EQ(ended().outcome, RunOutcome::Completed);
    rest();
  }
  void rest() {
    ASSERT_TRUE(run_until([&] { return gateway->status().run.empty(); }));
  }
  void begin_second() {
    const auto reply = start("TK");
    ASSERT_TRUE(reply.accepted) << reply.reason;
    ASSERT_TRUE(
        run_until([&] { return gateway->status().execution == dds::Execution::ProgramStopped; }));
    EXPECT_EQ(inches(), "1.6 1.1") << "N013, about the zero of the first program";
  }
  void abort_second() {
    ASSERT_TRUE(send(command(dds::CommandAction::Abort)).accepted);
    EXPECT_EQ(ended().outcome, RunOutcome::Aborted);
    rest();
  }
  std::string inches() const {
    const auto axes = gateway->status().position;
    return fmt::format("{:.4g} {:.4g}", axes[0] / 25.4, axes[1] / 25.4);
  }
};

// An operator moves the axes, and the zero stays where G94 has set it.
TEST(ZeroOfATape, OutlivesAJog) {
  TwoParts shop;
  EXPECT_EQ(shop.jog("X 0.03 in"), "X 1.53 in");
  EXPECT_EQ(shop.jog("Y -0.2 in"), "Y 0.8 in");
  shop.begin_second();
}

TEST(ZeroOfATape, IsThatOfTheBeginningAfterAnAbort) {
  TwoParts shop;
  shop.begin_second();
  shop.abort_second();
  shop.begin_second();
  shop.abort_second();
  EXPECT_EQ(shop.jog("X 0.3 in"), "X 1.9 in");
  shop.begin_second();
}

TEST(ZeroOfATape, IsThatOfAnMdiAfterAnAbortToo) {
  TwoParts shop;
  shop.begin_second();
  shop.abort_second();
  shop.push("MDI", "X5000F1000\n");
  auto command = shop.start_command("MDI");
  command.argument = dds::kMdiStart;
  EXPECT_THAT(shop.send(command).reason, HasSubstr("MDI begins with the zero (G94)"));
  EXPECT_EQ(shop.ended().outcome, RunOutcome::Completed);
  shop.rest();
  EXPECT_EQ(shop.inches(), "2 1.1");
  shop.begin_second();
}

TEST(ZeroOfATape, CountsIncrementsFromWhereAJogHasEnded) {
  JogShop shop(interpreter::kTektronix1704Dialect, "", "max");
  shop.push("TK", "%\nN1X10000F1000\nN2G94\nN3M02\n%\nN4G91X1000\nN5G90Y2000\nN6M02\n");
  ASSERT_TRUE(shop.start("TK").accepted);
  EXPECT_EQ(shop.ended().outcome, RunOutcome::Completed);
  ASSERT_TRUE(shop.run_until([&] { return shop.gateway->status().run.empty(); }));
  EXPECT_EQ(shop.jog("X 0.5 in"), "X 1.5 in");
  ASSERT_TRUE(shop.start("TK").accepted);
  EXPECT_EQ(shop.ended().outcome, RunOutcome::Completed);
  EXPECT_NEAR(shop.gateway->status().position[0], 1.6 * 25.4, 1e-6);
  EXPECT_NEAR(shop.gateway->status().position[1], 0.2 * 25.4, 1e-6);
}

// The machine may have lost where its axes are.
TEST(ZeroOfATape, IsLostWithAnEmergencyStop) {
  TwoParts shop;
  shop.begin_second();
  EXPECT_EQ(shop.panel("emergency-stop on"), "ok");
  EXPECT_EQ(shop.panel("emergency-stop off"), "ok");
  EXPECT_EQ(shop.ended().outcome, RunOutcome::Aborted);
  shop.rest();
  const auto reply = shop.start("TK");
  EXPECT_FALSE(reply.accepted);
  EXPECT_THAT(reply.reason, AllOf(HasSubstr("are lost: the last run was cut off"),
                                  HasSubstr("Rewind the tape at the panel")));
}

}  // namespace
}  // namespace dripline::gateway
