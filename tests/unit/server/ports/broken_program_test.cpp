#include "server/ports/programs/broken_program.hpp"

#include "gateway/line/line_words.hpp"
#include "tests/unit/server/ports/port_fixture.hpp"

namespace dripline::server_test {
namespace {

using storage::RunState;

/// A control at a line that sends at once: it does not ask for its programs.
class BrokenProgramTest : public PortServiceTest {
 protected:
  void SetUp() override {
    start_ports();
    add_machine("mill");
    push("O1", blocks(20000));
    push("O2", "%\nO2\nG0 X9\nM30\n%\n");
  }
  std::string sent() { return line().read_for(std::chrono::milliseconds(60)); }
  /// Of all that waits in the line's driver too.
  void let_come_to_rest() {
    ASSERT_TRUE(wait([&] { return line().read_for(std::chrono::milliseconds(40)).empty(); }));
  }
  void add_run(const std::string& id, RunState state, const std::string& reason = "") {
    Run run = run_of(store_->programs.revision("O1", {}).value(), id);
    run.machine = "mill";
    run.created = system_clock_.now();
    ASSERT_TRUE(store_->runs.create(run));
    ASSERT_TRUE(store_->runs.set_state(id, state, reason));
  }
  void break_off_a_run() {
    const auto run = start("O1");
    ASSERT_TRUE(run) << run.error().what;
    run_ = run->id;
    line().read_until("N50 ");
    ASSERT_TRUE(command(run->id, dds::CommandAction::Abort));
    ASSERT_TRUE(wait_state(run->id, RunState::Aborted));
    let_come_to_rest();
  }
  std::string run_;
};

TEST_F(BrokenProgramTest, IsFollowedByNothingUntilAPersonConfirmsTheReset) {
  add_port(mill());
  break_off_a_run();
  const auto refused = start("O2");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Conflict);
  EXPECT_EQ(refused.error().what,
            "run " + run_ +
                " of program O1 was broken off, and the control of machine 'mill' would read the "
                "next program as its rest: reset the control, then confirm that (dnc port "
                "confirm-reset com1)");
  const auto transfer = ports_->send("com1", {{"O2", {}}});
  ASSERT_FALSE(transfer);
  EXPECT_EQ(transfer.error().what, refused.error().what);
  EXPECT_EQ(sent(), "");
  EXPECT_EQ(ports_->confirm_reset("com1").value(), "run " + run_ + " of program O1");
  const auto run = start("O2");
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(line().read_until("M30\n%\n"), "%\nO2\nG0 X9\nM30\n%\n");
  ASSERT_TRUE(wait_state(run->id, RunState::Completed));
  EXPECT_EQ(ports_->confirm_reset("com1").error().code, Errc::Conflict) << "nothing is broken off";
}

TEST_F(BrokenProgramTest, IsKnownToTheNextServerAndConfirmedThereAgain) {
  add_port(mill());
  break_off_a_run();
  ASSERT_TRUE(ports_->confirm_reset("com1"));
  ports_.reset();
  start_ports();
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->is_open; }));
  EXPECT_EQ(start("O2").error().code, Errc::Conflict) << "another one may have been sent since";
  EXPECT_EQ(sent(), "");
  ASSERT_TRUE(ports_->confirm_reset("com1"));
  EXPECT_TRUE(start("O2"));
}

/// A confirmation is of one program, not of the machine.
TEST_F(BrokenProgramTest, IsConfirmedOnce) {
  add_port(mill());
  break_off_a_run();
  ASSERT_TRUE(ports_->confirm_reset("com1"));
  break_off_a_run();
  EXPECT_EQ(start("O2").error().code, Errc::Conflict);
  EXPECT_EQ(sent(), "");
}

TEST_F(BrokenProgramTest, OfATransferIsTheSame) {
  add_port(mill());
  ASSERT_TRUE(ports_->send("com1", {{"O1", {}}}));
  line().read_until("N50 ");
  ASSERT_TRUE(ports_->stop_transfer("com1", "stopped by cam"));
  let_come_to_rest();
  const auto refused = start("O2");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("O1 revision 1 was broken off"), std::string::npos)
      << refused.error().what;
  EXPECT_EQ(sent(), "");
  EXPECT_EQ(ports_->confirm_reset("com1").value(), "O1 revision 1");
  EXPECT_TRUE(start("O2"));
}

/// What passed the line last is not found by the clock, which may be set back.
TEST_F(BrokenProgramTest, IsTheLastOneAlsoAfterTheClockWasSetBack) {
  add_port(mill());
  storage::PortTransfer transfer;
  transfer.port = "com1";
  transfer.id = "transfer-1";
  transfer.programs = {"O2 revision 1"};
  transfer.at_most = 20;
  transfer.began = system_clock_.now() + std::chrono::hours(1);
  ASSERT_TRUE(store_->ports.save_transfer(transfer));
  transfer.state = storage::TransferState::Completed;
  transfer.ended = transfer.began;
  ASSERT_TRUE(store_->ports.save_transfer(transfer));
  using ports::broken_program;
  const auto broken = [&] { return broken_program(*store_, {"mill", "com1"}).value(); };
  EXPECT_FALSE(broken());
  add_run("cut off", RunState::Interrupted);
  ASSERT_TRUE(broken());
  EXPECT_EQ(broken()->id, "cut off");
  Run whole = run_of(store_->programs.revision("O1", {}).value(), "whole");
  whole.machine = "mill";
  whole.created = system_clock_.now() + std::chrono::hours(2);
  ASSERT_TRUE(store_->runs.create(whole));
  ASSERT_TRUE(store_->runs.set_state("whole", RunState::Completed, ""));
  EXPECT_FALSE(broken());
  transfer.id = "transfer-2";
  transfer.began = system_clock_.now();
  transfer.state = storage::TransferState::Interrupted;
  ASSERT_TRUE(store_->ports.save_transfer(transfer));
  ASSERT_TRUE(broken());
  EXPECT_EQ(broken()->id, "transfer-2");
}

/// Such a run was looked through and refused at a gateway, or tested there; the one before counts.
TEST_F(BrokenProgramTest, IsNoneWhereNothingHadLeft) {
  add_port(mill());
  add_run("unsent", RunState::Aborted);
  add_run("tested", RunState::Tested);
  const auto run = start("O2");
  ASSERT_TRUE(run) << run.error().what;
  ASSERT_TRUE(wait_state(run->id, RunState::Completed));
  line().read_until("M30\n%\n");
  break_off_a_run();
  add_run("unsent-2", RunState::Aborted);
  EXPECT_EQ(start("O2").error().code, Errc::Conflict);
}

/// Its first words are none of the program, and count no bytes of it.
TEST_F(BrokenProgramTest, OfARunWhoseHeadHadBegunToLeave) {
  add_port(mill());
  add_run("in-head", RunState::Aborted,
          fmt::format("aborted by command; {}; no whole block was sent", line::kHeadLeft));
  EXPECT_EQ(start("O2").error().code, Errc::Conflict);
  EXPECT_EQ(sent(), "");
}

/// Of a run from the middle; a pause after each block of the head.
class BrokenHead : public BrokenProgramTest {
 protected:
  void begin() {
    add_machine("mill", "fanuc");
    auto port = mill();
    port.settings.emplace_back("line_delay_ms", "500");
    add_port(port);
    push("O3", "O3\nN1 G21 G90 G17\nN2 T2 M6\nN3 S1000 M3\nN5 G1 X1. F200\nN6 Y2.\nM30\n", "fanuc");
    machines::StartRequest request{
        .machine = "mill", .program = "O3", .revision = {}, .author = "cam", .from = {}};
    request.from.sequence = 6;
    request.head = machines::StartHead::Send;
    const auto run = ports_->machines().start(request);
    ASSERT_TRUE(run) << run.error().what;
    run_ = run->id;
    EXPECT_EQ(line().read_until("\n"), "G21 G17 G90\n");
  }
  void expect_broken() {
    const auto run = store_->runs.find(run_);
    EXPECT_EQ(run->counters.sent, 0u);
    EXPECT_NE(run->reason.find(line::kHeadLeft), std::string::npos) << run->reason;
    EXPECT_EQ(start("O2").error().code, Errc::Conflict);
  }
};

TEST_F(BrokenHead, IsTheBeginningOfARunThatWasAborted) {
  begin();
  ASSERT_TRUE(command(run_, dds::CommandAction::Abort));
  ASSERT_TRUE(wait_state(run_, RunState::Aborted));
  expect_broken();
  EXPECT_EQ(line().read_for(std::chrono::milliseconds(700)), "");
}

TEST_F(BrokenHead, IsNotSentAgainWhenTheLineComesBack) {
  begin();
  line().pull();
  ASSERT_TRUE(wait_state(run_, RunState::Interrupted));
  line().put_back();
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->is_open; }));
  expect_broken();
  EXPECT_EQ(line().read_for(std::chrono::milliseconds(700)), "");
}

/// Two people, or a double click, while a run begins: that one is not broken off.
TEST_F(BrokenProgramTest, IsNotConfirmedOfARunThatBegins) {
  add_port(mill());
  break_off_a_run();
  add_run("begins", RunState::Active);
  EXPECT_EQ(ports_->confirm_reset("com1").error().code, Errc::Busy);
  EXPECT_EQ(start("O2").error().code, Errc::Busy) << "its end is not stored yet";
  ASSERT_TRUE(store_->runs.set_state("begins", RunState::Interrupted, ""));
  EXPECT_EQ(start("O2").error().code, Errc::Conflict);
  EXPECT_EQ(sent(), "");
}

/// The control is the same one.
TEST_F(BrokenProgramTest, IsNotForgottenWithThePort) {
  add_port(mill());
  ASSERT_TRUE(ports_->send("com1", {{"O1", {}}}));
  line().read_until("N50 ");
  ASSERT_TRUE(ports_->stop_transfer("com1", "stopped by cam"));
  let_come_to_rest();
  EXPECT_EQ(ports_->remove("com1").error().code, Errc::Conflict);
  auto other = mill();
  other.machine = "mill-2";
  EXPECT_EQ(ports_->save(other).error().code, Errc::Conflict);
  auto disabled = mill();
  disabled.is_enabled = false;
  ASSERT_TRUE(ports_->save(disabled));
  EXPECT_EQ(ports_->remove("com1").error().code, Errc::Conflict);
  ASSERT_TRUE(ports_->confirm_reset("com1"));
  EXPECT_TRUE(ports_->remove("com1"));
}

/// And what was lost with it, until it is here again.
TEST_F(BrokenProgramTest, OfAGatewaysLineIsWhatItReports) {
  ports::ResetGate gate(*store_);
  line::LineView view;
  view.names = {"lathe", "lathe", ""};
  EXPECT_TRUE(gate.check(view, ""));
  view.transfer = line::PortTransfer{.id = "t-1", .programs = {"O7 revision 1"}, .size = 90};
  view.transfer->state = line::TransferState::Aborted;
  EXPECT_TRUE(gate.check(view, "")) << "nothing of it had left";
  view.transfer->at_most = 90;
  EXPECT_EQ(gate.check(view, "").error().code, Errc::Conflict);
  EXPECT_EQ(gate.confirm(view, "").value(), "O7 revision 1");
  EXPECT_TRUE(gate.check(view, ""));
  gate.note_lost("lathe", {.id = "t-2", .what = "O8 revision 1"});
  EXPECT_EQ(gate.check(view, "").error().code, Errc::Conflict);
  EXPECT_EQ(gate.confirm(view, "").value(), "O8 revision 1");
  EXPECT_TRUE(gate.check(view, ""));
}

TEST_F(BrokenProgramTest, OfAControlThatAsksForItsProgramsIsLeftToItsProtocol) {
  auto port = mill();
  port.settings.emplace_back("wait_for_xon", "yes");
  add_port(port);
  const auto run = start("O1");
  ASSERT_TRUE(run) << run.error().what;
  line().write("\x11");
  line().read_until("N50 ");
  ASSERT_TRUE(command(run->id, dds::CommandAction::Abort));
  ASSERT_TRUE(wait_state(run->id, RunState::Aborted));
  let_come_to_rest();
  EXPECT_EQ(ports_->confirm_reset("com1").error().code, Errc::Unsupported);
  EXPECT_TRUE(start("O2")) << "it waits for the control's DC1";
  EXPECT_EQ(sent(), "");
}

/// What a control gets for a text of its own is read like a program.
class BrokenAnswer : public BrokenProgramTest {
 protected:
  void begin() {
    add_port(mill("reply = \"O9998\"\n[[rule]]\ntrigger = \"DIR\"\naction = \"directory\"\n"));
    for (int i = 100; i < 300; ++i) push(fmt::format("O{}", i), fmt::format("O{}\nM30\n", i));
  }
  void ask() { line().write("%\nO9999\n(DIR)\nM30\n%\n"); }
  void cut_off() {
    ask();
    line().read_until("O9998");
    line().write("\x13");
    let_come_to_rest();
    line().pull();
    ASSERT_TRUE(wait([&] { return !ports_->port("com1")->is_open; }));
    line().put_back();
    ASSERT_TRUE(wait([&] { return ports_->port("com1")->is_open; }));
  }
};

TEST_F(BrokenAnswer, IsFollowedByNothingUntilAPersonConfirmsTheReset) {
  begin();
  cut_off();
  ASSERT_TRUE(wait([&] { return start("O2").error().code == Errc::Conflict; }));
  EXPECT_NE(start("O2").error().what.find("the answer O9998 was broken off"), std::string::npos)
      << start("O2").error().what;
  EXPECT_EQ(ports_->send("com1", {{"O2", {}}}).error().code, Errc::Conflict);
  EXPECT_EQ(sent(), "");
  EXPECT_EQ(ports_->confirm_reset("com1").value(), "the answer O9998");
  EXPECT_TRUE(start("O2"));
}

TEST_F(BrokenAnswer, IsKnownToTheNextServer) {
  begin();
  cut_off();
  ASSERT_TRUE(wait([&] { return start("O2").error().code == Errc::Conflict; }));
  ports_.reset();
  start_ports();
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->is_open; }));
  EXPECT_EQ(start("O2").error().code, Errc::Conflict);
}

TEST_F(BrokenAnswer, ThatWentThroughHidesNoProgramThatWasBrokenOff) {
  begin();
  const auto transfer = ports_->send("com1", {{"O1", {}}});
  ASSERT_TRUE(transfer) << transfer.error().what;
  line().read_until("N50 ");
  ASSERT_TRUE(ports_->stop_transfer("com1", "stopped by cam"));
  let_come_to_rest();
  ask();
  line().read_until("M30\n%\n");
  const auto shown = [&] { return ports_->port("com1")->transfer; };
  EXPECT_TRUE(wait([&] { return shown()->id == transfer->id; }));
  ASSERT_TRUE(wait([&] { return start("O2").error().code == Errc::Conflict; }));
  EXPECT_NE(start("O2").error().what.find("O1 revision 1 was broken off"), std::string::npos);
  EXPECT_EQ(ports_->confirm_reset("com1").value(), "O1 revision 1");
  EXPECT_TRUE(start("O2"));
}

/// Also the first text without a run that the port ever had.
TEST_F(BrokenAnswer, ThatWentThroughHidesNoRunThatWasBrokenOff) {
  begin();
  break_off_a_run();
  ask();
  line().read_until("M30\n%\n");
  ASSERT_TRUE(wait([&] {
    const auto kept = *store_->ports.transfers("com1");
    return kept.size() == 1 && kept[0].direction == storage::TransferDirection::Receive;
  }));
  EXPECT_EQ(start("O2").error().code, Errc::Conflict);
  EXPECT_EQ(ports_->send("com1", {{"O2", {}}}).error().code, Errc::Conflict);
  ports_.reset();
  start_ports();
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->is_open; }));
  EXPECT_EQ(start("O2").error().code, Errc::Conflict);
  EXPECT_EQ(sent(), "");
}

/// The second is not sent, and what is shown and remembered is what the first leaves.
TEST_F(BrokenAnswer, ThatIsAskedForTwiceOpensNothing) {
  begin();
  break_off_a_run();
  ask();
  ask();
  line().read_until("M30\n%\n");
  let_come_to_rest();
  EXPECT_TRUE(wait([&] {
    const auto shown = ports_->port("com1")->transfer;
    return !shown || shown->state != line::TransferState::Sending;
  }));
  EXPECT_EQ(start("O2").error().code, Errc::Conflict);
  EXPECT_TRUE(ports_->confirm_reset("com1"));
}

TEST_F(BrokenAnswer, IsNotMadeByAChangeOfThePort) {
  begin();
  ask();
  line().read_until("O9998");
  line().write("\x13");
  const auto removed = ports_->remove("com1");
  ASSERT_FALSE(removed);
  EXPECT_EQ(removed.error().code, Errc::Busy);
  EXPECT_NE(removed.error().what.find("dnc port stop com1"), std::string::npos);
  auto other = mill();
  other.machine = "mill-2";
  EXPECT_EQ(ports_->save(other).error().code, Errc::Busy);
  ASSERT_TRUE(ports_->stop_transfer("com1", "stopped by cam"));
  EXPECT_TRUE(wait([&] { return ports_->remove("com1").error().code == Errc::Conflict; }))
      << "then its reset is to be confirmed";
}

TEST_F(BrokenAnswer, IsNotCutOffByAProgram) {
  begin();
  ask();
  line().read_until("O9998");
  line().write("\x13");
  EXPECT_EQ(start("O2").error().code, Errc::Busy);
  EXPECT_EQ(ports_->send("com1", {{"O2", {}}}).error().code, Errc::Busy);
  line().write("\x11");
  line().read_until("M30\n%\n");
  EXPECT_TRUE(wait([&] { return start("O2").has_value(); }));
}

}  // namespace
}  // namespace dripline::server_test
