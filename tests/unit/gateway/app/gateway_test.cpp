#include "gateway/app/gateway.hpp"

#include <gtest/gtest.h>

#include "gateway/app/state_folder.hpp"
#include "gateway/machine/simulated_machine.hpp"
#include "tests/unit/gateway/app/gateway_fixture.hpp"

namespace dripline::gateway {
namespace {

using dds::CommandAction;
using dds::Execution;
using dds::RecordKind;
using dds::RunOutcome;
using std::chrono::milliseconds;

TEST(Gateway, RunsAProgramAndReportsIt) {
  GatewayFixture fixture;
  fixture.push("O1", with_reports(100, 3));
  ASSERT_TRUE(fixture.start("O1").accepted);
  const auto end = fixture.ended();
  EXPECT_EQ(end.outcome, RunOutcome::Completed);
  EXPECT_EQ(end.executed, 401u);
  EXPECT_EQ(end.accepted, 401u);
  EXPECT_EQ(end.sent, fixture.programs["O1"].size());
  EXPECT_EQ(end.content_sha256, sha256(fixture.programs["O1"]).hex());
  EXPECT_EQ(end.content_length, fixture.programs["O1"].size());
  EXPECT_EQ(end.line, 401u);
  const auto lines = fixture.lines();
  ASSERT_EQ(lines.size(), 100u);
  for (int i = 0; i < 100; ++i)
    EXPECT_EQ(lines[static_cast<std::size_t>(i)], "LINE " + std::to_string(i));
  EXPECT_EQ(fixture.records.front().kind, RecordKind::RunStarted);
  EXPECT_EQ(dds::decode_run_start(fixture.records.front().text)->setup, fixture.setup_digest);
  EXPECT_EQ(fixture.records.back().kind, RecordKind::RunEnded);
  EXPECT_EQ(fixture.execution_probe().blocks_done, 401u);
  EXPECT_EQ(fixture.execution_probe().outputs_done, 100u);
}

TEST(Gateway, ShowsARunningAndThenACompletedStatus) {
  GatewayFixture fixture("1x");
  fixture.push("O1", "X100\nX0\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(
      fixture.run_until([&] { return fixture.status && fixture.status->feed_mm_per_min > 0; }));
  EXPECT_EQ(fixture.status->execution, Execution::Active);
  EXPECT_EQ(fixture.status->run, "run-1");
  EXPECT_EQ(fixture.status->program, "O1");
  EXPECT_GT(fixture.status->buffered_seconds, 0);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->run.empty(); }));
  EXPECT_EQ(fixture.status->execution, Execution::ProgramCompleted);
}

/// CEN-228. The interpreter is ahead of the machine; what is shown belongs to the block in motion.
TEST(Gateway, ShowsTheModesOfTheBlockThatIsExecuted) {
  GatewayFixture fixture("1x");
  fixture.push("O1", "X100\nX0\nX100\nX0\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  for (const std::uint64_t line : {1U, 3U}) {
    ASSERT_TRUE(fixture.run_until([&] {
      return fixture.status && fixture.status->line == line && fixture.status->feed_mm_per_min > 0;
    }));
    EXPECT_GT(fixture.status->accepted, line) << "the interpreter is ahead";
    ASSERT_TRUE(fixture.status->modes);
    EXPECT_EQ(fixture.status->modes->tool_radius, static_cast<double>(line));
    EXPECT_EQ(fixture.status->modes->motion, dds::MotionKind::Line);
    EXPECT_EQ(fixture.status->modes->work_system, "G54.1 P7");
    EXPECT_EQ(fixture.status->modes->cycle, "drill");
    EXPECT_FALSE(fixture.status->modes->tool);
  }
}

TEST(Gateway, RealTimeMotionTakesItsTime) {
  GatewayFixture fixture("1x");
  fixture.push("O1", "X100\nX0\nEND\n");  // 200 mm at no more than 5000 mm/min: 2.4 s and more
  ASSERT_TRUE(fixture.start("O1").accepted);
  const SteadyTime before = fixture.clock.steady;
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
  EXPECT_GT(fixture.clock.steady - before, milliseconds(2000));
  EXPECT_LT(fixture.clock.steady - before, milliseconds(4000));
}

TEST(Gateway, RefusesWhatItCannotRun) {
  GatewayFixture fixture("1x");
  fixture.push("O1", "X100\nX0\nEND\n");
  const auto refusal = [&](auto change) {
    dds::Command command = fixture.start_command("O1");
    change(command);
    const auto result = fixture.send(command);
    EXPECT_FALSE(result.accepted);
    return result.reason;
  };
  EXPECT_NE(refusal([](auto& o) { o.control = "fanuc"; }).find("fanuc"), std::string::npos);
  EXPECT_NE(refusal([](auto& o) { o.size = 0; }).find("0 bytes"), std::string::npos);
  EXPECT_NE(refusal([](auto& o) { o.run.clear(); }).find("run"), std::string::npos);
  EXPECT_NE(refusal([](auto& o) { o.program = "../O1"; }).find("../O1"), std::string::npos);
  EXPECT_NE(refusal([](auto& o) { o.revision = "abc"; }).find("revision"), std::string::npos);
  EXPECT_EQ(refusal([&](auto& o) { o.deadline = fixture.steady_time() - milliseconds(500); }),
            "the command came 0.5 s after its deadline");
  ASSERT_TRUE(fixture.start("O1").accepted);
  EXPECT_NE(refusal([](auto&) {}).find("busy"), std::string::npos);
  EXPECT_EQ(fixture.count(RecordKind::RunStarted), 1u);
}

TEST(Gateway, TheSameOrderGetsTheSameAnswerEvenAfterARestart) {
  GatewayFixture fixture;
  fixture.push("O1", "END\n");
  const dds::Command start = fixture.start_command("O1");
  EXPECT_TRUE(fixture.send(start).accepted);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
  const std::size_t stored = fixture.records.size();
  fixture.clock.steady += std::chrono::seconds(10);  // expired by now, and still known
  EXPECT_TRUE(fixture.send(start).accepted);
  fixture.restart_gateway();
  dds::Command again = fixture.command(CommandAction::Start);  // another command for the same run
  dds::Command repeated = start;
  repeated.session = again.session;
  EXPECT_TRUE(fixture.send(repeated).accepted);
  repeated.id = again.id;
  repeated.deadline = again.deadline;
  EXPECT_TRUE(fixture.send(repeated).accepted);
  EXPECT_EQ(fixture.records.size(), stored);
}

/// HD-191: interrupted, and terminated.
TEST(Gateway, HoldsResumesAndAborts) {
  GatewayFixture fixture("1x");
  fixture.push("O1", "X400\nX0\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->feed_mm_per_min > 0; }));
  EXPECT_TRUE(fixture.send(fixture.command(CommandAction::Hold)).accepted);
  ASSERT_TRUE(fixture.run_until([&] {
    return fixture.status->execution == Execution::FeedHold && fixture.status->feed_mm_per_min == 0;
  }));
  EXPECT_TRUE(fixture.send(fixture.command(CommandAction::Resume)).accepted);
  EXPECT_FALSE(fixture.send(fixture.command(CommandAction::Resume)).accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->feed_mm_per_min > 0; }));
  EXPECT_TRUE(fixture.send(fixture.command(CommandAction::Abort)).accepted);
  const auto end = fixture.ended();
  EXPECT_EQ(end.outcome, RunOutcome::Aborted);
  EXPECT_EQ(end.executed, 0u);
  EXPECT_FALSE(fixture.send(fixture.command(CommandAction::Hold)).accepted);
}

TEST(Gateway, InterpretsNothingMoreAfterAnAbort) {
  GatewayFixture fixture("1x");
  std::string text;
  for (int i = 0; i < 50'000; ++i) text += i % 2 == 0 ? "X1\n" : "X2\n";
  fixture.push("O1", text + "END\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  constexpr std::uint64_t kFull = machine::SimulatedMachine::kQueuedActions;
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->accepted > kFull; }));
  EXPECT_TRUE(fixture.send(fixture.command(CommandAction::Abort)).accepted);
  EXPECT_LT(fixture.ended().accepted, kFull + 1000);
}

TEST(Gateway, AsksOnlyForSecondsOfMotionAhead) {
  GatewayFixture fixture("1x");
  std::string text;
  for (int i = 0; i < 200'000; ++i) text += i % 2 == 0 ? "X10\n" : "X20\n";
  fixture.push("O1", text + "END\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->executed > 3; }));
  EXPECT_GT(fixture.status->sent, 32'000u);
  EXPECT_LT(fixture.status->sent, 300'000u);
}

TEST(Gateway, OrdersForAnotherRunAreRefused) {
  GatewayFixture fixture("1x");
  fixture.push("O1", "X400\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  dds::Command hold = fixture.command(CommandAction::Hold);
  hold.run = "run-77";
  EXPECT_FALSE(fixture.send(hold).accepted);
}

/// Row: TK-30.
TEST(Gateway, SwitchesAndOverridesAreCheckedAndShown) {
  GatewayFixture fixture("1x");
  const auto change = [&](CommandAction action, double value, const std::string& name = "") {
    dds::Command command = fixture.command(action);
    command.value = value;
    command.argument = name;
    return fixture.send(command).accepted;
  };
  EXPECT_TRUE(change(CommandAction::FeedOverride, 0.5));
  EXPECT_FALSE(change(CommandAction::FeedOverride, 3));
  EXPECT_FALSE(change(CommandAction::FeedOverride, 0.52)) << "between the knob's positions";
  EXPECT_FALSE(change(CommandAction::RapidOverride, std::nan("")));
  EXPECT_TRUE(change(CommandAction::Switch, 1, "single_block"));
  EXPECT_FALSE(change(CommandAction::Switch, 1, "turbo"));
  EXPECT_FALSE(change(CommandAction::Switch, 2, "optional_stop"));
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status && fixture.status->single_block; }));
  EXPECT_EQ(fixture.status->feed_override, 0.5);
}

TEST(Gateway, StopsBetweenBlocksInSingleBlock) {
  GatewayFixture fixture;
  dds::Command single = fixture.command(CommandAction::Switch);
  single.argument = "single_block";
  single.value = 1;
  ASSERT_TRUE(fixture.send(single).accepted);
  fixture.push("O1", "X1\nX2\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  for (std::uint64_t block = 1; block <= 2; ++block) {
    ASSERT_TRUE(fixture.run_until([&] {
      return fixture.status->execution == Execution::Interrupted &&
             fixture.status->executed == block;
    })) << block;
    EXPECT_TRUE(fixture.send(fixture.command(CommandAction::Resume)).accepted);
  }
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
}

TEST(Gateway, WaitsAtAProgramStopUntilResumed) {
  GatewayFixture fixture;
  fixture.push("O1", "X1\nSTOP\nOUT A\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(
      fixture.run_until([&] { return fixture.status->execution == Execution::ProgramStopped; }));
  EXPECT_TRUE(fixture.run_until([&] { return fixture.count(RecordKind::Stop) == 1; }));
  EXPECT_EQ(fixture.status->message, "program stop");
  EXPECT_TRUE(fixture.lines().empty());
  EXPECT_TRUE(fixture.send(fixture.command(CommandAction::Resume)).accepted);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
  EXPECT_EQ(fixture.lines(), std::vector<std::string>{"A"});
}

TEST(Gateway, AsksTheSetupFirstAndThenTheOperator) {
  GatewayFixture fixture;
  fixture.setup.answers = {"5.0"};
  fixture.restart_gateway();
  fixture.push("O1", "ASK FIRST\nASK SECOND\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->message == "asks: SECOND"; }));
  EXPECT_EQ(fixture.status->execution, Execution::Waiting);
  EXPECT_EQ(fixture.send(fixture.command(CommandAction::Resume)).reason,
            "the program waits for an answer to: SECOND");
  dds::Command answer = fixture.command(CommandAction::Answer);
  answer.argument = "7";
  EXPECT_TRUE(fixture.send(answer).accepted);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
  EXPECT_EQ(fixture.lines(), (std::vector<std::string>{"5.0", "7"}));
}

TEST(Gateway, KnowsWhatTheServerSentWithTheStart) {
  GatewayFixture fixture;
  fixture.push("O1", "TOOLS\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  (void)fixture.ended();
  auto command = fixture.start_command("O1");
  command.setup = "[[tool]]\nnumber = 4\n[[tool]]\nnumber = 5\n";
  ASSERT_TRUE(fixture.send(command).accepted);
  (void)fixture.ended();
  EXPECT_EQ(fixture.lines(), (std::vector<std::string>{"0", "2"}));
}

TEST(Gateway, RefusesAStartWithASetupItCannotRead) {
  GatewayFixture fixture;
  fixture.push("O1", "END\n");
  auto command = fixture.start_command("O1");
  command.setup = "[[tool]]\nnumber = 4\ncolor = 1\n";
  const auto result = fixture.send(command);
  EXPECT_FALSE(result.accepted);
  EXPECT_NE(result.reason.find("color"), std::string::npos) << result.reason;
  EXPECT_NE(result.reason.find("server's setup"), std::string::npos) << result.reason;
}

TEST(Gateway, ProbesTheSetupsWorkpiece) {
  GatewayFixture fixture;
  fixture.setup.workpiece.add(interpreter::ProbePlane{interpreter::Axis::X, Length::mm(-3)});
  fixture.restart_gateway();
  fixture.push("O1", "PROBE\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
  ASSERT_EQ(fixture.count(RecordKind::Probe), 1u);
  const auto probe = dds::decode_probe(fixture.records[1].text).value();
  EXPECT_TRUE(probe.tripped);
  EXPECT_DOUBLE_EQ(probe.at.at('X'), -3);
}

TEST(Gateway, AnAlarmEndsTheRunAtTheBlockBefore) {
  GatewayFixture fixture;
  fixture.push("O1", "X1\nOUT A\nBAD\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  const auto end = fixture.ended();
  EXPECT_EQ(end.outcome, RunOutcome::Alarmed);
  EXPECT_EQ(end.reason, "TOY0001 bad word");
  EXPECT_EQ(end.executed, 2u);
  EXPECT_EQ(end.line, 2u);
  EXPECT_EQ(fixture.count(RecordKind::Alarm), 1u);
  EXPECT_TRUE(fixture.start("O1").accepted) << "the next run may begin";
}

TEST(Gateway, CallsAndJumpsWorkWhileFed) {
  GatewayFixture fixture;
  fixture.push("O2", "HELLO\n");
  fixture.push("O1", "OUT A\nCALL O2\nJUMP\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
  EXPECT_EQ(fixture.lines(), (std::vector<std::string>{"A", "HELLO", "A", "HELLO", "A", "HELLO"}));
}

TEST(Gateway, TextThatIsNotUtf8IsReportedAsText) {
  GatewayFixture fixture;
  fixture.push("O1", "OUT CAF\xe9 \xc3\xa9\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  EXPECT_EQ(fixture.ended().outcome, RunOutcome::Completed);
  EXPECT_EQ(fixture.lines(), std::vector<std::string>{"CAF\xEF\xBF\xBD \xc3\xa9"});
}

TEST(GatewayOptions, UnknownKeysAndBadValuesAreNamed) {
  GatewayOptions options;
  EXPECT_TRUE(apply_config("machine = \"lathe-1\"\ndds-domain = 7\nspeed = \"max\"\n", options));
  EXPECT_EQ(options.machine, "lathe-1");
  EXPECT_EQ(options.network.domain, 7u);
  EXPECT_FALSE(options.speed.factor.has_value());
  for (const auto& [text, part] : {std::pair{"machnie = \"x\"", "machnie"},
                                   {"dds-domain = 999", "dds-domain"},
                                   {"speed = \"fast\"", "speed"},
                                   {"speed = \"-1x\"", "speed"},
                                   {"machine = \"Lathe 1\"", "machine"},
                                   {"machine = [1]", "machine"},
                                   {"machine", "line 1"}}) {
    const auto done = apply_config(text, options);
    ASSERT_FALSE(done) << text;
    EXPECT_NE(done.error().what.find(part), std::string::npos) << done.error().what;
  }
}

TEST(StateFolder, IsOfOneProcessAndNamesIt) {
  test_support::TemporaryFolder folder;
  const auto first = StateFolder::open(folder.path() / "a/b");
  ASSERT_TRUE(first) << first.error().what;
  const auto second = StateFolder::open(folder.path() / "a/b");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::Busy);
  EXPECT_NE(second.error().what.find(std::to_string(::getpid())), std::string::npos);
}

TEST(Inbox, DropsTextBeyondItsBound) {
  Inbox inbox;
  for (std::size_t i = 0; i < 2 * Inbox::kMaxBlocks; ++i) inbox.post(dds::BlockData{});
  inbox.post(StopRequested{15});
  EXPECT_EQ(inbox.take({}).size(), Inbox::kMaxBlocks + 1);
  EXPECT_TRUE(inbox.take({}).empty());
}

}  // namespace
}  // namespace dripline::gateway
