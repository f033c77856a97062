#include <gtest/gtest.h>

#include "gateway/interpreter/core/dialects.hpp"
#include "tests/unit/gateway/app/gateway_fixture.hpp"

/// The position displays and the coordinates of a control's status window.
namespace dripline::gateway {
namespace {

/// HD-082, HD-084: of the block in motion, while the interpreter is at the end of the program.
TEST(StatusWindow, IsOfTheBlockThatIsExecuted) {
  interpreter::Setup setup;
  GatewayFixture fixture(interpreter::kTnc155Dialect, setup, "1x");
  fixture.push(
      "7",
      "0 BEGIN PGM 7 MM\n1 TOOL CALL 0 Z S 500,000\n2 L X+0,000 Y+0,000 R0 F5000 M03\n"
      "3 CYCL DEF 7.0 DATUM SHIFT\n4 CYCL DEF 7.1 X+10,000\n"
      "5 CYCL DEF 10.0 ROTATION\n6 CYCL DEF 10.1 ROT +90,000\n7 CC X+1,000 Y+2,000\n"
      "8 L X+0,000 Y+50,000 R0 F500\n9 CYCL DEF 7.0 DATUM SHIFT\n10 CYCL DEF 7.1 X+99,000\n"
      "11 END PGM 7 MM\n");
  ASSERT_TRUE(fixture.start("7").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status && fixture.status->line == 9; }));
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->position[0] < -5; }));
  EXPECT_GE(fixture.status->accepted, 11U) << "the interpreter is ahead";
  EXPECT_EQ(fixture.status->modes->tool_axis, 2);
  EXPECT_EQ(fixture.status->modes->spindle, dds::SpindleState::Clockwise);
  ASSERT_TRUE(fixture.status->coordinates);
  const dds::Coordinates& all = *fixture.status->coordinates;
  EXPECT_NEAR(all.target[0], 10 - 50, 1e-9) << "turned by 90 degrees about X10";
  EXPECT_EQ(all.following_error, (std::array<double, 9>{}));
  ASSERT_TRUE(all.program);
  EXPECT_EQ(all.program->shift[0], 10) << "not the 99 of a later block";
  EXPECT_EQ(all.program->rotation, 90);
  EXPECT_EQ(all.program->pole_axes, 3);
  EXPECT_EQ(all.program->pole[1], 2);
  EXPECT_NEAR(all.program->target[1], 50, 1e-9);
  EXPECT_NEAR(all.program->position[1], 10 - fixture.status->position[0], 1e-9);
  EXPECT_NEAR(all.program->position[0], 0, 1e-9);
  fixture.ended();
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status->run.empty(); }));
  EXPECT_FALSE(fixture.status->coordinates->program) << "no program";
  EXPECT_EQ(fixture.status->coordinates->target, fixture.status->position);
}

TEST(StatusWindow, HasNoFrameOfAControlThatTellsNone) {
  GatewayFixture fixture("1x");
  fixture.push("O1", "X100\nEND\n");
  ASSERT_TRUE(fixture.start("O1").accepted);
  ASSERT_TRUE(
      fixture.run_until([&] { return fixture.status && fixture.status->feed_mm_per_min > 0; }));
  EXPECT_EQ(fixture.status->coordinates->target[0], 100);
  EXPECT_FALSE(fixture.status->coordinates->program);
}

}  // namespace
}  // namespace dripline::gateway
