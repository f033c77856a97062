// What the server knows of a gateway: its clock, its protocol, a rival for the same machine.
#include "server/machines/machine_registry.hpp"
#include "tests/support/store_decorator.hpp"
#include "tests/unit/server/machines/machine_fixture.hpp"

namespace dripline::server_test {
namespace {

using namespace std::chrono_literals;

/// A deadline by the gateway's clock needs to know that clock; a stop has none.
TEST_F(MachineRuns, AreStartedOnceTheGatewayHasReportedItsClock) {
  auto endpoint = test_support::FakeServerEndpoint(written_);
  std::atomic<bool> is_told = false;
  machines::CommandDispatcher::Options options;
  options.expiry = 300ms;
  options.grace = 0ms;
  options.repeat = 5ms;
  options.gateway_of = [&](const std::string&) {
    machines::CommandDispatcher::Options::Gateway gateway{.session = 2, .steady_ahead = {}};
    if (is_told) gateway.steady_ahead = kSteadyAhead;
    return gateway;
  };
  machines::CommandDispatcher dispatcher(endpoint, clock_, options, [](const dds::Command&) {});
  written_->on_command = [&](const dds::Command& heard) {
    dispatcher.on_result({.machine = "lathe-1", .id = heard.id, .accepted = true, .reason = {}});
  };
  dds::Command command;
  command.machine = "lathe-1";
  command.action = dds::CommandAction::Abort;
  EXPECT_TRUE(dispatcher.carry_out(command));
  command.action = dds::CommandAction::Resume;
  EXPECT_EQ(dispatcher.carry_out(command).error().code, Errc::Timeout);
  EXPECT_EQ(written_->commands.size(), 1u);
  is_told = true;
  EXPECT_TRUE(dispatcher.carry_out(command));
  EXPECT_EQ(written_->commands.back().deadline, gateway_steady() + 300ms);
}

TEST_F(MachineRuns, AreNotStartedByAGatewayOfAnotherProtocolWhichIsNotified) {
  push("O0100", "M30\n");
  start_service();
  answer_commands(true);
  protocol_ = 4711;
  announce();
  ASSERT_TRUE(written_->wait([&] { return !written_->commands.empty(); }));
  EXPECT_EQ(written_->commands[0].action, dds::CommandAction::Refuse);
  EXPECT_NE(written_->commands[0].argument.find("protocol 4711"), std::string::npos);
  const auto run = start("O0100");
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().code, Errc::Unsupported);
  EXPECT_NE(run.error().what.find("protocol 4711, this server 2"), std::string::npos);
  EXPECT_TRUE(store_->runs.list({}, {})->empty());
  const auto set = service_->position(
      {.machine = "lathe-1", .argument = "datum G54 Z 0 mm", .who = "anna", .is_playback = false});
  ASSERT_FALSE(set);
  EXPECT_NE(set.error().what.find("protocol 4711, this server 2"), std::string::npos);
  machines::CommandRequest stop;
  stop.machine = "lathe-1";
  stop.action = dds::CommandAction::Switch;
  stop.argument = "emergency_stop";
  stop.value = 1;
  EXPECT_TRUE(service_->command(stop)) << "stopping always works";
  stop.value = 0;
  EXPECT_EQ(service_->command(stop).error().code, Errc::Unsupported);
}

/// However often a gateway reports it: what a reader gets of it is paced, and is the latest.
TEST_F(MachineRuns, AreToldInRoundsWhileOnlyPositionsAndCountersMoveOn) {
  start_service();
  announce();
  ASSERT_TRUE(wait_notified(machines_, [](const auto& view) { return view.status.has_value(); }));
  constexpr std::uint64_t kStatuses = 2000;
  dds::Status status;
  status.machine = "lathe-1";
  status.session = kSession;
  for (std::uint64_t n = 1; n <= kStatuses; ++n) {
    status.executed = n;
    network_.on_status(status);
  }
  ASSERT_TRUE(wait_notified(machines_, [](const auto& view) {
    return view.status && view.status->executed == kStatuses;
  }));
  service_->end();
  EXPECT_LT(machines_.size(), kStatuses / 4);
}

/// A store in which no machine can be entered.
class ClosedMachines final : public test_support::MachineStoreDecorator {
 public:
  using MachineStoreDecorator::MachineStoreDecorator;
  Result<void> save(const storage::Machine& machine) override {
    ++tried_;
    if (is_closed_) return fail(Errc::Io, "the database is away");
    return MachineStoreDecorator::save(machine);
  }
  std::atomic<bool> is_closed_{true};
  std::atomic<int> tried_{0};
};

/// What a client does with a machine that it sees (rules, jobs, runs) refers to the stored one.
TEST_F(MachineServiceTest, AMachineIsShownOnceItIsStored) {
  ClosedMachines closed(*store_);
  const storage::Store store = test_support::with(*store_, closed);
  start_service(store);
  answer_commands(true);
  announce_at_once("lathe-1");
  ASSERT_TRUE(test_support::eventually([&] { return closed.tried_ > 0; }));
  EXPECT_TRUE(service_->machines().empty());
  EXPECT_EQ(service_->machine("lathe-1").error().code, Errc::NotFound);
  EXPECT_EQ(start("O0100").error().code, Errc::NotFound);
  machines::CommandRequest stop;
  stop.machine = "lathe-1";
  stop.action = dds::CommandAction::Switch;
  stop.argument = "emergency_stop";
  stop.value = 1;
  EXPECT_TRUE(service_->command(stop)) << "stopping always works";
  EXPECT_TRUE(machines_.empty()) << "no event names it either";
  closed.is_closed_ = false;
  EXPECT_TRUE(wait_notified(machines_, [](const auto& view) { return view.is_connected; }))
      << "without another word of its gateway";
  EXPECT_EQ(service_->machines().size(), 1u);
  EXPECT_TRUE(store_->machines.find("lathe-1"));
  service_.reset();  // before the store
}

TEST(IsNews, AreAlarmsPromptsAndStopsAndWhatAnOperatorSets) {
  const std::vector<void (*)(dds::Status&)> news{
      [](auto& s) { s.execution = dds::Execution::Stopped; },
      [](auto& s) { s.mode = dds::ControllerMode::Manual; },
      [](auto& s) { s.message = "ALARM"; },
      [](auto& s) { s.emergency_stop = true; },
      [](auto& s) { s.waits_for = dds::WaitsFor::CycleStart; },
      [](auto& s) { s.remote_enable = dds::RemoteEnable::NotGiven; },
      [](auto& s) { s.run = "run-2"; },
      [](auto& s) { s.program = "O2"; },
      [](auto& s) { s.feed_override = 0.5; },
      [](auto& s) { s.rapid_override = 0.5; },
      [](auto& s) { s.spindle_override = 0.5; },
      [](auto& s) { s.single_block = true; },
      [](auto& s) { s.session = 2; },
      [](auto& s) { s.serial_line.emplace(); }};
  for (std::size_t i = 0; i < news.size(); ++i) {
    dds::Status before, now;
    news[i](now);
    EXPECT_TRUE(machines::is_news(before, now)) << i;
  }
  dds::Status before, now;
  now.position[0] = 1;
  ++now.executed;
  now.feed_mm_per_min = now.buffered_seconds = 3;
  EXPECT_FALSE(machines::is_news(before, now));
}

TEST_F(MachineRuns, ShowHowFarTheGatewaysClockIsOff) {
  push("O0100", "M30\n");
  start_service();
  announce();
  EXPECT_EQ(service_->machine("lathe-1")->clock_ahead, std::nullopt);
  for (const auto ahead : {std::chrono::hours(1), std::chrono::hours(-1)}) {
    gateway_ahead_ = ahead;
    for (int i = 0; i < 4; ++i) heartbeat();
    const auto view = service_->machine("lathe-1");
    EXPECT_EQ(view->clock_ahead, ahead);
    EXPECT_EQ(machines::notices_of(*view).at(0),
              fmt::format("the gateway's clock is 3600.0 s {} the server's",
                          ahead.count() > 0 ? "ahead of" : "after"));
  }
  gateway_ahead_ = 300ms;
  for (int i = 0; i < 4; ++i) heartbeat();
  EXPECT_TRUE(machines::notices_of(*service_->machine("lathe-1")).empty());
}

TEST_F(MachineRuns, AreRefusedWhileTwoGatewaysSpeakForTheMachine) {
  push("O0100", "M30\n");
  start_service();
  announce();
  network_.on_rival("lathe-1", true);
  answer_commands(true);
  ASSERT_TRUE(start("O0100"))
      << "the successor of a killed gateway waits, and the killed is silent";
  heartbeat();
  EXPECT_TRUE(service_->machine("lathe-1")->is_contested);
  machines::CommandRequest command;
  command.machine = "lathe-1";
  command.action = dds::CommandAction::Resume;
  const auto resumed = service_->command(command);
  ASSERT_FALSE(resumed);
  EXPECT_EQ(resumed.error().what, "two gateways claim to be machine 'lathe-1'; stop one of them");
  command.action = dds::CommandAction::Hold;
  EXPECT_TRUE(service_->command(command)) << "stopping always works";
  answer_commands(false, "no run is active");
  const auto refused = service_->command(command);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("no run is active. Two gateways claim to be machine"),
            std::string::npos)
      << refused.error().what;
  network_.on_rival("lathe-1", false);
  clock_.advance(machines::MachineRegistry::kContested);
  EXPECT_FALSE(service_->machine("lathe-1")->is_contested);
}

/// A machine whose gateway is connected, and whose statuses do not arrive.
class SilentMachine : public MachineRuns {
 protected:
  void fall_silent() {
    push("O0100", "M30\n");
    start_service();
    announce();
    answer_commands(true);
    clock_.advance(machines::MachineRegistry::kStale + 1s);
  }
  Result<void> command(dds::CommandAction action) {
    machines::CommandRequest request;
    request.machine = "lathe-1";
    request.action = action;
    return service_->command(request);
  }
  bool is_stale() { return service_->machine("lathe-1")->is_stale; }
};

TEST_F(SilentMachine, IsMarkedAndOnlyStopped) {
  fall_silent();
  EXPECT_TRUE(wait_notified(machines_, [](const auto& view) { return view.is_stale; }));
  const auto view = service_->machine("lathe-1");
  EXPECT_TRUE(view->is_stale && view->is_connected);
  EXPECT_NE(machines::notices_of(*view).at(0).find("no status of it has arrived since"),
            std::string::npos);
  EXPECT_EQ(start("O0100").error().code, Errc::Timeout);
  EXPECT_EQ(command(dds::CommandAction::Resume).error().code, Errc::Timeout);
  EXPECT_TRUE(command(dds::CommandAction::Hold)) << "stopping always works";
  EXPECT_TRUE(written_->wait([&] { return written_->renewed.size() == 1; }));
}

TEST_F(SilentMachine, IsTakenAtItsWordAgainWithTheNextStatus) {
  fall_silent();
  EXPECT_TRUE(is_stale());
  heartbeat();
  EXPECT_FALSE(is_stale());
  EXPECT_TRUE(start("O0100"));
}

/// The latest one comes again when its reader is opened again.
TEST_F(SilentMachine, IsNotHeardByARepeatedStatus) {
  push("O0100", "M30\n");
  start_service();
  announce();
  dds::Status last;
  last.machine = "lathe-1";
  last.session = kSession;
  last.time = clock_.now();
  last.steady = gateway_steady();
  network_.on_status(last);
  clock_.advance(machines::MachineRegistry::kStale + 1s);
  network_.on_status(last);
  EXPECT_TRUE(is_stale());
}

/// It must not keep out the true ones, which are older by what it claims.
TEST_F(SilentMachine, IsHeardAfterAForgedStatusOfTheFuture) {
  push("O0100", "M30\n");
  start_service();
  announce();
  dds::Status forged;
  forged.machine = "lathe-1";
  forged.session = kSession;
  forged.steady = gateway_steady() + std::chrono::hours(1000);
  forged.time = clock_.now() + std::chrono::hours(1000);
  forged.execution = dds::Execution::Active;
  network_.on_status(forged);
  clock_.advance(machines::MachineRegistry::kStale + 1s);
  heartbeat();
  EXPECT_FALSE(is_stale());
  EXPECT_EQ(service_->machine("lathe-1")->status->execution, dds::Execution::Ready);
}

/// What it showed last may be from before the run.
TEST_F(SilentMachine, KeepsItsRun) {
  fall_silent();
  heartbeat();
  const auto run = start("O0100");
  ASSERT_TRUE(run) << run.error().what;
  clock_.advance(machines::MachineRegistry::kStale + 1s);
  auto endpoint = test_support::FakeServerEndpoint(written_);
  machines::CommandDispatcher dispatcher(endpoint, clock_, {}, [](const dds::Command&) {});
  std::mutex state_mutex;
  machines::RunReconciler reconciler({.runs = store_->runs,
                                      .clock = clock_,
                                      .commands = dispatcher,
                                      .state_mutex = state_mutex,
                                      .on_change = [](const auto&) {},
                                      .on_unwanted = [](const auto&) {}});
  reconciler.watch("lathe-1", run->id);
  reconciler.compare(service_->machines());
  clock_.advance(machines::RunReconciler::kAbsence);
  reconciler.compare(service_->machines());
  EXPECT_EQ(store_->runs.find(run->id)->state, storage::RunState::Active);
}

}  // namespace
}  // namespace dripline::server_test
