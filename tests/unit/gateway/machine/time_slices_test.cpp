#include <gtest/gtest.h>
#include <random>

#include "tests/unit/gateway/machine/test_machine.hpp"

namespace dripline::machine::test {
namespace {

/// A program of everything that takes time or is reported, different for each seed.
class RandomProgram {
 public:
  explicit RandomProgram(unsigned seed) : random_(seed) {}

  /// Queues one block; false when the program has ended.
  bool next(Program& program) {
    if (blocks_ == kBlocks) return false;
    ++blocks_;
    if (blocks_ == 1)
      program.spindle(600);
    else if (blocks_ == kBlocks)
      program.end();
    else
      any_block(program);
    return true;
  }

 private:
  static constexpr int kBlocks = 300;

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  void any_block(Program& program) {
    const double step = random_() % 2 == 0 ? 0.05 : 5;
    switch (random_() % 9) {
      case 0:
        return program.output(fmt::format("line {}", blocks_));
      case 1:
        return program.dwell(between(0, 0.1));
      case 2:
        x_ += between(-step, step);
        return program.rapid(x_, z_);
      case 3:
        z_ += between(-step, step);
        return program.line(x_, z_, Feed::per_revolution(Length::mm(0.2)));
      case 4: {  // a half circle
        const double radius = between(0.1, step);
        const double center = z_ + radius;
        z_ += 2 * radius;
        return program.arc(x_, z_, center, x_, 180, between(100, 3000));
      }
      case 5:
        z_ -= step;
        return program.thread(x_, z_, 1.5);
      default:
        x_ += between(-step, step);
        z_ += between(-step, step);
        return program.line(x_, z_, between(100, 3000));
    }
  }

  std::mt19937 random_;
  int blocks_ = 0;
  double x_ = 0, z_ = 0;
};

void queue_random_program(TestMachine& test, unsigned seed) {
  RandomProgram program(seed);
  while (program.next(test.program)) {
  }
}

TEST(TimeSlices, AnySlicingGivesTheSameOrderAndTheSameTotal) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    TestMachine whole, sliced;
    queue_random_program(whole, seed);
    queue_random_program(sliced, seed);
    const double total = whole.run_all();
    std::mt19937 random(seed);
    std::exponential_distribution<double> slice(1 / (total / 2000));
    double sum = 0;
    while (sliced.machine.state() == MachineState::Running)
      sum += sliced.machine.poll(Seconds{slice(random)}).count();
    EXPECT_EQ(sliced.recorder.lines, whole.recorder.lines) << seed;
    EXPECT_EQ(whole.recorder.lines.back(), "end");
    EXPECT_NEAR(sum, total, total * 1e-9) << seed;
    EXPECT_EQ(sliced.x(), whole.x());
    EXPECT_EQ(sliced.z(), whole.z());
  }
}

TEST(TimeSlices, SmallStepsPassThroughTheSamePlaces) {
  TestMachine coarse, fine;
  queue_random_program(coarse, 7);
  queue_random_program(fine, 7);
  for (int second = 0; second < 20; ++second) {
    coarse.machine.poll(Seconds{1});
    for (int i = 0; i < 1024; ++i) fine.machine.poll(Seconds{1.0 / 1024});
    EXPECT_NEAR(coarse.x(), fine.x(), 1e-7);
    EXPECT_NEAR(coarse.z(), fine.z(), 1e-7);
    EXPECT_EQ(coarse.recorder.blocks, fine.recorder.blocks);
  }
}

TEST(TimeSlices, HoldingAnywhereLosesNothing) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    TestMachine plain, held;
    queue_random_program(plain, seed);
    queue_random_program(held, seed);
    plain.run_all();
    std::mt19937 random(seed);
    std::exponential_distribution<double> slice(2);
    while (held.machine.state() != MachineState::Completed) {
      held.machine.poll(Seconds{slice(random)});
      held.machine.hold();
      held.machine.poll(Seconds{slice(random) / 20});  // often still slowing down
      held.machine.resume();
    }
    EXPECT_EQ(held.recorder.lines, plain.recorder.lines) << seed;
    EXPECT_EQ(held.x(), plain.x());
    EXPECT_EQ(held.z(), plain.z());
  }
}

TEST(TimeSlices, AnyOperatorAndAnyFeedOfBlocksGiveTheSameExecution) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    TestMachine plain, disturbed;
    queue_random_program(plain, seed);
    plain.run_all();
    RandomProgram program(seed);
    std::mt19937 random(seed);
    std::exponential_distribution<double> slice(5);
    while (disturbed.machine.state() != MachineState::Completed) {
      for (auto blocks = random() % 6; blocks > 0; --blocks) program.next(disturbed.program);
      OperatorPanel panel;
      panel.single_block = random() % 4 == 0;
      panel.feed_override = static_cast<double>(random() % 21) / 10;
      panel.rapid_override = static_cast<double>(random() % 11) / 10;
      if (random() % 2 == 0) disturbed.machine.set_panel(panel);
      if (random() % 4 == 0) disturbed.machine.hold();
      const double used = disturbed.machine.poll(Seconds{slice(random)}, random() % 9).count();
      ASSERT_GE(used, 0);
      if (random() % 2 == 0) disturbed.machine.resume();
    }
    EXPECT_EQ(disturbed.recorder.lines, plain.recorder.lines) << seed;
    EXPECT_EQ(disturbed.x(), plain.x());
    EXPECT_EQ(disturbed.z(), plain.z());
  }
}

TEST(TimeSlices, SpeedNeverJumpsByMoreThanTheAccelerationAllows) {
  TestMachine test;
  queue_random_program(test, 11);
  std::mt19937 random(11);
  const double step = 0.0005;
  double last = 0;
  for (int i = 0; test.machine.state() == MachineState::Running; ++i) {
    if (i % 400 == 0) {
      OperatorPanel panel = test.machine.panel();
      panel.feed_override = std::uniform_real_distribution<double>(0.2, 2)(random);
      panel.rapid_override = std::uniform_real_distribution<double>(0.2, 1)(random);
      test.machine.set_panel(panel);
    }
    test.machine.poll(Seconds{step});
    const double now = test.machine.status().feed_per_minute / 60;
    // 1000 mm/s^2 an axis: at most sqrt(2) of it along a diagonal.
    ASSERT_LE(std::fabs(now - last), 1000 * std::sqrt(2) * step + 1e-3) << i;
    last = now;
  }
}

}  // namespace
}  // namespace dripline::machine::test
