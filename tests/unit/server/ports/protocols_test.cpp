#include "tests/support/line/played_control.hpp"
#include "tests/unit/server/ports/port_fixture.hpp"

namespace dripline::server_test {
namespace {

using storage::RunState;
using test_support::PlayedControl;

/// A control that speaks a protocol of its own, at the end of the port's line.
class LineProtocolTest : public PortServiceTest {
 protected:
  void add_control(const std::string& flow, const std::string& offer = "none") {
    start_ports();
    add_machine("mill", "tnc155");
    auto port = mill();
    port.settings = {{"baud", "115200"}, {"flow", flow}, {"offer", offer}};
    add_port(port);
    control_ = std::make_unique<PlayedControl>(ports_->port("com1")->settings, line());
  }
  static std::string tnc_program(int number, int count) {
    std::string text = fmt::format("0 BEGIN PGM {} MM\n", number);
    for (int i = 1; i <= count; ++i) text += fmt::format("{} L X+{} Y-{} F200 M\n", i, i, i);
    return text + fmt::format("{} END PGM {} MM\n", count + 1, number);
  }
  std::vector<Run> runs() {
    return store_->runs.list({.machine = "mill", .program = {}, .state = {}}, {}).value();
  }
  std::unique_ptr<PlayedControl> control_;
};

TEST_F(LineProtocolTest, CountsWhatAnXmodemReceiverAccepts) {
  add_control("xmodem");
  const std::string text = blocks(200);
  push("O1", text, "tnc155");
  const auto run = start("O1");
  ASSERT_TRUE(run) << run.error().what;
  ASSERT_TRUE(control_->line().begin_receive("", control_->now()));
  ASSERT_TRUE(control_->until([&] { return control_->programs.size() == 1; }));
  EXPECT_TRUE(control_->programs[0] == text) << control_->programs[0].size();
  ASSERT_TRUE(
      control_->until([&] { return store_->runs.find(run->id)->state != RunState::Active; }));
  const auto stored = store_->runs.find(run->id);
  EXPECT_EQ(stored->state, RunState::Completed);
  EXPECT_EQ(stored->counters.sent, text.size());
  EXPECT_EQ(stored->counters.accepted, 200u);
  EXPECT_EQ(stored->counters.executed, 0u);
}

TEST_F(LineProtocolTest, ContinuesACheckedTransferWhenTheCableIsBack) {
  add_control("xmodem");
  const std::string text = blocks(300);
  push("O1", text, "tnc155");
  const auto run = start("O1");
  ASSERT_TRUE(run);
  ASSERT_TRUE(control_->line().begin_receive("", control_->now()));
  ASSERT_TRUE(control_->until([&] { return control_->received.size() > 1000; }));
  line().pull();
  ASSERT_TRUE(wait([&] { return !ports_->machines().machine("mill")->is_connected; }));
  EXPECT_EQ(ports_->machines().machine("mill")->status->execution, dds::Execution::Waiting);
  line().put_back();
  ASSERT_TRUE(
      control_->until([&] { return store_->runs.find(run->id)->state == RunState::Completed; }));
  EXPECT_TRUE(control_->received == text) << control_->received.size();
}

TEST_F(LineProtocolTest, SendsTheProgramThatATncAsksFor) {
  add_control("heidenhain_bcc", "all");
  const std::string text = tnc_program(15, 50);
  push("15.h", text, "tnc155");
  ASSERT_TRUE(
      control_->line().request({wire::TransferRequest::Kind::SendProgram, "15"}, control_->now()));
  ASSERT_TRUE(control_->until([&] { return control_->programs.size() == 1; }));
  EXPECT_TRUE(control_->programs[0] == text) << control_->programs[0];
  ASSERT_TRUE(control_->until([&] { return runs().front().state == RunState::Completed; }));
  EXPECT_EQ(runs().front().program, "15.h");
  EXPECT_EQ(runs().front().counters.accepted, 52u);
}

TEST_F(LineProtocolTest, ReportsAMissingProgramToATnc) {
  add_control("heidenhain_bcc", "all");
  ASSERT_TRUE(
      control_->line().request({wire::TransferRequest::Kind::SendProgram, "77"}, control_->now()));
  ASSERT_TRUE(control_->until([&] { return !control_->failures.empty(); }));
  EXPECT_TRUE(runs().empty());
}

TEST_F(LineProtocolTest, ListsItsProgramsForATncOneByOne) {
  add_control("heidenhain_bcc", "all");
  push("O0007", tnc_program(7, 2), "tnc155");
  push("15.h", tnc_program(15, 2), "tnc155");
  push("no-number", tnc_program(1, 2), "tnc155");
  push("O3", "%C\nG0\n", "centurion");
  const auto ask = [&] {
    return control_->line().request({wire::TransferRequest::Kind::Directory, ""}, control_->now());
  };
  for (std::size_t count = 1; count <= 2; ++count) {
    ASSERT_TRUE(ask());
    ASSERT_TRUE(control_->until([&] { return control_->programs.size() == count; }));
  }
  ASSERT_TRUE(ask());
  ASSERT_TRUE(control_->until([&] { return !control_->failures.empty(); }));
  EXPECT_EQ(control_->failures[0].what, "the device has no program left");
  EXPECT_NE(control_->programs[0].find("BEGIN PGM 7 "), std::string::npos);
  EXPECT_NE(control_->programs[1].find("BEGIN PGM 15 "), std::string::npos);
  // Asked again and again, it has no more to offer.
  for (std::size_t count = 2; count <= 4; ++count) {
    ASSERT_TRUE(ask());
    ASSERT_TRUE(control_->until([&] { return control_->failures.size() == count; }));
  }
  EXPECT_EQ(control_->programs.size(), 2u);
  EXPECT_TRUE(runs().empty());
}

/// A control that was fed asks for the rest of its program with the words that ask for any program.
TEST_F(LineProtocolTest, OffersNothingAfterARunThatWasBrokenOff) {
  start_ports();
  add_machine("mill", "tnc155");
  auto port = mill();
  port.line_template = "tnc155";
  port.settings = {{"baud", "9600"}, {"leader", "0"}};
  add_port(port);
  push("21.h", tnc_program(21, 2), "tnc155");
  push("22.h", tnc_program(22, 2000), "tnc155");
  line().write("\x11");
  EXPECT_NE(line().read_until("\x03").find("BEGIN PGM 21 "), std::string::npos) << "read-in";
  line().write("\x04");
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->line.phase == wire::Phase::Idle; }));
  const auto run = start("22.h");
  ASSERT_TRUE(run) << run.error().what;
  line().write("\x11");
  line().read_until("\n5 ");
  line().pull();
  ASSERT_TRUE(wait_state(run->id, RunState::Interrupted));
  line().put_back();
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->is_open; }));
  line().read_for(std::chrono::milliseconds(50));
  line().write("\x11");
  ASSERT_TRUE(wait([&] {
    const auto request = ports_->port("com1")->request;
    return request && request->answer.find("was broken off") != std::string::npos;
  }));
  EXPECT_EQ(line().read_until("\x04"), "\x04");
  const auto sent = ports_->send("com1", {{"21.h", std::nullopt}});
  ASSERT_TRUE(sent) << sent.error().what;
  line().write("\x11");
  line().read_until("\x03");
  line().write("\x04");
  ASSERT_TRUE(wait(
      [&] { return ports_->port("com1")->transfer->state == ports::TransferState::Completed; }));
  line().write("\x11");
  const std::string again = line().read_until("BEGIN PGM ");
  EXPECT_NE(again.find("BEGIN PGM "), std::string::npos) << "offered again";
}

TEST_F(LineProtocolTest, EndsTheRunThatAnXmodemReceiverCancels) {
  add_control("xmodem");
  push("O1", blocks(100), "tnc155");
  const auto run = start("O1");
  ASSERT_TRUE(run) << run.error().what;
  line().write("C");
  line().read_until("G1 ");
  line().write("\x18\x18");
  ASSERT_TRUE(wait_state(run->id, RunState::Interrupted)) << "not kept for a line that is there";
}

TEST_F(LineProtocolTest, OffersOnlyWhatIsKnownToBeForTheControl) {
  add_control("heidenhain_bcc", "all");
  push("O3", "%C\nG0\n", "centurion");
  ASSERT_TRUE(
      control_->line().request({wire::TransferRequest::Kind::Directory, ""}, control_->now()));
  ASSERT_TRUE(control_->until([&] { return control_->failures.size() == 1; }));
  ASSERT_TRUE(
      control_->line().request({wire::TransferRequest::Kind::SendProgram, "3"}, control_->now()));
  ASSERT_TRUE(control_->until([&] { return control_->failures.size() == 2; }));
  EXPECT_TRUE(control_->programs.empty());
  EXPECT_TRUE(runs().empty());
}

TEST_F(LineProtocolTest, SendsATncNothingThatIsNotOffered) {
  add_control("heidenhain_bcc");
  push("15.h", tnc_program(15, 2), "tnc155");
  for (const auto* name : {"15", ""}) {
    control_->failures.clear();
    ASSERT_TRUE(control_->line().request({wire::TransferRequest::Kind::SendProgram, name},
                                         control_->now()));
    ASSERT_TRUE(control_->until([&] { return !control_->failures.empty(); })) << name;
    EXPECT_NE(control_->failures[0].what.find("NO RUN WAITS"), std::string::npos)
        << control_->failures[0].what;
    const auto request = ports_->port("com1")->request;
    ASSERT_TRUE(request) << name;
    EXPECT_EQ(request->program, name);
    EXPECT_EQ(request->answer, "NO RUN WAITS");
  }
  EXPECT_TRUE(control_->received.empty());
  EXPECT_TRUE(runs().empty());
}

TEST_F(LineProtocolTest, LetsAnXmodemReceiverWaitForTheRun) {
  add_control("xmodem");
  push("21.h", tnc_program(21, 2), "tnc155");
  const std::string text = blocks(20);
  push("O1", text, "tnc155");
  ASSERT_TRUE(control_->line().begin_receive("", control_->now()));
  ASSERT_TRUE(control_->until([&] { return ports_->port("com1")->request.has_value(); }));
  EXPECT_TRUE(control_->failures.empty());
  EXPECT_TRUE(control_->received.empty());
  const auto run = start("O1");
  ASSERT_TRUE(run) << run.error().what;
  ASSERT_TRUE(control_->until([&] { return control_->programs.size() == 1; }));
  EXPECT_EQ(control_->programs[0], text);
  EXPECT_FALSE(ports_->port("com1")->request);
}

/// A Fanuc at the end of the line.
class FanucLineTest : public PortServiceTest {
 protected:
  void add_fanuc(const std::string& more_key = "retries", const std::string& more_value = "10") {
    start_ports();
    add_machine("mill", "fanuc");
    auto port = mill();
    port.line_template = "fanuc";
    port.settings = {{"baud", "115200"}, {more_key, more_value}};
    add_port(port);
  }
  bool is_noted(const std::string& text) {
    for (const auto& entry : recording()) {
      if (entry.text.find(text) != std::string::npos) return true;
    }
    return false;
  }
};

TEST_F(FanucLineTest, SendsNothingThatWasNotCommanded) {
  add_fanuc();
  push("O2001", "O2001\nM30\n", "fanuc");
  line().write("\x11");
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->request.has_value(); }));
  ASSERT_TRUE(wait([&] { return is_noted("the control asked for a program; no run waits"); }));
  EXPECT_EQ(line().read_for(std::chrono::milliseconds(100)), "");
  EXPECT_EQ(ports_->port("com1")->request->answer, "");
  EXPECT_EQ(ports_->machines().machine("mill")->status->message,
            "the control asked for a program; no run waits");
  EXPECT_TRUE(store_->runs.list({.machine = "mill", .program = {}, .state = {}}, {})->empty());
  line().write("\x13");
  EXPECT_TRUE(wait([&] { return !ports_->port("com1")->request.has_value(); }));
}

TEST_F(FanucLineTest, SendsTheRunThatIsStartedAfterTheOperatorAsked) {
  add_fanuc();
  push("O2001", "O2001\nM30\n", "fanuc");
  push("O2002", "O2002\nG0\nM30\n", "fanuc");
  line().write("\x11");
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->request.has_value(); }));
  const auto run = start("O2002");
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(line().read_until("M30\n%"), "%\nO2002\nG0\nM30\n%");
  line().write("\x13");
  ASSERT_TRUE(wait_state(run->id, RunState::Completed));
  EXPECT_FALSE(ports_->port("com1")->request);
}

/// The server was started again in the middle of a program; the control has room for more of it.
TEST_F(FanucLineTest, WaitsForAResetAfterAFormerLifeOfTheServerBrokeAProgramOff) {
  add_fanuc();
  push("O2001", "O2001\nM30\n", "fanuc");
  push("O2002", blocks(20000), "fanuc");
  const auto former = start("O2002");
  ASSERT_TRUE(former) << former.error().what;
  line().write("\x11");
  line().read_until("N500 ");
  line().write("\x13");
  ports_.reset();
  start_ports();
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->is_open; }));
  ASSERT_EQ(store_->runs.find(former->id)->state, RunState::Interrupted);
  line().read_for(std::chrono::milliseconds(50));
  const auto run = start("O2001");
  ASSERT_TRUE(run) << run.error().what;
  line().write("\x11");
  ASSERT_TRUE(wait([&] { return is_noted("DC1 came for the program that was broken off"); }));
  EXPECT_EQ(line().read_for(std::chrono::milliseconds(100)), "");
  line().write("\x13\x11");
  EXPECT_EQ(line().read_until("M30\n%"), "%\nO2001\nM30\n%");
}

TEST_F(FanucLineTest, DropsARequestWithItsLine) {
  add_fanuc();
  push("O2001", "O2001\nM30\n", "fanuc");
  line().write("\x11");
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->request.has_value(); }));
  line().pull();
  ASSERT_TRUE(wait([&] { return !ports_->port("com1")->is_open; }));
  line().put_back();
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->is_open; }));
  const auto run = start("O2001");
  ASSERT_TRUE(run) << run.error().what;
  EXPECT_EQ(line().read_for(std::chrono::milliseconds(100)), "");
  line().write("\x11");
  EXPECT_EQ(line().read_until("M30\n%"), "%\nO2001\nM30\n%");
}

TEST_F(FanucLineTest, WaitsForTheOperatorAtTheControl) {
  add_fanuc();
  push("O2001", "O2001\nM30\n", "fanuc");
  const auto run = start("O2001");
  ASSERT_TRUE(run) << run.error().what;
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->waiting_since.has_value(); }));
  const auto status = ports_->machines().machine("mill")->status;
  EXPECT_EQ(status->execution, dds::Execution::Waiting);
  EXPECT_EQ(status->message, "waits for the operator to start it at the control (DC1)");
}

TEST_F(LineProtocolTest, HoldsAProgramThatATncSends) {
  add_control("heidenhain_bcc");
  const std::string text = tnc_program(33, 20);
  ASSERT_TRUE(control_->send(text, "33"));
  ASSERT_TRUE(control_->until([&] { return store_->programs.revision("33", 1).has_value(); }));
  EXPECT_TRUE(store_->programs.revision("33", 1)->is_held);
  EXPECT_EQ(store_->programs.revision("33", 1)->content, sha256(text));
}

// HD-235: the setup came after the port, so that it is the start that is refused.
TEST_F(LineProtocolTest, StartsNothingBlockwiseOnATncWithoutIt) {
  add_control("heidenhain_bcc", "all");
  push("O0015", tnc_program(15, 5), "tnc155");
  const auto keep = [&](const std::string& model) {
    return setups_->save({"mill", "tnc155", "[control]\nmodel = \"" + model + "\"\n", ""}, "cam");
  };
  ASSERT_TRUE(keep("TNC 155 V"));
  const std::string why =
      "machine 'mill', setup 1: a TNC 155 V has no transfer blockwise; flow heidenhain (template "
      "tnc155) is its interface";
  const auto run = start("O0015");
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().code, Errc::Unsupported);
  EXPECT_EQ(run.error().what, why);
  EXPECT_TRUE(runs().empty());
  const auto sent = ports_->send("com1", {{"O0015", {}}});
  ASSERT_FALSE(sent);
  EXPECT_EQ(sent.error().what, why);
  ASSERT_TRUE(
      control_->line().request({wire::TransferRequest::Kind::SendProgram, "15"}, control_->now()));
  ASSERT_TRUE(control_->until([&] { return !control_->failures.empty(); }));
  EXPECT_TRUE(runs().empty());
  ASSERT_TRUE(keep("TNC 155 P"));
  EXPECT_TRUE(start("O0015"));
}

// HD-235
TEST_F(LineProtocolTest, KeepsNoBlockwisePortForATncWithoutIt) {
  start_ports();
  add_machine("mill", "tnc155");
  ASSERT_TRUE(setups_->save({"mill", "tnc155", "[control]\nmodel = \"TNC 151 E\"\n", ""}, "cam"));
  auto port = mill();
  port.line_template = "tnc155-bcc";
  port.settings = {};
  const auto refused = ports_->save(port);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Unsupported);
  EXPECT_EQ(refused.error().what,
            "port 'com1': machine 'mill', setup 1: a TNC 151 E has no transfer blockwise; flow "
            "heidenhain (template tnc155) is its interface");
  EXPECT_TRUE(ports_->ports().empty());
  port.line_template = "tnc155";
  EXPECT_TRUE(ports_->save(port));
}

// HD-235: a server whose settings file names such a port begins all the same.
TEST_F(LineProtocolTest, BeginsWithABlockwisePortOfATncWithoutIt) {
  add_machine("mill", "tnc155");
  ASSERT_TRUE(setups_->save({"mill", "tnc155", "[control]\nmodel = \"TNC 151 E\"\n", ""}, "cam"));
  auto port = mill();
  port.line_template = "tnc155-bcc";
  port.settings = {};
  start_ports(*store_, {port});
  EXPECT_EQ(ports_->ports().size(), 1u);
}

TEST_F(LineProtocolTest, WaitsForTheTncToAskForTheRun) {
  add_control("heidenhain_bcc");
  const std::string text = tnc_program(15, 5);
  push("O0015", text, "tnc155");
  const auto run = start("O0015");
  ASSERT_TRUE(run);
  ASSERT_TRUE(wait([&] { return ports_->port("com1")->waiting_since.has_value(); }));
  EXPECT_TRUE(ports_->port("com1")->line.may_wait_without_limit);
  ASSERT_TRUE(
      control_->line().request({wire::TransferRequest::Kind::SendProgram, "15"}, control_->now()));
  ASSERT_TRUE(
      control_->until([&] { return store_->runs.find(run->id)->state == RunState::Completed; }));
  EXPECT_TRUE(control_->received == text);
}

}  // namespace
}  // namespace dripline::server_test
