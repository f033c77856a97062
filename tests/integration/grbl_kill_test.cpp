// Gateway, device link and server cut off at random moments while a board of the Grbl class runs a
// program. The board is the witness. DRIPLINE_KILLS changes how often (100 by default, of each).
#include <gtest/gtest.h>
#include <cmath>
#include <cstdlib>
#include <random>

#include "tests/integration/grbl_system.hpp"

namespace dripline::integration {
namespace {

using test_support::eventually;
using test_support::GrblBoard;

constexpr double kSpeed = 2;            ///< of the board's time
constexpr int kFeed = 1200;             ///< a block of 1 mm takes 50 ms of the board's time
constexpr std::size_t kSilent = 2;      ///< the first blocks: modes, and back to X 0
constexpr std::size_t kMaxAhead = 23;   ///< blocks in the 1.15 s that the board may have ahead
constexpr std::size_t kOwnerLate = 20;  ///< blocks until the journal has them, under load

int kills() {
  const char* wanted = std::getenv("DRIPLINE_KILLS");
  return wanted != nullptr ? std::atoi(wanted) : 100;
}

/// Block n + 2 ends at X n.
std::string path_program(int blocks) {
  std::string text = "G21 G90 G94 F" + std::to_string(kFeed) + "\nG0 X0\n";
  for (int i = 1; i <= blocks; ++i) text += "G1 X" + std::to_string(i) + "\n";
  return text + "M2\n";
}

class GrblKill : public GrblSystem {
 protected:
  void begin() {
    start("rs274ngc", {}, kSpeed);
    system->push("path", path_program(8000));
  }
  /// Blocks that the axes have done in this run, each once and in order.
  std::size_t blocks_done() {
    const auto points = board->with([](GrblBoard& peer) { return peer.done; });
    const auto first = std::find_if(points.begin(), points.end(), [](const auto& point) {
      return std::fabs(point.at[0] - 1) < 1e-6;  // before it the rapid move back
    });
    std::size_t blocks = 0;
    for (auto point = first; point != points.end(); ++point)
      EXPECT_NEAR(point->at[0], static_cast<double>(++blocks), 1e-6) << "twice, or skipped";
    return blocks;
  }
  bool is_moving() {
    return board->with([](GrblBoard& peer) { return peer.is_moving(); });
  }
  /// One more run, cut off by `cut` at a random moment.
  template <class Cut>
  void cut_off(Cut cut) {
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
  /// What is on record is what the board has done, less what it still had.
  void expect_truth(const std::string& state) {
    const auto run = system->wait_ended(id);
    EXPECT_EQ(run.value("state", ""), state) << run.dump();
    executed = run.value("executed", std::size_t{0});
    EXPECT_LE(executed, truth + kSilent) << "claims what was not done: " << run.dump();
    EXPECT_GE(executed + kMaxAhead + kOwnerLate, truth + kSilent) << run.dump();
    EXPECT_EQ(blocks_done(), truth) << "nothing moves by itself";
    unknown = std::max(unknown, truth + kSilent - std::min(executed, truth + kSilent));
  }
  void TearDown() override {
    std::printf("at most %zu blocks were done and not on record\n", unknown);
  }
  std::mt19937 random{20'261'123};
  std::string id;
  std::size_t at_cut = 0, truth = 0, executed = 0, unknown = 0;
};

TEST_F(GrblKill, OfTheGatewayDoesNoBlockTwiceSkipsNoneAndClaimsNone) {
  begin();
  for (int kill = 0; kill < kills() && !HasFailure(); ++kill) {
    SCOPED_TRACE(kill);
    cut_off([&] { system->gateway().kill(); });
    start_gateway();
    expect_truth("interrupted");
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
    expect_truth("alarmed");
    press_emergency_stop(true);
    press_emergency_stop(false);
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
      EXPECT_TRUE(eventually([&] { return blocks_done() > at_cut + 2; })) << "the run goes on";
      at_cut = blocks_done();
      command(id, "abort");
    });
    expect_truth("aborted");
    EXPECT_EQ(executed, truth + kSilent) << "an abort counts what the axes have passed";
  }
}

}  // namespace
}  // namespace dripline::integration
