// Blocks per second through the FIFO of our back end, beside LinuxCNC that reads the same moves
// from a file by itself: the same LinuxCNC in the same run. One JSON object per figure; the other
// lines are LinuxCNC's and gtest's. DRIPLINE_BLOCKS changes how many.
#include <cmath>
#include <cstdlib>

#include "tests/integration/linuxcnc/linuxcnc_itself.hpp"
#include "tests/integration/linuxcnc/linuxcnc_shop.hpp"

namespace dripline::integration {
namespace {

using Clock = std::chrono::steady_clock;

int blocks() {
  const char* wanted = std::getenv("DRIPLINE_BLOCKS");
  return wanted != nullptr ? std::atoi(wanted) : 6'000;
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Around a circle of 20 mm again and again, a point at each `step`.
struct Case {
  const char* name;
  double step, feed;
  int share;  ///< of the blocks
};
std::pair<double, double> point(const Case& given, int i) {
  const double angle = given.step / 20 * i;
  return {20 * std::sin(angle), 20 - 20 * std::cos(angle)};
}

class LinuxCncRate : public LinuxCncTest {
 protected:
  void go_back() {
    begin();
    program->rapid(0, 0);
    program->end();
    ASSERT_TRUE(wait_over());
    runs = false;
  }
  double its_own(LinuxCncItself& itself, const Case& given, int count) {
    std::string text = fmt::format("G21 G90 G17 G94 G61 F{}\n", given.feed);
    for (int i = 1; i <= count; ++i)
      text += fmt::format("G1X{:.6f}Y{:.6f}\n", point(given, i).first, point(given, i).second);
    text += "M2\n";
    const auto start = Clock::now();
    itself.run(text, std::chrono::seconds(300));
    return count / seconds_since(start);
  }
  double ours(const Case& given, int count) {
    begin();
    int fed = 0;
    const auto start = Clock::now();
    while (!is_over() && seconds_since(start) < 300) {
      for (; fed < count && machine->has_room(); ++fed) feed_block(given, fed + 1);
      if (fed == count) {
        program->end();
        ++fed;
      }
      (void)machine->poll(Seconds{0}, 512);
      // As the gateway's loop: in real time the next turn is 10 ms later.
      std::this_thread::sleep_for(10ms);
    }
    EXPECT_EQ(machine->state(), MachineState::Completed) << alarm();
    EXPECT_GE(recorder.blocks.size(), static_cast<std::size_t>(count));
    runs = false;
    return count / seconds_since(start);
  }
  void feed_block(const Case& given, int i) {
    interpreter::Line line;
    line.origin = program->begin_block();
    line.to.set(interpreter::Axis::X, Length::mm(point(given, i).first));
    line.to.set(interpreter::Axis::Y, Length::mm(point(given, i).second));
    line.feed = Feed::per_minute(Length::mm(given.feed));
    machine->events().on_line(line);
    program->end_block();
  }
};

TEST_F(LinuxCncRate, BesideItself) {
  LinuxCncItself itself(linuxcnc->ini());
  for (const Case& given :
       {Case{"blocks of 0.05 mm", 0.05, 6000, 1}, Case{"blocks of 0.2 mm", 0.2, 6000, 30},
        Case{"blocks of 2 mm", 2, 6000, 60}}) {
    constexpr int kFewest = 50;  // fewer show nothing
    const int count = std::max(kFewest, blocks() / given.share);
    double alone = 0, fed = 0;  // the better of three: the machine has other work
    for (int i = 0; i < 3 && !HasFailure(); ++i) {
      go_back();
      alone = std::max(alone, its_own(itself, given, count));
      go_back();
      fed = std::max(fed, ours(given, count));
    }
    std::printf(
        "\n{\"name\":\"%s\",\"blocks_per_second\":%.0f,\"linuxcnc_itself\":%.0f,\"ratio\":%.3f}\n",
        given.name, fed, alone, fed / alone);
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace dripline::integration
