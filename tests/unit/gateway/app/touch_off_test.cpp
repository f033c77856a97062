// Touch-off: lengths of tools from where the axes rest, whatever has run before.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/gateway/app/position_fixture.hpp"
#include "tests/unit/gateway/app/toy_motion.hpp"

namespace dripline::gateway {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

struct TouchCase {
  std::string name;
  const interpreter::Dialect& control;
  std::string setup, move, set, effect;
};
void PrintTo(const TouchCase& shown, std::ostream* out) {
  *out << shown.name;
}
class TouchOff : public testing::TestWithParam<TouchCase> {};

// CEN-222.
TEST_P(TouchOff, SetsTheLengthThatMakesThePositionTheCoordinate) {
  const TouchCase& given = GetParam();
  Shop shop(given.control, given.setup);
  ASSERT_EQ(shop.mdi(given.move), "completed");
  EXPECT_THAT(shop.set(given.set), StartsWith(given.effect + " ("));
  EXPECT_THAT(shop.set(given.set), HasSubstr("is")) << "again: from the same position";
}

INSTANTIATE_TEST_SUITE_P(
    , TouchOff,
    testing::Values(
        TouchCase{"fanuc", interpreter::kFanucDialect,
                  "[[offset]]\nname = \"G54\"\nZ = -300.0\n[[tool]]\nnumber = 3\nlength = 10.0\n",
                  "G21 G91 G1 Z-180. F9000\n", "tool 3 Z 2 mm G54",
                  "tool.3.length is 118.000 mm, it was 10.000"},
        TouchCase{"fanuc_with_a_length_in_force", interpreter::kFanucDialect,
                  "[[tool]]\nnumber = 3\nlength = 10.0\n", "G21 G43 H3 G91 G1 Z-180. F9000\n",
                  "tool 3 Z -179.5 mm G54", "tool.3.length is 9.500 mm, it was 10.000"},
        TouchCase{"centurion_x", interpreter::kCenturionDialect, "units = \"mm\"\n",
                  "G21 G91 G98 G1 X80 F5000\n", "tool 2 X 30 mm G54",
                  "P611 is 25.000 mm, it was 0.000; P615 is 0.000 mm, it was 0.000"},
        TouchCase{"rs274ngc", interpreter::kRs274NgcDialect,
                  "units = \"in\"\n[[tool]]\nnumber = 4\nlength = 1.0\n", "G20 G91 G1 Z-2 F500\n",
                  "tool 4 Z -3 in G54", "tool.4.Z is 25.400 mm, it was 25.400"}),
    [](const auto& i) { return i.param.name; });

// [MEASUR] of a mill's geometry leaves the wear; a lathe's is 0 then.
TEST(TouchOffByFanuc, NamesTheWearThatStays) {
  Shop mill(interpreter::kFanucDialect,
            "[control]\noffset_memory = \"C\"\n[[tool]]\nnumber = 3\nlength = 10.0\n");
  ASSERT_EQ(mill.mdi("G21 G91 G1 Z-20. F9000\n"), "completed");
  EXPECT_THAT(mill.set("tool 3 Z -60 mm G54"), Not(HasSubstr("wear")));
  ASSERT_EQ(mill.mdi("G90 G10 L11 P3 R-0.25\n"), "completed");
  EXPECT_THAT(mill.set("tool 3 Z -60 mm G54"),
              AllOf(StartsWith("tool.3.length is 40.000 mm"),
                    HasSubstr("tool.3.length_wear stays, -0.250 mm: the length in force will be")));
}

// The control's own arithmetic with the length that was set comes to the coordinate.
TEST(TouchOffByFanuc, IsTheLengthOfG43) {
  Shop shop(interpreter::kFanucDialect, "[[offset]]\nname = \"G54\"\nZ = -300.0\n");
  ASSERT_EQ(shop.mdi("G21 G91 G1 Z-180. F9000\n"), "completed");
  ASSERT_THAT(shop.set("tool 3 Z 2 mm G54"),
              StartsWith("tool.3.length is 118.000 mm, it was 0.000"));
  EXPECT_EQ(shop.run("O1\nDPRNT[L#2003[43]]\nM30\n"), "completed");
  EXPECT_THAT(shop.lines(), testing::Contains(HasSubstr("118")));
}

struct OrderCase {
  std::string name;
  const interpreter::Dialect& control;
  std::string setup;
  std::vector<std::string> approach;  ///< with the tool in force
  std::string first, first_effect;    ///< what is set there
  std::string move;                   ///< begins without the tool
  std::size_t axis;                   ///< is `there` then, as the axes are
  double there;
  std::string second, second_effect;
};
void PrintTo(const OrderCase& shown, std::ostream* out) {
  *out << shown.name;
}
class UsualOrder : public testing::TestWithParam<OrderCase> {};

// Touch one axis, move, touch the other. The axes stay when the tool is dropped, so the length that
// the position has left out is in it from then on.
TEST_P(UsualOrder, SetsBothByWhereTheAxesAre) {
  const OrderCase& given = GetParam();
  Shop shop(given.control, given.setup);
  for (const std::string& text : given.approach) ASSERT_EQ(shop.mdi(text), "completed") << text;
  EXPECT_THAT(shop.set(given.first), StartsWith(given.first_effect + " ("));
  ASSERT_EQ(shop.mdi(given.move), "completed");
  EXPECT_NEAR(shop.at(given.axis), given.there, 1e-9);
  EXPECT_THAT(shop.set(given.second), StartsWith(given.second_effect + " ("));
  shop.restart_gateway();
}

INSTANTIATE_TEST_SUITE_P(
    , UsualOrder,
    testing::Values(
        // The tip goes to -180 with a length of 10: the axis is at -170, and -170 + 179.5 = 9.5.
        OrderCase{"fanuc",
                  interpreter::kFanucDialect,
                  "[[tool]]\nnumber = 3\nlength = 10.0\n",
                  {"G21 G43 H3 G91 G1 Z-180. F9000\n"},
                  "datum G54 X 5 mm",
                  "G54.X is -5.000 mm, it was 0.000",
                  "G21 G91 G1 X1. F9000\n",
                  2,
                  -170,
                  "tool 3 Z -179.5 mm G54",
                  "tool.3.length is 9.500 mm, it was 10.000"},
        // X 40 + 1 - 15 = 26; Z -20 + 2 = -18.
        OrderCase{"fanuc_lathe",
                  interpreter::kFanucLatheDialect,
                  "[[tool]]\nnumber = 3\nX = 1.0\nZ = 1.5\nwear = { Z = 0.5 }\n",
                  {"T0303\n", "G98 G1 U80. W-20. F5000\n"},
                  "tool 3 X 30 mm G54",
                  "tool.3.x is 26.000 mm, it was 1.000; tool.3.x_wear is 0.000 mm, it was 0.000",
                  "G98 G1 U2. F5000\n",
                  2,
                  -18,
                  "tool 3 Z 0 mm G54",
                  "tool.3.length is -18.000 mm, it was 1.500; tool.3.length_wear is 0.000 mm, it "
                  "was 0.500"},
        // X 40 + 5 - 15 = 30; Z -10 + 7 = -3.
        OrderCase{"centurion",
                  interpreter::kCenturionDialect,
                  "units = \"mm\"\n[[tool]]\nnumber = 2\nX = 5.0\nZ = 7.0\n[control]\ntool_changer "
                  "= true\n",
                  {"T0202 M6\n", "G21 G91 G98 G1 X80 Z-10 F5000\n"},
                  "tool 2 X 30 mm G54",
                  "P611 is 30.000 mm, it was 5.000; P615 is 0.000 mm, it was 0.000",
                  "G21 G91 G98 G1 X2 F5000\n",
                  2,
                  -3,
                  "tool 2 Z 0 mm G54",
                  "P610 is -3.000 mm, it was 7.000; P614 is 0.000 mm, it was 0.000"},
        // G43 shifts the tip by -1 in: Z -1 - 2 = -3 in, the axis is at -2 in, and -2 + 3 = 1 in.
        OrderCase{"rs274ngc",
                  interpreter::kRs274NgcDialect,
                  "units = \"in\"\n[[tool]]\nnumber = 4\nlength = 1.0\n",
                  {"G20 G43 H4 G91 G1 Z-2 F500\n"},
                  "datum G54 X 0.5 in",
                  "#5221 is -0.5000 in, it was 0.0000",
                  "G20 G91 G1 X1 F500\n",
                  2,
                  -50.8,
                  "tool 4 Z -3 in G54",
                  "tool.4.Z is 25.400 mm, it was 25.400"}),
    [](const auto& i) { return i.param.name; });

// Nothing has moved since G43 on a control whose position is shifted at once: the machine still
// shows the former one.
TEST(TouchOffByRs274Ngc, KnowsThatALengthShowsWithTheNextMove) {
  Shop shop(interpreter::kRs274NgcDialect, "[[tool]]\nnumber = 4\nlength = 25.0\n");
  ASSERT_EQ(shop.mdi("G21 G91 G1 Z-50 F500\n"), "completed");
  ASSERT_EQ(shop.mdi("G43 H4\n"), "completed");
  EXPECT_THAT(shop.set("datum G54 Z 0 mm"),
              AllOf(StartsWith("refused: "), HasSubstr("move the axes first")));
  EXPECT_THAT(shop.set("tool 4 Z -60 mm G54"), StartsWith("tool.4.Z is 10.000 mm, it was 25.000"));
  ASSERT_EQ(shop.mdi("G21 G91 G1 Z-1 F500\n"), "completed");
  EXPECT_NEAR(shop.at(2), -51, 1e-9);
}

// On a control that the axes follow, the move after G43 ends with the new length.
TEST(TouchOffByRs274Ngc, IsByTheNewLengthAfterTheNextMove) {
  Shop shop(interpreter::kRs274NgcDialect, "[[tool]]\nnumber = 4\nlength = 25.0\n");
  ASSERT_EQ(shop.mdi("G21 G91 G1 Z-50 F500\n"), "completed");
  ASSERT_EQ(shop.mdi("G43 H4\n"), "completed");
  ASSERT_EQ(shop.mdi("G1 X1\n"), "completed") << "Z has not moved";
  EXPECT_THAT(shop.set("tool 4 Z -60 mm G54"), StartsWith("tool.4.Z is 10.000 mm, it was 25.000"));
  Shop moved(interpreter::kRs274NgcDialect, "[[tool]]\nnumber = 4\nlength = 25.0\n");
  ASSERT_EQ(moved.mdi("G21 G91 G1 Z-50 F500\nG43 H4\nG1 Z-2\n"), "completed");
  EXPECT_NEAR(moved.at(2), -77, 1e-9) << "the tip; the axis is at -52";
  EXPECT_THAT(moved.set("tool 4 Z -60 mm G54"), StartsWith("tool.4.Z is 8.000 mm, it was 25.000"));
}

constexpr const char* kWithLength = "[[tool]]\nnumber = 3\nlength = 10.0\n";

// The first move under another length is somewhere between both.
TEST(TouchOffAfterAnAbort, IsRefusedWhereTheLengthWasChanging) {
  Shop shop(interpreter::kFanucDialect, kWithLength, "1x");
  EXPECT_EQ(shop.abort_when("G21 G43 H3 G91 G1 Z-180. F6000\n", [&] { return shop.at(2) < -20; }),
            "aborted by command");
  EXPECT_THAT(shop.set("tool 3 Z 0 mm G54"),
              AllOf(StartsWith("refused: "), HasSubstr("is not certain")));
  EXPECT_THAT(shop.set("datum G54 Z 0 mm"), HasSubstr("is not certain"));
  EXPECT_THAT(shop.set("datum G54 X 0 mm"), StartsWith("G54.X is 0.000 mm, it was 0.000"))
      << "along X it is";
  ASSERT_EQ(shop.mdi("G21 G91 G1 X1. F9000\n"), "completed");
  EXPECT_THAT(shop.set("tool 3 Z 0 mm G54"), HasSubstr("is not certain")) << "nor now";
  ASSERT_EQ(shop.run("O1\nG21 G90 G0 Z-7.\nM30\n"), "completed");
  EXPECT_THAT(shop.set("tool 3 Z 0 mm G54"),
              StartsWith("tool.3.length is -7.000 mm, it was 10.000"));
}

// Compensation gives the move to the machine when the next block is read.
TEST(TouchOffAfterAnAbort, IsRefusedAlsoWhereTheMoveHasWaited) {
  Shop shop(interpreter::kFanucDialect,
            std::string(kWithLength) + "[[tool]]\nnumber = 30\nradius = 1.0\n", "1x");
  EXPECT_EQ(shop.abort_when("G21 G90 G94 F6000\nG1 X1. Y0 Z0\nG41 D30 X5.\nG43 H3 G1 Z-180.\n"
                            "X30.\nX35.\nG40 X40.\n",
                            [&] { return shop.at(2) < -20; }),
            "aborted by command");
  EXPECT_THAT(shop.set("tool 3 Z 0 mm G54"),
              AllOf(StartsWith("refused: "), HasSubstr("is not certain")));
}

// Machine coordinates are those of the axes, a program's leave the length out.
TEST(TouchOffInMachineCoordinates, IsRefusedWithALengthInForce) {
  for (const std::string back : {"G53 Z-100.\n", "G28 G91 Z0\nG90\n"}) {
    Shop shop(interpreter::kFanucDialect, kWithLength);
    ASSERT_EQ(shop.mdi("G21 G90 G43 H3 G0 Z-50.\n" + back), "completed");
    EXPECT_THAT(shop.set("tool 3 Z 0 mm G54"),
                AllOf(StartsWith("refused: "), HasSubstr("G28, G53")))
        << back;
    ASSERT_EQ(shop.run("O1\nG21 G90 G0 Z-7.\nM30\n"), "completed");
    EXPECT_THAT(shop.set("tool 3 Z 0 mm G54"), StartsWith("tool.3.length is -7.000 mm")) << back;
  }
  Shop without(interpreter::kFanucDialect, kWithLength);
  ASSERT_EQ(without.mdi("G21 G90 G53 G0 Z-100.\n"), "completed");
  EXPECT_THAT(without.set("tool 3 Z 0 mm G54"), StartsWith("tool.3.length is -100.000 mm"));
}

TEST(TouchOffAfterAnAbort, IsByTheLengthThatIsInForce) {
  Shop shop(interpreter::kFanucDialect, kWithLength, "1x");
  EXPECT_EQ(shop.abort_when("G21 G43 H3 G91 G1 Z-30. F9000\nG1 X1.\nG1 X500. F3000\n",
                            [&] { return shop.at(0) > 5; }),
            "aborted by command");
  EXPECT_NEAR(shop.at(2), -30, 1e-9);
  EXPECT_THAT(shop.set("tool 3 Z 0 mm G54"),
              StartsWith("tool.3.length is -20.000 mm, it was 10.000"));
  ASSERT_EQ(shop.mdi("G21 G91 G1 Z-1. F9000\n"), "completed");
  EXPECT_NEAR(shop.at(2), -21, 1e-9) << "from -20, where the axis is";
  EXPECT_THAT(shop.set("tool 3 Z 0 mm G54"),
              StartsWith("tool.3.length is -21.000 mm, it was -20.000"));
}

// An alarm of the program: all before it was executed.
TEST(TouchOffAfterAnAlarm, IsByTheLengthThatIsInForce) {
  Shop shop(interpreter::kFanucDialect, kWithLength);
  ASSERT_NE(shop.mdi("G21 G43 H3 G91 G1 Z-180. F9000\nG1 Z-1. H999\n"), "completed");
  ASSERT_EQ(shop.mdi("G21 G91 G1 X1. F9000\n"), "completed");
  EXPECT_NEAR(shop.at(2), -170, 1e-9);
  EXPECT_THAT(shop.set("tool 3 Z -179.5 mm G54"),
              StartsWith("tool.3.length is 9.500 mm, it was 10.000"));
}

// With the machine locked the position of the program is not that of the axes.
TEST(TouchOffAfterALockedRun, IsByTheAxes) {
  Shop shop(interpreter::kFanucDialect, kWithLength);
  ASSERT_EQ(shop.mdi("G21 G91 G1 Z-5. F9000\n"), "completed");
  EXPECT_EQ(shop.panel("switch machine_lock on"), "ok");
  ASSERT_EQ(shop.mdi("G43 H3 G1 Z-180.\n"), "completed");
  EXPECT_NEAR(shop.at(2), -5, 1e-9);
  EXPECT_THAT(shop.set("tool 3 Z 0 mm G54"),
              StartsWith("tool.3.length is -5.000 mm, it was 10.000"));
}

// What the operator has touched with is not what the control knows: the datum would be off by its
// length.
TEST(DatumAfterMdiWithoutTheTool, NeedsATool) {
  Shop shop(interpreter::kFanucDialect, kWithLength);
  ASSERT_EQ(shop.mdi("G21 G43 H3 G91 G1 Z-180. F9000\n"), "completed");
  ASSERT_THAT(shop.set("datum G54 X 5 mm"), Not(StartsWith("refused")));
  ASSERT_EQ(shop.mdi("G21 G91 G1 X1. F9000\n"), "completed");
  EXPECT_THAT(shop.set("datum G54 Z 0 mm"),
              AllOf(StartsWith("refused: "), HasSubstr("(Z 10 mm)"), HasSubstr("call the tool")));
  EXPECT_THAT(shop.set("datum G54 Y 0 mm"), Not(StartsWith("refused")));
  ASSERT_EQ(shop.mdi("G21 G91 G43 H3 G1 Z-2. F9000\n"), "completed");
  EXPECT_THAT(shop.set("datum G54 Z 0 mm"), StartsWith("G54.Z is -172.000 mm, it was 0.000"));
}

TEST(MdiWithoutTheTool, ReportsWhatThePositionBecomes) {
  Shop shop(interpreter::kFanucLatheDialect, "[[tool]]\nnumber = 3\nX = 1.0\nZ = 2.5\n");
  ASSERT_EQ(shop.mdi("T0303\nG98 G1 U80. W-20. F5000\n"), "completed");
  ASSERT_THAT(shop.set("tool 3 X 30 mm G54"), Not(StartsWith("refused")));
  shop.push("M", "G98 G1 U2. F5000\n");
  dds::Command command = shop.start_command("M");
  command.argument = dds::kMdiStart;
  const auto reply = shop.send(command);
  EXPECT_TRUE(reply.accepted);
  EXPECT_THAT(reply.reason, AllOf(HasSubstr("without a tool: the control's memory was changed"),
                                  HasSubstr("from here on: X 2, Z 2.5 mm")));
}

TEST(TouchOffAnswer, ShowsUnitsAndWhatTheLengthWasComputedWith) {
  Shop shop(interpreter::kFanucDialect,
            std::string(kWithLength) + "[[offset]]\nname = \"G54\"\nZ = -300.0\n");
  ASSERT_EQ(shop.mdi("G21 G43 H3 G91 G1 Z-180. F9000\n"), "completed");
  const auto reply = shop.ask(dds::CommandAction::SetPosition, "tool 3 Z 2 mm G54");
  EXPECT_EQ(reply.reason,
            "tool.3.length is 128.000 mm, it was 10.000 (tool's length in force: Z 10.000 mm; G54: "
            "-300.000 mm)");
  EXPECT_EQ(reply.values,
            R"({"cells":[{"before":10.0,"name":"tool.3.length","unit":"mm","value":128.0}],)"
            R"("length":10.0,"zero":-300.0})");
  EXPECT_EQ(shop.set("datum G54 X 1 mm"),
            "G54.X is -1.000 mm, it was 0.000 (no tool's length in force along X)");
  EXPECT_EQ(shop.set("datum G54 A 90 mm"),
            "refused: 'datum G54 A 90 mm': expected 'datum G54 X "
            "12.5 mm' or 'tool 3 Z 0 mm G54'");
}

// Such a machine moves by coordinates alone: a length would be in the memory, and not in its
// motion.
TEST(TouchOffOfADevice, IsRefused) {
  Shop shop(interpreter::kFanucDialect, "", "1x");
  shop.motion = [](machine::ExecutionSink& sink) { return std::make_unique<ToyMotion>(sink); };
  shop.restart_gateway();
  EXPECT_THAT(shop.set("tool 3 X 0 mm G54"), HasSubstr("along Z alone"));
  EXPECT_THAT(shop.set("datum G54 X 0 mm"), testing::Eq("G54.X is 0.000 mm, it was 0.000"));
  Shop lathe(interpreter::kFanucLatheDialect, "[[tool]]\nnumber = 3\nX = 1.0\n", "1x");
  lathe.motion = [](machine::ExecutionSink& sink) { return std::make_unique<ToyMotion>(sink); };
  lathe.restart_gateway();
  EXPECT_THAT(lathe.set("tool 3 X 0 mm G54"),
              AllOf(StartsWith("refused: "), HasSubstr("would not be in its motion")));
}

}  // namespace
}  // namespace dripline::gateway
