#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/gateway_fixture.hpp"

/// TK-59: a tape of several programs stays in the reader of a gateway's control, and each start
/// reads the program that comes next.
namespace dripline::gateway {
namespace {

using dds::RunOutcome;
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
  EXPECT_EQ(shop.run().outcome, RunOutcome::Completed);
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
/// would take it for the leader of the next program. With the program of the gateway's process
/// before it, and with a new one.
class BlockAfterM02 : public testing::TestWithParam<const char*> {};

TEST_P(BlockAfterM02, AlarmsTheNextStartAlsoAfterARestart) {
  for (const bool restarts : {false, true}) {
    TapeShop shop;
    shop.push("TK", std::string("%\nN1F9000X10000\nN2M02\n") + GetParam());
    EXPECT_EQ(shop.run().outcome, RunOutcome::Completed);
    EXPECT_THAT(shop.status->message, HasSubstr("the next start reads program 2 of the tape"));
    if (restarts) shop.restart_gateway();
    ASSERT_TRUE(shop.start("TK").accepted);
    const auto end = shop.ended();
    EXPECT_EQ(end.outcome, RunOutcome::Alarmed);
    EXPECT_THAT(end.reason, HasSubstr("TEK0114"));
    EXPECT_THAT(end.reason, HasSubstr("N040X30000"));
    EXPECT_NEAR(shop.at(0), restarts ? 0 : 25.4, 1e-6) << "nothing was moved";
    EXPECT_EQ(shop.panel("rewind"), "ok");
    EXPECT_EQ(shop.run().outcome, RunOutcome::Completed) << "the first program, from a wound tape";
  }
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
  ASSERT_TRUE(shop.start("TK").accepted);
  const auto end = shop.ended();
  EXPECT_EQ(end.outcome, RunOutcome::Alarmed) << "F is that of power on: the run was cut off";
  EXPECT_THAT(end.reason, HasSubstr("TEK0301"));
}

}  // namespace
}  // namespace dripline::gateway
