// Orders to runs, and bringing stored states and machines together.
#include "server/machines/machine_registry.hpp"
#include "tests/support/store_decorator.hpp"
#include "tests/unit/server/machines/machine_fixture.hpp"

namespace dripline::server_test {
namespace {

using namespace std::chrono_literals;

TEST_F(MachineRuns, TakeCommandsUntilTheyHaveEnded) {
  push("O0100", "M30\n");
  start_service();
  announce();
  answer_commands(true);
  const std::string run = start("O0100")->id;
  ASSERT_TRUE(service_->command(
      {.run = run, .action = dds::CommandAction::FeedOverride, .argument = {}, .value = 0.5}));
  EXPECT_EQ(written_->commands.back().value, 0.5);
  EXPECT_EQ(written_->commands.back().run, run);
  record(1, run, dds::RecordKind::RunEnded, completed("M30\n", 1));
  ASSERT_TRUE(wait_ack(1));
  const auto late = service_->command(
      {.run = run, .action = dds::CommandAction::Hold, .argument = {}, .value = 0});
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().code, Errc::Conflict);
  machines::CommandRequest stray;
  stray.run = "none";
  EXPECT_EQ(service_->command(stray).error().code, Errc::NotFound);
}

/// A switch of the panel is there without a run.
TEST_F(MachineRuns, AreNotNeededForCommandsToAMachinesPanel) {
  start_service();
  machines::CommandRequest request;
  request.machine = "lathe-1";
  request.action = dds::CommandAction::Switch;
  request.argument = "emergency_stop";
  request.value = 1;
  EXPECT_EQ(service_->command(request).error().code, Errc::NotFound);
  announce();
  answer_commands(true);
  ASSERT_TRUE(service_->command(request));
  EXPECT_EQ(written_->commands.back().machine, "lathe-1");
  EXPECT_EQ(written_->commands.back().run, "");
  EXPECT_EQ(written_->commands.back().argument, "emergency_stop");
  EXPECT_EQ(written_->commands.back().value, 1);
  network_.on_lost("lathe-1");
  EXPECT_EQ(service_->command(request).error().code, Errc::Timeout);
}

/// A gateway with a screen answers queries; an older one would throw them away.
TEST_F(MachineRuns, AreNotNeededToAskForTheValuesOfAControl) {
  written_->on_command = [this](const dds::Command& command) {
    if (command.argument != "P1") return;  // its setup is asked for by another thread
    network_.on_command_result(
        {.machine = "lathe-1", .id = command.id, .accepted = true, .reason = "", .values = "{}"});
  };
  start_service();
  EXPECT_EQ(service_->values({.machine = "lathe-1", .beginning = ""}).error().code, Errc::NotFound);
  announce();
  dds::Status status;
  status.machine = "lathe-1";
  status.session = kSession;
  status.time = clock_.now();
  status.steady = gateway_steady();
  network_.on_status(status);
  const machines::ValueQuery query{.machine = "lathe-1", .beginning = "P1", .passed_over = 20};
  EXPECT_EQ(service_->values(query).error().code, Errc::Unsupported) << "an older gateway";
  EXPECT_TRUE(written_->commands.empty());
  status.screen.emplace();
  network_.on_status(status);
  ASSERT_TRUE(written_->wait([&] { return written_->commands.size() == 1; })) << "its setup";
  const auto values = service_->values(query);
  ASSERT_TRUE(values) << values.error().what;
  EXPECT_EQ(*values, "{}");
  const dds::Command& command = written_->commands.at(1);
  EXPECT_EQ(command.action, dds::CommandAction::Query);
  EXPECT_EQ(command.argument, "P1");
  EXPECT_EQ(command.value, 20);
  status.serial_line.emplace();
  network_.on_status(status);
  EXPECT_EQ(service_->values(query).error().code, Errc::Unsupported) << "a control on a line";
}

TEST_F(MachineRuns, AreActiveWhenTheMachineShowsThemAfterARestart) {
  const std::string run = stored_run();
  start_service();
  announce();
  status(run);
  EXPECT_TRUE(wait_state(run, storage::RunState::Active));
}

TEST_F(MachineRuns, AreGivenUpOnlyOnceAConnectedMachineWithoutRecordsDoesNotShowThem) {
  const std::string run = stored_run();
  auto endpoint = test_support::FakeServerEndpoint(written_);
  machines::CommandDispatcher dispatcher(endpoint, clock_, {}, [](const dds::Command&) {});
  std::mutex state_mutex;
  machines::RunReconciler reconciler({.runs = store_->runs,
                                      .clock = clock_,
                                      .commands = dispatcher,
                                      .state_mutex = state_mutex,
                                      .on_change = [](const Run&) {},
                                      .on_unwanted = [](const Run&) {}});
  ASSERT_TRUE(reconciler.load());
  machines::MachineView view;
  view.machine.name = "lathe-1";
  view.is_connected = true;
  view.status.emplace();
  view.status.edit().outbox = 3;
  const auto compare_twice = [&] {
    reconciler.compare({view});
    clock_.advance(machines::RunReconciler::kAbsence);
    reconciler.compare({view});
    return store_->runs.find(run)->state;
  };
  EXPECT_EQ(compare_twice(), storage::RunState::Ordered);
  view.is_connected = false;
  view.status.edit().outbox = 0;
  EXPECT_EQ(compare_twice(), storage::RunState::Ordered);
  view.is_connected = true;
  view.is_contested = true;
  EXPECT_EQ(compare_twice(), storage::RunState::Ordered) << "the other gateway may have it";
  view.is_contested = false;
  EXPECT_EQ(compare_twice(), storage::RunState::Refused);
}

TEST_F(MachineRuns, AreGivenUpOnceTheDiskTakesItAgain) {
  struct FullDisk final : test_support::RunStoreDecorator {
    using RunStoreDecorator::RunStoreDecorator;
    Result<void> set_state(const std::string& id, storage::RunState state,
                           const std::string& reason) override {
      if (is_full) return fail(Errc::Io, "disk full");
      return RunStoreDecorator::set_state(id, state, reason);
    }
    bool is_full = true;
  };
  const std::string run = stored_run();
  FullDisk runs(*store_);
  auto endpoint = test_support::FakeServerEndpoint(written_);
  machines::CommandDispatcher dispatcher(endpoint, clock_, {}, [](const dds::Command&) {});
  std::mutex state_mutex;
  machines::RunReconciler reconciler({.runs = runs,
                                      .clock = clock_,
                                      .commands = dispatcher,
                                      .state_mutex = state_mutex,
                                      .on_change = [](const Run&) {},
                                      .on_unwanted = [](const Run&) {}});
  ASSERT_TRUE(reconciler.load());
  machines::MachineView view;
  view.machine.name = "lathe-1";
  view.is_connected = true;
  view.status.emplace();
  reconciler.compare({view});
  clock_.advance(machines::RunReconciler::kAbsence);
  reconciler.compare({view});
  EXPECT_EQ(store_->runs.find(run)->state, storage::RunState::Ordered);
  runs.is_full = false;
  reconciler.compare({view});
  EXPECT_EQ(store_->runs.find(run)->state, storage::RunState::Refused);
}

TEST_F(MachineRuns, AreCommandedInSequence) {
  push("O0100", "M30\n");
  start_service();
  announce();
  answer_commands(true);
  const std::string run = start("O0100")->id;
  for (const auto action : {dds::CommandAction::Hold, dds::CommandAction::Resume}) {
    ASSERT_TRUE(service_->command({.run = run, .action = action, .argument = {}, .value = 0}));
  }
  const auto& commands = written_->commands;
  ASSERT_EQ(commands.size(), 3u);
  EXPECT_LT(commands[0].number, commands[1].number);
  EXPECT_LT(commands[1].number, commands[2].number);
  EXPECT_EQ(commands[2].session, kSession);
  EXPECT_EQ(commands[2].server, commands[0].server);
}

TEST_F(MachineRuns, ShowTheMachinesLatestStatus) {
  start_service();
  announce();
  status("", 5);
  EXPECT_TRUE(wait_notified(machines_, [](const machines::MachineView& view) {
    return view.is_connected && view.status && view.status->outbox == 5;
  }));
  service_->end();  // saves at the latest now
  const auto machine = store_->machines.find("lathe-1");
  ASSERT_TRUE(machine);
  EXPECT_EQ(machine->control, "centurion");
}

}  // namespace
}  // namespace dripline::server_test
