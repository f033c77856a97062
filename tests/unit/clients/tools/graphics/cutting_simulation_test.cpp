#include <gtest/gtest.h>

#include "clients/tools/graphics/cutting_simulation.hpp"

// Rows: HD-199 (blank), HD-203 (only the final part), HD-204 (what cannot be shown), HD-205
// (a part seen larger).
namespace dripline::graphics {
namespace {

using interpreter::Axis;
using interpreter::Position;

constexpr double kPi = 3.14159265358979323846;

Position at(double x, double y, double z) {
  Position position;
  position.set(Axis::X, Length::mm(x));
  position.set(Axis::Y, Length::mm(y));
  position.set(Axis::Z, Length::mm(z));
  return position;
}
interpreter::Origin line(std::uint64_t number) {
  interpreter::Origin origin;
  origin.line = number;
  return origin;
}

class CuttingSimulationTest : public testing::Test {
 protected:
  void begin(SimulationSettings settings = {}) {
    settings.cells_along = 1000;
    settings.start = at(0, 0, 50);
    simulation_.emplace(std::move(settings));
    simulation_->on_blank({{}, Axis::Z, at(0, 0, -20), at(100, 100, 0)});
  }
  void call_tool(double radius) {
    interpreter::ToolChange change;
    change.number = 1;
    change.shape = {Length{}, Length::mm(radius)};
    simulation_->on_tool(change);
  }
  double removed() const { return simulation_->part()->removed_volume(); }

  std::optional<CuttingSimulation> simulation_;
};

TEST_F(CuttingSimulationTest, AFullCircleCutsARing) {
  begin();
  call_tool(5);
  simulation_->on_rapid({{}, at(80, 50, 2)});
  simulation_->on_line({{}, at(80, 50, -4), {}});
  interpreter::Arc arc;
  arc.to = at(80, 50, -4);
  arc.center_first = arc.center_second = Length::mm(50);
  arc.sweep = Angle::degrees(360);
  simulation_->on_arc(arc);
  EXPECT_NEAR(removed(), kPi * (35 * 35 - 25 * 25) * 4, 15);
}

TEST_F(CuttingSimulationTest, AnArcTurnsTheWayItSays) {
  for (const auto turn : {interpreter::Turn::Clockwise, interpreter::Turn::Counterclockwise}) {
    begin();
    call_tool(5);
    simulation_->on_rapid({{}, at(80, 50, -4)});
    const double before = simulation_->part()->at(500, 800),
                 below = simulation_->part()->at(500, 200);
    interpreter::Arc arc;
    arc.to = at(20, 50, -4);
    arc.center_first = arc.center_second = Length::mm(50);
    arc.turn = turn;
    arc.sweep = Angle::degrees(180);
    simulation_->on_arc(arc);
    const bool is_over_the_top = turn == interpreter::Turn::Counterclockwise;
    EXPECT_EQ(simulation_->part()->at(500, 800), is_over_the_top ? -4 : before);
    EXPECT_EQ(simulation_->part()->at(500, 200), is_over_the_top ? below : -4);
  }
}

TEST_F(CuttingSimulationTest, LeavesAHelixOutUnlessAskedForIt) {
  for (const bool shows : {false, true}) {
    SimulationSettings settings;
    settings.shows_helices = shows;
    begin(settings);
    call_tool(5);
    simulation_->on_rapid({{}, at(80, 50, 0)});
    interpreter::Arc arc;
    arc.origin = line(7);
    arc.to = at(80, 50, -4);
    arc.center_first = arc.center_second = Length::mm(50);
    arc.sweep = Angle::degrees(360);
    simulation_->on_arc(arc);
    EXPECT_EQ(removed() > 0, shows);
    ASSERT_EQ(simulation_->omitted().size(), shows ? 0u : 1u);
    if (!shows) {
      EXPECT_EQ(simulation_->omitted()[0].why, Omission::Helix);
      EXPECT_EQ(simulation_->omitted()[0].origin.line, 7u);
    }
  }
}

TEST_F(CuttingSimulationTest, LeavesOutMovesOfAFourthAxisAndThoseWithoutATool) {
  begin();
  simulation_->on_line({line(3), at(10, 10, -5), {}});
  simulation_->on_line({line(4), at(20, 10, -5), {}});
  call_tool(3);
  Position turned = at(30, 10, -5);
  turned.set(Axis::C, Angle::degrees(10));
  simulation_->on_line({line(6), turned, {}});
  ASSERT_EQ(simulation_->omitted().size(), 2u);
  EXPECT_EQ(simulation_->omitted()[0].why, Omission::NoTool);
  EXPECT_EQ(simulation_->omitted()[0].moves, 2u);
  EXPECT_EQ(simulation_->omitted()[1].why, Omission::RotaryAxis);
  EXPECT_EQ(simulation_->omitted()[1].origin.line, 6u);
  EXPECT_EQ(removed(), 0);
}

// HD-204: the cutter is along the blank's axis; the interpreter reports where it is not.
TEST_F(CuttingSimulationTest, LeavesOutWhatAToolAcrossTheBlankDoes) {
  interpreter::Warning across;
  across.diagnostic.id = "TNC-GRAPHICS";
  begin();
  call_tool(5);
  simulation_->on_warning(across);
  simulation_->on_line({line(5), at(50, 50, -5), {}});
  ASSERT_EQ(simulation_->omitted().size(), 1u);
  EXPECT_EQ(simulation_->omitted()[0].why, Omission::ToolAxis);
  EXPECT_EQ(simulation_->omitted()[0].origin.line, 5u);
  EXPECT_EQ(removed(), 0);
  call_tool(5);
  simulation_->on_line({line(7), at(60, 50, -5), {}});
  EXPECT_GT(removed(), 0) << "called again, along the axis";
  const double before = removed();
  simulation_->on_warning(across);
  interpreter::Warning again;
  again.diagnostic.id = "TNC-GRAPHICS-AGAIN";
  simulation_->on_warning(again);
  simulation_->on_line({line(8), at(70, 50, -5), {}});
  EXPECT_GT(removed(), before) << "only its axis was named again";
  // another warning means nothing, nor does this one for a blank of the user
  SimulationSettings own;
  own.blank = Cuboid{{0, 0, -20}, {100, 100, 0}};
  begin(own);
  call_tool(5);
  simulation_->on_warning(across);
  simulation_->on_line({line(5), at(50, 50, -5), {}});
  EXPECT_GT(removed(), 0);
}

TEST_F(CuttingSimulationTest, TakesRadiiFromTheSetupAndFromTheUser) {
  SimulationSettings settings;
  interpreter::ToolRecord tool;
  tool.number = 4;
  tool.radius = Length::mm(2);
  settings.tools = {tool};
  settings.tool_radius = Length::mm(6);
  begin(settings);
  interpreter::ToolChange change;
  change.number = 4;
  simulation_->on_tool(change);
  simulation_->on_rapid({{}, at(20, 20, 1)});
  simulation_->on_line({{}, at(20, 20, -1), {}});
  EXPECT_NEAR(removed(), kPi * 4, 0.3);
  simulation_->on_rapid({{}, at(20, 20, 1)});
  simulation_->on_rapid({{}, at(70, 70, 1)});
  change.number = 9;
  simulation_->on_tool(change);
  simulation_->on_line({{}, at(70, 70, -1), {}});
  EXPECT_NEAR(removed(), kPi * (4 + 36), 1);
}

TEST(CuttingSimulation, SeesALyingSpindleAlongIt) {
  CuttingSimulation simulation({});
  simulation.on_blank({{}, Axis::Y, at(0, -30, 0), at(60, 0, 40)});
  EXPECT_EQ(simulation.frame().first, Axis::Z);
  EXPECT_EQ(simulation.frame().second, Axis::X);
  ASSERT_TRUE(simulation.part());
  EXPECT_EQ(simulation.part()->extent().high.u, 40);
  EXPECT_EQ(simulation.part()->extent().high.v, 60);
  EXPECT_EQ(simulation.part()->extent().low.w, -30);
}

TEST(CuttingSimulation, SaysThatABlankHasNoVolume) {
  CuttingSimulation simulation({});
  simulation.on_blank({{}, Axis::Z, at(0, 0, 0), at(60, 0, 40)});
  EXPECT_FALSE(simulation.part());
  ASSERT_TRUE(simulation.failure());
  EXPECT_EQ(simulation.failure()->code, Errc::LimitExceeded);
}

}  // namespace
}  // namespace dripline::graphics
