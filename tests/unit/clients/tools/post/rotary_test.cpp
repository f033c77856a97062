#include <gtest/gtest.h>
#include <stdexcept>

#include "gateway/interpreter/registry.hpp"
#include "tests/unit/clients/tools/post/converted.hpp"
#include "tests/unit/gateway/interpreter/dialects/fanuc/tilting_machine.hpp"

/// Planes of G68.2 are written as moves of the axes: right for the machine they were computed for,
/// whatever its tables and heads, and refused for another one.
namespace dripline::post {
namespace {

using interpreter::fanuc::kFork;
using interpreter::fanuc::kMixed;
using interpreter::fanuc::kTrunnion;
using interpreter::fanuc::TestMachine;

constexpr double kTiltedLength = 60;
constexpr std::string_view kTiltedTool = "[[tool]]\nnumber = 1\nlength = 60.0\n";

interpreter::Setup setup_on(const TestMachine& machine) {
  return setup_from("[control]\n" + machine.control + std::string(kTiltedTool));
}

/// Five corners of a plane through (10, 20, 5), inclined by 30 degrees about X.
constexpr std::string_view kTiltedProgram =
    "O1\nT1 M6\nG90 G00 X0 Y0\nG43 H1 Z200.\nG68.2 X10. Y20. Z5. I0 J30. K0\nG53.1\n"
    "G00 X0 Y0 Z10.\nG01 Z-2. F200.\nX15.\nY8.\nX0 Y0\nG00 Z50.\nG69\nM30\n";

ConversionOptions as_tilted(interpreter::Setup target) {
  ConversionOptions options;
  options.is_as_set_up = true;
  options.target_setup = std::move(target);
  return options;
}

/// Where the tips of the moves are that end at the five corners.
std::vector<interpreter::fanuc::Vector> tips(const TestMachine& machine, const std::string& text) {
  interpreter::MemorySource source(text);
  interpreter::fanuc::MachineLog log;
  const auto dialect = interpreter::find_dialect("fanuc");
  auto control = (*dialect)->make(setup_on(machine), source, log);
  if (!control) throw std::runtime_error(control.error().what);
  (void)(*control)->step(100);
  std::vector<interpreter::fanuc::Vector> at;
  for (const auto& move : log.moves) {
    if (move.kind == 'L') at.push_back(machine.tip(move.to, kTiltedLength));
  }
  return at;
}

class Tilted : public testing::TestWithParam<const TestMachine*> {};

TEST_P(Tilted, AreWrittenForTheSameMachine) {
  const TestMachine& machine = *GetParam();
  const Original original{"fanuc", std::string(kTiltedProgram), setup_on(machine)};
  for (const char* target : {"fanuc", "linuxcnc"}) {
    const bool is_fanuc = std::string_view(target) == "fanuc";
    const auto converted = convert(
        original, target, as_tilted(is_fanuc ? setup_on(machine) : setup_from(kTiltedTool)));
    EXPECT_TRUE(converted.is_proved) << target << ": " << converted.reason();
    EXPECT_EQ(converted.text.find("G68.2"), std::string::npos);
    if (!is_fanuc) continue;
    const auto written = tips(machine, converted.text);
    ASSERT_EQ(written.size(), 4U);
    const double c = std::cos(std::acos(-1.0) / 6), s = 0.5;
    const std::array<std::array<double, 3>, 4> plane{
        {{0, 0, -2}, {15, 0, -2}, {15, 8, -2}, {0, 0, -2}}};
    for (std::size_t i = 0; i < plane.size(); ++i) {
      const auto& [x, y, z] = plane[i];
      EXPECT_NEAR(written[i][0], 10 + x, 0.002) << i;
      EXPECT_NEAR(written[i][1], 20 + y * c - z * s, 0.002) << i;
      EXPECT_NEAR(written[i][2], 5 + y * s + z * c, 0.002) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Tilted, testing::Values(&kTrunnion, &kMixed, &kFork),
                         [](const auto& one) { return one.param->name; });

TEST(TiltedPlanes, AreRefusedForAnotherMachine) {
  const Original original{"fanuc", std::string(kTiltedProgram), setup_on(kTrunnion)};
  EXPECT_EQ(convert(original, "fanuc", as_tilted(setup_on(kFork))).reason(),
            "line 6: a move of the rotary axis A: the machine of the source is table-table A-C-, "
            "that of the target head-head C+A+");
  TestMachine other = kTrunnion;
  other.control =
      "kinematics = \"table-table\"\nrotary_master = \"A-\"\nrotary_slave = \"C-\"\n"
      "table_centers = [ { Y = 5.0, Z = -41.0 }, { X = 12.0, Y = 8.0 } ]\n";
  EXPECT_EQ(convert(original, "fanuc", as_tilted(setup_on(other))).reason(),
            "line 6: a move of the rotary axis A: the centers of tables or heads of the two "
            "machines differ");
  // without a move of a rotary axis machines may differ
  const Original flat{"fanuc", "O1\nT1 M6\nG00 X1. Y2.\nG43 H1 Z5.\nM30\n", setup_on(kTrunnion)};
  EXPECT_TRUE(convert(flat, "fanuc", as_tilted(setup_on(kFork))).is_proved);
}

/// With a tilted head X and Y hold a part of the length, too.
TEST(TiltedPlanes, AreRefusedForAToolOfAnotherLength) {
  auto setup = setup_on(kFork);
  const Original original{"fanuc",
                          "O1\nT1 M6\nG90 G43 H1\nG68.2 X0 Y0 Z0 I0 J-90. K0\nG53.1\n"
                          "G01 X5. F100.\nM30\n",
                          setup};
  setup.tools[0].length = {};
  const std::string reason = convert(original, "fanuc", as_tilted(setup)).reason();
  EXPECT_NE(reason.find("with a length of 60.0000 mm in force"), std::string::npos) << reason;
}

}  // namespace
}  // namespace dripline::post
