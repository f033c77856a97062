#include <gtest/gtest.h>

#include <iterator>
#include <random>
#include <sstream>

#include "tests/unit/gateway/interpreter/dialects/fanuc/tilting_machine.hpp"

/// FAN-102, FAN-103: G68.2, G53.1 and G69 on three machines, against positions worked out by hand
/// and against the machine as the test computes it.
namespace dripline::interpreter::fanuc {
namespace {

std::string text_of(const char* format, std::initializer_list<double> values) {
  std::string text;
  auto value = values.begin();
  for (const char* at = format; *at != 0; ++at) {
    if (*at != '%') {
      text += *at;
      continue;
    }
    char number[32];
    std::snprintf(number, sizeof number, "%.3f", *value++);
    text += number;
  }
  return text;
}

void expect_axes(const Position& at, std::initializer_list<std::pair<Axis, double>> axes) {
  for (const auto& [axis, value] : axes) EXPECT_NEAR(at.raw(axis), value, kClose) << letter(axis);
}

/// A tilts by 30: the plane's normal goes to (0, -sin 30, cos 30). On the trunnion C stays, A goes
/// to 30, and the plane's zero (10, 20, 5) rotates by -30 about Y5 Z-40: with 15 and 45 from there
/// Y = 5 + 15 cos 30 + 45 sin 30 and Z = -40 - 15 sin 30 + 45 cos 30.
TEST(TiltedPlane, OnATrunnionTheTableComesToTheTool) {
  const MachineLog log = run_on(
      kTrunnion, "G90 G00 X0 Y0 Z100.\nG68.2 X10. Y20. Z5. I0 J30. K0\nG53.1\nX0 Y0 Z0\nM30\n");
  ASSERT_EQ(log.alarm, "");
  const double c = std::sqrt(3) / 2, s = 0.5;
  expect_axes(log.at(), {{Axis::A, 30}, {Axis::C, 0}, {Axis::X, 10}});
  expect_axes(log.at(), {{Axis::Y, 5 + 15 * c + 45 * s}, {Axis::Z, -40 - 15 * s + 45 * c}});
}

/// G53.1 moves the rotary axes alone: the linear ones rest where they were.
TEST(TiltedPlane, TheToolAxisIsDirectedWithoutALinearMove) {
  const MachineLog log =
      run_on(kTrunnion, "G90 G00 X1. Y2. Z100.\nG68.2 X10. Y20. Z5. I0 J30. K0\nG53.1\nM30\n");
  ASSERT_EQ(log.alarm, "");
  const auto moves = log.of_line(3);
  ASSERT_EQ(moves.size(), 1U);
  EXPECT_EQ(moves[0].kind, 'R');
  expect_axes(moves[0].to, {{Axis::X, 1}, {Axis::Y, 2}, {Axis::Z, 100}, {Axis::A, 30}});
}

TEST(TiltedPlane, InG01TheToolAxisIsDirectedAtTheFeed) {
  const MachineLog log =
      run_on(kTrunnion, "G90 G01 X1. F200.\nG68.2 X0 Y0 Z0 I0 J30. K0\nG53.1\nM30\n");
  const auto moves = log.of_line(3);
  ASSERT_EQ(moves.size(), 1U) << log.alarm;
  EXPECT_EQ(moves[0].kind, 'L');
  EXPECT_EQ(moves[0].feed, Feed::per_minute(Length::mm(200)));
}

/// I90 J90 rotates Z to +X, B goes to 90. As seen from the axis of B, which is at (3, 150) of the
/// gauge point, the tip of a tool of 100 is at (-3, -250), and at (-250, 3) when it is tilted. The
/// gauge point is then (250 - 3, -150 - 3) from the tip, and the axes another 100 lower.
TEST(TiltedPlane, OnAHeadTheAxesFollowTheTip) {
  const MachineLog log = run_on(kMixed,
                                "G90 G00 Z300. G43 H1\nG68.2 X40. Y0 Z0 I90. J90. K0\nG53.1\n"
                                "G00 X0 Y0 Z0\nM30\n",
                                "", "[[tool]]\nnumber = 1\nlength = 100\n");
  ASSERT_EQ(log.alarm, "");
  expect_axes(log.at(), {{Axis::B, 90}, {Axis::C, 0}, {Axis::X, 40 - 3 + 250}, {Axis::Y, 0}});
  expect_axes(log.at(), {{Axis::Z, -250 - 3}});
}

struct PlaneCase {
  const char* name;
  const TestMachine* machine;
};
class TiltedPlaneMachines : public testing::TestWithParam<PlaneCase> {};

const std::string kTwoTools =
    "[[tool]]\nnumber = 1\nlength = 50\nradius = 3\n[[tool]]\nnumber = 2\nlength = 80\n";
const std::string kFacingY = "G90 G00 G43 H1 Z100.\nG68.2 X0 Y0 Z0 I0 J90. K0\nG53.1\nX0 Y0 Z20.\n";

/// The plane's Z is -Y, and the head points along it: a tool that is 30 longer takes the axes back
/// by 30, though the tip stays on its point of the plane, and the move after it is parallel to it.
TEST(TiltedPlane, ALengthAloneMovesTheAxesOfAHeadAlongTheTool) {
  for (const char* block : {"G43 H2 Z20.", "G43 H2", "H2", "G01 F500. H2"}) {
    const MachineLog log =
        run_on(kFork, kFacingY + block + "\nG01 X50. F200.\nM30\n", "", kTwoTools);
    ASSERT_EQ(log.alarm, "") << block;
    const auto back = log.of_line(5), along = log.of_line(6);
    ASSERT_EQ(back.size(), 1U) << block;
    ASSERT_EQ(along.size(), 1U) << block;
    EXPECT_EQ(back[0].kind, std::string_view(block).starts_with("G01") ? 'L' : 'R');
    EXPECT_NEAR(back[0].to.raw(Axis::Y), back[0].from.raw(Axis::Y) - 30, kClose);
    EXPECT_LT(distance(kFork.tip(back[0].to, 80), {0, -20, 0}), kClose);
    EXPECT_NEAR(along[0].to.raw(Axis::X), along[0].from.raw(Axis::X) + 50, kClose);
    EXPECT_NEAR(along[0].to.raw(Axis::Y), along[0].from.raw(Axis::Y), kClose);
  }
}

/// Without a head the axes are at the tip, whatever the length.
TEST(TiltedPlane, ALengthAloneMovesNoTable) {
  const MachineLog log =
      run_on(kTrunnion, kFacingY + "G43 H2 Z20.\nG41 D1 G01 X50. F200.\nY9. H1\nG40 Y30.\nM30\n",
             "", kTwoTools);
  ASSERT_EQ(log.alarm, "");
  EXPECT_TRUE(log.of_line(5).empty());
}

/// Moves that wait for the next one would be made with its length.
TEST(TiltedPlane, ALengthDoesNotChangeWhileMovesWait) {
  const MachineLog compensated =
      run_on(kFork, kFacingY + "G41 D1 G01 X50. F200.\nY20.\nX0 H2\nM30\n", "", kTwoTools);
  EXPECT_TRUE(compensated.alarm.starts_with("PS113")) << compensated.alarm;
  EXPECT_EQ(compensated.alarm_line, 7U);
  const MachineLog corner =
      run_on(kFork, kFacingY + "G01 X50. F200. ,R2.\nY20. H2\nM30\n", "", kTwoTools);
  EXPECT_NE(corner.alarm, "");
  const MachineLog arc = run_on(kFork, kFacingY + "G02 H2\nM30\n", "", kTwoTools);
  EXPECT_TRUE(arc.alarm.starts_with("PS113")) << arc.alarm;
}

/// Of random planes: the tool is normal to the plane and the tip is on the programmed point.
TEST_P(TiltedPlaneMachines, BringTheTipToThePointWithTheToolNormal) {
  const TestMachine& machine = *GetParam().machine;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> turn(-180, 180), tilt(0, 175), place(-80, 80);
  const auto rounded = [](double value) { return std::round(value * 1000) / 1000; };
  for (int n = 0; n < 200; ++n) {
    const double i = rounded(turn(random)), j = rounded(tilt(random)), k = rounded(turn(random));
    const Vector zero{rounded(place(random)), rounded(place(random)), rounded(place(random))};
    const Vector point{rounded(place(random)), rounded(place(random)), rounded(place(random))};
    const std::string program =
        text_of("G90 G00 G43 H1 Z50.\nG68.2 X% Y% Z% I% J% K%\nG53.1\nG01 X% Y% Z% F500.\nM30\n",
                {zero[0], zero[1], zero[2], i, j, k, point[0], point[1], point[2]});
    const MachineLog log = run_on(machine, program, "",
                                  "[[tool]]\nnumber = 1\nlength = 87.5\n"
                                  "[[offset]]\nname = \"G54\"\nX = 7.0\nY = -3.0\nZ = 11.0\n");
    ASSERT_EQ(log.alarm, "") << program;
    const Link frame = Link::shift(zero[0] + 7, zero[1] - 3, zero[2] + 11) * Link::turn(2, i) *
                       Link::turn(0, j) * Link::turn(2, k);
    EXPECT_LT(distance(machine.tip(log.at(), 87.5), frame(point)), kClose) << program;
    const Vector base = frame({0, 0, 0}), up = frame({0, 0, 1});
    EXPECT_LT(
        distance(machine.direction(log.at()), {up[0] - base[0], up[1] - base[1], up[2] - base[2]}),
        kClose)
        << program;
    const auto line = log.of_line(4);
    ASSERT_EQ(line.size(), 1U) << "a straight line stays one move";
    EXPECT_EQ(line[0].feed, Feed::per_minute(Length::mm(500)));
  }
}

/// A full circle in the plane: every point of what the axes do is on it, and nothing jumps.
TEST_P(TiltedPlaneMachines, KeepCirclesRound) {
  const TestMachine& machine = *GetParam().machine;
  for (const auto& [i, j, k] : std::initializer_list<std::array<double, 3>>{
           {0, 0, 0}, {0, 30, 0}, {90, 45, 0}, {-120, 80, 33}, {10, 90, 20}, {45, 135, 0}}) {
    const MachineLog log =
        run_on(machine,
               text_of("G90 G00 G43 H1 Z50.\nG68.2 X5. Y6. Z7. I% J% K%\nG53.1\nG00 X20. Y0 Z1.\n"
                       "G01 F300.\nG17 G03 X20. Y0 I-20.\nM30\n",
                       {i, j, k}),
               "", "[[tool]]\nnumber = 1\nlength = 60\n");
    ASSERT_EQ(log.alarm, "");
    const Link frame =
        Link::shift(5, 6, 7) * Link::turn(2, i) * Link::turn(0, j) * Link::turn(2, k);
    const auto on_plane = [&](const Position& at) { return frame.inverse()(machine.tip(at, 60)); };
    const auto moves = log.of_line(6);
    ASSERT_FALSE(moves.empty());
    double turned = 0;
    for (const auto& move : moves) {
      const Vector from = on_plane(move.from), to = on_plane(move.to);
      EXPECT_NEAR(std::hypot(to[0], to[1]), 20, kClose);
      EXPECT_NEAR(to[2], 1, kClose);
      if (move.kind == 'L') {
        const Vector middle{(from[0] + to[0]) / 2, (from[1] + to[1]) / 2, 0};
        EXPECT_GT(std::hypot(middle[0], middle[1]), 20 - 0.00501);
        turned += std::atan2(from[0] * to[1] - from[1] * to[0], from[0] * to[0] + from[1] * to[1]);
      } else {
        ASSERT_EQ(move.kind, 'A');
        const PlaneAxes axes = axes_of(move.arc.plane);
        for (const double degrees : {90.0, 200.0}) {
          Position at = move.from;
          const double sign = move.arc.turn == Turn::Clockwise ? -1 : 1;
          const double radians = sign * degrees * std::acos(-1.0) / 180;
          const double first = move.from.raw(axes.first) - move.arc.center_first.mm();
          const double second = move.from.raw(axes.second) - move.arc.center_second.mm();
          at.set_raw(axes.first, move.arc.center_first.mm() + first * std::cos(radians) -
                                     second * std::sin(radians));
          at.set_raw(axes.second, move.arc.center_second.mm() + first * std::sin(radians) +
                                      second * std::cos(radians));
          const Vector on = on_plane(at);
          const double expected = degrees * std::acos(-1.0) / 180;
          EXPECT_NEAR(on[0], 20 * std::cos(expected), kClose);
          EXPECT_NEAR(on[1], 20 * std::sin(expected), kClose);
        }
        turned += 2 * std::acos(-1.0);
      }
    }
    EXPECT_NEAR(turned, 2 * std::acos(-1.0), 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(, TiltedPlaneMachines,
                         testing::Values(PlaneCase{"trunnion", &kTrunnion},
                                         PlaneCase{"mixed", &kMixed}, PlaneCase{"fork", &kFork}),
                         [](const auto& each) { return std::string(each.param.name); });

/// The orders of G68.2 P1: about the axes of the workpiece, the first digit first.
TEST(TiltedPlane, RollPitchYawTurnAboutTheWorkpieceInTheOrderOfQ) {
  for (const int order : {123, 132, 213, 231, 312, 321}) {
    const MachineLog log =
        run_on(kTrunnion, "G90 G00 Z50.\nG68.2 P1 Q" + std::to_string(order) +
                              " X1. Y2. Z3. I20. J-35. K50.\nG53.1\nG00 X10. Y11. Z12.\nM30\n");
    ASSERT_EQ(log.alarm, "") << order;
    const std::array<double, 3> angles{20, -35, 50};
    Link frame;
    for (const int digit : {order / 100, order / 10 % 10, order % 10})
      frame = Link::turn(digit - 1, angles[static_cast<std::size_t>(digit - 1)]) * frame;
    const Vector expected = (Link::shift(1, 2, 3) * frame)({10, 11, 12});
    EXPECT_LT(distance(kTrunnion.tip(log.at(), 0), expected), kClose) << order;
  }
}

/// The normal (0, -sin 30, cos 30) can be had with A30 C0 and with A-30 C180: the master moves as
/// far in both, and the slave decides. From C170 it is the other one.
TEST(TiltedPlane, TheNearerPoseIsTaken) {
  const char* plane = "G68.2 X0 Y0 Z0 I0 J30. K0\nG53.1\nM30\n";
  const MachineLog from_zero = run_on(kTrunnion, std::string("G90 G00 C10.\n") + plane);
  expect_axes(from_zero.at(), {{Axis::A, 30}, {Axis::C, 0}});
  const MachineLog from_half = run_on(kTrunnion, std::string("G90 G00 C170.\n") + plane);
  expect_axes(from_half.at(), {{Axis::A, -30}, {Axis::C, 180}});
  // the master comes first: from A-20 it is 10 to A-30, 50 to A30
  const MachineLog tilted = run_on(kTrunnion, std::string("G90 G00 A-20.\n") + plane);
  EXPECT_NEAR(tilted.at().raw(Axis::A), -30, kClose);
  EXPECT_NEAR(std::fabs(tilted.at().raw(Axis::C)), 180, kClose);
  // whole revolutions of the slave are kept
  const MachineLog turned = run_on(kTrunnion, std::string("G90 G00 C725.\n") + plane);
  expect_axes(turned.at(), {{Axis::A, 30}, {Axis::C, 720}});
}

/// Of a head and a table the table comes before the head.
TEST(TiltedPlane, OfAHeadAndATableTheTableMovesLess) {
  // normal (sin 30, 0, cos 30): B30 C0 or B-30 C180
  const MachineLog log =
      run_on(kMixed, "G90 G00 B-29. C80.\nG68.2 X0 Y0 Z0 I90. J30. K0\nG53.1\nM30\n");
  ASSERT_EQ(log.alarm, "");
  expect_axes(log.at(), {{Axis::B, 30}, {Axis::C, 0}});
}

TEST(TiltedPlane, LimitsOfTheRotaryAxesExcludeAPose) {
  const char* program = "G90 G00 A-20.\nG68.2 X0 Y0 Z0 I0 J30. K0\nG53.1\nM30\n";
  const MachineLog log =
      run_on(kTrunnion, program, "rotary_limits = [ { A = -25 }, { A = 120 } ]\n");
  ASSERT_EQ(log.alarm, "");
  expect_axes(log.at(), {{Axis::A, 30}, {Axis::C, 0}});
  const MachineLog none =
      run_on(kTrunnion, program, "rotary_limits = [ { A = -25 }, { A = 20 } ]\n");
  EXPECT_TRUE(none.alarm.starts_with("PS5458")) << none.alarm;
  EXPECT_EQ(none.alarm_line, 3U);
}

/// A plane that lies as the table does: the slave may be anywhere, and stays.
TEST(TiltedPlane, WhereTheSlaveDoesNotMatterItStays) {
  const MachineLog log = run_on(
      kTrunnion, "G90 G00 A20. C33.\nG68.2 X1. Y2. Z3. I0 J0 K25.\nG53.1\nX4. Y5. Z6.\nM30\n");
  ASSERT_EQ(log.alarm, "");
  expect_axes(log.at(), {{Axis::A, 0}, {Axis::C, 33}});
  const Vector expected = (Link::shift(1, 2, 3) * Link::turn(2, 25))({4, 5, 6});
  EXPECT_LT(distance(kTrunnion.tip(log.at(), 0), expected), kClose);
}

/// The work offset of a table is right with the table at its work zero.
TEST(TiltedPlane, TheWorkpieceLiesAsTheTableDidAtItsWorkZero) {
  const MachineLog log =
      run_on(kTrunnion, "G90 G00 Z50.\nG68.2 X10. Y20. Z5. I0 J30. K0\nG53.1\nX1. Y2. Z3.\nM30\n",
             "", "[[offset]]\nname = \"G54\"\nX = 1.0\nA = 10.0\nC = 40.0\n");
  ASSERT_EQ(log.alarm, "");
  const Vector at_zero = (Link::shift(11, 20, 5) * Link::turn(0, 30))({1, 2, 3});
  const Vector on_table = kTrunnion.table(10, 40).inverse()(at_zero);
  EXPECT_LT(distance(kTrunnion.tip(log.at(), 0), on_table), kClose);
}

/// After G69 the program's coordinates are the machine's again, wherever the axes are.
TEST(TiltedPlane, EndsWithTheAxesWhereTheyAre) {
  const MachineLog log =
      run_on(kTrunnion,
             "G90 G00 Z50.\nG68.2 X10. Y20. Z5. I0 J30. K0\nG53.1\nX1. Y2. Z3.\nG69\nG91 X1.\n"
             "G90 X0 Y0 Z80.\nM30\n");
  ASSERT_EQ(log.alarm, "");
  const Position before = log.of_line(6).at(0).from;
  expect_axes(log.of_line(6).at(0).to, {{Axis::X, before.raw(Axis::X) + 1},
                                        {Axis::Y, before.raw(Axis::Y)},
                                        {Axis::Z, before.raw(Axis::Z)}});
  expect_axes(log.at(), {{Axis::X, 0}, {Axis::Y, 0}, {Axis::Z, 80}, {Axis::A, 30}});
}

/// Compensation, cycles and corners are those of the plane: on the machine each point is where the
/// untilted program has it, seen from the plane.
TEST(TiltedPlane, CyclesCompensationAndCornersWorkInThePlane) {
  const std::string body =
      "G00 X-10. Y0 Z5.\nG01 Z0 F100.\nG41 D1 X0 Y-5.\nY20. ,R4.\nX30.\nG02 X40. Y10. J-10.\n"
      "G01 Y0 ,C2.\nX50.\nG40 X60.\nG81 G99 X5. Y5. Z-8. R2. F50.\nX15.\nG80\nG00 Z20.\n";
  const std::string tables = "[[tool]]\nnumber = 1\nlength = 40\nradius = 2.5\n";
  const std::string model = "offset_memory = \"C\"\n";
  const MachineLog flat = run_on(kFork, "G90 G43 H1\n" + body + "M30\n", model, tables);
  ASSERT_EQ(flat.alarm, "");
  const MachineLog tilted = run_on(
      kFork, "G90 G43 H1 G00\nG68.2 X5. Y6. Z7. I20. J50. K-10.\nG53.1\n" + body + "G69\nM30\n",
      model, tables);
  ASSERT_EQ(tilted.alarm, "");
  const Link frame =
      Link::shift(5, 6, 7) * Link::turn(2, 20) * Link::turn(0, 50) * Link::turn(2, -10);
  std::size_t next = 1;  // after G53.1
  for (const auto& move : flat.moves) {
    const Vector expected = frame(linear(move.to));
    // an arc is made of pieces
    while (next < tilted.moves.size() &&
           distance(kFork.tip(tilted.moves[next].to, 40), expected) > 1e-6 && move.kind == 'A')
      ++next;
    ASSERT_LT(next, tilted.moves.size());
    EXPECT_LT(distance(kFork.tip(tilted.moves[next].to, 40), expected), 1e-6);
    EXPECT_TRUE(move.kind == tilted.moves[next].kind || move.kind == 'A');
    ++next;
  }
  EXPECT_EQ(next, tilted.moves.size());
}

TEST(TiltedPlane, AStrokeLimitStopsTheMoveOfTheAxesNotThatOfTheProgram) {
  const std::string limits =
      "stroke_limits = [ { X = -500, Y = -500, Z = -60 }, { X = 500, Y = 500, "
      "Z = 500 } ]\n";
  const std::string begin = "G90 G00 Z50.\nG68.2 X0 Y0 Z0 I0 J30. K0\nG53.1\n";
  // the plane's zero comes to Z-40 + 5 sin 30 + 40 cos 30 = -2.859, and its Z is the machine's
  const MachineLog good = run_on(kTrunnion, begin + "G00 X0 Y0 Z-10.\nM30\n", limits);
  EXPECT_EQ(good.alarm, "");
  const MachineLog bad = run_on(kTrunnion, begin + "G00 X0 Y0 Z-80.\nM30\n", limits);
  EXPECT_TRUE(bad.alarm.starts_with("OT500")) << bad.alarm;
  EXPECT_EQ(bad.alarm_line, 4U);
  EXPECT_TRUE(bad.of_line(4).empty());
}

TEST(TiltedPlane, VariablesShowThePlaneAndTheMachine) {
  const MachineLog log =
      run_on(kTrunnion,
             "G90 G00 Z50.\nG68.2 X10. Y20. Z5. I0 J30. K0\nG53.1\nX1. Y2. Z3.\nPOPEN\n"
             "DPRNT[#4016[31]*#5041[33]*#5042[33]*#5043[33]*#5021[33]]\nPCLOS\nM30\n");
  ASSERT_EQ(log.printed.size(), 1U) << log.alarm;
  std::istringstream numbers(log.printed[0]);
  std::vector<double> shown{std::istream_iterator<double>(numbers), {}};
  EXPECT_EQ(shown, (std::vector<double>{68.2, 1, 2, 3, 11})) << log.printed[0];
}

}  // namespace
}  // namespace dripline::interpreter::fanuc
