#include "server/ports/requests/remote_request_handler.hpp"

#include "server/machines/stop_order.hpp"
#include "tests/unit/server/ports/port_fixture.hpp"

namespace dripline::server_test {
namespace {

using namespace std::chrono_literals;

/// A line that keeps what it gets.
class FakeRequestedLine final : public ports::RequestedLine {
 public:
  std::vector<std::string> notes, refusals;
  std::vector<ports::SendJob> answers;
  std::vector<machines::StartRequest> starts;
  Started started;
  Result<void> reset;  ///< whether it is confirmed

  void note(const std::string& words) override { notes.push_back(words); }
  void refuse(const std::string& why) override { refusals.push_back(why); }
  bool is_asked() const override { return false; }
  Result<void> check_reset() const override { return reset; }
  void accept_receive(const std::string&) override {}
  void send(ports::SendJob job) override { answers.push_back(std::move(job)); }
  void start_later(const machines::StartRequest& request, Started later,
                   const std::string&) override {
    starts.push_back(request);
    started = std::move(later);
  }
};

/// What a text from the control asks for, by a rule of its line.
class RequestByRule : public ServerTest {
 protected:
  RequestByRule() {
    add_machine("mill");
    push("O1", "%\nO1\nM30\n%\n");
    handler_.emplace(ports::RemoteRequestHandler::Parts{.store = *store_,
                                                        .releases = *releases_,
                                                        .line = line_,
                                                        .clock = clock_,
                                                        .machine = "mill",
                                                        .reply = "O9998",
                                                        .offer = wire::Offer::All});
  }
  ~RequestByRule() override { *line_ = {}; }  // what it was to start holds the line
  void ask(std::chrono::milliseconds ago, line::RuleAction action = line::RuleAction::Send) {
    handler_->carry_out(action, "O1", clock_.steady_now() - ago);
  }

  std::shared_ptr<FakeRequestedLine> line_ = std::make_shared<FakeRequestedLine>();
  std::optional<ports::RemoteRequestHandler> handler_;
};

TEST_F(RequestByRule, IsGivenAtTheTimeOfItsText) {
  ask(3s);
  ASSERT_EQ(line_->starts.size(), 1U);
  EXPECT_EQ(line_->starts[0].given, clock_.steady_now() - 3s);
}

TEST_F(RequestByRule, IsLeftAloneWhenItWaitedForLong) {
  using enum line::RuleAction;
  for (const auto action : {Send, Directory, Restart, NextJob}) {
    ask(machines::StopOrder::kMaxWait + 1s, action);
    ASSERT_EQ(line_->notes.size(), 1U);
    EXPECT_NE(line_->notes[0].find("waited 11.0 s in the server"), std::string::npos)
        << line_->notes[0];
    EXPECT_TRUE(line_->starts.empty() && line_->answers.empty()) << "no text comes so late";
    line_->notes.clear();
  }
}

TEST_F(RequestByRule, IsNotAnsweredLateEither) {
  ask(0s);
  clock_.advance(machines::StopOrder::kMaxWait + 1s);
  line_->started(fail(Errc::Busy, "storing it took 11 s"));
  EXPECT_EQ(line_->notes.size(), 1U);
  EXPECT_TRUE(line_->answers.empty());
}

TEST_F(RequestByRule, GetsItsRefusalAsAProgramOfComments) {
  ask(0s);
  line_->started(fail(Errc::Busy, "it is busy"));
  EXPECT_EQ(line_->answers.size(), 1U);
}

TEST_F(RequestByRule, GetsNoTextWhileAResetIsToBeConfirmed) {
  line_->reset = fail(Errc::Conflict, "reset the control");
  ask(0s);
  line_->started(fail(Errc::Conflict, "reset the control"));
  EXPECT_TRUE(line_->answers.empty());
  EXPECT_EQ(line_->notes.size(), 1U);
}

/// The control is still waiting for it.
TEST_F(RequestByRule, OfTheProtocolHasNoTime) {
  handler_->answer({.kind = wire::TransferRequest::Kind::SendProgram, .name = "O1"});
  ASSERT_EQ(line_->starts.size(), 1U) << fmt::format("{}", fmt::join(line_->notes, "; "));
  EXPECT_EQ(line_->starts[0].given, std::nullopt);
}

/// A text with the words of a rule may come from a program that is still executed there.
TEST_F(PortServiceTest, SendsNothingByARuleUntilAPersonConfirmsTheReset) {
  start_ports();
  add_machine("mill");
  push("O1", blocks(20000));
  push("O0002", "%\nO2\nG0 X9\nM30\n%\n");
  add_port(mill("reply = \"O9998\"\n[[rule]]\ntrigger = \"PRG\"\naction = \"send\"\n"));
  const auto run = start("O1");
  ASSERT_TRUE(run) << run.error().what;
  line().read_until("N50 ");
  ASSERT_TRUE(command(run->id, dds::CommandAction::Abort));
  ASSERT_TRUE(wait_state(run->id, storage::RunState::Aborted));
  ASSERT_TRUE(wait([&] { return line().read_for(40ms).empty(); }));
  const std::string request = "%\nO9999\n(PRG=O0002)\nM30\n%\n";
  line().write(request);
  ASSERT_TRUE(wait([&] {
    return std::ranges::any_of(recording(), [](const ports::PortTraffic& one) {
      return one.text.starts_with("refused: run ") &&
             one.text.find("confirm-reset com1") != std::string::npos;
    });
  }));
  EXPECT_EQ(line().read_for(60ms), "") << "no program, and no reason either";
  ASSERT_TRUE(ports_->confirm_reset("com1"));
  line().write(request);
  EXPECT_EQ(line().read_until("M30\n%\n"), "%\nO2\nG0 X9\nM30\n%\n");
}

}  // namespace
}  // namespace dripline::server_test
