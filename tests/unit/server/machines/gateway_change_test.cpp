// A gateway that is replaced by the next, which begins with its switches off.
#include "server/machines/machine_registry.hpp"
#include "tests/unit/server/machines/machine_fixture.hpp"

namespace dripline::server_test {
namespace {

/// The first connection is lost, and the same gateway comes back.
TEST_F(MachineRuns, AreStartedByTheSameGatewayWhenItsConnectionIsBack) {
  auto endpoint = test_support::FakeServerEndpoint(written_);
  machines::CommandDispatcher::Options options;
  options.repeat = std::chrono::milliseconds(5);
  options.gateway_of = [](const std::string&) {
    return machines::CommandDispatcher::Options::Gateway{1, std::chrono::microseconds{0}};
  };
  machines::CommandDispatcher dispatcher(endpoint, clock_, options, [](const dds::Command&) {});
  int heard_so_far = 0;
  written_->on_command = [&](const dds::Command& heard) {
    if (++heard_so_far < 3) return;
    dispatcher.on_result({.machine = "lathe-1", .id = heard.id, .accepted = true, .reason = {}});
  };
  dds::Command command;
  command.machine = "lathe-1";
  command.action = dds::CommandAction::Start;
  EXPECT_TRUE(dispatcher.carry_out(command));
  EXPECT_EQ(written_->commands.at(0).id, written_->commands.back().id)
      << "the same command, sent again";
}

/// What moves was given to a machine whose switches (test run, single block) were seen: the next
/// gateway has others. What stops goes to whichever is there.
TEST_F(MachineRuns, AreNotGivenToAGatewayThatHasReplacedTheOneAddressed) {
  using enum dds::CommandAction;
  for (const auto action : {Start, Resume, Answer, Handwheel, Switch, SetPosition, Hold, Abort}) {
    written_->commands.clear();
    auto endpoint = test_support::FakeServerEndpoint(written_);
    std::atomic<std::uint64_t> session = 1;
    machines::CommandDispatcher::Options options;
    options.repeat = std::chrono::milliseconds(5);
    options.gateway_of = [&](const std::string&) {
      return machines::CommandDispatcher::Options::Gateway{session, std::chrono::microseconds{0}};
    };
    machines::CommandDispatcher dispatcher(endpoint, clock_, options, [](const dds::Command&) {});
    written_->on_command = [&](const dds::Command& heard) {
      session = 2;  // the first is gone, and has answered nothing
      if (heard.session != 2) return;
      dispatcher.on_result({.machine = "lathe-1", .id = heard.id, .accepted = true, .reason = {}});
    };
    dds::Command command;
    command.machine = "lathe-1";
    command.action = action;
    const auto done = dispatcher.carry_out(command);
    const bool is_stop = action == Hold || action == Abort;
    EXPECT_EQ(done.has_value(), is_stop) << dds::to_string(action);
    EXPECT_EQ(written_->commands.back().session, is_stop ? 2U : 1U) << dds::to_string(action);
    if (done) continue;
    EXPECT_EQ(done.error().code, Errc::Timeout);
    EXPECT_NE(done.error().what.find("its gateway was replaced"), std::string::npos);
  }
}

TEST_F(MachineRuns, AreRefusedWhenTheirGatewayIsReplacedBeforeItAnswers) {
  push("O0100", "M30\n");
  start_service();
  announce();
  written_->on_command = [&](const dds::Command& command) {
    dds::Announce next;
    next.machine = command.machine;
    next.control = "centurion";
    next.epoch = kEpoch;
    next.session = kSession + 1;
    network_.on_announce(next);
  };
  const auto run = start("O0100");
  ASSERT_FALSE(run);
  EXPECT_NE(run.error().what.find("nothing has begun at the new one"), std::string::npos)
      << run.error().what;
  EXPECT_EQ(store_->runs.list({}, {})->front().state, storage::RunState::Refused);
  EXPECT_EQ(written_->commands.size(), 1U);
}

/// The store may take some seconds.
TEST_F(MachineRuns, AreRefusedWhenTheirGatewayIsReplacedBeforeTheyAreSent) {
  push("O0100", "M30\n");
  start_service();
  announce();
  answer_commands(true);
  const auto run = service_->start({.machine = "lathe-1",
                                    .program = "O0100",
                                    .revision = {},
                                    .author = "cam",
                                    .before = [&](const Run&) -> Result<void> {
                                      dds::Status next;
                                      next.machine = "lathe-1";
                                      next.session = kSession + 1;
                                      next.time = clock_.now();
                                      next.steady = gateway_steady();
                                      network_.on_status(next);
                                      return {};
                                    }});
  ASSERT_FALSE(run);
  EXPECT_NE(run.error().what.find("its gateway was replaced"), std::string::npos)
      << run.error().what;
  EXPECT_TRUE(written_->commands.empty());
}

/// The switches are in the memory of the gateway that is gone.
TEST_F(MachineRuns, AreNotBegunUnawaresAfterARestartHasSwitchedTheTestRunOff) {
  start_service();
  announce();
  const auto report = [&](std::uint64_t session, bool tests, const std::string& run = "") {
    dds::Status status;
    status.machine = "lathe-1";
    status.session = session;
    status.time = clock_.now();
    status.steady = gateway_steady();
    status.run = run;
    status.switches.emplace();
    status.switches->test_run = tests ? dds::SwitchState::On : dds::SwitchState::Off;
    status.switches->machine_lock = status.switches->test_run;
    network_.on_status(status);
  };
  const auto notice = [&] { return machines::switch_notice(*service_->machine("lathe-1")); };
  report(kSession, false);
  report(kSession + 1, false);
  EXPECT_EQ(notice(), "") << "nothing was on";
  report(kSession + 1, true);
  report(kSession + 2, false);
  EXPECT_EQ(notice(),
            "the gateway was restarted, and test_run, machine_lock, on before, is off: a start "
            "moves the machine");
  report(kSession + 3, false);
  EXPECT_NE(notice(), "") << "restarted once more";
  report(kSession + 3, true);
  EXPECT_EQ(notice(), "") << "on again";
  report(kSession + 4, false);
  report(kSession + 4, false, "run-9");
  EXPECT_EQ(notice(), "") << "someone has started since";
}

}  // namespace
}  // namespace dripline::server_test
