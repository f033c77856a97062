// A test run with real processes: nothing moves, no part is counted, and a kill leaves nothing.
#include <gtest/gtest.h>
#include <future>

#include "tests/integration/system.hpp"

namespace dripline::integration {
namespace {

using nlohmann::json;
using test_support::eventually;

class TestRunSystem : public testing::Test {
 protected:
  void begin(const std::string& speed = "max") {
    system.emplace(System::Options{
        .speed = speed, .server_arguments = {}, .gateway_arguments = {}, .control = "fanuc"});
    system->start_server();
    system->start_gateway();
    system->wait_connected();
  }
  std::string test(const std::string& program) {
    const auto reply = system->rest().post(
        "/api/v1/runs", {{"machine", "lathe-1"}, {"program", program}, {"test", true}});
    EXPECT_EQ(reply.status, 201) << reply.body;
    return reply.json().value("id", "");
  }
  json status() { return system->rest().get("/api/v1/machines/lathe-1").json()["status"]; }
  double x() {
    const json now = status();
    return now.is_object() ? now["position"].value("X", -1e9) : -1e9;
  }
  std::optional<System> system;
};

TEST_F(TestRunSystem, EndsAsTestedAndPrintsAndMovesNothing) {
  begin();
  system->push("O1", "O1\nG21 G90 G1 X50. F600\nDPRNT[ON]\nM30\n");
  const std::string id = test("O1");
  const json run = system->wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "tested") << run.dump();
  EXPECT_EQ(run.value("reason", ""), "test run: 4 blocks, 5.0 s of motion at 100 %");
  EXPECT_EQ(run.value("executed", -1), 0);
  EXPECT_TRUE(run.value("content_verified", false))
      << "the bytes that were tested are the revision's";
  EXPECT_TRUE(system->report_lines(id).empty());
  EXPECT_EQ(x(), 0);
  EXPECT_EQ(system->rest().get("/api/v1/runs?state=tested").json()["runs"].size(), 1U);
  const std::string real = system->start_run("O1");
  EXPECT_EQ(system->wait_ended(real).value("state", ""), "completed");
  EXPECT_EQ(system->report_lines(real).size(), 1U);
}

TEST_F(TestRunSystem, OfAJobCountsNoPart) {
  begin();
  system->push("O1", "O1\nG21 G90 G1 X50. F600\nM30\n");
  const auto queued =
      system->rest().post("/api/v1/machines/lathe-1/jobs", {{"program", "O1"}, {"quantity", 2}});
  ASSERT_EQ(queued.status / 100, 2) << queued.body;
  const auto turned =
      system->rest().post("/api/v1/machines/lathe-1/commands",
                          {{"action", "switch"}, {"name", "test_run"}, {"value", 1}});
  ASSERT_EQ(turned.status / 100, 2) << turned.body;
  EXPECT_TRUE(eventually([&] { return status()["switches"].value("test_run", "") == "on"; }));
  const auto started = system->rest().post("/api/v1/machines/lathe-1/start-job", json::object());
  ASSERT_EQ(started.status, 201) << started.body;
  const std::string id = started.json().value("id", "");
  EXPECT_EQ(system->wait_ended(id).value("state", ""), "tested");
  const json queue = system->rest().get("/api/v1/machines/lathe-1/jobs").json();
  EXPECT_EQ(queue["jobs"][0].value("completed", -1), 0) << queue.dump();
}

TEST_F(TestRunSystem, NamesTheFirstAlarmWithItsLine) {
  begin();
  system->push("O2", "O2\nG21 G90 G1 X50. F600\nG2 X60. R1.\nM30\n");
  const json run = system->wait_ended(test("O2"));
  EXPECT_EQ(run.value("state", ""), "alarmed") << run.dump();
  EXPECT_NE(run.value("reason", "").find("(line 3, found by a test run)"), std::string::npos)
      << run.dump();
  EXPECT_EQ(x(), 0);
}

/// The switch was in the memory of the gateway that is gone: the next would run the program.
TEST_F(TestRunSystem, OfTheSwitchIsNoRunAtTheGatewayThatComesNext) {
  begin("1x");
  system->push("O4", "O4\nG21 G90 G1 X50. F6000\nM30\n");
  const auto turned =
      system->rest().post("/api/v1/machines/lathe-1/commands",
                          {{"action", "switch"}, {"name", "test_run"}, {"value", 1}});
  ASSERT_EQ(turned.status / 100, 2) << turned.body;
  ASSERT_TRUE(eventually([&] { return status()["switches"].value("test_run", "") == "on"; }));
  ASSERT_EQ(system->wait_ended(system->start_run("O4")).value("state", ""), "tested");
  system->gateway().kill();
  auto started = std::async(std::launch::async, [&] {
    return system->rest().post("/api/v1/runs", {{"machine", "lathe-1"}, {"program", "O4"}});
  });
  ASSERT_TRUE(eventually(
      [&] { return system->rest().get("/api/v1/runs?state=ordered").json()["runs"].size() == 1; }));
  system->start_gateway();
  const auto reply = started.get();
  EXPECT_GE(reply.status, 400);
  EXPECT_NE(reply.body.find("nothing has begun at the new one"), std::string::npos) << reply.body;
  system->wait_connected();
  const json newest = system->rest().get("/api/v1/runs?limit=1").json()["runs"][0];
  EXPECT_EQ(newest.value("state", ""), "refused") << newest.dump();
  EXPECT_TRUE(eventually([&] {
    const json machine = system->rest().get("/api/v1/machines/lathe-1").json();
    return machine["notices"].dump().find("test_run, on before, is off") != std::string::npos;
  }));
  EXPECT_EQ(x(), 0);
}

/// The gateway that comes back is where its machine was, and knows of no run.
TEST_F(TestRunSystem, OfAKilledGatewayIsInterruptedAndNothingMoves) {
  begin();
  std::string text = "O3\nG21 G90 F6000\n";
  for (int i = 0; i < 400'000; ++i) text += fmt::format("G1 X{}.{}\n", i % 300, i % 7);
  system->push("O3", text + "M30\n");
  const std::string id = test("O3");
  ASSERT_TRUE(eventually([&] { return status().value("accepted", 0) > 1000; })) << status().dump();
  system->gateway().kill();
  system->start_gateway();
  system->wait_connected();
  const json run = system->wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "interrupted") << run.dump();
  EXPECT_EQ(run.value("executed", -1), 0);
  EXPECT_EQ(x(), 0);
}

}  // namespace
}  // namespace dripline::integration
