#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "clients/tools/graphics/turned_views.hpp"
#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/core/dialects.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/dialects/centurion/part_path.hpp"

/// Turned parts: CEN-227. Volumes are those of the bodies that geometry books have.
namespace dripline::graphics {
namespace {

constexpr double kPi = std::numbers::pi;

double cylinder(double diameter, double length) {
  return kPi / 4 * diameter * diameter * length;
}

/// Turns `text` (metric, on a Centurion); tool 1 is an outside tool of type 3, 2 a boring bar, 3 a
/// drill of 10 mm, 4 a blade of 3 mm. Sharp, so that radii do not blur the volumes.
TurningSimulation turned(const std::string& text, std::optional<SectionExtent> bar = {},
                         double nose = 0, const std::function<bool()>& follows_pattern = {}) {
  TurningSettings settings;
  settings.bar = bar;
  settings.follows_pattern = follows_pattern;
  settings.cells_along = 800;
  settings.widths = {{3, 10.0}, {4, 3.0}};
  interpreter::Setup setup;
  setup.units = interpreter::Units::Millimeter;
  for (const auto& [number, tip] : {std::pair{1, 3}, {2, 2}, {3, 7}, {4, 8}}) {
    interpreter::ToolRecord tool;
    tool.number = number;
    tool.tip = tip;
    tool.radius = Length::mm(number == 1 ? nose : 0);
    setup.tools.push_back(tool);
  }
  setup.start.set(interpreter::Axis::X, Length::mm(100));
  setup.start.set(interpreter::Axis::Z, Length::mm(50));
  settings.tools = setup.tools;
  settings.start = setup.start;
  TurningSimulation simulation(std::move(settings));
  const std::string program = "G21 G98 F100\n" + text;
  interpreter::MemorySource source(program);
  const interpreter::Dialect dialect = follows_pattern ? interpreter::centurion::part_path_dialect()
                                                       : interpreter::kCenturionDialect;
  const auto run = interpreter::run_offline(dialect, setup, source, simulation);
  EXPECT_TRUE(run) << run.error().what;
  if (run && run->alarm) ADD_FAILURE() << run->alarm->text;
  simulation.finish();
  return simulation;
}

constexpr SectionExtent kBar{-80, 0, 0, 20};  // 40 mm in diameter

TEST(Turning, ALongCutLeavesAStep) {
  const auto simulation = turned("T0101M6\nG0 X30 Z2\nG1 Z-50\nX42\nG0 X100 Z50\n", kBar);
  ASSERT_TRUE(simulation.part());
  const double expected = cylinder(30, 50) + cylinder(40, 30);
  EXPECT_NEAR(simulation.part()->volume(), expected, 0.01 * expected);
  EXPECT_NEAR(simulation.part()->outer(simulation.part()->columns() - 5), 15, 0.1);
  EXPECT_NEAR(simulation.part()->outer(5), 20, 0.1);
}

TEST(Turning, AFaceCutTakesTheWholeSlice) {
  const auto simulation = turned("T0101M6\nG0 X44 Z-2\nG1 X0\nG0 Z5\n", kBar);
  const double expected = cylinder(40, 78);
  EXPECT_NEAR(simulation.part()->volume(), expected, 0.01 * expected);
}

TEST(Turning, ATaperAndABallHaveTheirVolumes) {
  const auto cone = turned("T0101M6\nG0 X0 Z0\nG1 X40 Z-40\nG0 X100\n", kBar);
  const double expected = cylinder(40, 40) / 3 + cylinder(40, 40);
  EXPECT_NEAR(cone.part()->volume(), expected, 0.01 * expected);
  const auto ball = turned("T0101M6\nG0 X0 Z0\nG3 X40 Z-20 R20\nG0 X100\n", kBar);
  const double half_ball = 2.0 / 3 * kPi * 20 * 20 * 20;
  EXPECT_NEAR(ball.part()->volume(), half_ball + cylinder(40, 60), 0.01 * cylinder(40, 80));
}

/// The imaginary tip of a tool with a nose is not on the nose: a shoulder keeps a fillet.
TEST(Turning, ANoseLeavesAFilletInTheCorner) {
  const std::string text = "T0101M6\nG0 X20 Z2\nG1 Z-40\nX42\nG0 X100 Z50\n";
  const double sharp = turned(text, kBar).part()->volume();
  const double round = turned(text, kBar, 4).part()->volume();
  // a ring of (1 - pi/4) r^2 at about radius 10 + 0.22 r
  const double fillet = (1 - kPi / 4) * 16 * 2 * kPi * (10 + 0.2234 * 4);
  EXPECT_NEAR(round - sharp, fillet, 0.1 * fillet);
}

TEST(Turning, DrillsAndBoresFromWithin) {
  const auto drilled = turned("T0303M6\nG0 X0 Z2\nG1 Z-30\nG0 Z50\n", kBar);
  const double point = 5 / std::tan(59 * kPi / 180);  // of the drill: 118 degrees
  const double hole = cylinder(10, 30 - point) + cylinder(10, point) / 3;
  EXPECT_NEAR(cylinder(40, 80) - drilled.part()->volume(), hole, 0.03 * hole);
  EXPECT_NEAR(drilled.part()->inner(drilled.part()->columns() - 5), 5, 0.1);
  const auto bored = turned("T0202M6\nG0 X24 Z2\nG1 Z-30\nX0\nG0 Z50\n", kBar);
  EXPECT_NEAR(cylinder(40, 80) - bored.part()->volume(), cylinder(24, 30), 0.03 * cylinder(24, 30));
}

TEST(Turning, ABladeIsAsWideAsItIs) {
  const auto grooved = turned("T0404M6\nG0 X100\nG0 X44 Z-20\nG1 X30\nG0 X44\n", kBar);
  const double ring = cylinder(40, 3) - cylinder(30, 3);
  EXPECT_NEAR(cylinder(40, 80) - grooved.part()->volume(), ring, 0.05 * ring);
}

/// P156 and P157 say the bar; from the work zero's face toward the chuck.
TEST(Turning, TheProgramSaysItsBar) {
  const auto simulation = turned("P156=60\nP157=25\nT0101M6\nG0 X20 Z2\nG1 Z-10\nX30\n");
  ASSERT_TRUE(simulation.part());
  EXPECT_EQ(simulation.part()->bar().z_low, -60);
  EXPECT_EQ(simulation.part()->bar().z_high, 0);
  EXPECT_EQ(simulation.part()->bar().x_high, 12.5);
  EXPECT_FALSE(turned("P157=25\nG0 X20 Z2\nG1 Z-10\n").part());
}

/// CEN-149: M90 stops drawing the path, M91 continues.
TEST(Turning, TheWayIsKeptWhileGraphicsAreOn) {
  const auto simulation = turned("G0 X50 Z2\nM90\nG1 Z1\nZ0\nM91\nZ-1\n", kBar);
  ASSERT_EQ(simulation.path().size(), 2u);
  EXPECT_EQ(simulation.path()[0].kind, PathKind::Rapid);
  EXPECT_EQ(simulation.path()[1].kind, PathKind::Feed);
  EXPECT_EQ(simulation.path()[1].to.z, -1);
}

/// Radius and Z of the ends of the pieces of a part path.
std::vector<std::pair<double, double>> part_path(const std::string& text) {
  std::vector<std::pair<double, double>> ends;
  const auto simulation = turned(text, kBar, 0.8, [] { return false; });
  for (const PathPiece& piece : simulation.path()) {
    EXPECT_EQ(piece.kind, PathKind::Part);
    ends.emplace_back(piece.to.x, piece.to.z);
  }
  return ends;
}

/// CEN-227: verify's PART.
TEST(Turning, ThePartPathIsThatOfTheProgramWithoutCompensation) {
  const std::vector<std::pair<double, double>> programmed{{10, 0}, {10, -10}, {15, -20}, {20, -20}};
  EXPECT_EQ(part_path("T0101M6\nG0 X30 Z2\nG1 G42 X20 Z0\nZ-10\nX30 Z-20\nG40 X40\n"), programmed);
}

TEST(Turning, ThePartPathOfARoughingCycleIsItsPattern) {
  const std::string pattern = "N1 G1 G42 X20\nZ-10\nX30 Z-20\nN2 G40 X42\nG1 X50\n";
  const std::vector<std::pair<double, double>> followed{
      {10, 2}, {10, -10}, {15, -20}, {21, -20}, {25, 2}};
  for (const char* cycle :
       {"G71 P1 Q2 U1 W.5 I1 D2 R1\n", "G72 P1 Q2 U1 W.5 I1 D2 R1\n", "G73 P1 Q2 U1 W.5 I1 D3\n"})
    EXPECT_EQ(part_path("T0101M6\nM3 S500\nG0 X42 Z2\n" + std::string(cycle) + pattern), followed)
        << cycle << "and the next move begins at the start point";
}

TEST(TurnedViews, DrawThePartPathYellow) {
  const std::vector<PathPiece> path{{{0, 10}, {-20, 10}, PathKind::Feed},
                                    {{0, 5}, {-20, 5}, PathKind::Part},
                                    {{0, 8}, {-20, 8}, PathKind::FinishPattern}};
  TurnedView view{.above = TurnedSide::Nothing, .below = TurnedSide::Nothing};
  view.window = Frame{{-20, 0}, {0, 20}};
  view.width = 400;
  const auto inks = [&] {
    const auto picture = draw_turned(nullptr, path, view);
    return std::vector{picture->ink_at(200, 200), picture->ink_at(200, 300),
                       picture->ink_at(200, 240)};
  };
  view.shows_path = true;
  EXPECT_EQ(inks(), (std::vector{Ink::Green, Ink::Gray, Ink::Yellow}));
  view.shows_part_path = true;
  EXPECT_EQ(inks(), (std::vector{Ink::Green, Ink::Yellow, Ink::Yellow})) << "both";
  view.shows_path = false;
  EXPECT_EQ(inks(), (std::vector{Ink::Gray, Ink::Yellow, Ink::Yellow}));
}

TEST(Turning, RefusesABarWithoutExtent) {
  EXPECT_FALSE(TurnedSection::make({0, 0, 0, 10}, 100));
  EXPECT_FALSE(TurnedSection::make({0, 10, 5, 5}, 100));
  EXPECT_FALSE(TurnedSection::make({0, 10, -5, 5}, 100));
  EXPECT_FALSE(TurnedSection::make({0, 10, 0, 5}, 1'000'000));
  const auto tube = TurnedSection::make({0, 10, 4, 8}, 400);
  ASSERT_TRUE(tube);
  EXPECT_NEAR(tube->volume(), cylinder(16, 10) - cylinder(8, 10), 20);
}

TEST(TurnedViews, ShowSectionAboveAndOutsideBelow) {
  const auto simulation = turned("T0202M6\nG0 X24 Z2\nG1 Z-30\nX0\nG0 Z50\n", kBar);
  const TurnedSection& part = *simulation.part();
  const auto picture =
      draw_turned(&part, simulation.path(), {.window = Frame{{-80, -25}, {0, 25}}, .width = 800});
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->height(), 500u);
  const auto at = [&](double z, double x) {
    return picture->at(static_cast<std::size_t>((z + 80) * 10),
                       static_cast<std::size_t>((25 - x) * 10));
  };
  EXPECT_LT(at(-15, 5), 40) << "the bore, in the section";
  EXPECT_GE(at(-15, 16), 75) << "its wall";
  EXPECT_GE(at(-15, -5), 75) << "from outside there is no bore";
  EXPECT_EQ(at(-15, 22), kBlack) << "beside the part";
}

TEST(TurnedViews, DrawTheWayLimitsAndZone) {
  const auto simulation = turned("T0101M6\nG0 X30 Z2\nG1 Z-50\n", kBar);
  TurnedView view{.above = TurnedSide::Nothing, .below = TurnedSide::Nothing};
  view.window = Frame{{-80, -25}, {20, 25}};
  view.width = 1000;
  view.shows_path = true;
  view.limits = Frame{{-70, -20}, {10, 24}};
  const auto picture = draw_turned(nullptr, simulation.path(), view);
  ASSERT_TRUE(picture);
  const auto at = [&](double z, double x) {
    return picture->at(static_cast<std::size_t>(std::lround((z + 80) * 10)),
                       static_cast<std::size_t>(std::lround((25 - x) * 10)));
  };
  EXPECT_EQ(at(-20, 15), 255) << "the feed";
  EXPECT_GT(at(-70, 10), 0) << "the limit of Z";
  EXPECT_EQ(at(-20, 10), kBlack);
  const auto has_ink = [&](Ink ink) {
    for (std::size_t y = 0; y < picture->height(); ++y)
      for (std::size_t x = 0; x < picture->width(); ++x)
        if (picture->ink_at(x, y) == ink) return true;
    return false;
  };
  EXPECT_EQ(picture->ink_at(600, 100), Ink::Green) << "the feed";
  EXPECT_TRUE(has_ink(Ink::Red)) << "the rapid move";
  constexpr std::size_t kColorType = 25;
  EXPECT_EQ(picture->png()->at(kColorType), 2) << "RGB";
  view.shows_path = false;
  EXPECT_EQ(draw_turned(nullptr, simulation.path(), view)->png()->at(kColorType), 0) << "gray";
  view.shows_path = true;
  view.has_front_turret = true;
  const auto below = draw_turned(nullptr, simulation.path(), view);
  EXPECT_EQ(below->at(600, 400), 255) << "+X points down";
  view.window = Frame{{0, 0}, {0, 10}};
  EXPECT_FALSE(draw_turned(nullptr, simulation.path(), view));
}

}  // namespace
}  // namespace dripline::graphics
