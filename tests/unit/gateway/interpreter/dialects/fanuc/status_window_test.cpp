#include <gtest/gtest.h>
#include <charconv>
#include <cmath>

#include "tests/unit/gateway/interpreter/dialects/fanuc/program_run.hpp"

/// Where program coordinates lie, as the screen shows it.
namespace dripline::interpreter::fanuc {
namespace {

/// After every block of `text`, one a line.
std::unique_ptr<ProgramRun> after(const std::string& text) {
  auto run = std::make_unique<ProgramRun>(text + "M30\n");
  for (const char c : text) {
    if (c != '\n') continue;
    EXPECT_EQ(run->step(1), StepState::Ran) << run->alarm();
  }
  return run;
}

CoordinateFrame frame_after(const std::string& text) {
  return after(text)->interpreter().frame().value();
}

TEST(FanucStatusWindow, ShowsWorkOffsetAndWhatTheProgramAdds) {
  const CoordinateFrame frame = frame_after("G21 G90\nG10 L2 P2 X100. Y50. Z-10.\nG55\nG52 X5.\n");
  EXPECT_EQ(frame.datum[0], 100);
  EXPECT_EQ(frame.datum[2], -10);
  EXPECT_EQ(frame.shift[0], 5);
  EXPECT_EQ(frame.to_program({108, 54, 0})[0], 3);
  EXPECT_EQ(frame.to_program({108, 54, 0})[1], 4);
  EXPECT_EQ(frame.to_program({108, 54, 0})[2], 10);
}

TEST(FanucStatusWindow, ShowsScalingMirrorImageAndRotation) {
  const CoordinateFrame frame =
      frame_after("G21 G90 G54\nG10 L2 P1 X100.\nG51 X10. Y0 Z0 I-2. J2. K1.\nG68 X0 Y0 R90.\n");
  EXPECT_EQ(frame.scale[0], 2);
  EXPECT_EQ(frame.scale[2], 1);
  EXPECT_EQ(frame.mirrored, (std::array<bool, 3>{true, false, false}));
  EXPECT_NEAR(std::abs(frame.rotation), 90, 1e-9);
}

/// The machine's own place, back in the program's words.
TEST(FanucStatusWindow, KnowsProgramCoordinatesUnderATransformation) {
  const auto run = after(
      "G21 G90 G54\nG10 L2 P1 X100. Y7.\nG51 X10. Y0 Z0 I2. J2. K1.\nG68 X1. Y2. R30.\n"
      "G1 F100. X3. Y4. Z5.\n");
  CoordinateFrame::Values machine{};
  const std::string line = run->events("line").back();
  const auto number_after = [&line](char axis) {
    double number = 0;
    std::from_chars(line.data() + line.find(axis) + 1, line.data() + line.size(), number);
    return number;
  };
  machine[0] = number_after('X');
  machine[1] = number_after('Y');
  machine[2] = number_after('Z');
  EXPECT_GT(std::abs(machine[0] - 103), 1) << "nothing was transformed: " << line;
  const auto at = run->interpreter().frame()->to_program(machine);
  EXPECT_NEAR(at[0], 3, 1e-9);
  EXPECT_NEAR(at[1], 4, 1e-9);
  EXPECT_NEAR(at[2], 5, 1e-9);
}

TEST(FanucStatusWindow, SaysWhenTheFrameHasChanged) {
  ProgramRun run(
      "G21 G90 G54\nG1 F100. X1.\nX2.\nG52 X5.\nX3.\nG68 X0 Y0 R90.\nX4. Y0\nG69\nM30\n");
  std::vector<std::uint32_t> changes;
  for (int block = 0; block < 8; ++block) {
    run.step(1);
    changes.push_back(run.interpreter().modes().frame_changes);
  }
  EXPECT_EQ(changes[0], changes[2]) << "moves";
  EXPECT_NE(changes[2], changes[3]) << "G52";
  EXPECT_EQ(changes[3], changes[4]);
  EXPECT_NE(changes[4], changes[5]) << "G68";
  EXPECT_EQ(changes[5], changes[6]);
  EXPECT_NE(changes[6], changes[7]) << "G69";
}

}  // namespace
}  // namespace dripline::interpreter::fanuc
