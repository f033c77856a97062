// Where a test run is refused, and what becomes of it.
#include "tests/unit/server/machines/machine_fixture.hpp"

namespace dripline::server_test {
namespace {

TEST_F(MachineRuns, AreNoTestsOnAControlAtTheEndOfAGatewaysLine) {
  push("O0100", "M30\n");
  start_service();
  announce();
  answer_commands(true);
  const auto test = [&] {
    return service_->start({.machine = "lathe-1",
                            .program = "O0100",
                            .revision = {},
                            .author = "cam",
                            .is_test = true});
  };
  dds::Status status;
  status.machine = "lathe-1";
  status.session = kSession;
  status.time = clock_.now();
  status.steady = gateway_steady();
  status.serial_line.emplace();
  network_.on_status(status);
  const auto refused = test();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Unsupported);
  EXPECT_NE(refused.error().what.find("it has no test run"), std::string::npos);
  EXPECT_TRUE(written_->commands.empty()) << "an older gateway would send the program";
  EXPECT_TRUE(store_->runs.list({}, {})->empty());
  heartbeat();
  const auto run = test();
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(written_->commands.back().argument, "test=yes");
  EXPECT_TRUE(store_->runs.find(run->id)->is_test) << "however it ends";
}

/// A start under the switch is one too, and no other start is.
TEST_F(MachineRuns, AreTestsWhileTheMachineTests) {
  push("O0100", "M30\n");
  start_service();
  announce();
  answer_commands(true);
  for (const auto state : {dds::SwitchState::On, dds::SwitchState::Off}) {
    dds::Status status;
    status.machine = "lathe-1";
    status.session = kSession;
    status.time = clock_.now();
    status.steady = gateway_steady();
    status.switches.emplace();
    status.switches->test_run = state;
    network_.on_status(status);
    const auto run = start("O0100");
    ASSERT_TRUE(run) << run.error().what;
    EXPECT_EQ(store_->runs.find(run->id)->is_test, state == dds::SwitchState::On);
    ASSERT_TRUE(store_->runs.set_state(run->id, storage::RunState::Aborted, ""));
  }
}

TEST_F(MachineRuns, OfATestAreNotRestarted) {
  push("O0100", "M30\n");
  start_service();
  announce();
  answer_commands(true);
  for (const auto& [state, reason] :
       {std::pair{storage::RunState::Tested, "test run: 3 blocks"},
        std::pair{storage::RunState::Aborted, "test run: aborted by command"},
        std::pair{storage::RunState::Alarmed, "MCH0001 X 101 (line 3, found by a test run)"}}) {
    const auto run = start("O0100");
    ASSERT_TRUE(run) << run.error().what;
    ASSERT_TRUE(store_->runs.set_state(run->id, state, reason));
    machines::StartRequest again{
        .machine = "lathe-1", .program = "O0100", .revision = {}, .author = "cam"};
    again.restart = {.run = run->id};
    const auto refused = service_->start(again);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().what,
              "run " + run->id + " was a test run: nothing of it was executed");
  }
}

}  // namespace
}  // namespace dripline::server_test
