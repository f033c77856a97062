// Lengths of tools: LinuxCNC by itself, with its own tool table, and our interpreter with
// LinuxCNC's motion, both bring the axes along the path that our interpreter and its lengths make
// of the text.
#include <gtest/gtest.h>
#include <fstream>
#include <random>

#include "tests/integration/linuxcnc/program_path.hpp"

namespace dripline::integration {
namespace {

using interpreter::StepState;

constexpr const char* kTable =
    "T1 P1 Z50.5 D10\nT2 P2 Z80 D6\nT3 P3 X4.25 Z-12.5 D5\nT4 P4 Z0 D1\n";
constexpr const char* kTools =
    "[[tool]]\nnumber = 1\nlength = 50.5\n[[tool]]\nnumber = 2\nlength = 80.0\n"
    "[[tool]]\nnumber = 3\nX = 4.25\nZ = -12.5\n[[tool]]\nnumber = 4\n";

class LinuxCncLengths : public LinuxCncPrograms {
 protected:
  LinuxCncLengths() {
    tools = kTools;
    table = kTable;
  }

  /// The path of the axes by our interpreter and its lengths.
  void expect(const std::string& text, Path& path) const {
    std::unique_ptr<interpreter::Interpreter> ours;
    machine::MotionCapabilities all = machine->capabilities();
    machine::CapabilityFilter filter(
        all, path,
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
    if (!itself) itself.emplace(linuxcnc->ini());
    auto samples = path_of([&] { itself->run(text); });
    EXPECT_EQ(path.difference(samples), "") << "LinuxCNC by itself";
    EXPECT_EQ(path.difference(path_of([&] { run(text); })), "") << "our interpreter";
    EXPECT_TRUE(notices_a_twentieth(path, samples));
    EXPECT_GT(samples.size(), 100U);
  }

  std::optional<LinuxCncItself> itself;
};

constexpr const char* kBegin = "G21 G90 G17 G94 G40 G49 G80 G61 G98 F9000\n";
constexpr const char* kEnd = "G17 G90 G49 G80\nG0 X0 Y0 Z0\nM2\n";

TEST_F(LinuxCncLengths, AreInTheAxesAsLinuxCncHasThemThere) {
  compare(std::string(kBegin) +
          "G0 Z20\nG43 H1\nX12\nZ5\nG1 Y7 Z-3\nG2 X2 Y7 I-5 J0 Z-6\nG43 H2\nG1 X3\nZ1\n"
          "G18 G3 X13 Z1 I5 K0\nG17 G49\nG1 X0\nZ4\nG43 H3\nG0 X1\nG1 Y2\nX-8 Z30\n" +
          kEnd);
}

TEST_F(LinuxCncLengths, AreInMachineCoordinatesCyclesAndOffsets) {
  compare(std::string(kBegin) +
          "G43 H2\nG0 Z10\nG53 G0 Z120\nG53 X6\nG0 Z12\nG81 X3 Y4 Z-2 R3 F6000\nX9\nG80\nG28 Z15\n"
          "G43.2 H1\nG0 Z-8\nG43.1 X2 Z33\nG0 X5 Z-4\nG92 Z7\nG1 Z2 F9000\nG92.1\nG0 Z-2\n" +
          kEnd);
}

// Lengths lie along the machine's axes, whatever the coordinate system.
TEST_F(LinuxCncLengths, AreAddedAfterTheRotation) {
  compare(std::string(kBegin) +
          "G10 L2 P1 X3 Y-4 Z-25 R30\nG54\nG43 H3\nG1 X8 Y2 Z6\nY-5\nG43 H1\nG1 X-2\nZ3\nG91 G2 "
          "X-4 Y0 I-2 J0\nG90 G10 L2 P1 X0 Y0 Z0 R0\n" +
          kEnd);
}

TEST_F(LinuxCncLengths, OfGeneratedProgramsAreTheSame) {
  std::mt19937_64 random(20'261'128);
  const auto below = [&](int limit) {
    return std::uniform_int_distribution<>(0, limit - 1)(random);
  };
  const auto between = [&](int low, int high) {
    return low + static_cast<double>(below((high - low) * 100)) / 100;
  };
  for (int i = 0; i < 3 && !HasFailure(); ++i) {
    std::string text = kBegin;
    for (int part = 0; part < 14; ++part) {
      static constexpr std::array kLengths{"G43 H1", "G43 H2",          "G43 H3",
                                           "G49",    "G43.1 X-3 Z21.5", "G43.2 H3"};
      if (below(2) == 0) text += std::string(kLengths[static_cast<std::size_t>(below(6))]) + "\n";
      switch (below(4)) {
        case 0:
          text += fmt::format("G0 X{:.2f}\n", between(-9, 9));
          break;
        case 1:
          text += fmt::format("G1 X{:.2f} Y{:.2f} Z{:.2f}\n", between(-9, 9), between(-9, 9),
                              between(-20, 20));
          break;
        case 2:
          text += fmt::format("G91 G1 Y{:.2f} Z{:.2f}\nG90\n", between(-4, 4), between(-3, 3));
          break;
        default:
          text += fmt::format("G91 G3 X0 Y0 I{:.2f} J{:.2f} Z{:.2f}\nG90\n", between(1, 5),
                              between(1, 5), between(-2, 2));
      }
    }
    compare(text + kEnd);
  }
}

}  // namespace
}  // namespace dripline::integration
