#include <random>

#include "tests/unit/gateway/machine/grbl/grbl_shop.hpp"

/// What a board still does when its link is cut, or its gateway is killed: no more than the motion
/// that its rules allow ahead of the axes.
namespace dripline::machine::grbl::test {
namespace {

constexpr double kRate = 12'000, kAcceleration = 500;  // of the board
constexpr double kAhead = 0.75 + kRate / 60 / kAcceleration;

struct PathCase {
  const char* name;
  double length, feed;
};

class GrblLinkCut : public testing::TestWithParam<PathCase> {
 protected:
  void add_block() {
    x_ += GetParam().length;
    shop.program.line(x_, 0, GetParam().feed);
  }
  void fill() {
    while (shop.machine.has_room() && x_ < kLength) add_block();
  }
  /// How long the axes continue, with nothing sent to the board.
  double seconds_alone() {
    double seconds = 0;
    for (; shop.board.is_moving() && seconds < 100; seconds += 0.001) shop.board.pass(0.001);
    return seconds;
  }
  static constexpr double kLength = 20'000;
  GrblShop shop{{.rx_bytes = 1024, .planner_blocks = 100, .is_grbl_hal = true}};

 private:
  double x_ = 0;
};

TEST_P(GrblLinkCut, LeavesNoMoreMotionThanIsAllowedAhead) {
  std::mt19937 random(20'261'123);
  shop.begin();
  fill();
  ASSERT_TRUE(shop.pass_until([&] { return shop.board.is_moving(); }));
  for (int i = 0; i < 10; ++i) {
    shop.pass(std::uniform_real_distribution<>(0.5, 2)(random));
    fill();
    GrblBoard board = shop.board;  // the other one is asked further
    std::swap(board, shop.board);
    const double alone = seconds_alone();
    std::swap(board, shop.board);
    EXPECT_LE(alone, kAhead + 0.01);
    EXPECT_GE(alone, 0.3) << "enough for the planner";
  }
}

TEST_P(GrblLinkCut, TheAxesAreNeverShortOfMotion) {
  shop.begin();
  fill();
  ASSERT_TRUE(shop.pass_until([&] { return shop.board.is_moving(); }));
  for (int ms = 0; ms < 10'000; ++ms) {
    shop.pass(0.001);
    fill();
    ASSERT_TRUE(shop.board.is_moving()) << ms << " ms";
  }
}

INSTANTIATE_TEST_SUITE_P(, GrblLinkCut,
                         testing::Values(PathCase{"blocks_of_10_ms", 0.2, 1200},
                                         PathCase{"blocks_of_a_second", 20, 1200},
                                         PathCase{"one_long_move", 20'000, 12'000},
                                         PathCase{"one_slow_move", 400, 60}),
                         [](const auto& i) { return std::string(i.param.name); });

}  // namespace
}  // namespace dripline::machine::grbl::test
