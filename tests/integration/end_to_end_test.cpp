// The main job on real processes: push, drip-feed, run, report.
#include <gtest/gtest.h>
#include <fstream>

#include "protocol/base/digest.hpp"
#include "tests/integration/system.hpp"
#include "tests/support/program_generator.hpp"

namespace dripline::integration {
namespace {

std::string contour(std::uint64_t blocks) {
  std::string text;
  test_support::write_contour(blocks, [&](std::string_view piece) { text += piece; });
  return text;
}

std::string report_program(std::uint64_t lines, std::uint64_t moves_per_line) {
  std::string text;
  test_support::write_report_program(lines, moves_per_line,
                                     [&](std::string_view piece) { text += piece; });
  return text;
}

class EndToEnd : public testing::Test {
 protected:
  void start(System::Options options = {}) {
    system.emplace(std::move(options));
    system->start_server();
    system->start_gateway();
    system->wait_connected();
  }
  std::optional<System> system;
};

TEST_F(EndToEnd, ALargeProgramIsFedWholeAndVerified) {
  start();
  const std::string text = contour(200'000);
  const auto revision = system->push("O0200", text);
  EXPECT_EQ(revision.value("sha256", ""), sha256(text).hex());
  const auto run = system->wait_ended(system->start_run("O0200"));
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_EQ(run.value("executed", 0u), 200'000u);
  EXPECT_EQ(run.value("accepted", 0u), 200'000u);
  EXPECT_EQ(run.value("sent", 0u), text.size());
  EXPECT_TRUE(run["content_verified"].get<bool>());
}

TEST_F(EndToEnd, EveryReportLineIsStoredOnceAndInOrder) {
  start();
  system->push("O0300", report_program(500, 2));
  const std::string id = system->start_run("O0300");
  EXPECT_EQ(system->wait_ended(id).value("state", ""), "completed");
  const auto lines = system->report_lines(id);
  ASSERT_EQ(lines.size(), 500u);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    char expected[32];
    std::snprintf(expected, sizeof expected, "LINE %05zu", i + 1);
    EXPECT_EQ(lines[i], expected);
  }
}

TEST_F(EndToEnd, ARunKeepsTheRevisionItBeganWith) {
  start({.speed = "1x", .server_arguments = {}, .gateway_arguments = {}});
  const std::string first = report_program(60, 9);
  system->push("O0300", first);
  const std::string id = system->start_run("O0300");
  ASSERT_TRUE(test_support::eventually([&] { return system->run(id).value("executed", 0u) > 3; }));
  const auto replaced = system->push("O0300", "O0300\nG0 X1\nM30\n");
  EXPECT_EQ(replaced.value("revision", 0), 2);
  const auto run = system->wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_EQ(run.value("revision", 0), 1);
  EXPECT_EQ(run.value("sha256", ""), sha256(first).hex());
  EXPECT_EQ(system->report_lines(id).size(), 60u);
}

TEST_F(EndToEnd, HoldStopsMotionAndResumeGoesOn) {
  start({.speed = "1x", .server_arguments = {}, .gateway_arguments = {}});
  system->push("O0300", report_program(60, 9));
  const std::string id = system->start_run("O0300");
  const auto command = [&](const char* action) {
    const auto reply =
        system->rest().post("/api/v1/runs/" + id + "/commands", {{"action", action}});
    EXPECT_EQ(reply.status, 200) << reply.body;
  };
  const auto execution = [&] {
    return system->rest().get("/api/v1/machines/lathe-1").json()["status"].value("execution", "");
  };
  command("hold");
  EXPECT_TRUE(test_support::eventually([&] { return execution() == "FEED_HOLD"; })) << execution();
  const auto held_at = system->run(id).value("executed", 0u);
  command("resume");
  const auto run = system->wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_GT(run.value("executed", 0u), held_at);
}

TEST_F(EndToEnd, AnAbortedRunSaysHowFarItCame) {
  start({.speed = "1x", .server_arguments = {}, .gateway_arguments = {}});
  system->push("O0300", report_program(4000, 4));
  const std::string id = system->start_run("O0300");
  ASSERT_TRUE(test_support::eventually([&] { return system->run(id).value("executed", 0u) > 5; }));
  EXPECT_EQ(system->rest().post("/api/v1/runs/" + id + "/commands", {{"action", "abort"}}).status,
            200);
  const auto run = system->wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "aborted") << run.dump();
  EXPECT_EQ(run.value("executed", 0u), system->execution_probe().blocks_done);
}

TEST_F(EndToEnd, AProgramAlarmEndsTheRunWithItsCode) {
  start();
  system->push("O0400", "O0400\nG20 G93\nG0 X1 Z1\nP1=1/0\nM30\n");
  const auto run = system->wait_ended(system->start_run("O0400"));
  EXPECT_EQ(run.value("state", ""), "alarmed") << run.dump();
  EXPECT_NE(run.value("reason", "").find("CEN"), std::string::npos) << run.dump();
  EXPECT_EQ(run.value("line", 0), 3) << "the block executed last is the one before the alarm";
}

TEST_F(EndToEnd, AMachineThatTwoGatewaysClaimIsNotStarted) {
  start();
  system->push("O0300", report_program(20, 2));
  const auto try_start = [&] {
    return system->rest().post("/api/v1/runs", {{"machine", "lathe-1"}, {"program", "O0300"}});
  };
  {
    auto second = system->second_gateway();
    EXPECT_TRUE(test_support::eventually([&] {
      const auto reply = try_start();
      if (reply.status == 201) system->wait_ended(reply.json().value("id", ""));
      return reply.status == 409 && reply.body.find("two gateways") != std::string::npos;
    }));
    second.kill();
  }
  EXPECT_TRUE(test_support::eventually([&] {
    const auto reply = try_start();
    if (reply.status != 201) return false;
    const std::string id = reply.json().value("id", "");
    return system->wait_ended(id).value("state", "") == "completed" &&
           system->report_lines(id).size() == 20;
  })) << "the other one continues";
}

TEST_F(EndToEnd, BothEndOrderlyOnSigterm) {
  start();
  system->gateway().signal(SIGTERM);
  system->server().signal(SIGTERM);
  EXPECT_EQ(system->gateway().wait(), 0);
  EXPECT_EQ(system->server().wait(), 0);
}

}  // namespace
}  // namespace dripline::integration
