#include "server/ports/line_machines.hpp"
#include "tests/unit/server/api/fake_machines.hpp"
#include "tests/unit/server/ports/port_fixture.hpp"

namespace dripline::server_test {
namespace {

using storage::RunState;

TEST_F(PortServiceTest, SendsAProgramAndCountsWhatLeftAndNothingElse) {
  start_ports();
  add_port(mill());
  const std::string text = blocks(100);
  push("O1", text);
  const auto run = start("O1");
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(line().read_until("N1000 G1 X100.5 Y-100.25\n"), text);
  ASSERT_TRUE(wait_state(run->id, RunState::Completed));
  const auto stored = store_->runs.find(run->id);
  EXPECT_EQ(stored->counters.sent, text.size());
  EXPECT_EQ(stored->counters.accepted, 0u);  // such a line has no acknowledgment
  EXPECT_EQ(stored->counters.executed, 0u);  // and no report of what was executed
  EXPECT_TRUE(stored->started);
  EXPECT_EQ(records_of(run->id, "run_started").size(), 1u);
  EXPECT_EQ(records_of(run->id, "run_ended").size(), 1u);
}

/// No setup goes to such a control with a start: it has what was loaded there.
TEST_F(PortServiceTest, ARunHasTheSetupThatIsSaidToBeInTheControl) {
  start_ports();
  add_port(mill());
  push("O1", blocks(10));
  const auto save = [&](const char* text) {
    storage::SetupRevision setup;
    setup.machine = "mill";
    setup.text = text;
    ASSERT_TRUE(store_->setups.save(setup, std::nullopt));
  };
  const auto setup_of_next_run = [&] {
    const auto run = start("O1");
    EXPECT_TRUE(run) << run.error().what;
    if (!run) return std::optional<std::uint64_t>();
    line().read_until("N100 G1 X10.5 Y-10.25\n");
    EXPECT_TRUE(wait_state(run->id, RunState::Completed));
    return store_->runs.find(run->id)->setup;
  };
  save("[[tool]]\nnumber = 1\n");
  EXPECT_EQ(setup_of_next_run(), std::nullopt) << "on the server is not in the control";
  ASSERT_TRUE(store_->setups.note_loaded("mill", 1, "olga"));
  EXPECT_EQ(setup_of_next_run(), 1u);
  save("[[tool]]\nnumber = 2\n");
  EXPECT_EQ(setup_of_next_run(), 1u) << "the newer one is not in the control yet";
  ASSERT_TRUE(store_->setups.note_loaded("mill", 2, "olga"));
  EXPECT_EQ(setup_of_next_run(), 2u);
  ASSERT_TRUE(store_->setups.note_loaded("mill", std::nullopt, "olga"));
  EXPECT_EQ(setup_of_next_run(), std::nullopt);
}

/// They may have waited for their audit entries while the store was away; the hold did not.
TEST_F(PortServiceTest, ContinuesNothingThatWasHeldAfterTheOrderToContinue) {
  start_ports();
  add_port(mill());
  push("O1", blocks(20000));
  const auto begun = system_clock_.steady_now();
  const auto run = start("O1");
  ASSERT_TRUE(run) << run.error().what;
  line().read_until("N50 ");
  ASSERT_TRUE(command(run->id, dds::CommandAction::Hold));
  ASSERT_TRUE(wait([&] { return line().read_for(std::chrono::milliseconds(60)).empty(); }));
  machines::CommandRequest resume{
      .run = run->id, .action = dds::CommandAction::Resume, .argument = {}};
  resume.given = begun;
  EXPECT_EQ(ports_->machines().command(resume).error().code, Errc::Conflict);
  resume.given = system_clock_.steady_now() - std::chrono::seconds(11);
  EXPECT_EQ(ports_->machines().command(resume).error().code, Errc::Busy);
  EXPECT_EQ(line().read_for(std::chrono::milliseconds(100)), "");
  resume.given = system_clock_.steady_now();
  EXPECT_TRUE(ports_->machines().command(resume));
  EXPECT_NE(line().read_until("N500 "), "");
}

/// Its sender had got "the outcome is unknown".
TEST_F(PortServiceTest, BeginsNothingThatWasGivenLongAgo) {
  start_ports();
  add_port(mill());
  push("O1", blocks(10));
  const auto late =
      ports_->machines().start({.machine = "mill",
                                .program = "O1",
                                .revision = {},
                                .author = "cam",
                                .given = system_clock_.steady_now() - std::chrono::seconds(11)});
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().code, Errc::Busy);
  EXPECT_EQ(line().read_for(std::chrono::milliseconds(60)), "");
  const auto runs =
      store_->runs.list({.machine = "mill", .program = {}, .state = {}}, {.limit = 2});
  ASSERT_EQ(runs->size(), 1u);
  EXPECT_EQ(runs->front().state, RunState::Refused);
  EXPECT_TRUE(start("O1")) << "and no reset is asked for";
}

TEST_F(PortServiceTest, StopsForXoffAndShowsTheWait) {
  start_ports();
  add_port(mill());
  const std::string text = blocks(300);
  push("O1", text);
  const auto run = start("O1");
  ASSERT_TRUE(run);
  std::string came = line().read_until("N20 ");
  line().write("\x13");
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->waiting_since.has_value(); }));
  came += line().read_for(std::chrono::milliseconds(50));  // what was in transit
  EXPECT_EQ(line().read_for(std::chrono::milliseconds(50)), "");
  EXPECT_TRUE(ports_->port("com1")->line.may_wait_without_limit);
  EXPECT_EQ(ports_->machines().machine("mill")->status->execution, dds::Execution::Waiting);
  EXPECT_EQ(ports_->port("com1")->run, run->id);
  line().write("\x11");
  came += line().read_until("N3000 G1 X300.5 Y-300.25\n");
  EXPECT_TRUE(came == text) << came.size();
  EXPECT_TRUE(wait_state(run->id, RunState::Completed));
  EXPECT_FALSE(ports_->port("com1")->waiting_since);
}

TEST_F(PortServiceTest, IsHeldResumedAndAborted) {
  start_ports();
  add_port(mill());
  push("O1", blocks(20000));
  const auto run = start("O1");
  ASSERT_TRUE(run);
  line().read_until("N50 ");
  ASSERT_TRUE(command(run->id, dds::CommandAction::Hold));
  EXPECT_EQ(ports_->machines().machine("mill")->status->execution, dds::Execution::FeedHold);
  // What was offered already leaves, half a second's worth; then the line is silent.
  ASSERT_TRUE(wait([&] { return line().read_for(std::chrono::milliseconds(40)).empty(); }));
  ASSERT_TRUE(command(run->id, dds::CommandAction::Resume));
  EXPECT_TRUE(wait([&] { return !line().read_for(std::chrono::milliseconds(20)).empty(); }));
  ASSERT_TRUE(command(run->id, dds::CommandAction::Abort));
  ASSERT_TRUE(wait_state(run->id, RunState::Aborted));
  const auto stored = store_->runs.find(run->id);
  EXPECT_GT(stored->counters.sent, 0u);
  EXPECT_LT(stored->counters.sent, stored->size);
  EXPECT_NE(stored->reason.find("the last block sent is line"), std::string::npos)
      << stored->reason;
  EXPECT_EQ(command(run->id, dds::CommandAction::Hold).error().code, Errc::Conflict);
  EXPECT_EQ(command("no-such-run", dds::CommandAction::Hold).error().code, Errc::NotFound);
}

TEST_F(PortServiceTest, RefusesWhatALineCannotCarry) {
  start_ports();
  add_port(mill());
  push("O1", blocks(20000));
  const auto run = start("O1");
  ASSERT_TRUE(run);
  EXPECT_EQ(command(run->id, dds::CommandAction::FeedOverride).error().code, Errc::Unsupported);
  machines::CommandRequest panel;
  panel.machine = "mill";
  panel.action = dds::CommandAction::Switch;
  EXPECT_EQ(ports_->machines().command(panel).error().code, Errc::Unsupported);
}

TEST_F(PortServiceTest, EndsAtAKnownBlockWhenTheCableIsPulled) {
  start_ports();
  add_port(mill());
  push("O1", blocks(20000));
  const auto run = start("O1");
  ASSERT_TRUE(run);
  line().read_until("N100 ");
  line().pull();
  ASSERT_TRUE(wait_state(run->id, RunState::Interrupted));
  const auto stored = store_->runs.find(run->id);
  EXPECT_NE(stored->reason.find("the cable is pulled"), std::string::npos) << stored->reason;
  EXPECT_NE(stored->reason.find("line"), std::string::npos) << stored->reason;
  EXPECT_GE(stored->counters.sent, 100u);
  EXPECT_FALSE(ports_->machines().machine("mill")->is_connected);
  EXPECT_NE(ports_->machines().machine("mill")->status->message.find("com1"), std::string::npos);
  EXPECT_EQ(start("O1").error().code, Errc::Timeout);
  line().put_back();
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->is_open; }));
  EXPECT_EQ(start("O1").error().code, Errc::Conflict);
  ASSERT_TRUE(ports_->confirm_reset("com1"));
  EXPECT_TRUE(start("O1"));
}

machines::StartPoint at_sequence(std::uint64_t number) {
  machines::StartPoint point;
  point.sequence = number;
  return point;
}
machines::StartPoint at_line(std::uint64_t number) {
  machines::StartPoint point;
  point.line = number;
  return point;
}

TEST_F(PortServiceTest, BeginsAtTheGivenBlock) {
  start_ports();
  add_port(mill());
  const std::string text = blocks(30);
  push("O1", text);
  const auto from_block = start("O1", at_sequence(290));
  ASSERT_TRUE(from_block) << from_block.error().what;
  EXPECT_EQ(line().read_until("N300 G1 X30.5 Y-30.25\n"),
            "N290 G1 X29.5 Y-29.25\nN300 G1 X30.5 Y-30.25\n");
  ASSERT_TRUE(wait_state(from_block->id, RunState::Completed));
  EXPECT_EQ(store_->runs.find(from_block->id)->counters.sent, 44u);
  const auto from_line = start("O1", at_line(30));
  ASSERT_TRUE(from_line);
  EXPECT_EQ(line().read_until("25\n"), "N300 G1 X30.5 Y-30.25\n");
  ASSERT_TRUE(wait_state(from_line->id, RunState::Completed));
  const auto nowhere = start("O1", at_sequence(7));
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().code, Errc::NotFound);
  EXPECT_NE(nowhere.error().what.find("N7"), std::string::npos);
}

TEST_F(PortServiceTest, BeginsInTheMiddleOnlyWithWhatTheRestReliesOn) {
  start_ports();
  add_machine("mill", "fanuc");
  add_port(mill());
  const std::string text =
      "O1\nN1 G21 G90 G17\nN2 T2 M6\nN3 S1000 M3\nN4 G0 X0 Y0\nN5 G1 X1. F200\nN6 Y2.\nM30\n";
  push("O1", text, "fanuc");
  const auto refused = start("O1", at_sequence(6));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Conflict);
  EXPECT_EQ(refused.error().what,
            "line 7 and what follows rely on G21 (line 2), G17 (line 2), G90 (line 2), T2 M6 (line "
            "3), S1000 (line 4), M3 (line 4), G1 (line 6), F200 (line 6), which would not be sent: "
            "--send-head sends 'G21 G17 G90 / T2 M6 / S1000 M3 / G1 F200' first, --modes-set "
            "confirms that all of it is in force at the control");
  EXPECT_EQ(line().read_for(std::chrono::milliseconds(50)), "");
  machines::StartRequest request{
      .machine = "mill", .program = "O1", .revision = {}, .author = "cam", .from = at_sequence(6)};
  request.memory = machines::StartMemory::Now;
  EXPECT_EQ(ports_->machines().start(request).error().code, Errc::Unsupported);
  request.memory = machines::StartMemory::Ask;
  request.head = machines::StartHead::Send;
  const auto sent = ports_->machines().start(request);
  ASSERT_TRUE(sent) << sent.error().what;
  EXPECT_EQ(line().read_until("M30\n"), "G21 G17 G90\nT2 M6\nS1000 M3\nG1 F200\nN6 Y2.\nM30\n");
  ASSERT_TRUE(wait_state(sent->id, RunState::Completed));
  EXPECT_EQ(store_->runs.find(sent->id)->counters.sent, 11u) << "the head is none of the program";
  request.head = machines::StartHead::Set;
  const auto bare = ports_->machines().start(request);
  ASSERT_TRUE(bare) << bare.error().what;
  EXPECT_EQ(line().read_until("M30\n"), "N6 Y2.\nM30\n");
}

TEST_F(PortServiceTest, BeginsAtTheChangeToATool) {
  start_ports();
  add_machine("mill", "fanuc");
  add_port(mill());
  push("O1",
       "O1\nG21 G90 G17 G54\nT2 M6\nS1000 M3\nM8\nG0 X0 Y0\nG1 X1. F200\nN3 T3 M6\nS800 M3\nG0 "
       "X5.\nG1 Y2. F90\nM30\n",
       "fanuc");
  machines::StartRequest request{
      .machine = "mill", .program = "O1", .revision = {}, .author = "cam", .from = {}};
  request.from.tool = 3;
  const auto asked = ports_->machines().start(request);
  ASSERT_FALSE(asked);
  EXPECT_EQ(asked.error().code, Errc::Conflict);
  EXPECT_NE(asked.error().what.find("line 8 and what follows rely on G21 (line 2)"),
            std::string::npos)
      << asked.error().what;
  request.head = machines::StartHead::Send;
  const auto sent = ports_->machines().start(request);
  ASSERT_TRUE(sent) << sent.error().what;
  EXPECT_EQ(line().read_until("M30\n"),
            "G21 G17 G90 G54\nM8\nN3 T3 M6\nS800 M3\nG0 X5.\nG1 Y2. F90\nM30\n");
  ASSERT_TRUE(wait_state(sent->id, RunState::Completed));
  request.from.tool = 4;
  const auto nowhere = ports_->machines().start(request);
  EXPECT_EQ(nowhere.error().code, Errc::NotFound);
  EXPECT_NE(nowhere.error().what.find("'O1' has no change to tool 4"), std::string::npos);
  request.from = {};
  request.from.skipped = 4;
  EXPECT_EQ(ports_->machines().start(request).error().code, Errc::Unsupported);
}

TEST_F(PortServiceTest, RefusesASecondRunAndAHeldRevision) {
  start_ports();
  add_port(mill());
  push("O1", blocks(20000));
  ASSERT_TRUE(start("O1"));
  const auto second = start("O1");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::Busy);
  EXPECT_NE(second.error().what.find("com1"), std::string::npos);
  const auto changed = ports_->save(mill());
  ASSERT_FALSE(changed);
  EXPECT_EQ(changed.error().code, Errc::Busy);
  EXPECT_EQ(ports_->remove("com1").error().code, Errc::Busy);
  EXPECT_EQ(ports_->test("com1").error().code, Errc::Busy);
}

TEST_F(PortServiceTest, EndsTheRunsOfAFormerLifeOfTheServer) {
  start_ports();
  add_port(mill());
  add_machine("mill");
  push("O1", blocks(20000));
  const auto run = start("O1");
  ASSERT_TRUE(run);
  line().read_until("N5000 ");
  ASSERT_TRUE(wait([&] { return store_->runs.find(run->id)->counters.sent > 1000; }));
  storage::Run left = *store_->runs.find(run->id);
  EXPECT_EQ(left.state, RunState::Active);
  ports_.reset();
  EXPECT_EQ(store_->runs.find(run->id)->state, RunState::Interrupted);  // a clean stop says so too
  storage::Run other = left;                                            // as a kill would leave it
  other.id = "cut-off";
  other.state = RunState::Ordered;
  other.counters = {};
  ASSERT_TRUE(store_->runs.create(other));
  ASSERT_TRUE(store_->runs.set_state(other.id, RunState::Active, ""));
  ASSERT_TRUE(store_->runs.update_counters(
      {other.machine, other.id, {.sent = 1234, .accepted = 5, .executed = 0}, 0, -1}));
  start_ports();
  ASSERT_TRUE(wait_state(other.id, RunState::Interrupted));
  EXPECT_EQ(store_->runs.find(other.id)->counters.sent, 1234u);
  EXPECT_NE(store_->runs.find(other.id)->reason.find("1234"), std::string::npos);
}

TEST_F(PortServiceTest, ListsMachinesOfBothKinds) {
  start_ports();
  add_port(mill());
  FakeMachines gateways;
  machines::MachineView lathe;
  lathe.machine.name = "lathe";
  lathe.is_connected = true;
  machines::MachineView mill_of_gateways;
  mill_of_gateways.machine.name = "mill";
  gateways.views = {lathe, mill_of_gateways};
  ports::MachineRouter machines(store_->runs, gateways, ports_->machines());
  auto views = machines.machines();
  ASSERT_EQ(views.size(), 2u);
  EXPECT_EQ(views[0].machine.name, "lathe");
  EXPECT_EQ(views[1].machine.name, "mill");
  EXPECT_TRUE(views[1].is_connected);
  EXPECT_FALSE(views[1].is_contested);
  push("O1", blocks(1));
  const auto run =
      machines.start({.machine = "mill", .program = "O1", .revision = {}, .author = "cam"});
  ASSERT_TRUE(run);
  ASSERT_TRUE(wait_state(run->id, RunState::Completed));
  EXPECT_TRUE(gateways.started.empty());
  // One writer per machine.
  gateways.views[1].is_connected = true;
  EXPECT_TRUE(machines.machine("mill")->is_contested);
  const auto contested =
      machines.start({.machine = "mill", .program = "O1", .revision = {}, .author = "cam"});
  ASSERT_FALSE(contested);
  EXPECT_EQ(contested.error().code, Errc::Busy);
}

TEST_F(PortServiceTest, AStartWhoseEntryCannotBeStoredSendsNothing) {
  start_ports();
  add_port(mill());
  push("O1", blocks(1));
  machines::StartRequest request{
      .machine = "mill", .program = "O1", .revision = {}, .author = "cam"};
  std::string noted;
  request.before = [&](const Run& run) -> Result<void> {
    noted = run.id;
    return fail(Errc::Io, "disk full");
  };
  const auto refused = ports_->machines().start(request);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().what, "disk full");
  EXPECT_EQ(store_->runs.find(noted)->state, RunState::Refused);
  EXPECT_EQ(ports_->port("com1")->sent, 0u);
}

}  // namespace
}  // namespace dripline::server_test
