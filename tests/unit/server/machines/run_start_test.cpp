// Starting runs: what a gateway gets, and who refuses.
#include <thread>

#include "server/machines/machine_registry.hpp"
#include "tests/unit/server/machines/machine_fixture.hpp"

namespace dripline::server_test {
namespace {

using namespace std::chrono_literals;

TEST_F(MachineRuns, SendAStartCommandAndAreActiveOnceItIsAccepted) {
  const auto revision = push("O0100", "M30\n");
  start_service();
  announce();
  answer_commands(true);
  const auto run = start("O0100");
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(run->state, storage::RunState::Active);
  EXPECT_EQ(run->author, "cam");
  const dds::Command& command = written_->commands.at(0);
  EXPECT_EQ(command.action, dds::CommandAction::Start);
  EXPECT_EQ(command.run, run->id);
  EXPECT_EQ(command.revision, revision.content.hex());
  EXPECT_EQ(command.size, 4u);
  EXPECT_EQ(command.session, kSession);
  EXPECT_NE(command.server, 0u);
  EXPECT_EQ(command.deadline, gateway_steady() + 200ms) << "by the gateway's clock";
}

/// MOD functions take effect at once: a control's screen shows by the setup without a start.
TEST_F(MachineRuns, AreNotNeededForTheSetupToBeShown) {
  start_service();
  announce();
  ASSERT_TRUE(setups_->save({"lathe-1", "centurion", "[[tool]]\nnumber = 1\n", ""}, "cam"));
  const auto setups_shown = [&] {
    std::vector<std::string> shown;
    for (const dds::Command& command : written_->commands)
      if (command.action == dds::CommandAction::Query) shown.push_back(command.setup);
    return shown;
  };
  const auto show = [&] {
    dds::Status status;
    status.machine = "lathe-1";
    status.session = kSession;
    status.time = clock_.now();
    status.steady = gateway_steady();
    status.screen.emplace();
    network_.on_status(status);
  };
  show();
  ASSERT_TRUE(written_->wait([&] { return setups_shown().size() == 1; })) << "at its beginning";
  EXPECT_EQ(setups_shown()[0], "[[tool]]\nnumber = 1\n");
  show();
  ASSERT_TRUE(setups_->save({"lathe-1", "centurion", "[[tool]]\nnumber = 2\n", ""}, "cam"));
  service_->show_setup("lathe-1");
  ASSERT_TRUE(written_->wait([&] { return setups_shown().size() == 2; })) << "once it is stored";
  EXPECT_EQ(setups_shown()[1], "[[tool]]\nnumber = 2\n");
  service_->show_setup("nothing");
}

/// A gateway with a line gives its control no setup: it has what was loaded there.
TEST_F(MachineRuns, HaveTheSetupThatIsInTheControlBehindAGatewaysLine) {
  push("O0100", "M30\n");
  start_service();
  announce();
  answer_commands(true);
  const std::string first = "[[tool]]\nnumber = 1\n", second = "[[tool]]\nnumber = 2\n";
  for (const auto& text : {first, second})
    ASSERT_TRUE(setups_->save({"lathe-1", "centurion", text, ""}, "cam"));
  const auto newest = start("O0100");
  EXPECT_EQ(newest->setup, 2u) << "no line: the newest goes with the start";
  EXPECT_EQ(written_->commands.back().setup, second);
  EXPECT_TRUE(store_->runs.set_state(newest->id, storage::RunState::Aborted, ""));
  dds::Status status;
  status.machine = "lathe-1";
  status.session = kSession;
  status.time = clock_.now();
  status.steady = gateway_steady();
  status.serial_line.emplace();
  network_.on_status(status);
  const auto unknown = start("O0100");
  ASSERT_TRUE(unknown) << unknown.error().what;
  EXPECT_EQ(unknown->setup, std::nullopt) << "never stated what is in the control";
  EXPECT_TRUE(store_->runs.set_state(unknown->id, storage::RunState::Aborted, ""));
  EXPECT_EQ(written_->commands.back().setup, "");
  ASSERT_TRUE(store_->setups.note_loaded("lathe-1", 1, "olga"));
  const auto known = start("O0100");
  ASSERT_TRUE(known) << known.error().what;
  EXPECT_EQ(known->setup, 1u);
  EXPECT_EQ(written_->commands.back().setup, first);
}

TEST_F(MachineRuns, TellTheGatewayWhereToBegin) {  // CEN-163
  push("O0100", "N5 M30\n");
  start_service();
  announce();
  answer_commands(true);
  machines::StartRequest elsewhere;
  elsewhere.machine = "lathe-1";
  elsewhere.program = "O0100";
  elsewhere.author = "cam";
  elsewhere.from.tool = 12;
  elsewhere.from.pass = 3;
  elsewhere.memory = machines::StartMemory::Begin;
  ASSERT_TRUE(service_->start(elsewhere));
  EXPECT_EQ(written_->commands.at(0).argument, "T12 pass=3 memory=begin");
}

/// A hand-over is ordered while a start is in progress: it is not left for the next server to find.
TEST_F(MachineRuns, AreAnsweredWhileTheServerEnds) {
  push("O0100", "M30\n");
  start_service();
  announce();
  std::thread answering;
  written_->on_command = [&](const dds::Command& command) {
    if (answering.joinable()) return;  // sent again
    answering = std::thread([this, command] {
      service_->stop_waiting();
      std::this_thread::sleep_for(50ms);
      network_.on_command_result(
          {.machine = command.machine, .id = command.id, .accepted = true, .reason = ""});
    });
  };
  const auto run = start("O0100");
  answering.join();
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(run->state, storage::RunState::Active);
}

/// The next server finds out what has become of it.
TEST_F(MachineRuns, StayOrderedWhenTheServerEndsBeforeTheAnswer) {
  push("O0100", "M30\n");
  start_service();
  announce();
  std::thread ending;
  written_->on_command = [&](const dds::Command&) {
    if (!ending.joinable()) ending = std::thread([this] { service_->stop_waiting(); });
  };
  const auto run = start("O0100");
  ending.join();
  ASSERT_FALSE(run);
  const auto runs = store_->runs.list({}, {});
  ASSERT_EQ(runs->size(), 1u);
  EXPECT_EQ(runs->front().state, storage::RunState::Ordered) << run.error().what;
}

TEST_F(MachineRuns, AreRefusedWithTheGatewaysReason) {
  push("O0100", "M30\n");
  start_service();
  announce();
  answer_commands(false, "the door is open");
  const auto run = start("O0100");
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().code, Errc::Busy);
  EXPECT_NE(run.error().what.find("the door is open"), std::string::npos);
  const auto runs = store_->runs.list({}, {});
  ASSERT_EQ(runs->size(), 1u);
  EXPECT_EQ(runs->front().state, storage::RunState::Refused);
}

TEST_F(MachineRuns, AreRefusedWhenTheGatewayDoesNotAnswerAndAbortedShouldItAnswerLate) {
  push("O0100", "M30\n");
  start_service();
  announce();
  const auto run = start("O0100");
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().code, Errc::Timeout);
  EXPECT_EQ(store_->runs.list({}, {})->front().state, storage::RunState::Refused);
  const dds::Command command = written_->commands.at(0);
  network_.on_command_result(
      {.machine = command.machine, .id = command.id, .accepted = true, .reason = {}});
  ASSERT_TRUE(written_->wait([&] { return written_->commands.size() == 2; }));
  EXPECT_EQ(written_->commands[1].action, dds::CommandAction::Abort);
  EXPECT_EQ(written_->commands[1].run, command.run);
}

TEST_F(MachineRuns, ThatWereRefusedAreAbortedShouldTheMachineShowThemAllTheSame) {
  push("O0100", "M30\n");
  start_service();
  announce();
  ASSERT_FALSE(start("O0100"));  // taken by the gateway, but its answer was lost with the link
  const std::string run = store_->runs.list({}, {})->front().id;
  status(run);
  ASSERT_TRUE(written_->wait([&] { return written_->commands.size() >= 2; }));
  EXPECT_EQ(written_->commands[1].action, dds::CommandAction::Abort);
  EXPECT_EQ(written_->commands[1].run, run);
}

/// The status of a short run may come before the answer to its start.
TEST_F(MachineRuns, HaveWhatTheGatewaySaysOfTheirStartAlsoWhenTheMachineShowsThemBefore) {
  push("O0100", "M30\n");
  start_service();
  announce();
  std::jthread gateway;
  written_->on_command = [&](const dds::Command& command) {
    status(command.run);
    gateway = std::jthread([this, command] {
      std::this_thread::sleep_for(20ms);
      network_.on_command_result({.machine = command.machine,
                                  .id = command.id,
                                  .accepted = true,
                                  .reason = "without a tool"});
    });
  };
  std::string notice;
  const auto run =
      service_->start({.machine = "lathe-1",
                       .program = "O0100",
                       .revision = {},
                       .author = "cam",
                       .on_notice = [&](const std::string& given) { notice = given; }});
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(notice, "without a tool");
}

TEST_F(MachineRuns, BeginWhenTheMachineShowsThemAndTheAnswerIsLost) {
  push("O0100", "M30\n");
  start_service();
  announce();
  written_->on_command = [&](const dds::Command& command) { status(command.run); };
  const auto run = start("O0100");
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(run->state, storage::RunState::Active);
}

/// The audit entry is one of them.
TEST_F(MachineRuns, SendNothingWhenWhatComesBeforeThemFails) {
  push("O0100", "M30\n");
  start_service();
  announce();
  answer_commands(true);
  std::string noted;
  const auto try_start = [&](const Result<void>& outcome) {
    return service_->start({.machine = "lathe-1",
                            .program = "O0100",
                            .revision = {},
                            .author = "cam",
                            .before = [&, outcome](const Run& run) {
                              noted = run.id;
                              EXPECT_TRUE(written_->commands.empty());
                              EXPECT_EQ(store_->runs.find(run.id)->state,
                                        storage::RunState::Ordered);
                              return outcome;
                            }});
  };
  const auto refused = try_start(fail(Errc::Io, "disk full"));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().what, "disk full");
  EXPECT_TRUE(written_->commands.empty());
  EXPECT_EQ(store_->runs.find(noted)->state, storage::RunState::Refused);
  EXPECT_TRUE(try_start({})) << "the machine is not occupied";
}

TEST_F(MachineRuns, NeedAConnectedMachineThatIsKnown) {
  push("O0100", "M30\n");
  start_service();
  EXPECT_EQ(start("O0100").error().code, Errc::NotFound);
  announce();
  network_.on_lost("lathe-1");
  const auto run = start("O0100");
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().code, Errc::Timeout);
  EXPECT_NE(run.error().what.find("last seen 2023-11-14T"), std::string::npos) << run.error().what;
  EXPECT_TRUE(store_->runs.list({}, {})->empty());
}

TEST_F(MachineRuns, AreOnlyOfProgramsForTheMachinesControl) {
  push("H1", "0 BEGIN PGM\n", "tnc155");
  start_service();
  announce();
  const auto run = start("H1");
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().code, Errc::Unsupported);
  EXPECT_NE(run.error().what.find("tnc155"), std::string::npos);
}

TEST_F(MachineRuns, AreOneAtATimeOnAMachine) {
  push("O0100", "M30\n");
  start_service();
  announce();
  answer_commands(true);
  ASSERT_TRUE(start("O0100"));
  EXPECT_EQ(start("O0100").error().code, Errc::Busy);
}

// HD-052, HD-053: only where the setup says that the control keeps its programs.
TEST_F(MachineRuns, AreRefusedWhereTheControlCannotKeepWhatTheProgramCalls) {
  std::string called = "BEGIN PGM 8 MM\n";
  for (int i = 1; i < 1000; ++i) called += "CC\n";
  push("8.h", called, "tnc155");
  push("7.h", "0 BEGIN PGM 7 MM\n1 CALL PGM 8\n2 END PGM 7 MM\n", "tnc155");
  add_machine("mill-1", "tnc155");
  start_service();
  dds::Announce mill;
  mill.machine = "mill-1";
  mill.control = "tnc155";
  mill.version = "1";
  mill.epoch = kEpoch;
  mill.session = kSession;
  network_.on_announce(mill);
  heartbeat("mill-1");
  answer_commands(true);
  const auto set = [&](const std::string& text) {
    EXPECT_TRUE(setups_->save({"mill-1", "tnc155", text, ""}, "cam"));
  };
  const auto start_it = [&] {
    return service_->start(
        {.machine = "mill-1", .program = "7.h", .revision = {}, .author = "cam"});
  };
  set("[control]\nmemory_limits = true\n");
  const auto refused = start_it();
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::LimitExceeded);
  EXPECT_EQ(refused.error().what,
            "machine 'mill-1' cannot keep program '7.h': line 2: PROGRAM MEMORY EXCEEDED: program "
            "8 has 1000 blocks, 999 is most (in program 8, which is called here)");
  set("[control]\nmemory_limits = false\n");
  EXPECT_TRUE(start_it());
}

/// The machine says itself which run it has; the store may be away.
TEST_F(MachineRuns, AreStoppedByTheMachinesOwnReportWithoutTheStore) {
  start_service();
  answer_commands(true);
  announce();
  dds::Status status;
  status.machine = "lathe-1";
  status.session = kSession;
  status.time = clock_.now();
  status.steady = gateway_steady();
  status.run = "not-in-the-store";
  network_.on_status(status);
  ASSERT_TRUE(wait_notified(machines_, [](const auto& view) {
    return view.status && view.status->run == "not-in-the-store";
  }));
  machines::CommandRequest request;
  request.run = "not-in-the-store";
  request.action = dds::CommandAction::Hold;
  EXPECT_TRUE(service_->command(request));
  request.action = dds::CommandAction::Abort;
  EXPECT_TRUE(service_->command(request));
  ASSERT_EQ(written_->commands.size(), 2u);
  EXPECT_EQ(written_->commands[1].run, "not-in-the-store");
  request.action = dds::CommandAction::Resume;
  EXPECT_EQ(service_->command(request).error().code, Errc::NotFound);
  request.run = "another";
  request.action = dds::CommandAction::Abort;
  EXPECT_EQ(service_->command(request).error().code, Errc::NotFound);
}

/// Who gave the start is at the machine by then.
TEST_F(MachineRuns, AreNotStartedLongAfterTheyWereAskedFor) {
  push("O0100", "M30\n");
  start_service();
  answer_commands(true);
  announce();
  ASSERT_TRUE(wait_notified(machines_, [](const auto& view) { return view.is_connected; }));
  const auto run = service_->start({.machine = "lathe-1",
                                    .program = "O0100",
                                    .revision = {},
                                    .author = "cam",
                                    .before = [this](const Run&) -> Result<void> {
                                      clock_.advance(std::chrono::seconds(11));
                                      return {};
                                    }});
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().code, Errc::Busy);
  EXPECT_NE(run.error().what.find("took 11 s, 10 are allowed"), std::string::npos)
      << run.error().what;
  EXPECT_TRUE(written_->commands.empty());
  EXPECT_EQ(store_->runs.list({}, {})->at(0).state, storage::RunState::Refused);
}

}  // namespace
}  // namespace dripline::server_test
