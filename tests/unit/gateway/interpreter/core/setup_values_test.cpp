#include "gateway/interpreter/setup_values.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/core/retained_memory.hpp"
#include "gateway/interpreter/registry.hpp"
#include "tests/support/event_log.hpp"

namespace dripline::interpreter {
namespace {

struct Cutting {
  const char* control;
  const char* settings;
  const char* program;  ///< takes tool 3 with its offsets and cuts with its radius
  int tip = 3;          ///< 0: a mill's tool
};

class ToolValues : public testing::TestWithParam<Cutting> {
 protected:
  /// `key`: of the tool, "wear.X" of its wear.
  static std::string setup_text(const std::string& key, double value) {
    const bool is_wear = key.starts_with("wear.");
    std::string tool = fmt::format("{} = {}", is_wear ? key.substr(5) : key, value);
    if (is_wear) tool = fmt::format("wear = {{ {} }}", tool);
    return fmt::format("units = \"mm\"\n{}[[tool]]\nnumber = 3\ntip = {}\n{}{}\n",
                       GetParam().settings, GetParam().tip, key == "radius" ? "" : "radius = 1.0\n",
                       tool);
  }
  struct Effect {
    std::vector<double> memory;  ///< what the control knows before the program, its tool table
    std::vector<std::string> events;
    friend bool operator==(const Effect&, const Effect&) = default;
  };
  /// Lengths of tools move the axes, not the program's path: they show in the memory.
  static Effect effect_of(const std::string& setup_text) {
    const auto setup = parse_setup(setup_text);
    EXPECT_TRUE(setup) << setup.error().what;
    MemorySource source(GetParam().program);
    EventLog log;
    const auto made = (*find_dialect(GetParam().control))->make(*setup, source, log);
    EXPECT_TRUE(made) << setup_text << made.error().what;
    if (!made) return {};
    Effect effect;
    if (auto* memory = dynamic_cast<RetainedMemory*>(made->get())) {
      (void)memory->read_memory(effect.memory);
      std::erase_if(effect.memory, [](double value) { return std::isnan(value); });  // vacant
    }
    StepState state = StepState::Ran;
    while (state == StepState::Ran) state = (*made)->step(65'536);
    EXPECT_EQ(state, StepState::Ended) << fmt::format("{}", fmt::join(log.lines(), "\n"));
    effect.events = log.lines();
    return effect;
  }
};

TEST_P(ToolValues, AreThoseThatChangeWhatAProgramDoes) {
  const auto listed = setup_values(GetParam().control);
  for (const std::string key : {"X", "Z", "length", "radius", "wear.X", "wear.Z", "wear.radius"}) {
    const bool has_effect = effect_of(setup_text(key, 1.0)) != effect_of(setup_text(key, 1.25));
    const bool is_listed = std::ranges::find(listed.tool, key) != listed.tool.end();
    EXPECT_EQ(is_listed, has_effect) << key;
  }
}

INSTANTIATE_TEST_SUITE_P(
    , ToolValues,
    testing::Values(
        Cutting{"tnc155", "",
                "0 BEGIN PGM 1 MM\n1 TOOL CALL 3 Z S100\n2 L Z+5 R0 F100 M3\n3 L X+0 Y+0\n"
                "4 L X+10 Y+0 RL\n5 L X+10 Y+20\n6 L X+20 Y+20 R0\n7 END PGM 1 MM\n"},
        Cutting{"centurion", "[control]\ntool_changer = true\n",
                "O1\nG21 G98\nT0303 M6\nG0 X60. Z5.\nG42\nG1 X40. Z0. F100\nZ-20.\nX60.\nG40\n"
                "M30\n"},
        Cutting{"fanuc", "",
                "%\nO1\nG21 G90 G54 G17\nG43 H3 Z10.\nG1 G41 D3 X10. Y0. F100\nY20.\nX30.\n"
                "G40 Y30.\nM30\n%\n"},
        Cutting{"fanuc-t", "",
                "%\nO1\nG21 G98\nT0303\nG0 X60. Z5.\nG42 G1 X40. Z0. F100\nZ-20.\nX60.\nG40 X70.\n"
                "M30\n%\n"},
        Cutting{"rs274ngc", "[control]\nprofile = \"linuxcnc\"\ntool_changer = true\n",
                "G21 G90 G17\nT3 M6\nG43 H3\nG0 X0 Y0 Z10\nG41 D3\nG1 X10 Y0 F100\nY20\nX30\nG40\n"
                "M30\n",
                0}),
    [](const auto& row) {
      std::string name = row.param.control;
      std::ranges::replace(name, '-', '_');
      return name;
    });

TEST(SetupValues, TwoControlsTakeNothingOfASetup) {
  for (const char* control : {"tektronix-1704", "prototrak-plus"}) {
    const auto values = setup_values(control);
    EXPECT_TRUE(values.tool.empty()) << control;
    EXPECT_FALSE(values.has_offsets || values.has_variables) << control;
  }
  for (const Dialect& dialect : dialects()) {
    const auto values = setup_values(dialect.name);
    EXPECT_EQ(values.tool.empty(), !values.has_offsets) << dialect.name << " has no row?";
  }
}

}  // namespace
}  // namespace dripline::interpreter
