#include "server/ports/programs/broken_program.hpp"

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

/// Such a run was looked through and refused at a gateway, or waited for a line; the one before
/// counts.
TEST_F(BrokenProgramTest, IsNoneWhereNothingHadLeft) {
  add_port(mill());
  const auto add = [&](const std::string& id, RunState state) {
    Run run = run_of(store_->programs.revision("O1", {}).value(), id);
    run.machine = "mill";
    run.created = system_clock_.now();
    ASSERT_TRUE(store_->runs.create(run));
    ASSERT_TRUE(store_->runs.set_state(id, state, ""));
  };
  add("unsent", RunState::Aborted);
  const auto run = start("O2");
  ASSERT_TRUE(run) << run.error().what;
  ASSERT_TRUE(wait_state(run->id, RunState::Completed));
  line().read_until("M30\n%\n");
  break_off_a_run();
  add("unsent-2", RunState::Aborted);
  EXPECT_EQ(start("O2").error().code, Errc::Conflict);
}

/// Who can ask is at the control, which has read his text, and is in no other.
TEST_F(BrokenProgramTest, IsNoObstacleForWhatIsAskedForAtTheControl) {
  add_port(mill());
  break_off_a_run();
  bool is_started = false;
  ports_->machines().start_later(
      {.machine = "mill", .program = "O2", .revision = {}, .author = "control"},
      [&](const Result<Run>& run) { is_started = run.has_value(); });
  EXPECT_EQ(line().read_until("M30\n%\n"), "%\nO2\nG0 X9\nM30\n%\n");
  EXPECT_TRUE(wait([&] { return is_started; }));
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

}  // namespace
}  // namespace dripline::server_test
