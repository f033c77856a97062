// Gateway, server and link cut off at random moments while a board of the Grbl class runs a
// program. The board is the witness. DRIPLINE_KILLS changes how often (20 by default).
#include <gtest/gtest.h>
#include <cstdlib>
#include <random>

#include "tests/integration/grbl_system.hpp"

namespace dripline::integration {
namespace {

using test_support::eventually;
using test_support::GrblBoard;

constexpr double kSpeed = 2;  ///< of the board's time
constexpr int kFeed = 1200;   ///< a block of 1 mm takes 25 ms at kSpeed
constexpr std::size_t kHeldByBoard =
    27;  ///< blocks in planner and receive buffer, and one in motion
/// Blocks in the time between their end and the report that is believed, on a machine under load.
constexpr std::size_t kReportedLate = 60;

int kills() {
  const char* wanted = std::getenv("DRIPLINE_KILLS");
  return wanted != nullptr ? std::atoi(wanted) : 20;
}

class GrblKill : public GrblSystem {
 protected:
  /// One more run, cut off by `cut` at a random moment.
  template <class Cut>
  void cut_off(Cut cut) {
    board->with([](GrblBoard& peer) { peer.done.clear(); });
    id = start_run("path");
    ASSERT_TRUE(eventually([&] { return done() > 1; }));
    // The moment is the test's subject, so here it does sleep.
    std::this_thread::sleep_for(
        std::chrono::milliseconds(std::uniform_int_distribution<>(0, 600)(random)));
    at_cut = done();
    cut();
    ASSERT_TRUE(eventually([&] { return rests(); })) << "the buffers of the board run out";
    truth = done();
  }
  /// Every block once and in order, and no more than that on record.
  void expect_truth(const std::string& state) {
    const auto points = board->with([](GrblBoard& peer) { return peer.done; });
    for (std::size_t i = 0; i < points.size(); ++i)
      ASSERT_NEAR(points[i].at[0], static_cast<double>(i + 1), 1e-6) << "block " << i + 2;
    EXPECT_EQ(points.size(), truth) << "nothing moves by itself";
    const auto run = system->wait_ended(id);
    EXPECT_EQ(run.value("state", ""), state) << run.dump();
    const auto executed = run.value("executed", std::size_t{0});
    EXPECT_LE(executed, truth + 1) << "the first block does not move: " << run.dump();
    EXPECT_GE(executed + kReportedLate, at_cut) << run.dump();
    EXPECT_GE(executed + kReportedLate + kHeldByBoard, truth) << run.dump();
    unknown = std::max(unknown, truth + 1 - std::min(executed, truth + 1));
  }
  void cut_gateway() {
    cut_off([&] { system->gateway().kill(); });
    system->start_gateway();
    system->wait_connected();
    expect_truth("interrupted");
  }
  void cut_link() {
    cut_off([&] {
      board->unplug();
      board->plug_in();
    });
    expect_truth("alarmed");
    press_emergency_stop(true);
    press_emergency_stop(false);
  }
  /// The gateway continues without it.
  void cut_server() {
    cut_off([&] {
      system->server().kill();
      system->start_server();
      system->wait_connected();
      EXPECT_TRUE(eventually([&] { return done() > at_cut + 2; })) << "the run goes on";
      command(id, "abort");
    });
    expect_truth("aborted");
  }
  std::mt19937 random{20'261'123};
  std::string id;
  std::size_t at_cut = 0, truth = 0, unknown = 0;
};

TEST_F(GrblKill, DoNoBlockTwiceSkipNoneAndClaimNone) {
  start("rs274ngc", {}, kSpeed);
  system->push("path", straight_program(8000, kFeed));
  for (int kill = 0; kill < kills() && !HasFailure(); ++kill) {
    SCOPED_TRACE(kill);
    if (kill % 10 == 9)
      cut_server();
    else if (kill % 2 == 0)
      cut_gateway();
    else
      cut_link();
  }
  std::printf("at most %zu blocks were done and not on record\n", unknown);
}

}  // namespace
}  // namespace dripline::integration
