#include "tests/unit/server/machines/machine_fixture.hpp"

#include <thread>

namespace dripline::server_test {
namespace {

using namespace std::chrono_literals;
using dds::CommandAction;

class MachineJog : public MachineServiceTest {
 protected:
  void announce_as(std::uint32_t commands, std::uint64_t session = kSession) {
    dds::Announce announce;
    announce.machine = "lathe-1";
    announce.control = "centurion";
    announce.version = "1";
    announce.epoch = kEpoch;
    announce.session = session;
    announce.commands = commands;
    network_.on_announce(announce);
    ASSERT_TRUE(test_support::eventually([&] { return service_->machine("lathe-1").has_value(); }));
    dds::Status status;
    status.machine = "lathe-1";
    status.session = session;
    status.time = clock_.now();
    status.steady = gateway_steady();
    network_.on_status(status);
  }
  static std::uint32_t all_commands() {
    return static_cast<std::uint32_t>(dds::words_of(CommandAction{}).size());
  }
  std::vector<dds::Command> jogs() const {
    std::vector<dds::Command> found;
    const std::lock_guard lock(written_->mutex);
    for (const auto& command : written_->commands)
      if (command.action == CommandAction::Jog) found.push_back(command);
    return found;
  }
  const machines::JogRequest step_{"lathe-1", "X 1 mm F300"};
};

TEST_F(MachineJog, LivesForTwoSecondsAndIsAnsweredByTheGateway) {
  start_service();
  announce_as(all_commands());
  written_->on_command = [this](const dds::Command& command) {
    network_.on_command_result({.machine = command.machine,
                                .id = command.id,
                                .accepted = true,
                                .reason = "X 1 mm",
                                .values = "{}"});
  };
  const auto done = service_->jog(step_);
  ASSERT_TRUE(done) << done.error().what;
  EXPECT_EQ(done->text, "X 1 mm");
  ASSERT_EQ(jogs().size(), 1U);
  EXPECT_EQ(jogs()[0].argument, "X 1 mm F300");
  EXPECT_EQ(jogs()[0].session, kSession);
  EXPECT_LE(jogs()[0].deadline, gateway_steady() + 2s);
  EXPECT_TRUE(jogs()[0].run.empty());
}

/// The gateway may have moved the axis before it was killed: the next one is not asked to.
TEST_F(MachineJog, IsNotGivenToTheNextGateway) {
  start_service();
  announce_as(all_commands());
  written_->on_command = [this](const dds::Command& command) {
    if (command.action == CommandAction::Jog) announce_as(all_commands(), kSession + 1);
  };
  const auto done = service_->jog(step_);
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, Errc::Timeout);
  EXPECT_NE(done.error().what.find("whether the axis has moved is not known"), std::string::npos)
      << done.error().what;
  ASSERT_EQ(jogs().size(), 1U);
  EXPECT_EQ(jogs()[0].session, kSession);
}

TEST_F(MachineJog, NeedsAGatewayThatKnowsIt) {
  start_service();
  EXPECT_EQ(service_->jog(step_).error().code, Errc::NotFound);
  announce_as(static_cast<std::uint32_t>(CommandAction::Jog));
  const auto refused = service_->jog(step_);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Unsupported);
  EXPECT_NE(refused.error().what.find("does not know jog"), std::string::npos);
  machines::CommandRequest stop;
  stop.machine = "lathe-1";
  stop.action = CommandAction::Abort;
  stop.argument = dds::kJogAbort;
  EXPECT_EQ(service_->command(stop).error().code, Errc::Unsupported)
      << "an older one would abort its run";
  EXPECT_TRUE(written_->commands.empty());
  announce_as(all_commands());
  answer_commands(true);
  EXPECT_TRUE(service_->command(stop));
}

}  // namespace
}  // namespace dripline::server_test
