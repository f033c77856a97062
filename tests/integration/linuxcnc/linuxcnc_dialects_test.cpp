// One program of each control: what LinuxCNC's motors do is what the simulated machine does.
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/core/program_source.hpp"
#include "tests/integration/linuxcnc/linuxcnc_shop.hpp"
#include "tests/support/dialect_programs.hpp"

namespace dripline::integration {
namespace {

using interpreter::StepState;
using test_support::BlockEnds;

template <class A, class B>
double distance(const A& a, const B& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// The straight line between two samples, a millisecond apart, meets the point.
template <class Point>
bool passes(const LinuxCnc::Sample& from, const LinuxCnc::Sample& to, const Point& point) {
  double part = 0;
  for (std::size_t i = 0; i < 3; ++i) part += (point[i] - from.at[i]) * (to.at[i] - from.at[i]);
  const double length = distance(from.at, to.at);
  part = length > 0 ? std::clamp(part / (length * length), 0.0, 1.0) : 0;
  std::array<double, 3> nearest{};
  for (std::size_t i = 0; i < 3; ++i) nearest[i] = from.at[i] + (to.at[i] - from.at[i]) * part;
  return distance(nearest, point) < 0.001;
}

class LinuxCncDialects : public LinuxCncTest, public testing::WithParamInterface<std::size_t> {};

TEST_P(LinuxCncDialects, EndEveryBlockWhereTheSimulatedMachineDoes) {
  const auto& text = test_support::dialect_programs()[GetParam()];
  const BlockEnds expected = test_support::simulated_ends(text);
  const auto dialect = interpreter::find_dialect(text.control);
  ASSERT_TRUE(dialect);
  begin();
  interpreter::MemorySource source(text.text);
  auto made = (*dialect)->make({}, source, machine->events());
  ASSERT_TRUE(made) << made.error().what;
  bool is_read = false;
  ASSERT_TRUE(wait([&] {
    while (!is_read && machine->has_room()) is_read = (*made)->step(1) != StepState::Ran;
    if (machine->state() == MachineState::ProgramStop) (void)machine->resume();
    return is_over();
  })) << machine->status().executed;
  EXPECT_EQ(machine->state(), MachineState::Completed) << alarm();
  EXPECT_EQ(recorder.blocks.size(), expected.size());
  ASSERT_TRUE(wait([&] { return linuxcnc->rests(); }));
  const auto samples = linuxcnc->samples();
  auto at = samples.begin() + 1;
  for (const auto& [block, end] : expected) {
    at = std::find_if(at, samples.end(), [&, &point = end](const auto& sample) {
      return passes(*(&sample - 1), sample, point);
    });
    ASSERT_NE(at, samples.end()) << "the axes did not pass the end of block " << block;
  }
  EXPECT_LT(distance(linuxcnc->position(), expected.rbegin()->second), 0.001);
}

INSTANTIATE_TEST_SUITE_P(, LinuxCncDialects, testing::Range<std::size_t>(0, 6), [](const auto& i) {
  std::string name(test_support::dialect_programs()[i.param].control);
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace dripline::integration
