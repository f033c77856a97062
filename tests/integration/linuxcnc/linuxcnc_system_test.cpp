// Server, gateway and a real LinuxCNC.
#include <atomic>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <thread>

#include "tests/integration/motion_system.hpp"
#include "tests/support/linuxcnc/linuxcnc.hpp"

namespace dripline::integration {
namespace {

using test_support::eventually;
using test_support::LinuxCnc;

class LinuxCncSystem : public MotionSystem {
 protected:
  void start(const std::string& control, const std::vector<std::string>& more = {}) {
    if (const std::string missing = LinuxCnc::missing(); !missing.empty())
      GTEST_SKIP() << "skipped: " << missing;
    linuxcnc.emplace();
    if (!ini.empty()) linuxcnc->add_to_ini("RS274NGC", ini);
    linuxcnc->start();
    start_system(control, "linuxcnc:" + linuxcnc->ini(), more);
  }
  /// As the example's README has it.
  void turn_on(const std::string& program) {
    ASSERT_TRUE(eventually([&] {
      return post_run(program).body.find("LinuxCNC is in emergency stop") != std::string::npos;
    })) << post_run(program).body;
    press_emergency_stop(true);
    press_emergency_stop(false);
    ASSERT_TRUE(eventually([&] { return panel({"home"}).status == 0; })) << panel({"home"}).output;
  }

  std::string ini;  ///< more lines of its [RS274NGC]
  std::optional<LinuxCnc> linuxcnc;
};

TEST_F(LinuxCncSystem, AProgramOfATnc155RunsOnALinuxCncMill) {
  start("tnc155");
  if (IsSkipped() || HasFatalFailure()) return;
  std::ostringstream text;
  text << std::ifstream("deploy/examples/linuxcnc/PLATE.H").rdbuf();
  system->push("PLATE", text.str());
  turn_on("PLATE");
  const std::string id = start_run("PLATE");
  const auto run = system->wait_ended(id, std::chrono::seconds(180));
  EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  EXPECT_EQ(run.value("executed", 0), 51) << run.dump();
  EXPECT_TRUE(linuxcnc->rests());
  double deepest = 0, widest = 0;
  for (const auto& sample : linuxcnc->samples()) {
    deepest = std::min(deepest, sample.at[2]);
    widest = std::max(widest, sample.at[0]);
  }
  EXPECT_NEAR(deepest, -8, 0.001);
  EXPECT_NEAR(widest, 95, 0.001);
}

TEST_F(LinuxCncSystem, ProgramsBeginInTheModesOfItsStartupCode) {
  ini = "RS274NGC_STARTUP_CODE = G20 G40 G64 P0.01 (inches)";
  start("rs274ngc");
  if (IsSkipped() || HasFatalFailure()) return;
  const std::string text = "G0 X1\nM2\n";
  system->push("inch", text);
  EXPECT_TRUE(eventually([&] {
    return post_run("inch").body.find("Set startup_code = ") != std::string::npos;
  })) << post_run("inch").body;
  const auto setup = std::filesystem::path(linuxcnc->ini()).parent_path() / "setup.toml";
  std::ofstream(setup) << "[control]\nprofile = \"linuxcnc\"\n"
                          "startup_code = \"G20 G40 G64 P0.01 (inches)\"\n";
  system.reset();
  start_system("rs274ngc", "linuxcnc:" + linuxcnc->ini(), {"--setup", setup.string()});
  system->push("inch", text);
  turn_on("inch");
  EXPECT_EQ(system->wait_ended(start_run("inch")).value("state", ""), "completed");
  EXPECT_TRUE(eventually([&] { return std::fabs(linuxcnc->position()[0] - 25.4) < 0.001; }))
      << linuxcnc->position()[0];
}

TEST_F(LinuxCncSystem, BlocksKeyedInMoveTheMachineAndAnAbortStopsIt) {
  start("fanuc");
  if (IsSkipped() || HasFatalFailure()) return;
  system->push("end", "O1\nM30\n");
  turn_on("end");
  EXPECT_EQ(system->wait_ended(start_run("end")).value("state", ""), "completed");
  const auto key_in = [&](const std::string& text) {
    const auto reply = system->rest().post("/api/v1/machines/lathe-1/mdi", {{"text", text}});
    EXPECT_EQ(reply.status, 201) << reply.body;
    return reply.status == 201 ? reply.json().value("id", "") : "";
  };
  // The witness writes what it has sampled a moment later.
  const auto comes_to = [&](double x) {
    return eventually([&] { return std::fabs(linuxcnc->position()[0] - x) < 0.001; });
  };
  const double begun_at = linuxcnc->position()[0];
  EXPECT_EQ(system->wait_ended(key_in("G21 G91 G1 X20. F2400\n")).value("state", ""), "completed");
  EXPECT_TRUE(comes_to(begun_at + 20));
  EXPECT_EQ(system->wait_ended(key_in("X5.\n")).value("state", ""), "completed");
  EXPECT_TRUE(comes_to(begun_at + 25)) << "G91 is in force";
  const auto datum = system->rest().post("/api/v1/machines/lathe-1/datum",
                                         {{"offset", "G54"}, {"axis", "X"}, {"value", 0}});
  EXPECT_EQ(datum.status, 200) << datum.body;
  const auto length = system->rest().post(
      "/api/v1/machines/lathe-1/touch-off",
      {{"tool", 1}, {"offset", "G54"}, {"axis", "Z"}, {"value", -20}, {"unit", "mm"}});
  EXPECT_EQ(length.status, 200) << length.body;
  EXPECT_TRUE(comes_to(begun_at + 25)) << "nothing moves";
  const double touched_at = linuxcnc->position()[2];
  EXPECT_EQ(system->wait_ended(key_in("G21 G90 G54 G43 H1 G1 Z-15. F2400\n")).value("state", ""),
            "completed");
  EXPECT_TRUE(eventually([&] {
    return std::fabs(linuxcnc->position()[2] - touched_at - 5) < 0.001;
  })) << "5 above the place where the tip was -20: "
      << linuxcnc->position()[2];
  EXPECT_EQ(system->wait_ended(key_in("G21 G90 G54 G1 X-3. F2400\n")).value("state", ""),
            "completed");
  EXPECT_TRUE(comes_to(begun_at + 22)) << "by the datum that was set";
  const std::string id = key_in("G91 G1 X300. F1200\n");
  ASSERT_TRUE(eventually([&] { return linuxcnc->position()[0] > begun_at + 27; }));
  command(id, "abort");
  EXPECT_EQ(system->wait_ended(id).value("state", ""), "aborted");
  ASSERT_TRUE(eventually([&] { return linuxcnc->rests(); }));
  EXPECT_LT(linuxcnc->position()[0], begun_at + 300);
}

TEST_F(LinuxCncSystem, AJogIsLinuxCncsOwnAndMdiGoesOnFromThere) {
  start("fanuc", {"--jog-step", "50", "--jog-feed", "3000"});
  if (IsSkipped() || HasFatalFailure()) return;
  system->push("end", "O1\nM30\n");
  turn_on("end");
  EXPECT_EQ(system->wait_ended(start_run("end")).value("state", ""), "completed");
  const auto jog = [&](double distance, double feed) {
    return system->rest().post(
        "/api/v1/machines/lathe-1/jog",
        {{"axis", "X"}, {"distance", distance}, {"unit", "mm"}, {"feed", feed}});
  };
  const auto x = [&] { return linuxcnc->position()[0]; };
  const auto comes_to = [&](double place) {
    return eventually([&] { return std::fabs(x() - place) < 0.001; });
  };
  const double begun_at = x();
  // An override of LinuxCNC's own would make it quicker than it was asked for.
  const auto override = system->rest().post("/api/v1/machines/lathe-1/commands",
                                            {{"action", "feed_override"}, {"value", 2}});
  EXPECT_EQ(override.status, 200) << override.body;
  for (const double distance : {20.0, -15.0}) {
    const auto begin = std::chrono::steady_clock::now();
    const auto done = jog(distance, 600);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    ASSERT_EQ(done.status, 200) << done.body;
    EXPECT_EQ(done.json()["reached"], true) << done.body;
    EXPECT_GT(took.count(), std::fabs(distance) / 10 * 0.9) << "at the feed, whatever the override";
  }
  EXPECT_TRUE(comes_to(begun_at + 5)) << x();
  const auto beyond = jog(-50, 3000);
  EXPECT_TRUE(beyond.status == 200 || beyond.body.find("travel") != std::string::npos)
      << beyond.body;
  if (beyond.status == 200) {
    test_support::RestClient::Reply back;  // busy, while LinuxCNC's status shows the last one
    EXPECT_TRUE(eventually([&] { return (back = jog(50, 3000)).status == 200; })) << back.body;
  }
  const auto mdi =
      system->rest().post("/api/v1/machines/lathe-1/mdi", {{"text", "G21 G91 G1 X2. F2400\n"}});
  ASSERT_EQ(mdi.status, 201) << mdi.body;
  EXPECT_EQ(system->wait_ended(mdi.json().value("id", "")).value("state", ""), "completed");
  EXPECT_TRUE(comes_to(begun_at + 7)) << x();
  test_support::RestClient::Reply stopped;
  std::thread mover([&] { stopped = jog(50, 600); });
  EXPECT_TRUE(eventually([&] { return x() > begun_at + 9; }));
  const auto stop =
      system->rest().post("/api/v1/machines/lathe-1/commands", {{"action", "stop_jog"}});
  mover.join();
  EXPECT_EQ(stop.status, 200) << stop.body;
  ASSERT_EQ(stopped.status, 200) << stopped.body;
  EXPECT_EQ(stopped.json()["reached"], false) << stopped.body;
  ASSERT_TRUE(eventually([&] { return linuxcnc->rests(); }));
  EXPECT_LT(x(), begun_at + 50);
}

/// In more pieces than one; how far it comes before a busy computer misses a keep is not certain.
TEST_F(LinuxCncSystem, AHeldJogMovesWhileItIsKept) {
  start("fanuc", {"--jog-step", "50", "--jog-feed", "3000"});
  if (IsSkipped() || HasFatalFailure()) return;
  system->push("end", "O1\nM30\n");
  turn_on("end");
  EXPECT_EQ(system->wait_ended(start_run("end")).value("state", ""), "completed");
  const auto x = [&] { return linuxcnc->position()[0]; };
  const double begun_at = x();
  double longest = 0;
  for (int i = 0; i < 10 && longest < 3.5; ++i) {
    const double before = x();
    const std::string word = "a" + std::to_string(i);
    test_support::RestClient::Reply done;
    std::atomic<bool> is_over = false;
    std::thread mover([&] {
      done = system->rest().post(
          "/api/v1/machines/lathe-1/jog",
          {{"axis", "X"}, {"distance", 20}, {"unit", "mm"}, {"feed", 600}, {"hold", word}});
      is_over = true;
    });
    while (!is_over && x() < before + 8) {
      (void)system->rest().post("/api/v1/machines/lathe-1/jog/hold", {{"hold", word}});
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    mover.join();
    ASSERT_TRUE(eventually([&] { return linuxcnc->rests(); }));
    longest = std::max(longest, x() - before);
    EXPECT_LT(x() - before, 20) << done.body;
  }
  EXPECT_GT(longest, 3.5) << "more than the piece of 3 mm";
  const double at = x();
  EXPECT_GT(at, begun_at);
  EXPECT_TRUE(linuxcnc->rests(std::chrono::seconds(1)));
  EXPECT_EQ(x(), at);
}

TEST_F(LinuxCncSystem, AStoppedGatewayStopsTheAxesFirstAndKnowsHowFarTheyWere) {
  start("rs274ngc");
  if (IsSkipped() || HasFatalFailure()) return;
  system->push("path", straight_program(380, 1200));
  turn_on("path");
  const std::string id = start_run("path");
  ASSERT_TRUE(eventually([&] { return linuxcnc->position()[0] > 5; }));
  system->server().signal(SIGSTOP);  // so the gateway waits for its acknowledgments
  system->gateway().signal(SIGTERM);
  const auto held = panel({"hold"});
  EXPECT_EQ(held.output.find("refused"), std::string::npos) << held.output;
  EXPECT_EQ(system->gateway().wait(), 0);
  ASSERT_TRUE(linuxcnc->rests());
  const double at = linuxcnc->position()[0];
  EXPECT_LT(at, 379);
  system->server().signal(SIGCONT);
  start_gateway();
  const auto run = system->wait_ended(id);
  EXPECT_EQ(run.value("state", ""), "interrupted") << run.dump();
  // Block 1 does not move; block n + 1 ends at X n.
  EXPECT_NEAR(run.value("executed", 0.0), std::floor(at) + 1, 1.001) << at << run.dump();
  EXPECT_TRUE(linuxcnc->rests(std::chrono::seconds(1)));
  EXPECT_EQ(linuxcnc->position()[0], at) << "nothing moves by itself";
}

TEST_F(LinuxCncSystem, AKilledGatewayLeavesNoMotionAndClaimsNothing) {
  start("rs274ngc");
  if (IsSkipped() || HasFatalFailure()) return;
  system->push("path", straight_program(380, 2400));
  turn_on("path");
  std::mt19937 random(20'261'123);
  for (int kill = 0; kill < 3; ++kill) {
    const double before = linuxcnc->position()[0];
    const std::string id = start_run("path");
    ASSERT_TRUE(eventually([&] { return linuxcnc->position()[0] != before; })) << kill;
    std::this_thread::sleep_for(
        std::chrono::milliseconds(std::uniform_int_distribution<>(0, 1500)(random)));
    system->gateway().kill();
    ASSERT_TRUE(eventually([&] { return linuxcnc->rests(); })) << "what it had is aborted";
    const double at = linuxcnc->position()[0];
    EXPECT_LT(at, 379);
    start_gateway();
    const auto run = system->wait_ended(id);
    EXPECT_EQ(run.value("state", ""), "interrupted") << run.dump();
    // Block 1 does not move; block n + 1 ends at X n. The first block may begin far off.
    if (before < 1) {
      EXPECT_LE(run.value("executed", 0.0), at + 1.001) << run.dump();
    }
    EXPECT_TRUE(linuxcnc->rests(std::chrono::seconds(1)));
    EXPECT_EQ(linuxcnc->position()[0], at) << "nothing moves by itself";
  }
  EXPECT_EQ(panel({"home"}).status, 0);
}

}  // namespace
}  // namespace dripline::integration
