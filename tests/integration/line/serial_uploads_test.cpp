#include <fstream>

#include "tests/integration/control_in_hand.hpp"

/// What a control sends and requests at a gateway beside it, and what the server shows of its line.
namespace dripline::integration {
namespace {

using namespace std::chrono_literals;
using test_support::eventually;

TEST_F(ControlInHand, AProgramThatItSendsIsPendingApproval) {
  start();
  control_->send("O1234\nG0 X1.\nM30\n");
  EXPECT_TRUE(waits_for_approval("O1234")) << system_->rest().get("/api/v1/imports").body;
}

/// Longer than a message, and while the server is away: it waits on the gateway's disk, also over a
/// kill.
TEST_F(ControlInHand, ALongProgramIsStoredOnceWhateverIsKilled) {
  start();
  system_->server().kill();
  std::string text = "O1235\n";
  while (text.size() < 100'000) text += "G1 X1. Z-1. F50.\n";
  text += "M30\n";
  control_->send(text);
  ASSERT_TRUE(
      eventually([&] { return control_->is_idle() && control_->sent() >= text.size(); }, 30s));
  ASSERT_TRUE(eventually([&] {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(
             system_->folder() / "gateway" / "lathe-1" / "uploads", error))
      if (entry.path().extension() == ".json") return true;
    return false;
  }));
  system_->gateway().kill();
  system_->start_server();
  start_gateway();
  EXPECT_TRUE(waits_for_approval("O1235")) << system_->rest().get("/api/v1/imports").body;
  EXPECT_TRUE(eventually([&] {
    return std::filesystem::is_empty(system_->folder() / "gateway" / "lathe-1" / "uploads");
  }));
}

TEST_F(ControlInHand, ItsLineIsShownTestedAndRecordedAsAPortOfTheServer) {
  start();
  EXPECT_EQ(port().value("machine", ""), "lathe-1");
  EXPECT_EQ(port().value("template", ""), "centurion") << port().dump();
  EXPECT_EQ(port()["effective"].value("line", ""), "115200e72") << port().dump();
  const auto test = system_->rest().post("/api/v1/ports/lathe-1/test", nlohmann::json::object());
  EXPECT_EQ(test.status, 200) << test.body;
  EXPECT_TRUE(test.json().value("passed", false)) << test.body;
  control_->send("HELLO FROM THE CONTROL\n");
  ASSERT_TRUE(eventually([&] {
    return system_->rest().get("/api/v1/ports/lathe-1/recording").body.find("48454c4c4f") !=
           std::string::npos;
  })) << system_->rest().get("/api/v1/ports/lathe-1/recording").body;
  const auto changed = system_->rest().put_bytes(
      "/api/v1/ports/lathe-1",
      nlohmann::json{{"machine", "lathe-1"}, {"address", "/dev/null"}}.dump());
  EXPECT_NE(changed.status, 200) << "it is set up at the gateway";
}

TEST_F(ControlInHand, ItsRulesDecideWhatItsOperatorRequests) {
  const test_support::TemporaryFolder folder;
  std::ofstream(folder.path() / "rules.toml") << kSendRules;
  start({"--line-rules", folder.path() / "rules.toml"});
  system_->push("O0077", "O0077\nG0 X1.\nM30\n");
  control_->send("O9999\n(PRG=0077)\nM30\n");
  EXPECT_TRUE(
      eventually([&] { return control_->received().find("O0077") != std::string::npos; }, 20s))
      << control_->received();
  const auto runs = system_->rest().get("/api/v1/runs").json().at("runs");
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].value("program", ""), "O0077");
  // What there is not gets an answer in the control's own terms.
  control_->send("O9999\n(PRG=5555)\nM30\n");
  EXPECT_TRUE(
      eventually([&] { return control_->received().find("O9998") != std::string::npos; }, 20s))
      << control_->received();
}

TEST_F(ControlInHand, PrintsWithoutARunAreTheMachinesReport) {
  start();
  control_->send("TEMPERATURE 21.5\n");
  EXPECT_TRUE(eventually([&] {
    return system_->rest().get("/api/v1/machines/lathe-1/report").body.find("TEMPERATURE 21.5") !=
           std::string::npos;
  })) << system_->rest().get("/api/v1/machines/lathe-1/report").body;
}

/// A run that begins in the middle gets what its rest relies on sent first.
TEST_F(ControlInHand, ARunFromTheMiddleIsLookedThroughAndGetsItsHead) {
  start();
  std::string text = "O0077\nG20 G98\nT0202\n";
  for (int i = 1; i <= 200; ++i) text += "N" + std::to_string(i) + " G1 X1. Z-1. F50.\n";
  system_->push("O0077", text + "M30\n");
  const auto start_at = [&](const nlohmann::json& more) {
    nlohmann::json body{{"machine", "lathe-1"}, {"program", "O0077"}, {"from", "N150"}};
    body.update(more);
    const auto reply = system_->rest().post("/api/v1/runs", body);
    EXPECT_EQ(reply.status, 201) << reply.body;
    return system_->wait_ended(reply.json().value("id", "none"));
  };
  const auto refused = start_at(nlohmann::json::object());
  EXPECT_EQ(refused.value("state", ""), "aborted") << refused.dump();
  EXPECT_NE(refused.value("reason", "").find("rely on"), std::string::npos) << refused.dump();
  EXPECT_EQ(control_->received(), "");
  const auto run = start_at({{"head", "send"}});
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_TRUE(eventually([&] { return control_->received().find("M30") != std::string::npos; }));
  const std::string received = control_->received();
  EXPECT_EQ(received.find("G20 G98\nT0202"), 0U) << received.substr(0, 80);
  EXPECT_NE(received.find("N150 "), std::string::npos);
  EXPECT_EQ(received.find("N149 "), std::string::npos);
}

}  // namespace
}  // namespace dripline::integration
