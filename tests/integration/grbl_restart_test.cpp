// A run on a board of the Grbl class that was cut off with its gateway or its server, continued by
// a restart: the path that the board has done before and after is the path of an undisturbed run.
// The board is the witness. DRIPLINE_RESTART_KILLS changes how often.
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>

#include "tests/integration/grbl_system.hpp"

namespace dripline::integration {
namespace {

using test_support::eventually;
using test_support::GrblBoard;

constexpr double kSpeed = 2;  ///< of the board's time
constexpr int kFeed = 6000;   ///< a block of 1 mm takes 5 ms at kSpeed
constexpr int kMoves = 1200;

int kills() {
  const char* wanted = std::getenv("DRIPLINE_RESTART_KILLS");
  return wanted != nullptr ? std::atoi(wanted) : 2;
}

class GrblRestart : public GrblSystem {
 protected:
  GrblRestart() {
    start("rs274ngc", {}, kSpeed);
    system->push("path", straight_program(kMoves, kFeed));
  }
  std::vector<double> path() {
    std::vector<double> points;
    for (const auto& one : board->with([](GrblBoard& peer) { return peer.done; }))
      points.push_back(one.at[0]);
    return points;
  }
  /// A run from X0 that is cut off at a random moment; what the board has done then, and the run.
  template <class Cut>
  nlohmann::json cut_off(Cut cut) {
    home_axes();
    board->with([](GrblBoard& peer) { peer.done.clear(); });
    const std::string id = start_run("path");
    EXPECT_TRUE(eventually([&] { return done() > 1; }));
    std::this_thread::sleep_for(
        std::chrono::milliseconds(std::uniform_int_distribution<>(0, 1500)(random)));
    cut(id);
    EXPECT_TRUE(eventually([&] { return rests(); })) << "the buffers of the board run out";
    return system->wait_ended(id);
  }
  /// The report of the restart's run.
  nlohmann::json report_of(const std::string& id) {
    nlohmann::json report;
    EXPECT_TRUE(eventually([&] {
      report = system->restart_report(id);
      return report.is_object();
    })) << system->run(id).dump()
        << system->rest().get("/api/v1/machines/lathe-1").body;
    return report;
  }
  void restart(const nlohmann::json& cut) {
    const auto before = path();
    const auto executed = cut.value("executed", std::size_t{0});
    ASSERT_GE(executed, 1u) << cut.dump();
    // Block 1 is the line of modes: block n + 1 ends at X n.
    ASSERT_EQ(before.size() + 1, executed) << cut.dump();
    for (std::size_t i = 0; i < before.size(); ++i)
      ASSERT_NEAR(before[i], static_cast<double>(i + 1), 1e-6);
    board->with([](GrblBoard& peer) { peer.done.clear(); });
    std::string refusal;
    nlohmann::json second;
    ASSERT_TRUE(eventually([&] {
      const auto reply = system->rest().post("/api/v1/runs/" + cut.value("id", "") + "/restart",
                                             nlohmann::json::object());
      refusal = reply.body;
      if (reply.status == 201) second = reply.json();
      return reply.status == 201;
    })) << refusal;
    const std::string id = second.value("id", "");
    const auto report = report_of(id);
    ASSERT_TRUE(report.is_object());
    EXPECT_EQ(report["after"]["block"], executed) << report.dump();
    EXPECT_EQ(report["proof"]["path"], "equal");
    const double at = report["position"].value("X", -1.0);
    EXPECT_GE(at, static_cast<double>(before.size()) - 1e-6);
    EXPECT_LT(at, static_cast<double>(before.size()) + 1) << "an abort ends within a block";
    EXPECT_TRUE(rests()) << "nothing moves before cycle start";
    EXPECT_EQ(done(), 0u);
    command(id, "resume");
    const auto whole = system->wait_ended(id);
    EXPECT_EQ(whole.value("state", ""), "completed") << whole.dump();
    const auto after = path();
    const std::size_t rest = kMoves - (executed - 1);
    ASSERT_GE(after.size(), rest);
    for (std::size_t i = 0; i < rest; ++i) {
      ASSERT_NEAR(after[after.size() - rest + i], static_cast<double>(executed + i), 1e-6)
          << "after block " << executed;
    }
    constexpr std::size_t kMaxApproach = 4;
    EXPECT_LE(after.size(), rest + kMaxApproach);
  }
  std::mt19937 random{20'261'123};
};

TEST_F(GrblRestart, CutsThePathOfAnUndisturbedRun) {
  int restarts = 0;
  for (int tries = 0; restarts < kills() && tries < 4 * kills() + 4 && !HasFailure(); ++tries) {
    SCOPED_TRACE(tries);
    const bool is_server = tries % 2 == 1;
    const auto cut = cut_off([&](const std::string& id) {
      if (is_server) {
        system->server().kill();
        system->start_server();
        system->wait_connected();
        // The board did not wait for the server: the run may be over.
        const auto reply = post_command(id, "abort");
        if (reply.status != 200) {
          EXPECT_EQ(system->wait_ended(id).value("state", ""), "completed") << reply.body;
        }
        return;
      }
      system->gateway().kill();
      EXPECT_TRUE(eventually([&] { return rests(); }));
      start_gateway();
    });
    if (cut.value("state", "") == "completed") continue;
    restart(cut);
    ++restarts;
  }
  EXPECT_EQ(restarts, kills());
}

/// The second restart continues the first one's run, and knows what that has done.
TEST_F(GrblRestart, OfARestartContinuesWhereThatWasCutOff) {
  const auto kill = [&](const std::string&) {
    system->gateway().kill();
    EXPECT_TRUE(eventually([&] { return rests(); }));
    start_gateway();
  };
  auto cut = cut_off(kill);
  ASSERT_EQ(cut.value("state", ""), "interrupted") << cut.dump();
  const auto done_before = path().size();
  std::string refusal, again;
  ASSERT_TRUE(eventually([&] {
    const auto reply = system->rest().post("/api/v1/runs/" + cut.value("id", "") + "/restart",
                                           nlohmann::json::object());
    refusal = reply.body;
    if (reply.status == 201) again = reply.json().value("id", "");
    return reply.status == 201;
  })) << refusal;
  EXPECT_EQ(report_of(again)["after"]["block"], done_before + 1);
  command(again, "resume");
  ASSERT_TRUE(eventually([&] { return path().size() > done_before + 20; }));
  kill(again);
  cut = system->wait_ended(again);
  EXPECT_EQ(cut.value("state", ""), "interrupted") << cut.dump();
  // The approach is not part of the path: what counts is where the axes are.
  const auto at = board->with([](GrblBoard& peer) { return peer.position()[0]; });
  EXPECT_EQ(cut.value("executed", std::size_t{0}), static_cast<std::size_t>(at + 0.005) + 1)
      << cut.dump();
  board->with([&](GrblBoard& peer) {
    peer.done.clear();
    for (int x = 1; x <= static_cast<int>(at + 0.005); ++x) {
      peer.done.emplace_back();
      peer.done.back().at[0] = x;
    }
  });
  restart(cut);
}

/// With nothing in hand the axes rest where the program has left them: as long as they are there,
/// the board was not switched off.
TEST_F(GrblRestart, AfterAKillAtAStopNeedsNoHomingWhileTheAxesAreThere) {
  system->push("stop", "G21 G90 G94 F6000\nG1 X5\nM0\nM3 S500\nG1 X10\nM2\n");
  const auto kill_at_stop = [&] {
    home_axes();
    const std::string id = start_run("stop");
    EXPECT_TRUE(eventually([&] {
      const auto shown = system->rest().get("/api/v1/machines/lathe-1").json();
      return shown["status"].value("execution", "") == "PROGRAM_STOPPED";
    }));
    EXPECT_TRUE(eventually([&] { return rests(); }));
    system->gateway().kill();
    return id;
  };
  const auto restarted = [&](const std::string& id) {
    std::string refusal, second;
    EXPECT_TRUE(eventually([&] {
      const auto reply =
          system->rest().post("/api/v1/runs/" + id + "/restart", nlohmann::json::object());
      refusal = reply.body;
      if (reply.status == 201) second = reply.json().value("id", "");
      return reply.status == 201 || refusal.find("home the machine") != std::string::npos;
    })) << refusal;
    return std::pair(second, refusal);
  };
  const std::string id = kill_at_stop();
  start_gateway();
  EXPECT_EQ(system->wait_ended(id).value("state", ""), "interrupted");
  const auto [second, refusal] = restarted(id);
  ASSERT_FALSE(second.empty()) << refusal;
  EXPECT_EQ(report_of(second)["continues_at"].value("X", 0.0), 5);
  command(second, "resume");
  const auto whole = system->wait_ended(second);
  EXPECT_EQ(whole.value("state", ""), "completed") << whole.dump();
  EXPECT_EQ(board->with([](GrblBoard& peer) { return peer.position()[0]; }), 10);

  const std::string again = kill_at_stop();
  board->with([](GrblBoard& peer) { peer.restart(); });
  start_gateway();
  EXPECT_EQ(system->wait_ended(again).value("state", ""), "interrupted");
  const auto [none, why] = restarted(again);
  EXPECT_TRUE(none.empty()) << "it was switched off";
}

}  // namespace
}  // namespace dripline::integration
