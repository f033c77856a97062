#include <gtest/gtest.h>

#include "tests/unit/gateway/machine/test_machine.hpp"

namespace dripline::machine::test {
namespace {

MachineLimits small_lathe() {
  MachineLimits limits = plain_lathe();
  limits.axis(Axis::X)->min = 0;
  limits.axis(Axis::X)->max = 100;
  limits.axis(Axis::Z)->min = -200;
  limits.axis(Axis::Z)->max = 10;
  return limits;
}

TEST(Travel, BeyondIsAnAlarmBeforeTheMoveThatNamesAxisValueAndLimit) {
  TestMachine test(small_lathe());
  test.program.line(50, 0, 1200);
  test.program.line(50, -250, 1200);
  test.program.output("never");
  test.run_all();
  EXPECT_EQ(test.recorder.lines,
            (std::vector<std::string>{
                "block 1", "alarm MCH0001 axis Z would go to -250 mm, its travel ends at -200"}));
  EXPECT_EQ(test.x(), 50);
  EXPECT_EQ(test.z(), 0);
}

TEST(Travel, IsShownAsTheProgramsControlShowsIt) {
  TestMachine test(small_lathe());
  interpreter::ProgramHeader header;
  header.units = interpreter::Units::Inch;
  header.x_is_diameter = true;
  test.machine.events().on_program(header);
  test.program.line(127, 0, 1200);
  test.run_all();
  EXPECT_EQ(test.recorder.lines.back(),
            "alarm MCH0001 axis X (diameter) would go to 10 in, its travel ends at 7.874");

  test.machine.begin({});
  header.x_is_diameter = false;
  test.machine.events().on_program(header);
  test.machine.events().on_units({{}, interpreter::Units::Millimeter});
  test.program.line(127, 0, 1200);
  test.run_all();
  EXPECT_EQ(test.recorder.lines.back(),
            "alarm MCH0001 axis X would go to 127 mm, its travel ends at 100");
}

TEST(Travel, TheEndsThemselvesAreAllowed) {
  TestMachine test(small_lathe());
  test.program.rapid(100, 10);
  test.program.rapid(0, -200);
  test.run_all();
  EXPECT_EQ(test.recorder.blocks.size(), 2u);
}

TEST(Travel, OfAnArcCountsItsWholeWay) {
  for (const bool bulges_out : {false, true}) {
    TestMachine test(small_lathe());
    test.machine.begin(Program::at(bulges_out ? 40 : 60, 5));
    // Half a turn counterclockwise, seen with Z to the right and X upwards: from above it goes
    // through smaller Z, from below through greater Z, out to 15.
    test.program.arc(bulges_out ? 60 : 40, 5, 5, 50, 180, 600);
    test.run_all();
    EXPECT_EQ(
        test.recorder.lines.back(),
        bulges_out ? "alarm MCH0001 axis Z would go to 15 mm, its travel ends at 10" : "block 1");
  }
}

TEST(Travel, AxisThatTheMachineHasNotIsAnAlarm) {
  TestMachine test(small_lathe());
  Position to;
  to.set(Axis::Y, Length::mm(1));
  const Origin& origin = test.program.begin_block();
  test.machine.events().on_line({origin, to, Feed::per_minute(Length::mm(100))});
  test.run_all();
  EXPECT_EQ(test.recorder.lines.back(), "alarm MCH0002 this machine has no axis Y");
}

TEST(Travel, NotANumberIsAnAlarm) {
  TestMachine test(small_lathe());
  test.program.line(std::nan(""), 0, 1200);
  test.run_all();
  EXPECT_TRUE(test.recorder.lines.back().starts_with("alarm MCH"));
}

TEST(Limits, AreCheckedBeforeUse) {
  EXPECT_TRUE(check(MachineLimits::lathe()));
  EXPECT_TRUE(check(MachineLimits::mill()));
  EXPECT_FALSE(check(MachineLimits{}));
  MachineLimits limits = plain_lathe();
  limits.axis(Axis::Z)->acceleration = 0;
  const auto checked = check(limits);
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().what, "axis Z: acceleration is 0, must be above 0");
}

}  // namespace
}  // namespace dripline::machine::test
