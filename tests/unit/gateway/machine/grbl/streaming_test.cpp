#include <gtest/gtest.h>

#include "gateway/machine/grbl/character_counter.hpp"
#include "gateway/machine/grbl/execution_tracker.hpp"

namespace dripline::machine::grbl {
namespace {

TEST(CharacterCounter, NeverHasMoreUnansweredThanTheBufferHolds) {
  CharacterCounter counter;
  counter.set_window(20);
  std::string line;
  EXPECT_TRUE(counter.fits(10));
  counter.sent("123456789\n");
  EXPECT_TRUE(counter.fits(10));
  counter.sent("abcdefghi\n");
  EXPECT_FALSE(counter.fits(1));
  ASSERT_TRUE(counter.answered(line));
  EXPECT_EQ(line, "123456789\n") << "the oldest";
  EXPECT_TRUE(counter.fits(10));
  EXPECT_TRUE(counter.answered(line));
  EXPECT_FALSE(counter.answered(line)) << "an answer to nothing";
  counter.sent("x\n");
  counter.reset();
  EXPECT_EQ(counter.unanswered_bytes(), 0U);
}

StatusReport report(BoardState state, std::optional<std::uint32_t> line = {},
                    std::optional<int> free = {}) {
  StatusReport report;
  report.state = state;
  report.line = line;
  if (free) report.buffers = {*free, 100};
  return report;
}

class Tracker : public testing::Test {
 protected:
  void send(int lines, int answered) {
    for (int i = 0; i < lines; ++i) (void)tracker.sent(true);
    for (int i = 0; i < answered; ++i) tracker.answered();
  }
  /// 100 ms after the one before.
  bool see(const StatusReport& seen) {
    return tracker.reported(seen, now += std::chrono::milliseconds(100));
  }
  ExecutionTracker tracker;
  SteadyTime now{};
};

TEST_F(Tracker, TakesNoAnswerForExecution) {
  send(3, 3);
  EXPECT_EQ(tracker.executed(), 0U);
  EXPECT_FALSE(tracker.is_empty());
}

TEST_F(Tracker, BelievesALineNumberSomeTimeLater) {
  send(5, 5);
  EXPECT_TRUE(see(report(BoardState::Run, 3)));
  EXPECT_TRUE(see(report(BoardState::Run, 3)));
  EXPECT_EQ(tracker.executed(), 0U) << "the axes may still do line 2";
  EXPECT_TRUE(see(report(BoardState::Run, 3)));
  EXPECT_EQ(tracker.executed(), 2U);
  EXPECT_TRUE(see(report(BoardState::Run, 5)));
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(see(report(BoardState::Hold, 5)));
  EXPECT_EQ(tracker.executed(), 2U) << "held before the axes got there";
}

TEST_F(Tracker, LeavesTheLastLineToTheReportAtRest) {
  send(2, 2);
  (void)see(report(BoardState::Run, 2));
  for (int i = 0; i < 5; ++i) (void)see(report(BoardState::Run));
  EXPECT_EQ(tracker.executed(), 1U) << "the planner is empty, the axes are not there yet";
  (void)see(report(BoardState::Idle));
  EXPECT_TRUE(tracker.is_empty());
}

TEST_F(Tracker, KnowsThatAllIsDoneAtRestWithEveryAnswer) {
  send(2, 1);
  (void)see(report(BoardState::Run, 1));
  (void)see(report(BoardState::Idle));
  EXPECT_EQ(tracker.executed(), 0U) << "the second line is not answered";
  tracker.answered();
  (void)see(report(BoardState::Idle, 2));
  EXPECT_EQ(tracker.executed(), 0U) << "line 2 is planned, and has not started";
  (void)see(report(BoardState::Idle));
  EXPECT_TRUE(tracker.is_empty());
}

TEST_F(Tracker, IsNotMisledByABoardThatNamesItsLastLineAtRest) {
  tracker.set_capacity(15);
  send(2, 2);
  (void)see(report(BoardState::Idle, 2, 14));
  EXPECT_FALSE(tracker.is_empty());
  (void)see(report(BoardState::Idle, 2, 15));
  EXPECT_TRUE(tracker.is_empty());
  send(1, 1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(tracker.is_empty()) << "without buffers";
    (void)see(report(BoardState::Idle, 3));
  }
  EXPECT_TRUE(tracker.is_empty());
}

TEST_F(Tracker, CountsByBuffersWhereThereAreNoLineNumbers) {
  tracker.set_capacity(15);
  send(6, 5);
  for (int i = 0; i < 3; ++i) (void)see(report(BoardState::Run, {}, 12));
  EXPECT_EQ(tracker.executed(), 2U) << "of 5 planned, 3 are left at most";
  tracker.answered();
  (void)see(report(BoardState::Idle, {}, 14));
  EXPECT_FALSE(tracker.is_empty());
  (void)see(report(BoardState::Idle, {}, 15));
  EXPECT_TRUE(tracker.is_empty());
}

TEST_F(Tracker, NeedsTwoReportsAtRestWithoutAnyEvidence) {
  send(1, 1);
  (void)see(report(BoardState::Idle));
  EXPECT_FALSE(tracker.is_empty()) << "the motion may be about to start";
  (void)see(report(BoardState::Idle));
  EXPECT_TRUE(tracker.is_empty());
}

TEST_F(Tracker, RefusesALineThatWasNeverSent) {
  send(3, 3);
  EXPECT_FALSE(see(report(BoardState::Run, 4)));
  EXPECT_FALSE(see(report(BoardState::Run, 0)));
  EXPECT_TRUE(see(report(BoardState::Run, 1)));
}

TEST_F(Tracker, CountsOnWhereTheNumbersBeginAgain) {
  constexpr std::uint32_t kNumbers = 99;
  tracker.set_numbers(kNumbers);
  EXPECT_EQ(tracker.number_of(kNumbers), kNumbers);
  EXPECT_EQ(tracker.number_of(kNumbers + 1), 1U);
  for (std::uint32_t i = 0; i < kNumbers - 1; ++i) {
    send(1, 1);
    if (i % 8 == 7) (void)see(report(BoardState::Run, tracker.number_of(tracker.sent())));
  }
  (void)see(report(BoardState::Idle));
  ASSERT_TRUE(tracker.is_empty());
  send(3, 3);  // 99, 1, 2
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(see(report(BoardState::Run, 2)));
  EXPECT_EQ(tracker.sent() - tracker.executed(), 1U);
}

}  // namespace
}  // namespace dripline::machine::grbl
