#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"
#include "tests/unit/gateway/machine/grbl/grbl_shop.hpp"

/// A board changes no tools: the operator does, with the axes and the spindle at rest.
namespace dripline::machine::grbl::test {
namespace {

using interpreter::StepState;

struct ToolCase {
  const char* name;
  const char* control;
  const char* program;
  std::vector<double> stops_at;  ///< X
};

class GrblToolChange : public testing::TestWithParam<ToolCase> {};

TEST_P(GrblToolChange, WaitsForTheOperatorBeforeTheNextMotion) {
  GrblShop shop;
  shop.begin();
  interpreter::MemorySource source(GetParam().program);
  const auto dialect = interpreter::find_dialect(GetParam().control);
  auto made = (*dialect)->make({}, source, shop.machine.events());
  ASSERT_TRUE(made) << made.error().what;
  std::vector<double> stops;
  bool is_over = false;
  ASSERT_TRUE(shop.pass_until([&] {
    while (!is_over && shop.machine.has_room()) is_over = (*made)->step(1) != StepState::Ran;
    if (shop.machine.state() == MachineState::ProgramStop) {
      EXPECT_EQ(shop.machine.status().stopped_at, interpreter::StopKind::ToolChange);
      EXPECT_FALSE(shop.board.is_spindle_on()) << "hands are at the spindle";
      stops.push_back(shop.board.position()[0]);
      const double before = shop.board.traveled();
      shop.pass(2);
      EXPECT_EQ(shop.board.traveled(), before);
      EXPECT_TRUE(shop.machine.resume());
    }
    const MachineState state = shop.machine.state();
    return state == MachineState::Completed || state == MachineState::Alarmed;
  }));
  EXPECT_EQ(shop.alarm(), "");
  ASSERT_EQ(stops.size(), GetParam().stops_at.size());
  for (std::size_t i = 0; i < stops.size(); ++i)
    EXPECT_NEAR(stops[i], GetParam().stops_at[i], 1e-3);
}

INSTANTIATE_TEST_SUITE_P(
    , GrblToolChange,
    testing::Values(
        ToolCase{"fanuc_with_the_changer_that_it_believes_in",
                 "fanuc",
                 "%\nO1\nG21G90G94\nT1M6\nM3S1000\nG0X5.\nT2M6\nG1X9.F900.\nT2M6\nX10.\nM30\n%\n",
                 {0, 5}},
        ToolCase{
            "in_the_block_of_a_move", "fanuc", "%\nO1\nG21G90G94\nG0X3.\nG0X7.T4M6\nM30\n%\n", {3}},
        ToolCase{"two_without_a_move_between",
                 "fanuc",
                 "%\nO1\nG21G90G94\nT1M6\nT2M6\nG0X5.\nM3S500\nT3M6\nT1M6\nG0X7.\nM30\n%\n",
                 {0, 0, 5, 5}},
        ToolCase{"the_same_again_without_a_move_between",
                 "fanuc",
                 "%\nO1\nG21G90G94\nT1M6\nT1M6\nG0X5.\nM30\n%\n",
                 {0}},
        ToolCase{"rs274ngc_without_a_move_between",
                 "rs274ngc",
                 "G21G90G94\nT3M6\nT1M6\nG0X4\nM2\n",
                 {0, 0}},
        ToolCase{"rs274ngc", "rs274ngc", "G21G90G94\nT3M6\nM3S500\nG0X2\nT1M6\nG0X4\nM2\n", {0, 2}},
        ToolCase{"tnc155_by_m06",
                 "tnc155",
                 "0 BEGIN PGM 5 MM\n1 TOOL DEF 1 L+0 R+0\n2 TOOL CALL 1 Z S100.000\n"
                 "3 L X+5 Y+0 R0 F2000 M06\n4 L X+9 Y+0 R0 F2000\n5 END PGM 5 MM\n",
                 {0, 5}}),
    [](const auto& i) { return std::string(i.param.name); });

TEST(GrblToolStop, TheSpindleTurnsAgainAsBefore) {
  GrblShop shop;
  shop.begin();
  interpreter::MemorySource source("%\nO1\nG21G90G94\nM3S1000\nG0X3.\nT4M6\nG0X7.\nM30\n%\n");
  auto made = (*interpreter::find_dialect("fanuc"))->make({}, source, shop.machine.events());
  ASSERT_TRUE(made);
  while ((*made)->step(1) == StepState::Ran) {
  }
  ASSERT_TRUE(shop.pass_until([&] { return shop.machine.state() == MachineState::ProgramStop; }));
  EXPECT_TRUE(shop.machine.resume());
  ASSERT_TRUE(shop.pass_until([&] { return shop.x() > 4; })) << shop.alarm();
  EXPECT_TRUE(shop.board.is_spindle_on());
}

/// A restart: the tool before it, the spindle, then the block that changes the tool.
TEST(GrblToolStop, TheStopForTheToolOfARestartIsNotThatOfTheNextTool) {
  GrblShop shop;
  shop.begin();
  interpreter::EventSink& events = shop.machine.events();
  const interpreter::Origin origin{.block = 1};
  events.on_tool({.origin = origin, .number = 1, .offset = {}});
  interpreter::Spindle spindle;
  spindle.origin = origin;
  spindle.state = interpreter::SpindleState::Clockwise;
  spindle.revolutions_per_minute = 1000;
  events.on_spindle(spindle);
  events.on_tool({.origin = origin, .number = 2, .offset = {}});
  events.on_block_end(origin);
  for (const bool is_second : {false, true}) {
    const auto is_stopped = [&] { return shop.machine.state() == MachineState::ProgramStop; };
    ASSERT_TRUE(shop.pass_until(is_stopped)) << "is second: " << is_second;
    EXPECT_EQ(shop.machine.status().tool, is_second ? 2 : 1);
    EXPECT_FALSE(shop.board.is_spindle_on());
    EXPECT_TRUE(shop.machine.resume());
  }
}

TEST(GrblToolStop, AToolThatIsInTheSpindleIsNoReasonForOne) {
  GrblShop shop;
  shop.begin();
  interpreter::MemorySource source("G21G90G94\nM61Q3\nG0X2\nM2\n");
  const auto setup = interpreter::parse_setup("[control]\nprofile = \"linuxcnc\"\n");
  auto made = (*interpreter::find_dialect("rs274ngc"))->make(*setup, source, shop.machine.events());
  ASSERT_TRUE(made);
  while ((*made)->step(1) == StepState::Ran) {
  }
  ASSERT_TRUE(shop.pass_until([&] { return shop.machine.state() == MachineState::Completed; }))
      << shop.alarm();
  EXPECT_NEAR(shop.x(), 2, 1e-3);
}

TEST(GrblFunctions, ThatAreDoneWithoutTheBoardAreTakenButM66) {
  for (const bool reads : {false, true}) {
    GrblShop shop;
    shop.begin();
    interpreter::MemorySource source(reads ? "G21G90G94\nM66P0\nG0X2\nM30\n"
                                           : "G21G90G94\nM49\nM48\nG0X2\nM30\n");
    const auto setup = interpreter::parse_setup("[control]\nprofile = \"linuxcnc\"\npins = [0]\n");
    auto made =
        (*interpreter::find_dialect("rs274ngc"))->make(*setup, source, shop.machine.events());
    ASSERT_TRUE(made);
    while ((*made)->step(1) == StepState::Ran) {
    }
    const auto end = reads ? MachineState::Alarmed : MachineState::Completed;
    ASSERT_TRUE(shop.pass_until([&] { return shop.machine.state() == end; })) << shop.alarm();
    EXPECT_NEAR(shop.x(), reads ? 0 : 2, 1e-3);
  }
}

}  // namespace
}  // namespace dripline::machine::grbl::test
