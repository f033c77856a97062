#include <fmt/core.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/core/program_source.hpp"

/// The probing macros of deploy/macros on a simulated control and workpiece. The simulated probe
/// has no ball: a surface is where the center of the ball would be when it touches.
namespace dripline::interpreter {
namespace {

constexpr double kMicrometer = 0.001;
constexpr double kBall = 3;

std::optional<std::string> macro_text(std::string_view name) {
  std::ifstream file("deploy/macros/" + std::string(name) + ".nc", std::ios::binary);
  if (!file) return std::nullopt;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// What the program put out, and what it ended with.
class Report final : public EventSink {
 public:
  void on_output(const Output& event) override { lines.emplace_back(event.text); }
  void on_alarm(const Alarm& event) override {
    alarm = fmt::format("{} {}", event.diagnostic.id, event.diagnostic.text);
  }
  void on_line(const Line& event) override { at = event.to; }
  void on_rapid(const Rapid& event) override { at = event.to; }
  void on_probe(const Probe& event) override {
    if (event.result) at = event.result->at;
  }

  std::vector<std::string> lines;
  std::string alarm;
  Position at;
};

/// A line of the report. Blanks may stand between a sign and its number.
struct Value {
  std::string name;
  int feature = 0;
  double nominal = 0, actual = 0, deviation = 0;
  int is_out = 0;
};

double number_after(const std::string& line, std::string_view word) {
  const auto at = line.find(word);
  if (at == std::string::npos) return 1e9;
  std::string digits;
  for (const char c : line.substr(at + word.size())) {
    if (c >= 'A' && c <= 'Z') break;
    if (c != ' ') digits += c;
  }
  return std::atof(digits.c_str());
}

Value value_of(const std::string& line) {
  return {line.substr(0, 1),         static_cast<int>(number_after(line, line.substr(0, 1))),
          number_after(line, "NOM"), number_after(line, "ACT"),
          number_after(line, "DEV"), static_cast<int>(number_after(line, "OUT"))};
}

struct ProbeSetup {
  std::string surfaces;
  std::string start = "{ X = 0.0, Y = 0.0, Z = 0.0 }";
  std::string more = "";
  std::string ball = fmt::format("[[variable]]\nname = \"#520\"\nvalue = {:.1f}\n", kBall);
};

Report run(const ProbeSetup& probing, const std::string& blocks) {
  const Dialect* control = *find_dialect("fanuc");
  const auto setup =
      parse_setup(fmt::format("start = {}\n{}{}[probe]\nsurface = [{}]\n", probing.start,
                              probing.more, probing.ball, probing.surfaces),
                  control->units);
  Report report;
  if (!setup) {
    report.alarm = setup.error().what;
    return report;
  }
  const std::string text = "%\nO0001\nG21G90G40G49G80\nPOPEN\n" + blocks + "\nPCLOS\nM30\n%\n";
  MemorySource source(text, macro_text);
  const auto outcome = run_offline(*control, *setup, source, report);
  if (!outcome) report.alarm = outcome.error().what;
  return report;
}

void expect_value(const std::string& line, const Value& expected) {
  const Value value = value_of(line);
  EXPECT_EQ(value.name, expected.name) << line;
  EXPECT_EQ(value.feature, expected.feature) << line;
  EXPECT_NEAR(value.nominal, expected.nominal, kMicrometer / 2) << line;
  EXPECT_NEAR(value.actual, expected.actual, kMicrometer) << line;
  EXPECT_NEAR(value.deviation, expected.actual - expected.nominal, kMicrometer) << line;
  EXPECT_EQ(value.is_out, expected.is_out) << line;
}

std::string plane(char axis, double at) {
  return fmt::format("{{ axis = \"{}\", at = {:.6f} }}", axis, at);
}
std::string cylinder(double x, double y, double radius) {
  return fmt::format(
      "{{ cylinder = {{ center = {{ X = {:.6f}, Y = {:.6f} }}, radius = {:.6f} }} }}", x, y,
      radius);
}

TEST(ProbingMacros, SurfaceAlongXIsReportedWithTheBall) {
  const Report report =
      run({plane('X', 25.012 - kBall), "{ X = 10.0, Y = 4.0, Z = -2.0 }"}, "G65P9711X25.S7.H.01");
  ASSERT_EQ(report.alarm, "");
  ASSERT_EQ(report.lines.size(), 2u);
  EXPECT_EQ(report.lines[0].substr(0, 7), "SURFACE");
  expect_value(report.lines[1], {"X", 7, 25, 25.012, 0, 1});
  EXPECT_NEAR(report.at.linear(Axis::X).mm(), 10, kMicrometer) << "back at the start";
}

TEST(ProbingMacros, SurfaceAlongYFromThePositiveSide) {
  const Report report =
      run({plane('Y', -30.245 + kBall), "{ X = 0.0, Y = -20.0, Z = 0.0 }"}, "G65P9711Y-30.S8.H.5");
  ASSERT_EQ(report.alarm, "");
  ASSERT_EQ(report.lines.size(), 2u);
  expect_value(report.lines[1], {"Y", 8, -30, -30.245, 0, 0});
}

TEST(ProbingMacros, SurfaceAlongZNeedsNoBall) {
  const Report report = run({.surfaces = plane('Z', -7.4567),
                             .start = "{ X = 0.0, Y = 0.0, Z = 2.0 }",
                             .more = "[[tool]]\nnumber = 9\nlength = 80.0\n"},
                            "G43H9Z0\nG65P9711Z-7.5S1.");
  ASSERT_EQ(report.alarm, "");
  ASSERT_EQ(report.lines.size(), 2u);
  expect_value(report.lines[1], {"Z", 1, -7.5, -7.4567, 0, 0});
}

TEST(ProbingMacros, BoreIsFoundOffItsNominalCenter) {
  const Report report =
      run({cylinder(80.018, 44.973, 40.031 / 2 - kBall), "{ X = 80.0, Y = 45.0, Z = 10.0 }"},
          "G65P9712D40.Z-8.S12.H.02");
  ASSERT_EQ(report.alarm, "");
  ASSERT_EQ(report.lines.size(), 4u);
  EXPECT_EQ(report.lines[0].substr(0, 4), "BORE");
  expect_value(report.lines[1], {"X", 12, 80, 80.018, 0, 0});
  expect_value(report.lines[2], {"Y", 12, 45, 44.973, 0, 1});
  expect_value(report.lines[3], {"D", 12, 40, 40.031, 0, 1});
  EXPECT_NEAR(report.at.linear(Axis::X).mm(), 80.018, kMicrometer) << "in the center";
  EXPECT_NEAR(report.at.linear(Axis::Z).mm(), 10, kMicrometer);
}

TEST(ProbingMacros, ABoreFarOffIsStillExact) {
  const Report report = run({cylinder(2.5, -3.25, 15 - kBall)}, "G65P9712X0Y0D30.S1.");
  ASSERT_EQ(report.alarm, "");
  ASSERT_EQ(report.lines.size(), 4u);
  expect_value(report.lines[1], {"X", 1, 0, 2.5, 0, 0});
  expect_value(report.lines[2], {"Y", 1, 0, -3.25, 0, 0});
  expect_value(report.lines[3], {"D", 1, 30, 30, 0, 0});
}

TEST(ProbingMacros, BossIsTouchedFromAbove) {
  const Report report =
      run({cylinder(-20.4, 10.3, 24.987 / 2 + kBall), "{ X = -20.0, Y = 10.0, Z = 5.0 }"},
          "G65P9713D25.Z-6.S3.H.05");
  ASSERT_EQ(report.alarm, "");
  ASSERT_EQ(report.lines.size(), 4u);
  EXPECT_EQ(report.lines[0].substr(0, 4), "BOSS");
  expect_value(report.lines[1], {"X", 3, -20, -20.4, 0, 1});
  expect_value(report.lines[2], {"Y", 3, 10, 10.3, 0, 1});
  expect_value(report.lines[3], {"D", 3, 25, 24.987, 0, 0});
  EXPECT_NEAR(report.at.linear(Axis::Z).mm(), 5, kMicrometer);
}

TEST(ProbingMacros, WebAcrossX) {
  const Report report = run({plane('X', 44.98 - kBall) + ", " + plane('X', 57.03 + kBall),
                             "{ X = 51.0, Y = 0.0, Z = 5.0 }"},
                            "G65P9714X51.D12.Z-3.S4.");
  ASSERT_EQ(report.alarm, "");
  ASSERT_EQ(report.lines.size(), 3u);
  EXPECT_EQ(report.lines[0].substr(0, 3), "WEB");
  expect_value(report.lines[1], {"X", 4, 51, 51.005, 0, 0});
  expect_value(report.lines[2], {"W", 4, 12, 12.05, 0, 0});
}

TEST(ProbingMacros, SlotAcrossY) {
  const Report report =
      run({plane('Y', -8.01 + kBall) + ", " + plane('Y', 8.05 - kBall)}, "G65P9714Y0.D16.S5.H.03");
  ASSERT_EQ(report.alarm, "");
  ASSERT_EQ(report.lines.size(), 3u);
  EXPECT_EQ(report.lines[0].substr(0, 4), "SLOT");
  expect_value(report.lines[1], {"Y", 5, 0, 0.02, 0, 0});
  expect_value(report.lines[2], {"W", 5, 16, 16.06, 0, 1});
}

TEST(ProbingMacros, OutsideCorner) {
  const Report report = run({plane('X', 100.021 - kBall) + ", " + plane('Y', 50.034 + kBall),
                             "{ X = 90.0, Y = 60.0, Z = -3.0 }"},
                            "G65P9715X100.Y50.I8.J-8.S6.");
  ASSERT_EQ(report.alarm, "");
  ASSERT_EQ(report.lines.size(), 4u);
  EXPECT_EQ(report.lines[0].substr(0, 6), "CORNER");
  expect_value(report.lines[1], {"X", 6, 100, 100.021, 0, 0});
  expect_value(report.lines[2], {"Y", 6, 50, 50.034, 0, 0});
  expect_value(report.lines[3], {"A", 6, 0, 0, 0, 0});
}

TEST(ProbingMacros, InsideCorner) {
  const Report report = run({plane('X', 0.4 + kBall) + ", " + plane('Y', -0.3 + kBall),
                             "{ X = 12.0, Y = 11.0, Z = -3.0 }"},
                            "G65P9715X0Y0I10.J9.S2.");
  ASSERT_EQ(report.alarm, "");
  ASSERT_EQ(report.lines.size(), 4u);
  expect_value(report.lines[1], {"X", 2, 0, 0.4, 0, 0});
  expect_value(report.lines[2], {"Y", 2, 0, -0.3, 0, 0});
}

/// A face turned by 2 degrees: a cylinder so large that it is flat within 0.00002 mm here.
std::string turned_face(double x, double y, double normal_degrees) {
  constexpr double kFlat = 1e7;
  const Angle normal = Angle::degrees(normal_degrees);
  return cylinder(x - kFlat * std::cos(normal.radians()), y - kFlat * std::sin(normal.radians()),
                  kFlat + kBall);
}

TEST(ProbingMacros, CornerOfATurnedPart) {
  // the part turned by 2 degrees about its corner at (20.1, 30.2): faces look to 182 and 272
  const Report report = run({turned_face(20.1, 30.2, 182) + ", " + turned_face(20.1, 30.2, 272),
                             "{ X = 10.0, Y = 20.0, Z = -3.0 }"},
                            "G65P9715X20.Y30.I10.J10.S9.");
  ASSERT_EQ(report.alarm, "");
  ASSERT_EQ(report.lines.size(), 4u);
  expect_value(report.lines[1], {"X", 9, 20, 20.1, 0, 0});
  expect_value(report.lines[2], {"Y", 9, 30, 30.2, 0, 0});
  expect_value(report.lines[3], {"A", 9, 0, 2, 0, 0});
}

TEST(ProbingMacros, InInchesTheReportHasFourDecimals) {
  const Report report =
      run({cylinder(25.4 * 2.0012, 25.4, 25.4 * 0.7515 - kBall), "{ X = 50.8, Y = 25.4, Z = 0.0 }"},
          "G20\nG65P9712D1.5S1.");
  ASSERT_EQ(report.alarm, "");
  ASSERT_EQ(report.lines.size(), 4u);
  EXPECT_NEAR(value_of(report.lines[1]).actual, 2.0012, 0.00005);
  EXPECT_NEAR(value_of(report.lines[3]).actual, 1.503, 0.00005);
  EXPECT_EQ(report.lines[3].find("1.5030") != std::string::npos, true) << report.lines[3];
}

TEST(ProbingMacros, TheWorkOffsetTakesOverTheDeviation) {
  const Report report = run({.surfaces = cylinder(60.25, 39.5, 10 - kBall),
                             .start = "{ X = 60.0, Y = 40.0, Z = 0.0 }",
                             .more = "[[offset]]\nname = \"G55\"\nX = 50.0\nY = 30.0\n"},
                            "G55\nG65P9712X10.Y10.D20.W55.S1.\nG90G0X10.Y10.");
  ASSERT_EQ(report.alarm, "");
  ASSERT_EQ(report.lines.size(), 4u);
  expect_value(report.lines[1], {"X", 1, 10, 10.25, 0, 0});
  EXPECT_NEAR(report.at.linear(Axis::X).mm(), 60.25, kMicrometer);
  EXPECT_NEAR(report.at.linear(Axis::Y).mm(), 39.5, kMicrometer);
}

TEST(ProbingMacros, IncrementalModeComesBack) {
  const Report report =
      run({plane('X', 20), "{ X = 10.0, Y = 0.0, Z = 0.0 }"}, "G91\nG65P9711X23.S1.\nG0X5.");
  ASSERT_EQ(report.alarm, "");
  EXPECT_NEAR(report.at.linear(Axis::X).mm(), 15, kMicrometer);
}

struct Refusal {
  std::string name, surfaces, blocks, alarm;
  std::string ball = ProbeSetup{}.ball;
};

class ProbingAlarms : public testing::TestWithParam<Refusal> {};

TEST_P(ProbingAlarms, SayWhatIsWrong) {
  const Refusal& refusal = GetParam();
  const Report report = run({.surfaces = refusal.surfaces, .ball = refusal.ball}, refusal.blocks);
  EXPECT_NE(report.alarm.find(refusal.alarm), std::string::npos) << report.alarm;
}

INSTANTIATE_TEST_SUITE_P(
    , ProbingAlarms,
    testing::Values(
        Refusal{"no_surface", "", "G65P9711X20.S1.", "PS3121"},
        Refusal{"ball_unknown", "", "G65P9711X20.S1.", "PS3101", ""},
        Refusal{"no_axis", "", "G65P9711S1.", "PS3102"},
        Refusal{"two_axes", "", "G65P9711X1.Y1.S1.", "PS3102"},
        Refusal{"bore_without_diameter", "", "G65P9712S1.", "PS3103"},
        Refusal{"bore_below_ball", "", "G65P9712D5.S1.", "PS3104"},
        Refusal{"boss_without_height", "", "G65P9713D5.S1.", "PS3105"},
        Refusal{"web_without_axis", "", "G65P9714D5.S1.", "PS3106"},
        Refusal{"slot_below_ball", "", "G65P9714X0D5.S1.", "PS3107"},
        Refusal{"corner_without_distances", "", "G65P9715X0Y0S1.", "PS3108"},
        Refusal{"unknown_work_offset", "{ axis = \"X\", at = 20.0 }", "G65P9711X23.W60.", "PS3109"},
        Refusal{"bottom_in_the_way", "{ axis = \"Z\", at = -5.0 }", "G65P9712D40.Z-8.", "PS3120"},
        Refusal{"touching_already", "{ axis = \"X\", at = 0.0 }", "G65P9711X5.", "PS3122"}),
    [](const auto& i) { return i.param.name; });

}  // namespace
}  // namespace dripline::interpreter
