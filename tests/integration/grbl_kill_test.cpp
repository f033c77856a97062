// Gateway, device link and server cut off at random moments while a board of the Grbl class runs a
// program. The board is the witness. DRIPLINE_KILLS changes how often (20 by default, of each).
#include <gtest/gtest.h>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <random>

#include "tests/integration/grbl_system.hpp"

namespace dripline::integration {
namespace {

using test_support::eventually;
using test_support::GrblBoard;

constexpr double kSpeed = 2;                ///< of the board's time
constexpr int kFeed = 1200;                 ///< a block of 1 mm takes 50 ms of the board's time
constexpr std::size_t kSilent = 1;          ///< the first block: modes
constexpr std::size_t kMaxAhead = 23;       ///< blocks in the 1.15 s that the board may have ahead
constexpr std::size_t kMaxLateBlocks = 15;  ///< until a signal is taken, under load
constexpr std::size_t kOwnerLate = 20;      ///< blocks until the journal has them, under load

int kills() {
  const char* wanted = std::getenv("DRIPLINE_KILLS");
  return wanted != nullptr ? std::atoi(wanted) : 20;
}

class GrblKill : public GrblSystem {
 protected:
  void begin() {
    start("rs274ngc", {}, kSpeed);
    system->push("path", straight_program(8000, kFeed));
  }
  /// Blocks that the axes have done in this run, each once and in order.
  std::size_t blocks_done() {
    std::size_t blocks = 0;
    for (const auto& point : board->with([](GrblBoard& peer) { return peer.done; }))
      EXPECT_NEAR(point.at[0], static_cast<double>(++blocks), 1e-6) << "twice, or skipped";
    return blocks;
  }
  bool is_moving() {
    return board->with([](GrblBoard& peer) { return peer.is_moving(); });
  }
  /// One more run, cut off by `cut` at a random moment.
  template <class Cut>
  void cut_off(Cut cut) {
    home_axes();
    board->with([](GrblBoard& peer) { peer.done.clear(); });
    id = start_run("path");
    ASSERT_TRUE(eventually([&] { return blocks_done() > 1; }));
    // The moment is the test's subject, so here it does sleep.
    std::this_thread::sleep_for(
        std::chrono::milliseconds(std::uniform_int_distribution<>(0, 600)(random)));
    at_cut = blocks_done();
    cut();
    ASSERT_TRUE(eventually([&] { return !is_moving(); })) << "what the board has runs out";
    truth = blocks_done();
    EXPECT_LE(truth, at_cut + kMaxAhead + 1) << "and the block in motion";
  }
  /// 1 where an abort has stopped the axes as good as at the end of the block in motion, which
  /// then counts as executed.
  std::size_t rests_at_next_end() {
    constexpr double kSlack = 0.005;  // mm, as the gateway takes it
    const double x = board->with([](GrblBoard& peer) { return peer.position()[0]; });
    return std::fabs(x - static_cast<double>(truth + 1)) < kSlack ? 1 : 0;
  }
  /// What is on record is what the board has done, less `unknown` blocks that it still had.
  void expect_truth(const std::string& state, std::size_t unknown) {
    const auto run = system->wait_ended(id);
    EXPECT_EQ(run.value("state", ""), state) << run.dump();
    executed = run.value("executed", std::size_t{0});
    EXPECT_LE(executed, truth + kSilent + rests_at_next_end())
        << "claims what was not done: " << run.dump();
    EXPECT_GE(executed + unknown, truth + kSilent) << run.dump();
    EXPECT_EQ(blocks_done(), truth) << "nothing moves by itself";
  }
  /// The board's position shows what the run's record does not have.
  void expect_restart_after(std::size_t block) {
    std::string text, restarted;
    ASSERT_TRUE(eventually([&] {
      const auto reply =
          system->rest().post("/api/v1/runs/" + id + "/restart", nlohmann::json::object());
      text = reply.body;
      if (reply.status == 201) restarted = reply.json().value("id", "");
      return reply.status == 201;
    })) << text;
    nlohmann::json report;
    ASSERT_TRUE(eventually([&] {
      report = system->restart_report(restarted);
      return report.is_object();
    })) << system->run(restarted).dump();
    EXPECT_EQ(report["after"]["block"], block) << report.dump();
    EXPECT_EQ(report["on_record"], executed);
    EXPECT_EQ(report["proof"]["path"], "equal");
    command(restarted, "abort");
    (void)system->wait_ended(restarted);
    EXPECT_EQ(blocks_done(), truth) << "nothing moves before cycle start";
  }
  std::mt19937 random{20'261'123};
  std::string id;
  std::size_t at_cut = 0, truth = 0, executed = 0;
};

TEST_F(GrblKill, AGatewayThatIsStoppedStopsTheBoardFirstAndKnowsHowFarItWas) {
  begin();
  for (int stop = 0; stop < 3; ++stop) {
    cut_off([&] {
      system->server().signal(SIGSTOP);  // so the gateway waits for its acknowledgments
      system->gateway().signal(SIGTERM);
      for (const char* verb : {"hold", "abort"}) {
        const auto stopped = panel({verb});
        EXPECT_EQ(stopped.output.find("refused"), std::string::npos) << stopped.output;
      }
      system->gateway().signal(SIGTERM);
      EXPECT_EQ(system->gateway().wait(), 0);
      EXPECT_TRUE(rests());
    });
    EXPECT_LE(truth, at_cut + kMaxLateBlocks) << "what the board had was dropped";
    system->server().signal(SIGCONT);
    start_gateway();
    expect_truth("interrupted", 0);
  }
}

TEST_F(GrblKill, OfTheGatewayDoesNoBlockTwiceSkipsNoneAndClaimsNone) {
  begin();
  for (int kill = 0; kill < kills() && !HasFailure(); ++kill) {
    SCOPED_TRACE(kill);
    cut_off([&] { system->gateway().kill(); });
    start_gateway();
    expect_truth("interrupted", 0);
  }
}

TEST_F(GrblKill, OfTheLinkDoesNoBlockTwiceSkipsNoneAndClaimsNone) {
  begin();
  for (int kill = 0; kill < kills() && !HasFailure(); ++kill) {
    SCOPED_TRACE(kill);
    cut_off([&] {
      board->unplug();
      board->plug_in();
    });
    expect_truth("alarmed", kMaxAhead + kOwnerLate);
    press_emergency_stop(true);
    press_emergency_stop(false);
    expect_restart_after(truth + kSilent);
  }
}

/// The gateway continues without it, and is stopped in order afterwards.
TEST_F(GrblKill, OfTheServerIsNotFelt) {
  begin();
  for (int kill = 0; kill < kills() / 10 && !HasFailure(); ++kill) {
    SCOPED_TRACE(kill);
    cut_off([&] {
      system->server().kill();
      system->start_server();
      system->wait_connected();
      EXPECT_TRUE(eventually([&] { return blocks_done() > at_cut + 2; })) << "the run continues";
      at_cut = blocks_done();
      command(id, "abort");
    });
    expect_truth("aborted", 0);
  }
}

}  // namespace
}  // namespace dripline::integration
