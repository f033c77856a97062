#pragma once

#include <thread>

#include "tests/integration/motion_system.hpp"
#include "tests/support/grbl/board_port.hpp"

namespace dripline::integration {

class GrblSystem : public MotionSystem {
 protected:
  /// `speed`: of the board's time.
  void start(const std::string& control = "rs274ngc",
             const test_support::GrblBoard::Options& options = {}, double speed = 20,
             const std::vector<std::string>& more = {}) {
    board.emplace(options, speed);
    start_system(control, "grbl:" + board->path(), more);
  }
  double traveled() {
    return board->with([](test_support::GrblBoard& peer) { return peer.traveled(); });
  }
  /// The axes stay where they are for a while, and not because the board's thread has no processor.
  bool rests() {
    const double before = traveled();
    std::this_thread::sleep_for(std::chrono::milliseconds(300));  // 6 s at speed 20
    return board->with([&](test_support::GrblBoard& peer) {
      return !peer.is_moving() && peer.traveled() == before;
    });
  }
  /// A program of its own moves them back to X 0.
  void home_axes() {
    if (board->with([](test_support::GrblBoard& peer) { return peer.position()[0]; }) == 0) return;
    system->push("back", "G21 G90 G0 X0\nM2\n");
    const auto run = system->wait_ended(start_run("back"));
    EXPECT_EQ(run.value("state", ""), "completed") << run.dump();
  }
  std::size_t done() {
    return board->with([](test_support::GrblBoard& peer) { return peer.done.size(); });
  }

  std::optional<test_support::GrblBoardPort> board;
};

}  // namespace dripline::integration
