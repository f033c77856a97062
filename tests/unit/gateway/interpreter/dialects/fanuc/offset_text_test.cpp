#include "gateway/interpreter/dialects/fanuc/memory/offset_text.hpp"

#include <gtest/gtest.h>
#include <map>

#include "gateway/interpreter/core/retained_memory.hpp"
#include "tests/unit/gateway/interpreter/dialects/fanuc/program_run.hpp"

namespace dripline::interpreter::fanuc {
namespace {

std::string written(const std::string& toml, bool is_lathe = false) {
  const auto data = parse_control_data(toml);
  if (!data) return "setup: " + data.error().what;
  const auto text = write_offset_text(*data, is_lathe);
  return text ? *text : text.error().what;
}

/// What is not 0 of the memory after a program ran on a control with this setup.
template <const Dialect& kDialect>
std::map<std::string, double> memory_after(const std::string& program, const std::string& toml) {
  DialectRun<kDialect> run(program, *parse_control_data(toml));
  EXPECT_EQ(run.step(), StepState::Ended) << run.alarm();
  auto& retained = dynamic_cast<RetainedMemory&>(run.interpreter());
  const auto cells = retained.memory_cells();
  std::vector<double> values;
  EXPECT_TRUE(retained.read_memory(values));
  std::map<std::string, double> held;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (values[i] != 0 && !std::isnan(values[i])) held[cells[i].name] = std::round(values[i] * 1e4);
  return held;
}

/// The text, run on a control that has nothing but the options, gives what the setup has.
template <const Dialect& kDialect>
void expect_same_memory(const std::string& options, const std::string& tables) {
  const std::string toml = options + tables;
  const auto data = parse_control_data(toml);
  ASSERT_TRUE(data) << data.error().what;
  const auto text = write_offset_text(*data, &kDialect == &kFanucLatheDialect);
  ASSERT_TRUE(text) << text.error().what;
  const auto wanted = memory_after<kDialect>("M30\n", toml);
  EXPECT_FALSE(wanted.empty());
  EXPECT_EQ(memory_after<kDialect>(*text, options), wanted) << *text;
}

constexpr const char* kSystems =
    "[[offset]]\nname = \"EXT\"\nZ = -1.5\n[[offset]]\nname = \"G54\"\nX = -300.125\nY = 0\nZ = "
    "-20.5\n"
    "[[offset]]\nname = \"G59\"\nX = 7\nC = 12.5\n[[offset]]\nname = \"G54.1P12\"\nY = 3\n";

TEST(FanucOffsetText, GivesAMillWhatTheSetupHas) {
  expect_same_memory<kFanucDialect>(
      "[control]\noffset_memory = \"C\"\n",
      std::string(kSystems) +
          "[[tool]]\nnumber = 3\nlength = 101.234\nradius = 5\nwear = { Z = -0.05, radius = 0.012 "
          "}\n"
          "[[tool]]\nnumber = 200\nlength = -1\n[[variable]]\nname = \"#500\"\nvalue = 1.25\n");
}

TEST(FanucOffsetText, GivesOffsetMemoriesAAndBWhatTheyHave) {
  EXPECT_EQ(written("[control]\noffset_memory = \"B\"\n[[tool]]\nnumber = 3\nlength = 80\n"
                    "wear = { Z = 0.1 }\n"),
            "%\n(TOOLS AND OFFSETS)\nG21 G90\nG10 L10 P3 R80.\nG10 L11 P3 R0.1\nM30\n%\n");
  EXPECT_EQ(written("[[tool]]\nnumber = 3\nradius = 5\n"),
            "%\n(TOOLS AND OFFSETS)\nG21 G90\nG10 L11 P3 R5.\nM30\n%\n");
  const std::string both = "[[tool]]\nnumber = 4\nlength = 80\nradius = 5\n";
  for (const char* memory : {"A", "B"}) {
    const std::string options = std::string("[control]\noffset_memory = \"") + memory + "\"\n";
    EXPECT_NE(written(options + both).find("tool 4: the control's offset memory has one number"),
              std::string::npos);
  }
  EXPECT_NE(written("[[tool]]\nnumber = 5\nlength = 80\nwear = { Z = 0.1 }\n").find("has no wear"),
            std::string::npos);
}

TEST(FanucOffsetText, GivesALatheDiametersAndItsTips) {
  for (const char* system : {"A", "B", "C"}) {
    expect_same_memory<kFanucLatheDialect>(
        std::string("[control]\ncode_system = \"") + system + "\"\n",
        "[[tool]]\nnumber = 3\nX = 40.25\nZ = -12.5\nradius = 0.8\ntip = 3\n"
        "wear = { X = -0.015, Z = 0.02, radius = 0.001 }\n"
        "[[offset]]\nname = \"G54\"\nX = 1\nZ = 150\n");
  }
  EXPECT_EQ(
      written("units = \"mm\"\n[[tool]]\nnumber = 3\nwear = { X = 0.01 }\n", true),
      "%\n(TOOLS AND OFFSETS)\nG21\nG10 P10003 X0. Z0. R0. Q0\nG10 P3 X0.02 Z0. R0.\nM30\n%\n");
}

TEST(FanucOffsetText, IsInTheUnitsOfTheSetup) {
  const std::string inch =
      "units = \"in\"\n[control]\noffset_memory = \"C\"\n[[tool]]\nnumber = 1\n"
      "length = 4.12341\n";
  EXPECT_NE(written(inch).find("G20 G90\nG10 L10 P1 R4.1234"), std::string::npos) << written(inch);
}

TEST(FanucOffsetText, RefusesWhatTheControlHasNoNumberFor) {
  EXPECT_NE(written("[[offset]]\nname = \"G92\"\nX = 1\n").find("offset G92"), std::string::npos);
  EXPECT_NE(
      written("[[tool]]\nnumber = 1\nlength = 1000\n").find("tool 1: 1000 mm is beyond 999.999"),
      std::string::npos);
  EXPECT_NE(written("[[variable]]\nname = \"G54.X\"\nvalue = 1\n").find("variable G54.X"),
            std::string::npos);
}

}  // namespace
}  // namespace dripline::interpreter::fanuc
