#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gateway/app/gateway_fixture.hpp"

/// What may still be done when it comes late, out of turn, or from a server with another clock.
namespace dripline::gateway {
namespace {

using dds::CommandAction;
using dds::Execution;
using std::chrono::hours;
using std::chrono::seconds;

class Commands : public testing::Test {
 protected:
  dds::Command make(CommandAction action, double value = 0, const std::string& argument = "") {
    dds::Command command = fixture.command(action);
    command.value = value;
    command.argument = argument;
    return command;
  }
  static dds::Command late(dds::Command command) {
    command.deadline = std::chrono::microseconds{1};
    return command;
  }
  void run_long_program() {
    fixture.push("O1", "X400\nX0\nEND\n");
    ASSERT_TRUE(fixture.start("O1").accepted);
    ASSERT_TRUE(fixture.run_until([&] { return fixture.status->feed_mm_per_min > 0; }));
  }
  void pass_a_second() {
    const auto end = fixture.steady_time() + seconds(1);
    ASSERT_TRUE(fixture.run_until([&] { return fixture.steady_time() >= end; }));
  }
  bool comes_to(Execution execution) {
    return fixture.run_until([&] { return fixture.status->execution == execution; });
  }
  GatewayFixture fixture{"1x"};
};

TEST_F(Commands, ThatStopNeverComeTooLate) {
  run_long_program();
  EXPECT_TRUE(fixture.send(late(make(CommandAction::FeedOverride, 0.5))).accepted);
  EXPECT_TRUE(fixture.send(late(make(CommandAction::Hold))).accepted);
  EXPECT_TRUE(comes_to(Execution::FeedHold));
  EXPECT_TRUE(fixture.send(late(make(CommandAction::Switch, 1, "emergency_stop"))).accepted);
  EXPECT_TRUE(fixture.run_until([&] { return fixture.status->emergency_stop; }));
  EXPECT_TRUE(fixture.send(make(CommandAction::Switch, 0, "emergency_stop")).accepted);
  EXPECT_EQ(fixture.ended().outcome, dds::RunOutcome::Aborted);
  run_long_program();
  EXPECT_TRUE(fixture.send(late(make(CommandAction::Abort))).accepted);
  EXPECT_EQ(fixture.ended().outcome, dds::RunOutcome::Aborted);
}

/// One that waited in the server, as for its audit entry: its sender has not seen what was done at
/// the machine meanwhile.
TEST_F(Commands, ThatWereGivenBeforeThePanelWasUsedDoNothing) {
  run_long_program();
  const auto given = [&](dds::Command command, std::chrono::microseconds time) {
    command.given = time;
    return command;
  };
  const auto before = fixture.steady_time();
  pass_a_second();
  ASSERT_THAT(fixture.panel("hold"), testing::StartsWith("ok"));
  ASSERT_TRUE(comes_to(Execution::FeedHold));
  const auto refused = fixture.send(given(make(CommandAction::Resume), before));
  EXPECT_FALSE(refused.accepted);
  EXPECT_THAT(refused.reason, testing::HasSubstr("the machine's panel was used"));
  EXPECT_FALSE(fixture.send(given(make(CommandAction::FeedOverride, 1.2), before)).accepted);
  EXPECT_FALSE(
      fixture.send(given(make(CommandAction::Switch, 0, "single_block"), before)).accepted);
  EXPECT_TRUE(fixture.send(given(make(CommandAction::Hold), before)).accepted) << "a stop always";
  EXPECT_EQ(fixture.status->execution, Execution::FeedHold);
  pass_a_second();
  EXPECT_TRUE(fixture.send(given(make(CommandAction::Resume), fixture.steady_time())).accepted);
}

TEST_F(Commands, ThatMoveSomethingDoNotComeAfterTheirDeadline) {
  run_long_program();
  ASSERT_TRUE(fixture.send(make(CommandAction::FeedOverride, 0.5)).accepted);
  ASSERT_TRUE(fixture.send(make(CommandAction::Hold)).accepted);
  ASSERT_TRUE(comes_to(Execution::FeedHold));
  EXPECT_FALSE(fixture.send(late(make(CommandAction::Resume))).accepted);
  EXPECT_FALSE(fixture.send(late(make(CommandAction::FeedOverride, 1))).accepted);
  EXPECT_FALSE(fixture.send(late(make(CommandAction::Switch, 1, "single_block"))).accepted);
  ASSERT_TRUE(fixture.send(make(CommandAction::Switch, 1, "emergency_stop")).accepted);
  EXPECT_FALSE(fixture.send(late(make(CommandAction::Switch, 0, "emergency_stop"))).accepted);
  EXPECT_TRUE(fixture.run_until([&] { return fixture.status->emergency_stop; }));
}

TEST_F(Commands, ThatMoveSomethingNeedASessionAndADeadline) {
  fixture.push("O1", "END\n");
  dds::Command start = fixture.start_command("O1");
  start.deadline = {};
  EXPECT_EQ(fixture.send(start).reason,
            "the command names no session and deadline: the server is older than protocol 2");
  start = fixture.start_command("O1");
  start.session = 0;
  EXPECT_FALSE(fixture.send(start).accepted);
  start = fixture.start_command("O1");
  start.server = 0;
  EXPECT_FALSE(fixture.send(start).accepted);
}

TEST_F(Commands, ThatWereOvertakenByAStopMoveNothing) {
  run_long_program();
  ASSERT_TRUE(fixture.send(make(CommandAction::Hold)).accepted);
  ASSERT_TRUE(comes_to(Execution::FeedHold));
  const dds::Command resume = make(CommandAction::Resume);  // lost in transit, and repeated below
  ASSERT_TRUE(fixture.send(make(CommandAction::Hold)).accepted);
  EXPECT_EQ(fixture.send(resume).reason, "a later command has stopped the machine meanwhile");
  EXPECT_TRUE(fixture.send(make(CommandAction::Resume)).accepted);
}

TEST_F(Commands, OfARestartedServerAreNumberedAgain) {
  run_long_program();
  ASSERT_TRUE(fixture.send(make(CommandAction::Hold)).accepted);
  ASSERT_TRUE(comes_to(Execution::FeedHold));
  dds::Command resume = make(CommandAction::Resume);
  resume.server = 2;
  resume.number = 1;
  EXPECT_TRUE(fixture.send(resume).accepted);
}

TEST_F(Commands, ThatStopAreCarriedOutByAnyGatewayOfTheName) {
  run_long_program();
  dds::Command hold = make(CommandAction::Hold);
  hold.session += 7;
  EXPECT_TRUE(fixture.send(hold).accepted);
  dds::Command resume = make(CommandAction::Resume);
  resume.session += 7;
  fixture.gateway->receive(resume, fixture.clock.steady);
  (void)fixture.run_until([] { return false; });
  EXPECT_FALSE(fixture.results.contains(resume.id)) << "it is for another session";
}

TEST_F(Commands, AreDoneOnceHoweverOftenTheyCome) {
  run_long_program();
  const dds::Command hold = make(CommandAction::Hold);
  ASSERT_TRUE(fixture.send(hold).accepted);
  ASSERT_TRUE(comes_to(Execution::FeedHold));
  ASSERT_TRUE(fixture.send(make(CommandAction::Resume)).accepted);
  ASSERT_TRUE(comes_to(Execution::Active));
  EXPECT_TRUE(fixture.send(hold).accepted) << "its answer is repeated";
  (void)fixture.run_until([&] { return fixture.status->execution == Execution::FeedHold; });
  EXPECT_NE(fixture.status->execution, Execution::FeedHold);
}

/// The time of day of gateway and server has no part in any of it.
TEST_F(Commands, WorkOnAGatewayWhoseTimeOfDayIsAnHourOff) {
  for (const auto step : {hours(1), hours(-1)}) {
    fixture.clock.step = step;
    run_long_program();
    EXPECT_TRUE(fixture.send(make(CommandAction::Hold)).accepted);
    EXPECT_TRUE(comes_to(Execution::FeedHold));
    EXPECT_TRUE(fixture.send(make(CommandAction::Resume)).accepted);
    EXPECT_TRUE(fixture.send(make(CommandAction::Abort)).accepted);
    EXPECT_EQ(fixture.ended().outcome, dds::RunOutcome::Aborted);
  }
}

TEST_F(Commands, AreNotToBeExpectedFromAServerThatRefusesTheGateway) {
  fixture.gateway->receive(make(CommandAction::Refuse, 0, "protocol 2, not 9"),
                           fixture.clock.steady);
  EXPECT_TRUE(fixture.run_until([&] {
    return fixture.status &&
           fixture.status->message == "the server does not command this gateway: protocol 2, not 9";
  }));
}

}  // namespace
}  // namespace dripline::gateway
