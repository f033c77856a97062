// Commands that have waited in the server, as for their audit entry.
#include "tests/unit/server/machines/machine_fixture.hpp"

namespace dripline::server_test {
namespace {

using namespace std::chrono_literals;
using enum dds::CommandAction;
using Origin = machines::CommandDispatcher::Origin;

/// A gateway that does what comes.
class StopOrderTest : public MachineServiceTest {
 protected:
  StopOrderTest() {
    clock_.advance(1h);
    written_->on_command = [this](const dds::Command& heard) {
      dispatcher_.on_result(
          {.machine = heard.machine, .id = heard.id, .accepted = true, .reason = {}});
    };
  }
  SteadyTime ago(SteadyTime::duration time) const { return clock_.steady_now() - time; }
  Result<void> give(dds::CommandAction action, const Origin& origin, double value = 0) {
    dds::Command command;
    command.machine = "lathe-1";
    command.action = action;
    command.value = value;
    return dispatcher_.carry_out(std::move(command), origin);
  }
  std::size_t sent() const { return written_->commands.size(); }

  test_support::FakeServerEndpoint endpoint_{written_};
  machines::CommandDispatcher dispatcher_{
      endpoint_, clock_,
      machines::CommandDispatcher::Options{
          .gateway_of =
              [](const std::string&) {
                return machines::CommandDispatcher::Options::Gateway{1, 0us};
              }},
      [](const dds::Command&) {}};
};

TEST_F(StopOrderTest, NothingGivenBeforeAStopComesAfterIt) {
  for (const auto stop : {Hold, Abort}) {
    for (const auto later : {Start, Resume, Answer, Handwheel, Jog, SetPosition, Switch}) {
      ASSERT_TRUE(give(stop, {.given = ago(500ms), .is_stop = true}));
      const auto before = sent();
      const auto refused = give(later, {.given = ago(501ms)});
      ASSERT_FALSE(refused) << dds::to_string(later);
      EXPECT_EQ(refused.error().code, Errc::Conflict);
      EXPECT_NE(refused.error().what.find("was given before a command that stopped it"),
                std::string::npos)
          << refused.error().what;
      EXPECT_EQ(sent(), before);
      EXPECT_TRUE(give(later, {.given = ago(499ms)})) << "it was given after the stop";
      EXPECT_EQ(sent(), before + 1);
      clock_.advance(1s);
    }
  }
}

/// The machine was not connected when it was given, and is when the resume has its entry.
TEST_F(StopOrderTest, AStopThatReachedNothingCountsToo) {
  dispatcher_.note_stop("lathe-1", Hold, ago(100ms));
  EXPECT_EQ(give(Resume, {.given = ago(200ms)}).error().code, Errc::Conflict);
  EXPECT_TRUE(give(Resume, {.given = ago(50ms)}));
}

TEST_F(StopOrderTest, IsOfOneMachine) {
  ASSERT_TRUE(give(Hold, {.given = ago(0s), .is_stop = true}));
  dds::Command other;
  other.machine = "mill-2";
  other.action = Resume;
  EXPECT_TRUE(dispatcher_.carry_out(std::move(other), {.given = ago(1s)}));
}

TEST_F(StopOrderTest, AnOverrideIsNotRaisedAfterALaterOneThatLoweredIt) {
  ASSERT_TRUE(give(FeedOverride, {.given = ago(100ms), .is_stop = true}, 0));
  EXPECT_EQ(give(FeedOverride, {.given = ago(200ms)}, 1.2).error().code, Errc::Conflict);
  EXPECT_TRUE(give(RapidOverride, {.given = ago(200ms)}, 1)) << "another one";
  EXPECT_TRUE(give(FeedOverride, {.given = ago(50ms)}, 1.2));
}

/// The machine's status still shows the higher one, so both are stops.
TEST_F(StopOrderTest, AnOverrideStaysAsLowAsTheLastOneHasSetIt) {
  ASSERT_TRUE(give(FeedOverride, {.given = ago(100ms), .is_stop = true}, 0.1));
  const auto higher = give(FeedOverride, {.given = ago(200ms), .is_stop = true}, 0.3);
  ASSERT_FALSE(higher);
  EXPECT_EQ(higher.error().code, Errc::Conflict);
  EXPECT_TRUE(give(FeedOverride, {.given = ago(200ms), .is_stop = true}, 0.05)) << "lower still";
  EXPECT_TRUE(give(FeedOverride, {.given = ago(50ms), .is_stop = true}, 0.3)) << "given later";
}

TEST_F(StopOrderTest, WhatHasWaitedTooLongIsNotSent) {
  const auto resume = give(Resume, {.given = ago(10'001ms)});
  ASSERT_FALSE(resume);
  EXPECT_EQ(resume.error().code, Errc::Busy);
  EXPECT_NE(resume.error().what.find("waited 10.0 s in the server, 10 are allowed"),
            std::string::npos)
      << resume.error().what;
  EXPECT_EQ(give(Jog, {.given = ago(2'001ms)}).error().code, Errc::Busy) << "at once or never";
  EXPECT_EQ(sent(), 0u);
  EXPECT_TRUE(give(Jog, {.given = ago(2s)}));
}

TEST_F(StopOrderTest, AStopIsAlwaysSent) {
  ASSERT_TRUE(give(Hold, {.given = ago(0s), .is_stop = true}));
  EXPECT_TRUE(give(Abort, {.given = ago(1h), .is_stop = true}));
  EXPECT_TRUE(give(Hold, {.given = ago(1s), .is_stop = true}));
  EXPECT_EQ(sent(), 3u);
}

}  // namespace
}  // namespace dripline::server_test
