#include <fstream>

#include "tests/integration/line/line_protocols.hpp"
#include "tests/integration/line/serial_system.hpp"

/// A gateway beside an old control: programs over DDS, then over its serial line, and what the
/// control prints back again.
namespace dripline::integration {
namespace {

using namespace std::chrono_literals;
using test_support::eventually;

class SerialGatewayProtocol : public testing::TestWithParam<Protocol> {};

TEST_P(SerialGatewayProtocol, FeedsTheControlAndBringsItsPrintsHome) {
  SerialSystem shop({.settings = GetParam().settings, .request = GetParam().request});
  std::vector<std::string> expected;
  const std::string text = printing_program(expected);
  const std::string id = shop.start("O0077", text);
  const auto run = shop.system->wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_EQ(run.value("sent", 0U), text.size()) << run.dump();
  EXPECT_EQ(run.value("executed", 9U), 0U) << "a line does not report what is executed";
  EXPECT_TRUE(run.value("content_verified", false)) << run.dump();
  ASSERT_TRUE(shop.control->wait_ended(1));
  if (GetParam().prints_back) {
    EXPECT_TRUE(eventually([&] { return shop.system->report_lines(id) == expected; }))
        << testing::PrintToString(shop.system->report_lines(id));
  }
  const auto endings = shop.control->endings();
  ASSERT_GE(endings.size(), 1U);
  EXPECT_EQ(endings[0].outcome, dds::RunOutcome::Completed) << endings[0].reason;
  EXPECT_EQ(endings[0].executed,
            static_cast<std::uint64_t>(std::count(text.begin(), text.end(), '\n')));
}

INSTANTIATE_TEST_SUITE_P(, SerialGatewayProtocol, every_protocol(),
                         [](const auto& i) { return std::string(i.param.name); });

/// At the question the control waits for the end of a long move, and its memory fills up.
TEST(SerialGateway, IsHeldByTheControlAndReportsItsBuffer) {
  const test_support::TemporaryFolder folder;
  const auto setup = folder.path() / "setup.toml";
  std::ofstream(setup) << "units = \"in\"\nanswers = [\"1\"]\n";
  SerialSystem shop({.settings = {"flow=xonxoff"},
                     .gateway_arguments = {"--line-ahead-s", "20"},
                     .control_speed = "100x",
                     .control_arguments = {"--line-buffer", "1024", "--setup", setup}});
  std::string text = "O0077\nG20 G98\nG0 X3. Z0\nG1 Z-5. F1.\nINPUT (GO ON) P1\n";
  for (int i = 0; i < 1500; ++i) text += "G1 X1. F500.\n";
  const std::string id = shop.start("O0077", text + "M30\n");
  EXPECT_TRUE(eventually([&] {
    const std::string message = shop.message();
    return message.find("the control holds the line") == 0 &&
           message.find("the rest of the program is buffered") != std::string::npos &&
           shop.status().value("buffered_seconds", 0.0) > 1;
  })) << shop.message();
  const auto run = shop.system->wait_ended(id, 120s);
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
}

TEST(SerialGateway, IsNotFeltByTheControlWhenTheServerIsAwayForAsLongAsTheBufferReaches) {
  SerialSystem shop({.settings = {"flow=xonxoff"}, .gateway_arguments = {"--line-ahead-s", "60"}});
  const std::string text = contour(80'000);  // 7 s of the line
  std::vector<std::string> printed;
  const std::string program = printing_program(printed);
  const std::string id = shop.start("contour", ended_by(text, program));
  ASSERT_TRUE(eventually([&] {
    return shop.message().find("the rest of the program is buffered") != std::string::npos;
  })) << shop.message();
  shop.system->server().kill();
  // The control gets all of it without pause, and prints while no one is there.
  ASSERT_TRUE(shop.control->wait_ended(1, 60s));
  EXPECT_FALSE(shop.control->wait_logged("line:", 2)) << "no gap, no fault";
  shop.system->start_server();
  const auto run = shop.system->wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_TRUE(eventually([&] { return shop.system->report_lines(id) == printed; }))
      << testing::PrintToString(shop.system->report_lines(id));
}

TEST(SerialGateway, EndsTheRunAtAKnownBlockWhenItsCableIsPulled) {
  SerialSystem shop({.settings = {"flow=xonxoff"}});
  const std::string text = contour(150'000);
  const std::string id = shop.start("contour", text);
  ASSERT_TRUE(eventually([&] { return shop.cable.passed() > 5000; }));
  shop.cable.unplug();
  const auto run = shop.system->wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "interrupted") << run.dump();
  EXPECT_NE(run.value("reason", "").find("block"), std::string::npos) << run.dump();
  EXPECT_TRUE(eventually([&] { return shop.message().find("is lost") != std::string::npos; }))
      << shop.message();
  const std::uint64_t received = shop.check_received(text);
  const auto sent = run.value("sent", std::uint64_t{0});
  ASSERT_LT(sent, text.size());
  EXPECT_LE(received, sent + (text[sent] == '\n' ? 1 : 0));
  EXPECT_LE(sent, received + 64);
}

/// Both starts of a program: the gateway sends at cycle start, or the control asks.
TEST(SerialGatewayAttended, SendsNothingBeforeCycleStartAtItsPanel) {
  SerialSystem shop({.settings = {"flow=xonxoff"}, .is_unattended = false});
  const std::string text = "O0077\nG20 G98\nG1 X1. Z-1. F50.\nM30\n";
  const std::string id = shop.start("O0077", text);
  ASSERT_TRUE(eventually([&] {
    return shop.message().find("the rest of the program is buffered") != std::string::npos;
  })) << shop.message();
  EXPECT_EQ(shop.status().value("waits_for", ""), "cycle_start") << shop.status().dump();
  EXPECT_EQ(shop.cable.passed(), 0U);
  const auto reply =
      shop.system->rest().post("/api/v1/runs/" + id + "/commands", {{"action", "resume"}});
  EXPECT_NE(reply.status, 200) << "the network is no consent";
  EXPECT_EQ(shop.panel({"cycle-start"}).output, "ok\n");
  EXPECT_EQ(shop.system->wait_ended(id).value("state", ""), "completed");
  ASSERT_TRUE(shop.control->wait_ended(1));
}

/// As on a machine that the gateway moves: who released the stop has not enabled the network again.
TEST(SerialGatewayAttended, AnEmergencyStopEndsTheRemoteEnable) {
  SerialSystem shop({.settings = {"flow=xonxoff"}, .is_unattended = false});
  const auto enabled = [&] { return shop.status().value("remote_enable", ""); };
  EXPECT_EQ(shop.panel({"remote-enable", "on"}).output, "ok\n");
  ASSERT_TRUE(eventually([&] { return enabled() == "given"; })) << shop.status().dump();
  EXPECT_EQ(shop.panel({"emergency-stop", "on"}).output, "ok\n");
  EXPECT_EQ(shop.panel({"emergency-stop", "off"}).output, "ok\n");
  ASSERT_TRUE(eventually([&] { return enabled() == "not_given"; })) << shop.status().dump();
}

TEST(SerialGatewayAttended, TakesTheControlsRequestForConsentWhenItComesAfterTheStart) {
  SerialSystem shop({.settings = {"flow=dc_codes", "start_char=%", "end_char=%"},
                     .request = "next",
                     .is_unattended = false});
  const std::string id = shop.start("O0077", "O0077\nG20 G98\nG1 X1. Z-1. F50.\nM30\n");
  EXPECT_EQ(shop.system->wait_ended(id).value("state", ""), "completed");
  ASSERT_TRUE(shop.control->wait_ended(1));
}

TEST(SerialGatewayStops, HoldsResumesAndAborts) {
  SerialSystem shop({.settings = {"flow=xonxoff"}});
  const std::string text = contour(150'000);
  const std::string id = shop.start("contour", text);
  const auto command = [&](const char* action) {
    const auto reply =
        shop.system->rest().post("/api/v1/runs/" + id + "/commands", {{"action", action}});
    EXPECT_EQ(reply.status, 200) << action << reply.body;
  };
  ASSERT_TRUE(eventually([&] { return shop.cable.passed() > 3000; }));
  command("hold");
  EXPECT_TRUE(eventually([&] { return shop.status().value("execution", "") == "FEED_HOLD"; }))
      << shop.status().dump();
  command("resume");
  const auto before = shop.cable.passed();
  // What the gateway is sure of is a little less than what has passed the cable.
  ASSERT_TRUE(eventually([&] { return shop.cable.passed() > before + 4000; }));
  command("abort");
  const auto run = shop.system->wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "aborted") << run.dump();
  const auto sent = run.value("sent", std::uint64_t{0});
  EXPECT_GT(sent, 6000U);
  EXPECT_LT(sent, text.size());
}

}  // namespace
}  // namespace dripline::integration
