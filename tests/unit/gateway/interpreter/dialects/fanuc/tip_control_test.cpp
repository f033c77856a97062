#include <gtest/gtest.h>

#include <random>

#include "tests/unit/gateway/interpreter/dialects/fanuc/tilting_machine.hpp"

/// FAN-104, G43.4: the tip goes straight from point to point of the workpiece while the rotary axes
/// turn.
namespace dripline::interpreter::fanuc {
namespace {

constexpr double kTolerance = 0.005;
const std::string kTool = "[[tool]]\nnumber = 1\nlength = 87.5\n";

/// Of the segment from a to b.
double distance_from(const Vector& a, const Vector& b, const Vector& p) {
  const Vector along{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const double square = along[0] * along[0] + along[1] * along[1] + along[2] * along[2];
  double part = 0;
  if (square > 0) {
    part =
        ((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1] + (p[2] - a[2]) * along[2]) / square;
    part = std::min(1.0, std::max(0.0, part));
  }
  return distance(p, {a[0] + part * along[0], a[1] + part * along[1], a[2] + part * along[2]});
}

Position between(const Position& from, const Position& to, double part) {
  Position at = to;
  for (const Axis axis : kAllAxes)
    at.set_raw(axis, from.raw(axis) + part * (to.raw(axis) - from.raw(axis)));
  return at;
}

/// A quarter of C under a tip that rests at (112, 8, 0), 100 from the axis of C: the trunnion's
/// table rotates clockwise, the point and the axes with it go to (12, 8 - 100).
TEST(TipControl, OnATrunnionTheLinearAxesFollowTheTable) {
  const MachineLog log = run_on(kTrunnion, "G90 G00 X112. Y8. Z0\nG43.4 H1\nG01 C90. F500.\nM30\n");
  ASSERT_EQ(log.alarm, "");
  EXPECT_NEAR(log.at().raw(Axis::X), 12, kClose);
  EXPECT_NEAR(log.at().raw(Axis::Y), -92, kClose);
  EXPECT_NEAR(log.at().raw(Axis::Z), 0, kClose);
  EXPECT_NEAR(log.at().raw(Axis::C), 90, kClose);
}

/// A by 90 about Y5 Z-40: the point (0, 5, 60) is 100 above it and goes to Y5 + 100.
TEST(TipControl, OnATrunnionTheTiltTurnsAboutItsOwnAxis) {
  const MachineLog log = run_on(kTrunnion, "G90 G00 Y5. Z60.\nG43.4 H1\nG01 A90. F500.\nM30\n");
  ASSERT_EQ(log.alarm, "");
  EXPECT_NEAR(log.at().raw(Axis::Y), 105, kClose);
  EXPECT_NEAR(log.at().raw(Axis::Z), -40, kClose);
}

/// B by 90 with a tool of 87.5: 237.5 from the axis, which is 3 beside the spindle.
TEST(TipControl, OnAHeadTheToolTurnsAboutItsTip) {
  const MachineLog log =
      run_on(kMixed, "G90 G00 X10. Y0 Z20.\nG43.4 H1\nG01 B90. F500.\nM30\n", "", kTool);
  ASSERT_EQ(log.alarm, "");
  EXPECT_NEAR(log.at().raw(Axis::X), 10 + 237.5 - 3, kClose);
  EXPECT_NEAR(log.at().raw(Axis::Z), 20 - 237.5 - 3, kClose);
}

/// A90 lays the tool along -Y: its tip is 267.5 from the axis of A; C180 rotates the fork by half a
/// turn.
TEST(TipControl, OnAForkBothAxesTurnTheTool) {
  const MachineLog log =
      run_on(kFork, "G90 G00 X0 Y0 Z0\nG43.4 H1\nG01 A90. C180. F500.\nM30\n", "", kTool);
  ASSERT_EQ(log.alarm, "");
  // gauge to tip: A rotates (0,-4,-267.5) to (0, 267.5,-4), at (0, 271.5, 176); C rotates that
  // about (2, -1.5) to (4, -3 - 271.5, 176)
  EXPECT_NEAR(log.at().raw(Axis::X), -4, kClose);
  EXPECT_NEAR(log.at().raw(Axis::Y), 274.5, kClose);
  EXPECT_NEAR(log.at().raw(Axis::Z), -176 - 87.5, kClose);
}

struct MachineCase {
  const char* name;
  const TestMachine* machine;
  const char* rotary[2];
};
class TipControlMachines : public testing::TestWithParam<MachineCase> {};

/// Over random moves: the tip ends on the point with the angles as programmed, no piece begins
/// elsewhere than the last one ended, and between them, between the ends of the pieces too, the tip
/// is within the tolerance of its straight path and never goes back.
TEST_P(TipControlMachines, KeepTheTipOnAStraightPath) {
  const MachineCase& each = GetParam();
  const TestMachine& machine = *each.machine;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(-100, 100), place(-60, 60);
  const auto rounded = [](double value) { return std::round(value * 1000) / 1000; };
  std::string program = "G90 G00 X1. Y2. Z30.\nG43.4 H1 X0 Y0 Z20.\nG01 F800.\n";
  std::vector<std::array<double, 5>> targets;
  for (int n = 0; n < 25; ++n) {
    const std::array<double, 5> to{rounded(place(random)), rounded(place(random)),
                                   rounded(place(random)), rounded(angle(random)),
                                   rounded(angle(random))};
    targets.push_back(to);
    char block[160];
    std::snprintf(block, sizeof block, "%s X%.3f Y%.3f Z%.3f %s%.3f %s%.3f\n",
                  n % 3 == 0 ? "G00" : "G01", to[0], to[1], to[2], each.rotary[0], to[3],
                  each.rotary[1], to[4]);
    program += block;
  }
  const MachineLog log = run_on(machine, program + "M30\n", "",
                                kTool + "[[offset]]\nname = \"G54\"\nX = 5.0\nY = -6.0\nZ = 7.0\n");
  ASSERT_EQ(log.alarm, "");
  Vector from{5, -6, 27};
  for (std::size_t n = 0; n < targets.size(); ++n) {
    const auto moves = log.of_line(4 + n);
    ASSERT_FALSE(moves.empty());
    const Vector to{targets[n][0] + 5, targets[n][1] - 6, targets[n][2] + 7};
    double traveled = -kTolerance;
    for (const auto& move : moves) {
      EXPECT_EQ(move.kind, n % 3 == 0 ? 'R' : 'L');
      for (int step = 1; step <= 8; ++step) {
        const Vector tip = machine.tip(between(move.from, move.to, step / 8.0), 87.5);
        ASSERT_LE(distance_from(from, to, tip), kTolerance + kClose) << n;
        ASSERT_GT(distance(from, tip), traveled - 2 * kTolerance) << n;
        traveled = distance(from, tip);
      }
      EXPECT_EQ(move.rests, n % 3 == 0 && &move == &moves.back());
    }
    EXPECT_LT(distance(machine.tip(log.of_line(4 + n).back().to, 87.5), to), kClose);
    EXPECT_NEAR(moves.back().to.raw(machine.master), targets[n][3], kClose);
    EXPECT_NEAR(moves.back().to.raw(machine.slave), targets[n][4], kClose);
    from = to;
  }
}

/// F is the speed of the tip: the pieces of a move take the time of its path.
TEST_P(TipControlMachines, TakeTheTimeOfTheTipsPath) {
  const MachineCase& each = GetParam();
  const MachineLog log =
      run_on(*each.machine,
             "G90 G00 Z30.\nG43.4 H1\nG01 X30. Y40. " + std::string(each.rotary[0]) + "20. " +
                 each.rotary[1] + "70. F100.\nX0 Y0 F200.\nM30\n",
             "", kTool);
  ASSERT_EQ(log.alarm, "");
  double minutes = 0;
  const auto moves = log.of_line(3);
  EXPECT_GT(moves.size(), 10U);
  for (const auto& move : moves) {
    ASSERT_EQ(move.feed.per(), Feed::Per::Move);
    minutes += 1 / move.feed.moves_per_minute();
  }
  EXPECT_NEAR(minutes, 0.5, 1e-9);
  const auto straight = log.of_line(4);
  ASSERT_EQ(straight.size(), 1U);
  EXPECT_EQ(straight[0].feed, Feed::per_minute(Length::mm(200)));
}

INSTANTIATE_TEST_SUITE_P(, TipControlMachines,
                         testing::Values(MachineCase{"trunnion", &kTrunnion, {"A", "C"}},
                                         MachineCase{"mixed", &kMixed, {"B", "C"}},
                                         MachineCase{"fork", &kFork, {"C", "A"}}),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(TipControl, AFinerToleranceMakesMorePieces) {
  const std::string program = "G90 G00 X112. Y8. Z0\nG43.4 H1\nG01 C90. F500.\nM30\n";
  const auto coarse = run_on(kTrunnion, program, "tip_tolerance = 0.1\n").of_line(3);
  const auto fine = run_on(kTrunnion, program, "tip_tolerance = 0.001\n").of_line(3);
  EXPECT_GT(fine.size(), 9 * coarse.size());
  double most = 0;
  for (const auto& move : fine) {
    most =
        std::max(most, distance(kTrunnion.tip(between(move.from, move.to, 0.5), 0), {112, 8, 0}));
  }
  EXPECT_LE(most, 0.001);
}

/// The rotary axes turn at F where the tip rests: 90 degrees at 45 a minute, also in inches.
TEST(TipControl, WhereTheTipRestsFIsInDegrees) {
  for (const char* units : {"G21", "G20"}) {
    const auto moves =
        run_on(kTrunnion, std::string(units) + " G90 G43.4 H1\nG01 C90. F45.\nM30\n").of_line(2);
    double minutes = 0;
    for (const auto& move : moves) minutes += 1 / move.feed.moves_per_minute();
    EXPECT_NEAR(minutes, 2, 1e-9) << units;
  }
}

TEST(TipControl, InG93AllPiecesTogetherAreOneMove) {
  const auto moves = run_on(kTrunnion, "G90 G93 G43.4 H1\nG01 X50. C90. F4.\nM30\n").of_line(2);
  ASSERT_GT(moves.size(), 1U);
  double minutes = 0;
  for (const auto& move : moves) minutes += 1 / move.feed.moves_per_minute();
  EXPECT_NEAR(minutes, 0.25, 1e-9);
}

TEST(TipControl, IncrementsCountFromTheTip) {
  const MachineLog log = run_on(
      kTrunnion, "G90 G00 X10. Y20. Z30.\nG43.4 H1\nG01 A30. C40. F500.\nG91 X5. Y6. Z7.\nM30\n");
  ASSERT_EQ(log.alarm, "");
  EXPECT_LT(distance(kTrunnion.tip(log.at(), 0), {15, 26, 37}), kClose);
}

/// G49 leaves the axes where they are; from there on the coordinates are the machine's.
TEST(TipControl, EndsWithTheAxesWhereTheyAre) {
  const MachineLog log =
      run_on(kTrunnion, "G90 G00 X10.\nG43.4 H1\nG01 A30. C40. F500.\nG49\nG91 G00 X1.\nM30\n");
  ASSERT_EQ(log.alarm, "");
  EXPECT_TRUE(log.of_line(4).empty());
  const auto move = log.of_line(5).at(0);
  EXPECT_NEAR(move.to.raw(Axis::X), move.from.raw(Axis::X) + 1, kClose);
  EXPECT_NEAR(move.to.raw(Axis::Z), move.from.raw(Axis::Z), kClose);
}

/// Begun with the table at C30: by default the work offset is that of C0, by option that of C30.
TEST(TipControl, TheTablesFrameIsItsZeroOrItsStart) {
  const std::string program = "G90 G00 C30.\nG43.4 H1\nG01 X50. Y0 Z0 F500.\nM30\n";
  const MachineLog zero = run_on(kTrunnion, program);
  EXPECT_LT(distance(kTrunnion.tip(zero.at(), 0), {50, 0, 0}), kClose);
  const MachineLog start = run_on(kTrunnion, program, "table_frame = \"start\"\n");
  EXPECT_NEAR(start.at().raw(Axis::X), 50, kClose);
  EXPECT_NEAR(start.at().raw(Axis::Y), 0, kClose);
}

/// Nothing of a move goes out that would leave the limits between its ends, though its ends are
/// good.
TEST(TipControl, ALimitOnTheWayStopsTheMoveBeforeItBegins) {
  const MachineLog log = run_on(
      kTrunnion, "G90 G00 X112. Y8. Z0\nG43.4 H1\nG01 C180. F500.\nM30\n",
      "stroke_limits = [ { X = -200, Y = -50, Z = -200 }, { X = 200, Y = 200, Z = 200 } ]\n");
  EXPECT_TRUE(log.alarm.starts_with("OT500")) << log.alarm;
  EXPECT_EQ(log.alarm_line, 3U);
  EXPECT_TRUE(log.of_line(3).empty());
}

TEST(TipControl, ALimitOfARotaryAxisIsAnAlarm) {
  const MachineLog log = run_on(kTrunnion, "G90 G43.4 H1\nG01 A121. F500.\nM30\n",
                                "rotary_limits = [ { A = -30 }, { A = 120 } ]\n");
  EXPECT_TRUE(log.alarm.starts_with("OT500")) << log.alarm;
  const MachineLog plain =
      run_on(kTrunnion, "G90 G00 A121.\nM30\n", "rotary_limits = [ { A = -30 }, { A = 120 } ]\n");
  EXPECT_TRUE(plain.alarm.starts_with("OT500")) << plain.alarm;
}

TEST(TipControl, APathOfTooManyPiecesIsAnAlarm) {
  const MachineLog log = run_on(kTrunnion, "G90 G43.4 H1\nG01 X90000. C99999. F500.\nM30\n");
  EXPECT_TRUE(log.alarm.starts_with("PS5421")) << log.alarm;
  EXPECT_TRUE(log.moves.empty());
}

/// G43.5: I, J, K of any length are the tool's direction on the workpiece, whatever axes make it.
TEST_P(TipControlMachines, BringTheToolAlongAVector) {
  const TestMachine& machine = *GetParam().machine;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> part(-1, 1);
  for (int n = 0; n < 100; ++n) {
    const Vector wanted{std::round(part(random) * 1e6) / 1e6, std::round(part(random) * 1e6) / 1e6,
                        std::round(part(random) * 1e6) / 1e6};
    const double size = distance(wanted, {0, 0, 0});
    if (size < 0.01) continue;
    char block[120];
    std::snprintf(block, sizeof block, "X10. Y20. Z5. I%.6f J%.6f K%.6f\n", wanted[0], wanted[1],
                  wanted[2]);
    const MachineLog log =
        run_on(machine,
               std::string("G90 G00 Z30.\nG43.5 H1\nG01 F500.\n") + block + "I0.5 K1.\nX20.\nM30\n",
               "", kTool);
    ASSERT_EQ(log.alarm, "") << block;
    const Position at = log.of_line(4).back().to;
    EXPECT_LT(distance(machine.tip(at, 87.5), {10, 20, 5}), kClose);
    EXPECT_LT(
        distance(machine.direction(at), {wanted[0] / size, wanted[1] / size, wanted[2] / size}),
        kClose);
    const Position turned = log.of_line(5).back().to;
    EXPECT_LT(distance(machine.tip(turned, 87.5), {10, 20, 5}), kClose) << "the tip rests";
    const double half = std::sqrt(1.25);
    EXPECT_LT(distance(machine.direction(log.at()), {0.5 / half, 0, 1 / half}), kClose);
  }
}

struct TipRefusal {
  const char* name;
  std::string blocks;  ///< the last one is refused
  const char* word;
};
class TipControlRefuses : public testing::TestWithParam<TipRefusal> {};

TEST_P(TipControlRefuses, WithTheLineAndTheReason) {
  const std::string& blocks = GetParam().blocks;
  const MachineLog log = run_on(kTrunnion, "G90 G01 X1. Y1. Z50. F100.\n" + blocks + "\nM30\n",
                                "offset_memory = \"C\"\n", "[[tool]]\nnumber = 1\nradius = 2\n");
  EXPECT_TRUE(log.alarm.starts_with("PS5421")) << log.alarm;
  EXPECT_NE(log.alarm.find(GetParam().word), std::string::npos) << log.alarm;
  EXPECT_EQ(log.alarm_line,
            2U + static_cast<std::uint64_t>(std::count(blocks.begin(), blocks.end(), '\n')));
}

const std::string kInTipControl = "G43.4 H1\n";
INSTANTIATE_TEST_SUITE_P(
    , TipControlRefuses,
    testing::Values(TipRefusal{"no_number", "G43.4 Z10.", "H is needed"},
                    TipRefusal{"posture", "G43.4 H1 P1", "P1"},
                    TipRefusal{"direction_by_a_vector", kInTipControl + "X5. I0 J0 K1.", "G43.5"},
                    TipRefusal{"in_rotation", "G68 X0 Y0 R30.\nG43.4 H1", "G68"},
                    TipRefusal{"in_polar", "G16\nG43.4 H1", "G16"},
                    TipRefusal{"in_cycle", "G81 Z-5. R2.\nG43.4 H1", "hole cycle"},
                    TipRefusal{"in_compensation", "G41 D1 X5.\nG43.4 H1", "compensation"},
                    TipRefusal{"in_feed_per_revolution", "G95 F1.\nG43.4 H1", "per revolution"},
                    TipRefusal{"with_a_return", "G43.4 H1 G28 Z0", "this G code"},
                    TipRefusal{"with_a_cycle", "G43.4 H1 G81 Z-5. R2.", "hole cycle"},
                    TipRefusal{"itself", kInTipControl + "G43.4 H1", "G43.4"},
                    TipRefusal{"another_length", kInTipControl + "G43 H1", "G43"},
                    TipRefusal{"another_number", kInTipControl + "G01 X1. H2", "H while"},
                    TipRefusal{"arc", kInTipControl + "G02 X5. R10.", "G00 and G01"},
                    TipRefusal{"thread", kInTipControl + "G33 Z5. F1.", "G00 and G01"},
                    TipRefusal{"cycle", kInTipControl + "G81 Z-5. R2.", "hole cycle"},
                    TipRefusal{"compensation", kInTipControl + "G41 D1 X5.", "compensation"},
                    TipRefusal{"corner", kInTipControl + "X5. ,R2.", "corner"},
                    TipRefusal{"polar", kInTipControl + "G16", "G16"},
                    TipRefusal{"rotation", kInTipControl + "G68 X0 Y0 R5.", "G68"},
                    TipRefusal{"scaling", kInTipControl + "G51 P2.", "G51"},
                    TipRefusal{"work_system", kInTipControl + "G55", "work system"},
                    TipRefusal{"work_system_before_a_call", kInTipControl + "G55 G65 P9001",
                               "work system"},
                    TipRefusal{"reference", kInTipControl + "G28 Z0", "this G code"},
                    TipRefusal{"machine_coordinates", kInTipControl + "G53 Z0", "this G code"},
                    TipRefusal{"skip", kInTipControl + "G31 Z0", "this G code"},
                    TipRefusal{"feed_per_revolution", kInTipControl + "G95 F1.", "per revolution"},
                    TipRefusal{"direction", kInTipControl + "G53.1", "G53.1"},
                    TipRefusal{"rotary_word_by_vector", "G43.5 H1\nX1. A5.", "rotary word"},
                    TipRefusal{"inclination", "G43.5 H1\nX1. Q5. I0 J0 K1.", "Q while G43.5"},
                    TipRefusal{"no_vector", "G43.5 H1\nX1. I0 J0 K0", "no direction"},
                    TipRefusal{"quill", kInTipControl + "G01 X5. W-3.", "in no kinematics"},
                    TipRefusal{"quill_at_the_start", "G43.4 H1 W-5. Z0", "in no kinematics"},
                    TipRefusal{"quill_by_vector", "G43.5 H1\nG01 I1. K1. U4.", "in no kinematics"},
                    TipRefusal{"quill_before", "G01 W-5.\nG43.4 H1", "not at 0"},
                    TipRefusal{"units", kInTipControl + "G20", "units"}),
    [](const auto& each) { return std::string(each.param.name); });

/// Snapshots between any two blocks: the rest of the program does the same.
TEST(TipControl, ContinuesFromEverySnapshot) {
  const std::string program =
      "G90 G00 X10. Y20. Z30.\nG43.4 H1\nG01 A30. C40. F500.\nX5.\nG49\n"
      "G68.2 X1. Y2. Z3. I10. J20. K30.\nG53.1\nG01 X4. Y5.\nG02 X8. Y9. R10.\nG69\nG00 "
      "Z50.\nM30\n";
  const auto setup =
      parse_setup("[control]\n" + kTrunnion.control + "[[tool]]\nnumber = 1\nlength = 9\n");
  ASSERT_TRUE(setup);
  const MachineLog whole = run_on(kTrunnion, program, "", "[[tool]]\nnumber = 1\nlength = 9\n");
  ASSERT_EQ(whole.alarm, "");
  for (std::uint64_t blocks = 1; blocks < 12; ++blocks) {
    MachineLog first, second;
    MemorySource source(program);
    auto begun = kFanucDialect.make(*setup, source, first);
    ASSERT_EQ((*begun)->step(blocks), StepState::Ran);
    const Snapshot snapshot = (*begun)->snapshot();
    auto resumed = kFanucDialect.make(*setup, source, second);
    ASSERT_TRUE((*resumed)->restore(snapshot));
    EXPECT_EQ((*resumed)->snapshot().digest(), snapshot.digest());
    ASSERT_EQ((*resumed)->step(100), StepState::Ended);
    ASSERT_EQ(first.moves.size() + second.moves.size(), whole.moves.size());
    for (std::size_t n = 0; n < second.moves.size(); ++n)
      EXPECT_EQ(second.moves[n].to, whole.moves[first.moves.size() + n].to) << blocks;
    // on a machine without kinematics the snapshot is damage, not a tilted plane
    const auto plain = parse_setup("");
    auto other = kFanucDialect.make(*plain, source, second);
    const bool is_tilted = (blocks >= 2 && blocks < 5) || (blocks >= 6 && blocks < 10);
    EXPECT_EQ((*other)->restore(snapshot).has_value(), !is_tilted) << blocks;
  }
}

}  // namespace
}  // namespace dripline::interpreter::fanuc
