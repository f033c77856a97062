#include <fstream>

#include "tests/integration/control_in_hand.hpp"

/// What `dnc port` does with the line of a gateway beside a control: the same as with a port of the
/// server, but for its setup.
namespace dripline::integration {
namespace {

using namespace std::chrono_literals;
using test_support::eventually;

class GatewaysPort : public ControlInHand {
 protected:
  void push_two() {
    system_->push("O0077", "O0077\nG0 X1.\nM30\n");
    system_->push("O0078", "O0078\nG0 X2.\nM30\n");
  }
  std::size_t runs() { return system_->rest().get("/api/v1/runs").json().at("runs").size(); }
  nlohmann::json transfer() const {
    const auto shown = port()["transfer"];
    return shown.is_object() ? shown : nlohmann::json::object();
  }
};

TEST_F(GatewaysPort, SendsProgramsToTheControlsMemoryAsOneText) {
  start();
  push_two();
  const auto sent = dnc({"port", "send", "lathe-1", "O0077", "O0078"});
  EXPECT_EQ(sent.status, 0) << sent.output;
  EXPECT_NE(sent.output.find("Sent O0077 revision 1, O0078 revision 1"), std::string::npos)
      << sent.output;
  EXPECT_TRUE(eventually([&] { return control_->received().find("X2.") != std::string::npos; }));
  EXPECT_NE(control_->received().find("O0077\nG0 X1.\nM30\nO0078\nG0 X2.\nM30\n"),
            std::string::npos)
      << control_->received();
  EXPECT_EQ(transfer().value("state", ""), "completed") << port().dump();
  EXPECT_EQ(runs(), 0U);
  const auto recorded = dnc({"port", "recording", "lathe-1"});
  EXPECT_NE(recorded.output.find("the transfer of programs completed"), std::string::npos)
      << recorded.output;
}

TEST_F(GatewaysPort, StopsATransferAndGivesTheLineBack) {
  start();
  push_two();
  system_->push("O0079", "O0079\n" + contour(300'000));
  ASSERT_EQ(dnc({"port", "send", "lathe-1", "O0079", "--no-wait"}).status, 0);
  ASSERT_TRUE(eventually([&] { return control_->received().size() > 2000; }));
  const auto busy = dnc({"port", "send", "lathe-1", "O0077"});
  EXPECT_NE(busy.status, 0);
  EXPECT_NE(busy.output.find("is busy"), std::string::npos) << busy.output;
  const auto run =
      system_->rest().post("/api/v1/runs", {{"machine", "lathe-1"}, {"program", "O0077"}});
  EXPECT_NE(run.status, 201) << "a run does not go in between";
  EXPECT_EQ(dnc({"port", "stop", "lathe-1"}).output, "The transfer on lathe-1 is ended.\n");
  EXPECT_TRUE(eventually([&] { return transfer().value("state", "") == "aborted"; }))
      << port().dump();
  EXPECT_NE(dnc({"port", "stop", "lathe-1"}).output.find("nothing comes in"), std::string::npos);
  const auto unconfirmed = dnc({"port", "send", "lathe-1", "O0077"});
  EXPECT_NE(unconfirmed.output.find("O0079 revision 1 was broken off"), std::string::npos)
      << unconfirmed.output;
  const auto confirmed = dnc({"port", "confirm-reset", "lathe-1"});
  EXPECT_EQ(confirmed.status, 0) << confirmed.output;
  const auto sent = dnc({"port", "send", "lathe-1", "O0077"});
  EXPECT_EQ(sent.status, 0) << sent.output;
}

/// All of a transfer is at the gateway before its first character leaves.
TEST_F(GatewaysPort, ATransferGoesOnWithoutTheServer) {
  start();
  const std::string text = "O0079\n" + contour(60'000);
  system_->push("O0079", text);
  ASSERT_EQ(dnc({"port", "send", "lathe-1", "O0079", "--no-wait"}).status, 0);
  system_->server().kill();
  EXPECT_TRUE(eventually([&] { return control_->received().size() >= text.size(); }, 30s))
      << control_->received().size();
  system_->start_server();
  system_->wait_connected();
  EXPECT_TRUE(eventually([&] { return transfer().value("state", "") == "completed"; }))
      << port().dump();
}

TEST_F(GatewaysPort, RefusesWhatIsNotThereAndWhatIsSetUpAtTheGatewayWithAReason) {
  start();
  push_two();
  const auto refuses = [&](const std::vector<std::string>& verb, const std::string& why) {
    const auto done = dnc(verb);
    EXPECT_NE(done.status, 0) << done.output;
    EXPECT_NE(done.output.find(why), std::string::npos) << verb[1] << ": " << done.output;
  };
  const std::string there = "is its gateway's own: it is set up there";
  refuses({"port", "set", "lathe-1", "baud=4800"}, there);
  refuses({"port", "disable", "lathe-1"}, there);
  refuses({"port", "enable", "lathe-1"}, there);
  refuses({"port", "remove", "lathe-1"}, there);
  refuses({"port", "send", "lathe-1", "O5555"}, "O5555");
  refuses({"port", "receive", "lathe-1"}, "only over XMODEM");
  refuses({"port", "stop", "lathe-1"}, "nothing comes in");
  EXPECT_EQ(control_->received(), "");
  system_->gateway().kill();
  EXPECT_TRUE(eventually([&] { return port()["fault"] == "its gateway is not connected"; }))
      << port().dump();
  refuses({"port", "send", "lathe-1", "O0077"}, "its gateway is not connected");
  refuses({"port", "test", "lathe-1"}, "is not connected");
}

/// A control reads the numbers of an export without its builder's table as other parameters.
TEST_F(GatewaysPort, SendsNoParametersInNumbersThatTheControlDoesNotHave) {
  start();
  const test_support::TemporaryFolder folder;
  const auto setup = folder.path() / "setup.toml";
  const auto text = folder.path() / "O9990.nc";
  std::ofstream(setup) << "units = \"mm\"\n[[offset]]\nname = \"G55\"\nZ = -120.5\n";
  ASSERT_EQ(dnc({"setup", "push", "lathe-1", setup}).status, 0);
  const auto exported = dnc({"setup", "export", "lathe-1", "-o", text});
  ASSERT_EQ(exported.status, 0) << exported.output;
  const auto pushed = dnc({"program", "push", text, "--name", "O9990", "--control", "centurion"});
  ASSERT_EQ(pushed.status, 0) << pushed.output;
  for (const std::vector<std::string>& verb :
       {std::vector<std::string>{"port", "send", "lathe-1", "O9990"},
        {"run", "start", "lathe-1", "O9990"},
        {"job", "add", "lathe-1", "O9990", "--quantity", "1"}}) {
    const auto done = dnc(verb);
    EXPECT_NE(done.status, 0) << verb[0] << ": " << done.output;
    EXPECT_NE(done.output.find("program O9990 revision 1 has parameters in Dripline's own numbers"),
              std::string::npos)
        << verb[0] << ": " << done.output;
    EXPECT_NE(done.output.find("dnc setup export MACHINE --map FILE"), std::string::npos);
  }
  EXPECT_EQ(runs(), 0U);
  EXPECT_EQ(control_->received(), "");
}

TEST_F(GatewaysPort, TriesTheRulesThatTheGatewayHas) {
  const test_support::TemporaryFolder folder;
  std::ofstream(folder.path() / "rules.toml") << kSendRules;
  std::ofstream(folder.path() / "call.nc") << "O9999\n(PRG=0077)\nM30\n";
  start({"--line-rules", folder.path() / "rules.toml"});
  const auto tried = dnc({"port", "test-rules", "lathe-1", folder.path() / "call.nc"});
  EXPECT_EQ(tried.status, 0) << tried.output;
  EXPECT_NE(tried.output.find("O0077"), std::string::npos) << tried.output;
  EXPECT_EQ(control_->received(), "") << "nothing is done";
}

}  // namespace
}  // namespace dripline::integration
