// F and a change of units: LinuxCNC by itself goes as fast as our interpreter says it does.
#include <gtest/gtest.h>
#include <map>

#include "tests/integration/linuxcnc/linuxcnc_itself.hpp"
#include "tests/integration/linuxcnc/program_path.hpp"

namespace dripline::integration {
namespace {

using interpreter::StepState;

constexpr const char* kProgram =
    "G21 G90 G94 G61 F600\nG1 X5\nG20\nX0\nF30 X0.3\nG21 X0\nG20 F300 X0.1\nX0\nF40 X0.3\n"
    "G21 F20 X0\nM70\nG20\nF50\nX0.3\nM72\nX0\nM2\n";

/// Millimeters per minute, by line.
class Feeds final : public interpreter::EventSink {
 public:
  void on_line(const interpreter::Line& event) override {
    by_line[static_cast<long>(event.origin.line)] = event.feed.length().mm();
  }
  std::map<long, double> by_line;
};

/// Millimeters per minute: half of the samples, 1 ms apart, are farther from the one before.
double speed_of(const std::vector<LinuxCnc::Sample>& samples, long line) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < samples.size(); ++i)
    if (samples[i].line == line && samples[i - 1].line == line)
      steps.push_back(distance(samples[i].at, samples[i - 1].at));
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::ranges::nth_element(steps, middle);
  return *middle * 60'000;
}

using LinuxCncFeeds = LinuxCncPrograms;

TEST_F(LinuxCncFeeds, StayTheSameSpeedOverAChangeOfUnits) {
  Feeds feeds;
  interpreter::MemorySource source(kProgram);
  const auto ours = interpret(source, feeds);
  ASSERT_NE(ours, nullptr);
  while (ours->step(1) == StepState::Ran) {
  }
  ASSERT_EQ(feeds.by_line.size(), 10U);
  LinuxCncItself itself(linuxcnc->ini());
  const auto samples = path_of([&] { itself.run(kProgram); });
  for (const auto& [line, feed] : feeds.by_line)
    EXPECT_NEAR(speed_of(samples, line), feed, feed / 50) << "line " << line;
}

}  // namespace
}  // namespace dripline::integration
