#include <gtest/gtest.h>

#include "tests/unit/gateway/interpreter/dialects/rs274ngc/control_run.hpp"

/// Where program coordinates lie, as a screen shows it.
namespace dripline::interpreter::rs274ngc {
namespace {

constexpr std::string_view kLater = "[control]\nprofile = \"linuxcnc\"\n";

TEST(Rs274StatusWindow, ShowsSystemRotationAndG92) {
  ControlRun run("G21 F100\nG10 L2 P2 X100 Y50 Z-10 R90\nG55\nG92 X1 Y2 Z3\nG1 X3 Y4 Z5\nM2\n",
                 kLater);
  ASSERT_EQ(run.step(4), StepState::Ran);
  ASSERT_EQ(run.step(1), StepState::Ran);
  const CoordinateFrame frame = run.interpreter().frame().value();
  EXPECT_EQ(frame.datum[0], 100);
  EXPECT_EQ(frame.datum[2], -10);
  EXPECT_EQ(frame.rotation, 90);
  EXPECT_NEAR(frame.shift[2], 7, 1e-9) << "the tool stood at 10 above the system's zero";
  // X and Y of the event: program 3, 4 is 2, 2 from where it stood, turned by 90 degrees.
  const auto at = frame.to_program({-2, 2, 2});
  EXPECT_NEAR(at[0], 3, 1e-9);
  EXPECT_NEAR(at[1], 4, 1e-9);
  EXPECT_NEAR(at[2], 5, 1e-9);
}

TEST(Rs274StatusWindow, SaysWhenTheFrameHasChanged) {
  ControlRun run("G21 F100\nG1 X1\nX2\nG92 X0\nX3\nG55\nX4\nG92.1\nM2\n", kLater);
  std::vector<std::uint32_t> changes;
  for (int block = 0; block < 8; ++block) {
    ASSERT_EQ(run.step(1), StepState::Ran);
    changes.push_back(run.interpreter().modes().frame_changes);
  }
  EXPECT_EQ(changes[0], changes[2]) << "moves";
  EXPECT_NE(changes[2], changes[3]) << "G92";
  EXPECT_EQ(changes[3], changes[4]);
  EXPECT_NE(changes[4], changes[5]) << "G55";
  EXPECT_EQ(changes[5], changes[6]);
  EXPECT_NE(changes[6], changes[7]) << "G92.1";
}

}  // namespace
}  // namespace dripline::interpreter::rs274ngc
