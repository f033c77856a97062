// A LinuxCNC whose unit is the inch: its own files, positions and speeds are in inches, whatever
// its programs and ours count in.
#include <gtest/gtest.h>

#include "tests/integration/linuxcnc/program_path.hpp"

namespace dripline::integration {
namespace {

using interpreter::StepState;

class LinuxCncInches : public LinuxCncPrograms {
 protected:
  LinuxCncInches() {
    head = "units = \"in\"\n";
    tools = "[[tool]]\nnumber = 1\nlength = 1.5\n";
    table = "T1 P1 Z1.5 D0.25\n";
  }
  void prepare() override { linuxcnc->count_in_inches(); }

  /// In millimeters.
  std::vector<LinuxCnc::Sample> metric_path_of(const std::function<void()>& execute) {
    auto samples = path_of(execute);
    for (auto& sample : samples)
      for (double& value : sample.at) value *= Length::kMillimetersPerInch;
    return samples;
  }
  void expect(const std::string& text, Path& path) const {
    std::unique_ptr<interpreter::Interpreter> ours;
    machine::CapabilityFilter filter(
        machine->capabilities(), path,
        [&] {
          return machine::CapabilityFilter::Now{ours->modes(), ours->origin().block};
        },
        {.shifts = true, .is_certain = true, .set = [&](const machine::ToolLengths& lengths) {
           path.set_lengths(lengths);
         }});
    filter.begin({}, {});
    interpreter::MemorySource source(text);
    ours = interpret(source, filter);
    ASSERT_NE(ours, nullptr);
    while (ours->step(1) == StepState::Ran) {
    }
    ASSERT_EQ(path.alarm, "");
  }
  void compare(const std::string& text) {
    SCOPED_TRACE(text);
    Path path;
    expect(text, path);
    if (HasFailure()) return;
    LinuxCncItself itself(linuxcnc->ini());
    EXPECT_EQ(path.difference(metric_path_of([&] { itself.run(text); })), "")
        << "LinuxCNC by itself";
    EXPECT_EQ(path.difference(metric_path_of([&] { run(text); })), "") << "our interpreter";
  }
};

TEST_F(LinuxCncInches, AreThoseOfProgramsOffsetsLengthsAndArcs) {
  compare(
      "G90 G17 G94 G40 G49 G80 G61 F300\nG1 X0.75\nG20 G10 L2 P2 X1 Y-0.5 Z0.25 R30\n"
      "G55 G1 X0.5 Y0.25 Z0.1\nG21\nG1 X20 Y10 F8000\nG2 X30 Y10 I5 J0\nG3 X20 Y0 R10\n"
      "G10 L2 P2 R0\nG20 G43 H1\nG1 Z0.5\nG28.1\nG1 X1 Y1\nG21 G28 Z10\nG53 G0 Z30\nG92 X5\n"
      "G1 X6\nG92.1\nG91 G1 X2 Y2\nG20 G90 G49 G54\nG10 L2 P2 X0 Y0 Z0\nG0 X0 Y0 Z0\nM2\n");
}

TEST_F(LinuxCncInches, AreThoseOfAContact) {
  begin();
  program->line(0, -2500, 90'000);
  machine->begin_probe({.origin = program->begin_block(),
                        .from = {},
                        .to = machine::test::Program::at(0, -2600),
                        .feed = Feed::per_minute(Length::mm(6000)),
                        .result = {}});
  ASSERT_TRUE(wait([&] { return !recorder.probes.empty() || is_over(); })) << alarm();
  ASSERT_EQ(recorder.probes.size(), 1U) << alarm();
  const auto result = recorder.probes.front().result;
  EXPECT_TRUE(result->tripped);
  EXPECT_NEAR(result->at.raw(interpreter::Axis::Z), -2540, 0.3) << "100 inches";
  program->end_block();
  program->end();
  ASSERT_TRUE(wait_over());
  EXPECT_EQ(machine->state(), MachineState::Completed) << alarm();
}

}  // namespace
}  // namespace dripline::integration
