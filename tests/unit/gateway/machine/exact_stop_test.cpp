#include <gtest/gtest.h>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"
#include "tests/unit/gateway/machine/test_machine.hpp"

/// Exact stops of whole programs, by the time that the machine takes: positions do not show them.
namespace dripline::machine::test {
namespace {

/// Seconds from the program's first move to its end on a plain machine.
double seconds_of(const std::string& control, const std::string& text, const std::string& setup) {
  const interpreter::Dialect* dialect = *interpreter::find_dialect(control);
  const auto parsed = interpreter::parse_setup(setup, dialect->units);
  interpreter::MemorySource source(text);
  TestMachine test;
  auto made = dialect->make(*parsed, source, test.machine.events());
  EXPECT_TRUE(made) << (made ? "" : made.error().what);
  while ((*made)->step(1) == interpreter::StepState::Ran) {
  }
  const double seconds = test.run_all();
  EXPECT_EQ(test.recorder.lines.back(), "end") << text;
  return seconds;
}

/// Moves of 10 mm at 20 mm/s, straight on: as one where nothing stops between them.
double moves(std::initializer_list<int> each) {
  double seconds = 0;
  for (const int tens : each) seconds += trapezoid(10 * tens, 20, 1000);
  return seconds;
}

/// The same in rapid traverse at 100 mm/s.
double rapids(std::initializer_list<int> each) {
  double seconds = 0;
  for (const int tens : each) seconds += trapezoid(10 * tens, 100, 1000);
  return seconds;
}

struct ProgramCase {
  const char* name;
  const char* control;
  const char* text;
  double seconds;
  const char* setup = "";
};
class ExactStop : public testing::TestWithParam<ProgramCase> {};

TEST_P(ExactStop, TakesTheTimeOfItsRests) {
  const ProgramCase& row = GetParam();
  EXPECT_NEAR(seconds_of(row.control, row.text, row.setup), row.seconds, 1e-6);
}

// FAN-020
INSTANTIATE_TEST_SUITE_P(
    Fanuc, ExactStop,
    testing::Values(
        ProgramCase{"cutting_mode", "fanuc", "G01 X10. F1200\nX20.\nX30.\nM30\n", moves({3})},
        ProgramCase{"one_block", "fanuc", "G01 X10. F1200\nG09 X20.\nX30.\nM30\n", moves({2, 1})},
        ProgramCase{"mode", "fanuc", "G61 G01 X10. F1200\nX20.\nX30.\nM30\n", moves({1, 1, 1})},
        ProgramCase{"mode_until_g64", "fanuc", "G61 G01 X10. F1200\nG64 X20.\nX30.\nM30\n",
                    moves({1, 2})},
        ProgramCase{"mode_until_g63", "fanuc", "G61 G01 X10. F1200\nG63 X20.\nX30.\nM30\n",
                    moves({1, 2})},
        // A quarter of radius 10 between two lines that are tangent to it.
        ProgramCase{"arc_in_passing", "fanuc",
                    "G18 G01 Z10. F1200\nG03 Z20. X10. I10.\nG01 X20.\nM30\n",
                    trapezoid(20 + 5 * Angle::kPi, 20, 1000)},
        ProgramCase{"arc_at_rest", "fanuc",
                    "G18 G61 G01 Z10. F1200\nG03 Z20. X10. I10.\nG01 X20.\nM30\n",
                    moves({1, 1}) + trapezoid(5 * Angle::kPi, 20, 1000)},
        ProgramCase{"arc_of_g09", "fanuc",
                    "G18 G01 Z10. F1200\nG09 G03 Z20. X10. I10.\nG01 X20.\nM30\n",
                    moves({1}) + trapezoid(10 + 5 * Angle::kPi, 20, 1000)},
        ProgramCase{"rapid_traverse", "fanuc", "G00 X10.\nX20.\nX30.\nM30\n", rapids({1, 1, 1})},
        ProgramCase{"within_compensation", "fanuc",
                    "G18 G42 D1 G01 X10. F1200\nX20.\nG09 X30.\nX40.\nX50.\nM30\n", moves({3, 2})}),
    [](const auto& row) { return std::string{row.param.name}; });

constexpr const char* kLinuxCnc = "[control]\nprofile = \"linuxcnc\"\n";

// NGC-041
INSTANTIATE_TEST_SUITE_P(
    Rs274ngc, ExactStop,
    testing::Values(
        ProgramCase{"continuous", "rs274ngc", "G21 G1 X10 F1200\nX20\nX30\nM2\n", moves({3})},
        ProgramCase{"exact_path_passes_points_on_a_line", "rs274ngc",
                    "G21 G61 G1 X10 F1200\nX20\nX30\nM2\n", moves({3})},
        ProgramCase{"exact_stop", "rs274ngc", "G21 G61.1 G1 X10 F1200\nX20\nX30\nM2\n",
                    moves({1, 1, 1})},
        ProgramCase{"exact_stop_until_g64", "rs274ngc",
                    "G21 G61.1 G1 X10 F1200\nG64 X20\nX30\nM2\n", moves({1, 2})},
        ProgramCase{"exact_stop_until_g61", "rs274ngc",
                    "G21 G61.1 G1 X10 F1200\nG61 X20\nX30\nM2\n", moves({1, 2})},
        ProgramCase{"arc", "rs274ngc", "G21 G18 G61.1 G1 Z10 F1200\nG3 Z20 X10 I10\nG1 X20\nM2\n",
                    moves({1, 1}) + trapezoid(5 * Angle::kPi, 20, 1000)},
        ProgramCase{"rapid_traverse", "rs274ngc", "G21 G61.1 G0 X10\nX20\nX30\nM2\n",
                    rapids({1, 1, 1})},
        ProgramCase{"rapid_traverse_blended", "rs274ngc", "G21 G0 X10\nX20\nX30\nM2\n",
                    rapids({3})},
        ProgramCase{"rapid_held_by_compensation", "rs274ngc",
                    "G21 G18 G61.1\nG41.1 D0 G0 X10\nX20\nX30\nG40\nM2\n", rapids({1, 1, 1}),
                    kLinuxCnc},
        ProgramCase{"later_profile", "rs274ngc", "G21 G61.1 G1 X10 F1200\nX20\nG64 X30\nM2\n",
                    moves({1, 1, 1}), kLinuxCnc},
        ProgramCase{"held_by_compensation", "rs274ngc",
                    "G21 G18 G61.1\nG41.1 D0.5 G1 X10 F1200\nX20\nX30\nG40\nM2\n",
                    std::hypot(10, 0.25) / 20 + 0.2 / std::hypot(10, 0.25) + moves({1, 1}),
                    kLinuxCnc}),
    [](const auto& row) { return std::string{row.param.name}; });

// CEN-057
INSTANTIATE_TEST_SUITE_P(Centurion, ExactStop,
                         testing::Values(ProgramCase{"rapid_traverse", "centurion",
                                                     "G0 Z1\nZ2\nZ3\nM2\n",
                                                     3 * trapezoid(25.4, 100, 1000)}),
                         [](const auto& row) { return std::string{row.param.name}; });

// TK-19
INSTANTIATE_TEST_SUITE_P(Tektronix1704, ExactStop,
                         testing::Values(ProgramCase{"rapid_traverse", "tektronix-1704",
                                                     "%\nG50X10000\nX20000\nX30000\nM02\n",
                                                     3 * trapezoid(25.4, 100, 1000)}),
                         [](const auto& row) { return std::string{row.param.name}; });

}  // namespace
}  // namespace dripline::machine::test
