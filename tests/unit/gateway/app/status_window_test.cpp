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
  ASSERT_TRUE(fixture.status->coordinates->program) << "its coordinates are still in force";
  EXPECT_EQ(fixture.status->coordinates->program->shift[0], 0) << "END PGM takes it out";
  EXPECT_EQ(fixture.status->coordinates->program->position, fixture.status->position);
  EXPECT_EQ(fixture.status->coordinates->target, fixture.status->position);
}

constexpr const char* kSlowProgram =
    "0 BEGIN PGM 7 MM\n1 TOOL CALL 0 Z S 500,000\n2 L X+0,000 Y+0,000 R0 F5000 M03\n"
    "3 L X+0,000 Y+50,000 R0 F100\n4 L X+10,000 R0 F100\n5 END PGM 7 MM\n";

interpreter::Setup with_options(const std::string& control) {
  return *interpreter::parse_setup("[control]\n" + control);
}

/// The status while line 4 of it is executed, of a TNC with these options.
dds::Status in_line_4(const std::string& control) {
  GatewayFixture fixture(interpreter::kTnc155Dialect, with_options(control), "1x");
  fixture.push("7", kSlowProgram);
  EXPECT_TRUE(fixture.start("7").accepted);
  EXPECT_TRUE(fixture.run_until([&] { return fixture.status && fixture.status->line == 4; }));
  return *fixture.status;
}

/// HD-083: small characters have the block before and two after it, large ones the block alone.
TEST(StatusWindow, HasTheBlocksThatTheSizeOfItsCharactersAllows) {
  const auto small = in_line_4("").screen;
  ASSERT_TRUE(small);
  EXPECT_EQ(small->previous_block, "2 L X+0,000 Y+0,000 R0 F5000 M03");
  EXPECT_EQ(small->block, "3 L X+0,000 Y+50,000 R0 F100");
  EXPECT_EQ(small->next_block, "4 L X+10,000 R0 F100");
  EXPECT_EQ(small->further_block, "5 END PGM 7 MM");
  const auto large = in_line_4("display_size = \"large\"").screen;
  ASSERT_TRUE(large);
  EXPECT_EQ(large->block, "3 L X+0,000 Y+50,000 R0 F100");
  EXPECT_EQ(large->previous_block + large->next_block + large->further_block, "");
}

TEST(StatusWindow, HasSmallCharactersForISOWhateverIsChosen) {
  GatewayFixture fixture(interpreter::kTnc155Dialect, with_options("display_size = \"large\""),
                         "1x");
  fixture.push(
      "7",
      "%7 G71 *\nN10 G99 T1 L+0 R+4 *\nN20 T1 G17 S500 *\nN30 G01 G40 G90 X+50 F100 M03 *\n"
      "N40 M02 *\nN9999 %7 G71 *\n");
  ASSERT_TRUE(fixture.start("7").accepted);
  ASSERT_TRUE(fixture.run_until([&] { return fixture.status && fixture.status->line == 4; }));
  EXPECT_EQ(fixture.status->screen->block, "N30 G01 G40 G90 X+50 F100 M03 *");
  EXPECT_EQ(fixture.status->screen->next_block, "N40 M02 *");
}

/// HD-081, HD-082: MM/INCH changes the display alone.
TEST(StatusWindow, HasTheUnitsAndThePositionThatItsOperatorChose) {
  dds::Status status = in_line_4("");
  EXPECT_FALSE(status.screen->is_inch);
  EXPECT_EQ(status.screen->position, dds::PositionDisplay::Actual);
  status = in_line_4("display_units = \"inch\"\nposition_display = \"DIST\"");
  EXPECT_TRUE(status.screen->is_inch);
  EXPECT_FALSE(status.modes->is_inch) << "the program is in mm";
  EXPECT_EQ(status.screen->position, dds::PositionDisplay::DistanceToGo);
}

TEST(StatusWindow, OfAnIdleControlHasItsOwnUnitsAndAxes) {
  const auto idle = [](const interpreter::Dialect& control, const std::string& options) {
    GatewayFixture fixture(control, with_options(options), "1x");
    EXPECT_TRUE(fixture.run_until([&] { return fixture.status.has_value(); }));
    return *fixture.status;
  };
  constexpr unsigned kXYZ = 0b111, kC = 1U << 5, kA = 1U << 3, kXY = 0b11, kXZ = 0b101;
  EXPECT_EQ(idle(interpreter::kTnc155Dialect, "").axes, kXYZ | kC) << "X Y Z and the axis IV";
  EXPECT_EQ(idle(interpreter::kTnc155Dialect, "fourth_axis = \"A\"").axes, kXYZ | kA);
  EXPECT_TRUE(idle(interpreter::kTnc155Dialect, "display_units = \"inch\"").screen->is_inch);
  EXPECT_EQ(idle(interpreter::kProtoTrakDialect, "").axes, kXY);
  const dds::Status lathe = idle(interpreter::kCenturionDialect, "");
  EXPECT_EQ(lathe.axes, kXZ);
  EXPECT_TRUE(lathe.screen->is_inch);
  EXPECT_TRUE(lathe.modes->is_inch);
  EXPECT_EQ(lathe.screen->position, dds::PositionDisplay::Unknown);
  EXPECT_EQ(lathe.screen->block, "");
}

TEST(StatusWindow, OfAProtoTrakHasTheUnitAndTheCutOfItsEvent) {
  GatewayFixture fixture(interpreter::kProtoTrakDialect, with_options("waits = false"), "1x");
  fixture.push("7", "PN7 G20 ;\nG101 XB1. YB1. XE3. YE1. TC2 D0.5 F10. CR-1.;\n%\n");
  ASSERT_TRUE(fixture.start("7").accepted);
  ASSERT_TRUE(fixture.run_until(
      [&] { return fixture.status && fixture.status->modes && fixture.status->modes->feed > 0; }));
  EXPECT_TRUE(fixture.status->screen->is_inch);
  EXPECT_EQ(fixture.status->modes->compensation, dds::CompensationSide::Left);
  EXPECT_NEAR(fixture.status->modes->tool_radius, 6.35, 1e-9);
  EXPECT_NEAR(fixture.status->modes->feed, 254, 1e-9);
  EXPECT_EQ(fixture.status->screen->block, "G101 XB1. YB1. XE3. YE1. TC2 D0.5 F10. CR-1.;");
}

/// CEN-203: the time of motion and the path of the executed blocks, when the program ends.
TEST(RunStatistics, AreOfTheBlocksThatWereExecuted) {
  GatewayFixture fixture(interpreter::kTnc155Dialect, {}, "max");
  fixture.push("7",
               "0 BEGIN PGM 7 MM\n1 TOOL CALL 0 Z S 500,000\n2 L X+30,000 Y+40,000 R0 F3000 M03\n"
               "3 CC X+30,000 Y+30,000\n4 C X+30,000 Y+20,000 DR+ R0 F3000\n5 END PGM 7 MM\n");
  ASSERT_TRUE(fixture.start("7").accepted);
  const dds::RunEndText end = fixture.ended();
  ASSERT_EQ(end.outcome, dds::RunOutcome::Completed) << end.reason;
  ASSERT_TRUE(end.path_mm && end.motion_seconds);
  EXPECT_NEAR(*end.path_mm, 50 + 10 * 3.14159265, 1e-6);
  const double at_feed = *end.path_mm / 3000 * 60;
  EXPECT_GE(*end.motion_seconds, at_feed);
  EXPECT_LT(*end.motion_seconds, at_feed + 2) << "some more for speeding up and slowing down";
}

TEST(RunStatistics, LeaveOutWhatWasNotExecutedAndStops) {
  GatewayFixture fixture(interpreter::kTnc155Dialect, {}, "1x");
  fixture.push("7",
               "0 BEGIN PGM 7 MM\n1 TOOL CALL 0 Z S 500,000\n2 L X+10,000 R0 F6000 M03\n3 STOP\n"
               "4 L X+99,000 R0 F600\n5 END PGM 7 MM\n");
  ASSERT_TRUE(fixture.start("7").accepted);
  ASSERT_TRUE(fixture.run_until([&] {
    return fixture.status && fixture.status->execution == dds::Execution::ProgramStopped;
  }));
  fixture.clock.steady += std::chrono::seconds(3);
  ASSERT_TRUE(fixture.send(fixture.command(dds::CommandAction::Abort)).accepted);
  const dds::RunEndText end = fixture.ended();
  EXPECT_NEAR(end.path_mm.value_or(0), 10, 1e-6);
  EXPECT_LT(end.motion_seconds.value_or(9), 1);
}

TEST(RunStatistics, LeaveOutTheTimeOfABlockThatWasCutOff) {
  GatewayFixture fixture(interpreter::kTnc155Dialect, {}, "1x");
  fixture.push("7",
               "0 BEGIN PGM 7 MM\n1 TOOL CALL 0 Z S 500,000\n2 L X+10,000 R0 F6000 M03\n"
               "3 L X+99,000 R0 F100\n4 END PGM 7 MM\n");
  ASSERT_TRUE(fixture.start("7").accepted);
  ASSERT_TRUE(
      fixture.run_until([&] { return fixture.status && fixture.status->position[0] > 15; }));
  ASSERT_TRUE(fixture.send(fixture.command(dds::CommandAction::Abort)).accepted);
  const dds::RunEndText end = fixture.ended();
  EXPECT_NEAR(end.path_mm.value_or(0), 10, 1e-6);
  EXPECT_LT(end.motion_seconds.value_or(9), 1)
      << "more than 3 seconds were spent in the next block";
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
