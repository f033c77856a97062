#include <gtest/gtest.h>

#include "tests/unit/gateway/machine/grbl/grbl_shop.hpp"

namespace dripline::machine::grbl::test {
namespace {

class GrblOperator : public testing::Test {
 protected:
  void run(int blocks = 40) {
    shop.begin();
    for (int i = 1; i <= blocks; ++i) shop.program.line(i * 2, 0, 1200);
    shop.program.end();
    ASSERT_TRUE(shop.pass_until([&] { return shop.x() > 5; }));
  }
  void set(OperatorPanel panel) { shop.machine.set_panel(panel); }
  bool is_spindle_shown() const {
    return shop.machine.status().spindle.state != interpreter::SpindleState::Off;
  }
  double moved_in(double seconds) {
    const double before = shop.board.traveled();
    shop.pass(seconds);
    return shop.board.traveled() - before;
  }
  GrblShop shop;
};

TEST_F(GrblOperator, HoldStopsAndResumeContinues) {
  run();
  shop.machine.hold();
  EXPECT_EQ(shop.machine.state(), MachineState::Held);
  shop.pass(0.5);
  EXPECT_FALSE(shop.machine.is_moving());
  EXPECT_EQ(moved_in(5), 0);
  EXPECT_TRUE(shop.machine.resume());
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.machine.state(), MachineState::Completed);
  EXPECT_EQ(shop.recorder.blocks.size(), 41U);
  EXPECT_NEAR(shop.x(), 80, 1e-3);
}

TEST_F(GrblOperator, AResumeRightAfterAHoldIsNotLost) {
  run();
  shop.machine.hold();
  EXPECT_TRUE(shop.machine.resume());
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.machine.state(), MachineState::Completed);
}

TEST_F(GrblOperator, RepeatsAHoldThatWasLost) {
  run();
  shop.is_cut = true;
  shop.machine.hold();
  shop.pass(0.05);
  shop.is_cut = false;
  shop.pass(1);
  EXPECT_EQ(moved_in(2), 0);
}

TEST_F(GrblOperator, TheBoardsOwnHoldNeedsTheOperatorToo) {
  run();
  shop.board.press_hold();
  shop.pass(1);
  EXPECT_EQ(shop.machine.state(), MachineState::Held);
  EXPECT_EQ(moved_in(5), 0) << "never resumed by itself";
  EXPECT_TRUE(shop.machine.resume());
  EXPECT_TRUE(shop.pass_until_over());
}

TEST_F(GrblOperator, AbortKeepsThePosition) {
  run();
  shop.machine.abort();
  ASSERT_TRUE(shop.pass_until_over(5));
  EXPECT_EQ(shop.machine.state(), MachineState::Aborted);
  EXPECT_TRUE(shop.has("aborted"));
  shop.pass(1);
  EXPECT_EQ(moved_in(5), 0);
  EXPECT_NEAR(shop.x(), shop.board.position()[0], 1e-3);
  EXPECT_TRUE(shop.machine.check_begin(shop.machine.status().position)) << "no alarm of the board";
  EXPECT_EQ(shop.recorder.blocks.size(), shop.board.done.size());
}

TEST_F(GrblOperator, AnAbortCountsWhatTheAxesHavePassedAndNoMore) {
  for (const double after : {0.1, 0.93, 1.27, 2.0}) {
    GrblShop other;
    other.begin();
    other.program.line(3, 0, 1200);
    other.program.arc(3, 0, 0, 0, 360, 1200);
    for (int i = 0; i < 20; ++i) other.program.line(i % 2 == 0 ? 5 : 4, -0.3 * i, 1200);
    ASSERT_TRUE(other.pass_until([&] { return other.board.is_moving(); }));
    other.pass(after);
    other.machine.abort();
    ASSERT_TRUE(other.pass_until_over(5));
    constexpr std::size_t kCircle = 4;  // lines
    const std::size_t lines = other.board.done.size();
    const std::size_t blocks =
        lines > kCircle ? lines - kCircle + 1 : std::min<std::size_t>(lines, 1);
    EXPECT_EQ(other.recorder.blocks.size(), blocks) << after;
  }
}

TEST_F(GrblOperator, EmergencyStopEndsTheProgramWhenItIsReleased) {
  run();
  set({.emergency_stop = true});
  EXPECT_EQ(shop.machine.state(), MachineState::EmergencyStop);
  shop.pass(1);
  EXPECT_EQ(moved_in(5), 0);
  EXPECT_FALSE(shop.has("aborted"));
  EXPECT_FALSE(shop.machine.resume());
  set({});
  shop.pass(0.1);
  EXPECT_TRUE(shop.has("aborted"));
}

TEST_F(GrblOperator, NothingContinuesUnattendedAfterADoorWasOpen) {
  run();
  shop.machine.hold();
  shop.pass(0.5);
  EXPECT_TRUE(shop.machine.continue_unattended());
  EXPECT_GT(moved_in(1), 1);
  shop.machine.hold();
  shop.pass(0.5);
  shop.board.open_door();
  shop.pass(1);
  shop.board.close_door();
  shop.pass(0.5);
  EXPECT_FALSE(shop.machine.continue_unattended());
  EXPECT_EQ(moved_in(3), 0);
  EXPECT_TRUE(shop.machine.resume());
  EXPECT_GT(moved_in(1), 1);
}

TEST_F(GrblOperator, TheEmergencyStopReportsSpindleAndCoolantOffWhenTheBoardHasObeyed) {
  shop.begin();
  shop.program.spindle(1200);
  for (int i = 1; i <= 9; ++i) shop.program.line(i * 5, 0, 1200);
  ASSERT_TRUE(shop.pass_until([&] { return shop.x() > 5; }));
  shop.is_cut = true;
  set({.emergency_stop = true});
  shop.pass(0.3);
  EXPECT_TRUE(is_spindle_shown()) << "it has not heard it";
  EXPECT_EQ(std::ranges::count(shop.recorder.lines, "spindle"), 1);
  shop.is_cut = false;
  for (int i = 0; i < 5000 && is_spindle_shown(); ++i) {
    shop.pass(0.001);
    ASSERT_TRUE(is_spindle_shown() || !shop.board.is_spindle_on());
  }
  EXPECT_FALSE(is_spindle_shown());
  shop.pass(0.1);
  EXPECT_EQ(std::ranges::count(shop.recorder.lines, "spindle"), 2);
}

TEST_F(GrblOperator, AnAlarmShowsTheSpindleOffWhenTheBoardHasObeyed) {
  shop.begin();
  shop.program.spindle(1200);
  for (int i = 1; i <= 9; ++i) shop.program.line(i * 5, 0, 1200);
  ASSERT_TRUE(shop.pass_until([&] { return shop.x() > 5; }));
  shop.board.refuses_line = 1;
  ASSERT_TRUE(shop.pass_until([&] { return shop.machine.state() == MachineState::Alarmed; }));
  EXPECT_TRUE(is_spindle_shown());
  shop.is_polled = false;  // the run is over
  for (int i = 0; i < 5000 && is_spindle_shown(); ++i) {
    shop.pass(0.001);
    ASSERT_TRUE(is_spindle_shown() || !shop.board.is_spindle_on());
  }
  EXPECT_FALSE(is_spindle_shown());
}

TEST_F(GrblOperator, NothingBeginsBeforeWhatWasToldIsWritten) {
  shop.recorder.is_disk_full = true;
  shop.begin();
  shop.program.line(5, 0, 1200);
  shop.program.spindle(1200);
  shop.program.line(9, 0, 1200);
  shop.program.end();
  EXPECT_EQ(moved_in(3), 0);
  shop.recorder.is_disk_full = false;
  ASSERT_TRUE(shop.pass_until([&] { return shop.x() > 1; }));
  shop.recorder.is_disk_full = true;
  shop.pass(3);
  EXPECT_NEAR(shop.x(), 5, 1e-3);
  EXPECT_FALSE(shop.board.is_spindle_on());
  shop.recorder.is_disk_full = false;
  ASSERT_TRUE(shop.pass_until_over(10));
  EXPECT_EQ(shop.machine.state(), MachineState::Completed) << shop.alarm();
}

TEST_F(GrblOperator, SingleBlockStopsAfterEveryBlock) {
  set({.single_block = true});
  shop.begin();
  for (int i = 1; i <= 3; ++i) shop.program.line(i, 0, 1200);
  shop.program.end();
  for (std::size_t i = 1; i <= 3; ++i) {
    ASSERT_TRUE(
        shop.pass_until([&] { return shop.machine.state() == MachineState::SingleBlock; }, 5));
    EXPECT_EQ(shop.recorder.blocks.size(), i);
    EXPECT_EQ(moved_in(1), 0);
    EXPECT_NEAR(shop.x(), static_cast<double>(i), 1e-3);
    EXPECT_TRUE(shop.machine.resume());
  }
  EXPECT_TRUE(shop.pass_until_over());
}

TEST_F(GrblOperator, AProgramStopWaitsForResume) {
  shop.begin();
  shop.program.line(1, 0, 1200);
  shop.program.stop();
  shop.program.line(2, 0, 1200);
  shop.program.end();
  ASSERT_TRUE(shop.pass_until([&] { return shop.machine.state() == MachineState::ProgramStop; }));
  EXPECT_EQ(moved_in(2), 0);
  EXPECT_TRUE(shop.machine.resume());
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.machine.state(), MachineState::Completed);
}

TEST_F(GrblOperator, AnOpenDoorHoldsAndItsClosingStartsNothing) {
  run();
  shop.board.open_door();
  shop.pass(1);
  EXPECT_EQ(shop.machine.state(), MachineState::Held);
  EXPECT_FALSE(shop.machine.resume()) << "the door is open";
  shop.board.close_door();
  EXPECT_EQ(moved_in(3), 0);
  EXPECT_TRUE(shop.machine.resume());
  ASSERT_TRUE(shop.pass_until_over());
  EXPECT_EQ(shop.machine.state(), MachineState::Completed);
}

TEST_F(GrblOperator, NeitherHomesNorUnlocksDuringAProgram) {
  run();
  EXPECT_FALSE(shop.machine.home());
  EXPECT_FALSE(shop.machine.unlock());
}

TEST_F(GrblOperator, NothingBeginsWithoutTheOwnersLeave) {
  shop.begin();
  shop.program.line(5, 0, 1200);
  shop.is_polled = false;
  for (int i = 0; i < 100; ++i) {
    (void)shop.machine.poll(Seconds{0.01}, 0);
    shop.pass(0.01);
  }
  EXPECT_EQ(shop.board.traveled(), 0);
  shop.is_polled = true;
  EXPECT_TRUE(shop.pass_until([&] { return shop.x() > 4.9; }));
}

}  // namespace
}  // namespace dripline::machine::grbl::test
