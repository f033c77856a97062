#include <gtest/gtest.h>

#include "gateway/interpreter/core/setup.hpp"
#include "tests/unit/gateway/interpreter/dialects/centurion/program_run.hpp"

/// What the status window shows of the block executed last: CEN-228.
namespace dripline::interpreter::centurion {
namespace {

using ControlSetup = interpreter::Setup;

/// The modes after the last block of `text`.
ActiveModes after(const std::string& text, const ControlSetup& setup = {}) {
  ProgramRun run(text, setup);
  for (const char c : text) {
    if (c != '\n') continue;
    EXPECT_EQ(run.step(1), StepState::Ran) << run.alarm();
  }
  return run.interpreter().modes();
}

TEST(StatusWindow, ShowsTheModesInForce) {
  const ActiveModes modes = after("G20 G91 G57 G98 F12\nG41\n");
  EXPECT_EQ(modes.units, Units::Inch);
  EXPECT_TRUE(modes.is_incremental);
  EXPECT_EQ(modes.compensation, CompensationSide::Left);
  EXPECT_EQ(modes.work_system, 570);
  EXPECT_EQ(modes.feed, Feed::per_minute(Length::inch(12)));
  EXPECT_EQ(modes.cycle, "");
}

TEST(StatusWindow, ShowsTheActiveOffsetWithItsWear) {
  const auto setup = parse_setup(R"(
units = "mm"
[[tool]]
number = 5
X = 1.5
Z = 2.0
radius = 0.4
)",
                                 Units::Millimeter);
  ASSERT_TRUE(setup) << setup.error().what;
  ActiveModes modes = after("G21\nT0505M6\nG10\nP645=.25\nG11\n", *setup);
  EXPECT_NEAR(modes.tool_length_x.mm(), 1.75, 1e-9) << "P645 is the wear in X of offset 5";
  EXPECT_NEAR(modes.tool_length_z.mm(), 2, 1e-9);
  EXPECT_NEAR(modes.tool_radius.mm(), 0.4, 1e-9);
  modes = after("G21\nT0505M6\nG49\n", *setup);
  EXPECT_EQ(modes.tool_length_z.mm(), 0);
}

TEST(StatusWindow, NamesACycleForAsLongAsItRuns) {
  EXPECT_EQ(after("G98 F10 M3 S500\nG0 X0 Z1\nG81 R.1 Z-1\n").cycle, "drill");
  EXPECT_EQ(after("G98 F10 M3 S500\nG0 X0 Z1\nG81 R.1 Z-1\nX2\n").cycle, "");
  EXPECT_EQ(after("G99 F.1 M3 S500\nG0 X2 Z0\nG32 Z-1 F.1\n").cycle, "thread line");
  EXPECT_EQ(after("G98 F10 M3 S500\nG0 X2.2 Z.1\nG71 P1 Q2 U0 W0 I0 K0 D.1 R0\n").cycle,
            "rough turning");
}

}  // namespace
}  // namespace dripline::interpreter::centurion
