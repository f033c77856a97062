#include <gtest/gtest.h>
#include <cmath>
#include <random>

#include <fmt/format.h>

#include "tests/unit/clients/tools/post/converted.hpp"

/// Programs that are hard to write as they are, and what becomes of them.
namespace dripline::post {
namespace {

/// 1000 steps of 0.0004 mm: each is shorter than a step of 0.001, all together are not.
TEST(Rounding, DoesNotAddUp) {
  std::string source = "G21 G90 G94\nG0 X0 Y0 Z0\nF100\n";
  for (int i = 1; i <= 1000; ++i)
    source += fmt::format("G1 X{:.4f} Y{:.4f}\n", i * 0.0004, i * 0.0007);
  source += "M2\n";
  const auto converted = convert({"rs274ngc", source}, "fanuc");
  EXPECT_TRUE(converted.is_proved) << converted.reason();
  EXPECT_NE(converted.text.find("X0.4"), std::string::npos);
  EXPECT_NE(converted.text.find("Y0.7\n"), std::string::npos);
  EXPECT_GE(converted.written->adapted.short_moves, 100u);
}

TEST(ShortMoves, AreLeftOutAndCounted) {
  const auto converted =
      convert({"rs274ngc", "G21 G90\nG0 X0 Y0 Z0\nG1 X1 F100\nG1 X1.0003\nG1 X2\nM2\n"}, "fanuc");
  EXPECT_TRUE(converted.is_proved) << converted.reason();
  EXPECT_EQ(converted.written->adapted.short_moves, 1u);
}

/// An arc of less than a step must not become a full circle.
TEST(ShortArcs, NeverBecomeCircles) {
  std::string source = "G21 G90 G94 G17\nG0 X10 Y0 Z0\nF100\n";
  for (const double degrees : {0.001, 0.003, 0.02, 0.5}) {
    const double angle = degrees * Angle::kPi / 180;
    source += fmt::format("G0 X10 Y0\nG3 X{:.8f} Y{:.8f} I-10 J0\n", 10 * std::cos(angle),
                          10 * std::sin(angle));
  }
  source += "M2\n";
  const auto converted = convert({"rs274ngc", source}, "fanuc");
  EXPECT_TRUE(converted.is_proved) << converted.reason() << '\n' << converted.text;
  const auto& adapted = converted.written->adapted;
  EXPECT_EQ(adapted.short_moves, 1u) << converted.text;
  for (const auto& place : converted.result->places) ADD_FAILURE() << place.second_text;
}

/// However lenient the comparison: what is left out is shorter than a step of the control.
TEST(Tolerance, LeavesNoLittleCircleOut) {
  ConversionOptions options;
  options.tolerance = 1;
  const auto converted =
      convert({"rs274ngc", "G21 G90 G17\nG0 X0 Y0 Z0\nG2 X0 Y0 I0.2 J0 F100\nG1 X0.01\nM2\n"},
              "fanuc", options);
  EXPECT_TRUE(converted.is_proved) << converted.reason();
  EXPECT_EQ(converted.written->written.arcs, 1u);
  EXPECT_EQ(converted.written->written.moves, 3u);
  EXPECT_EQ(converted.written->adapted.short_moves, 0u);
}

TEST(FullCircles, StayFullCirclesFromEverySide) {
  std::string source = "G21 G90 G94 G17\nG0 X0 Y0 Z0\nF100\n";
  for (int i = 0; i < 16; ++i) {
    const double angle = i * Angle::kPi / 8 + 0.1;
    source += fmt::format("G0 X{0:.6f} Y{1:.6f}\nG2 X{0:.6f} Y{1:.6f} I{2:.6f} J{3:.6f}\n",
                          7.7 * std::cos(angle), 7.7 * std::sin(angle), -7.7 * std::cos(angle),
                          -7.7 * std::sin(angle));
  }
  source += "M2\n";
  for (const char* target : {"fanuc", "itnc", "tnc155", "linuxcnc"}) {
    ConversionOptions options;
    options.tolerance = 0.002;
    const auto converted = convert({"rs274ngc", source}, target, options);
    EXPECT_TRUE(converted.is_proved) << target << converted.reason();
    EXPECT_EQ(converted.written->written.arcs, 16u);
  }
}

TEST(SeveralTurns, AreWrittenAsFullCircles) {
  const std::string source = "G21 G90 G94 G17\nG0 X10 Y0 Z0\nG3 X0 Y10 Z-6 I-10 J0 P3 F100\nM2\n";
  const Original original{"rs274ngc", source, setup_from("[control]\nprofile = \"linuxcnc\"\n")};
  for (const char* target : {"fanuc", "tnc155", "rs274ngc"}) {
    const auto converted = convert(original, target);
    EXPECT_TRUE(converted.is_proved) << target << ' ' << converted.reason() << converted.text;
    EXPECT_EQ(converted.written->written.arcs, 3u);
    EXPECT_EQ(converted.written->adapted.split_arcs, 1u);
  }
}

TEST(ArcsAsLines, StayWithinTheirTolerance) {
  const std::string source =
      "G21 G90 G94\nG00 X0 Y0 Z0\nG18 G02 X10. Z10. I10. F100.\nG17 G01 X20.\nM30\n";
  ConversionOptions options;
  options.chord = 0.01;
  const auto converted = convert({"fanuc", source}, "tnc155", options);
  EXPECT_TRUE(converted.is_proved) << converted.reason();
  EXPECT_EQ(converted.written->adapted.arcs_as_lines, 1u);
  // Three quarters of radius 10 within 0.01: 2 acos(1 - 0.001) a chord.
  const double chords = std::ceil(3 * Angle::kPi / 2 / (2 * std::acos(1 - 0.001)));
  EXPECT_EQ(converted.written->written.moves, static_cast<std::uint64_t>(chords) + 2);
}

/// The written lines against the true arc, by their text: the comparison shares the stage that
/// makes them.
TEST(ArcsAsLines, LieOnTheArc) {
  const std::string source = "G21 G90 G94\nG00 X0 Y0 Z0\nG18 G02 X10. Z10. I10. F100.\nM30\n";
  ConversionOptions options;
  options.chord = 0.02;
  const auto converted = convert({"fanuc", source}, "tnc155", options);
  ASSERT_TRUE(converted.is_proved) << converted.reason();
  double x = 0, z = 0;
  int points = 0;
  for (std::size_t at = converted.text.find(" L "); at != std::string::npos;
       at = converted.text.find(" L ", at + 1)) {
    std::string line = converted.text.substr(at, converted.text.find('\r', at) - at);
    for (char& c : line) c = c == ',' ? '.' : c;
    const double last_x = x, last_z = z;
    if (const auto i = line.find("X"); i != std::string::npos) x = std::stod(line.substr(i + 1));
    if (const auto i = line.find("Z"); i != std::string::npos) z = std::stod(line.substr(i + 1));
    if (line.find("FMAX") != std::string::npos || line.find(" M") != std::string::npos) continue;
    ++points;
    EXPECT_NEAR(std::hypot(x - 10, z), 10, 0.001) << line;
    EXPECT_GE(std::hypot((x + last_x) / 2 - 10, (z + last_z) / 2), 10 - 0.0215) << line;
  }
  EXPECT_GT(points, 8);
  EXPECT_EQ(x, 10);
  EXPECT_EQ(z, 10);
}

TEST(Arcs, ThatCannotBeRoundedAreRefusedWithTheDeviation) {
  ConversionOptions options;
  options.tolerance = 0.0001;  // less than the step of the target
  const auto converted = convert(
      {"rs274ngc", "G21 G90\nG0 X10.0005 Y0.0004 Z0\nG2 X0.0003 Y10.0001 I-10 J0.0002 F100\nM2\n"},
      "fanuc", options);
  EXPECT_FALSE(converted.is_proved);
  EXPECT_TRUE(converted.reason().starts_with("line 3: arc of ")) << converted.reason();
  EXPECT_NE(converted.reason().find("mm off, the tolerance is 0.0001 mm"), std::string::npos)
      << converted.reason();
}

struct Feature {
  const char* name;
  const char* control;
  const char* text;
};
class Features : public testing::TestWithParam<Feature> {};

TEST_P(Features, BecomeMotion) {
  for (const char* target : {"fanuc", "itnc", "rs274ngc", "linuxcnc", "tnc155"}) {
    ConversionOptions options;
    options.tolerance = 0.002;
    const auto converted = convert({GetParam().control, GetParam().text}, target, options);
    EXPECT_TRUE(converted.is_proved) << target << ": " << converted.reason() << '\n'
                                     << converted.text;
  }
}

INSTANTIATE_TEST_SUITE_P(
    , Features,
    testing::Values(
        Feature{"incremental", "fanuc",
                "G21 G90 G00 X10. Y10. Z5.\nG91 G01 X5. F100.\nY5.\nG90 X0\nM30\n"},
        Feature{"machine_coordinates", "fanuc",
                "G21 G90 G00 X10. Y10. Z5.\nG53 G00 Z0\nG53 X0 Y0\nG01 X5. F100.\nM30\n"},
        Feature{"rotated", "fanuc",
                "G21 G90 G00 X0 Y0 Z5.\nG68 X0 Y0 R30.\nG01 X10. F100.\nG02 X20. Y0 R5.\nG69\n"
                "G00 X0 Y0\nM30\n"},
        Feature{
            "scaled", "fanuc",
            "G21 G90 G00 X0 Y0 Z5.\nG51 X0 Y0 Z0 P1500\nG01 X10. Y4. F100.\nG50\nG00 X0 Y0 Z5.\n"
            "M30\n"},
        Feature{"mirrored", "tnc155",
                "0 BEGIN PGM 1 MM\n1 TOOL CALL Z\n2 L X+0 Y+0 Z+5 R0 FMAX\n"
                "3 CYCL DEF 8.0 MIRROR IMAGE\n4 CYCL DEF 8.1 X\n5 L X+10 R0 F100\n"
                "6 CC X+10 Y+5\n7 C X+10 Y+10 DR+\n8 END PGM 1 MM\n"},
        Feature{
            "compensated", "tnc155",
            "0 BEGIN PGM 1 MM\n1 TOOL DEF 1 L+0 R+5\n2 TOOL CALL 1 Z S800\n"
            "3 L X-20 Y-20 Z+5 R0 FMAX M3\n4 L X+0 Y+0 RL F200\n5 L Y+30\n6 L X+40 Y+30\n7 RND R4\n"
            "8 L X+40 Y+0\n9 L X+0\n10 L X-20 Y-20 R0 FMAX\n11 END PGM 1 MM\n"},
        Feature{"cycle", "fanuc",
                "G21 G90 G00 X0 Y0 Z20.\nG99 G83 X10. Y10. R2. Z-12. Q4. F80.\nX20.\nG80\nM30\n"},
        Feature{"subprogram", "fanuc",
                "O1\nG21 G90 G00 X0 Y0 Z5.\nM98 P2 L3\nM30\nO2\nG91 G01 X3. F100.\nG90\nM99\n"},
        Feature{"tools", "fanuc",
                "G21 G90\nT1 M06\nS900 M03\nG00 X0 Y0 Z5.\nM05\nT2 M06\nS500 M04\nG00 X5. Y5. "
                "Z5.\nM05\nM30\n"},
        Feature{"inches", "fanuc", "G20 G90 G00 X1. Y1. Z.5\nG01 X2.0625 F20.\nM30\n"},
        Feature{"inverse_time", "rs274ngc",
                "G21 G90 G0 X0 Y0 Z0\nG93 G1 X10 F5\nG1 X20 F10\nG94 G1 X0 F100\nM2\n"},
        Feature{"zero_length", "fanuc",
                "G21 G90 G00 X1. Y1. Z1.\nG01 X1. F100.\nX2.\nX2. Y1.\nM30\n"},
        Feature{"off_at_first", "fanuc", "M05\nM09\nG21 G90 G00 X1. Y1.\nM05\nM30\n"},
        Feature{"end_without_off", "fanuc", "G21 G90\nS100 M03\nM08\nG00 X1. Y1.\nM30\n"}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(ToolChange, StartsASpindleAgainThatTheTargetStops) {
  const std::string source = "G21 G90\nT1 M06\nS900 M03\nG00 X0 Y0 Z5.\nT2 M06\nG00 X5. Y5.\nM30\n";
  const auto converted = convert({"fanuc", source}, "rs274ngc");
  EXPECT_TRUE(converted.is_proved) << converted.reason() << converted.text;
  EXPECT_EQ(converted.written->adapted.spindle_restarts, 1u);
  EXPECT_NE(converted.text.find("M5\nT2 M6\nS900 M3\n"), std::string::npos) << converted.text;
}

TEST(TargetSetup, WorkOffsetsAreTakenOutOfCoordinates) {
  const std::string source = "G21 G90 G00 X10. Y20. Z5.\nG01 X12. F100.\nM30\n";
  ConversionOptions options;
  options.target_setup = setup_from("[[offset]]\nname = \"G54\"\nX = 100.0\nY = -50.0\nZ = 7.0\n");
  for (const char* target : {"fanuc", "rs274ngc"}) {
    const auto converted = convert({"fanuc", source}, target, options);
    EXPECT_TRUE(converted.is_proved) << target << converted.reason();
    EXPECT_NE(converted.text.find("X-90"), std::string::npos) << converted.text;
    EXPECT_NE(converted.text.find("Y70"), std::string::npos) << converted.text;
    EXPECT_NE(converted.text.find("Z-2"), std::string::npos) << converted.text;
  }
}

/// The comparison is the judge: a text that was changed after it was written is no proof.
TEST(Prove, FindsAChangedNumber) {
  const std::string source = "G21 G90 G00 X10. Y20. Z5.\nG01 X12. F100.\nM30\n";
  const auto converted = convert({"fanuc", source}, "rs274ngc");
  ASSERT_TRUE(converted.is_proved);
  struct Change {
    const char *from, *to;
  };
  for (const auto& [from, to] : {Change{"X12", "X12.001"}, Change{"F100", "F101"},
                                 Change{"G1 ", "G0 "}, Change{"M2\n", "M0\nM2\n"}}) {
    std::string changed = converted.text;
    const auto at = changed.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    changed.replace(at, std::string_view(from).size(), to);
    interpreter::MemorySource first(source), second(changed);
    const interpreter::Setup setup;
    const auto result = prove({**interpreter::find_dialect("fanuc"), setup, first, source},
                              *converted.written, second, {});
    ASSERT_TRUE(result);
    EXPECT_FALSE(result->is_same) << from;
  }
}

/// Polygons and arcs off every grid, there and back again: within a step of each control.
TEST(RandomPrograms, AreProvedOrRefused) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-50, 50), angle(0.2, 6.0);
  int proved = 0;
  constexpr int kPrograms = 40;
  for (int i = 0; i < kPrograms; ++i) {
    std::string source = "G21 G90 G94 G17 G0 X0 Y0 Z0\nF250\n";
    double x = 0, y = 0;
    for (int k = 0; k < 20; ++k) {
      if (k % 3 == 2) {
        const double cx = x + place(random) / 5 + 0.6, cy = y + place(random) / 5;
        const double sweep = angle(random), c = std::cos(sweep), s = std::sin(sweep);
        const double dx = x - cx, dy = y - cy;
        const double to_x = cx + c * dx - s * dy, to_y = cy + s * dx + c * dy;
        source += fmt::format("G3 X{:.7f} Y{:.7f} I{:.7f} J{:.7f}\n", to_x, to_y, -dx, -dy);
        x = to_x;
        y = to_y;
      } else {
        x = place(random);
        y = place(random);
        source += fmt::format("G1 X{:.7f} Y{:.7f} Z{:.7f}\n", x, y, place(random));
      }
    }
    source += "M2\n";
    ConversionOptions options;
    options.tolerance = 0.0025;
    for (const char* target : {"fanuc", "tnc155"}) {
      const auto converted = convert({"rs274ngc", source}, target, options);
      proved += converted.is_proved ? 1 : 0;
      if (!converted.is_proved) {
        EXPECT_TRUE(converted.refusal) << converted.reason() << '\n' << source;
      }
    }
  }
  EXPECT_GT(proved, kPrograms);
}

}  // namespace
}  // namespace dripline::post
