#include "gateway/app/run/start_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/registry.hpp"

namespace dripline::gateway {
namespace {

struct ReaderCase {
  std::string name;
  std::string setup;  ///< the text of the setup file
  std::string startup_code, settings;
  std::string why;  ///< in the refusal; empty: the program begins
};
void PrintTo(const ReaderCase& shown, std::ostream* out) {
  *out << shown.name;
}
class Reader : public testing::TestWithParam<ReaderCase> {};

const std::string kLater = "[control]\nprofile = \"linuxcnc\"\n";

TEST_P(Reader, BeginsProgramsOnlyInTheModesOfTheMachine) {
  const ReaderCase& given = GetParam();
  const auto setup = interpreter::parse_setup(given.setup);
  ASSERT_TRUE(setup) << setup.error().what;
  const machine::ProgramReader reader{
      .control = "rs274ngc", .startup_code = given.startup_code, .settings = given.settings};
  const auto done = check_reader(reader, **interpreter::find_dialect("rs274ngc"), *setup);
  EXPECT_EQ(done.has_value(), given.why.empty());
  if (!done) {
    EXPECT_THAT(done.error().what, testing::HasSubstr(given.why));
  }
}

INSTANTIATE_TEST_SUITE_P(
    , Reader,
    testing::Values(
        ReaderCase{"none", kLater, "", "", ""},
        ReaderCase{"that_of_power_on", kLater, "G21 G40 G90 G94 G97 G64 F10 (as at power on)", "",
                   ""},
        ReaderCase{"inches", kLater, "G20 G90", "", "Set startup_code = \"G20 G90\" in [control]"},
        ReaderCase{"inches_stated", kLater + "startup_code = \"G20\"\n", "G20 G90", "", ""},
        ReaderCase{"path_mode", kLater, "G61", "", "with other modes"},
        ReaderCase{"inches_in_the_setup_only", kLater + "startup_code = \"G20\"\n", "", "",
                   "the machine none"},
        ReaderCase{"incremental", kLater, "G91", "",
                   "G91 would be in force until the first M2 only"},
        ReaderCase{"an_offset", kLater, "G10 L2 P1 X5", "", "does more than set modes"},
        ReaderCase{"an_error", kLater, "G21 G20", "", "cannot begin as at the machine"},
        ReaderCase{"profile_nist", "", "G20 G64 P0.01 G91.1", "", "Set startup_code"},
        ReaderCase{"length_of_every_tool", kLater, "", "[RS274NGC]RETAIN_G43",
                   "[RS274NGC]RETAIN_G43: take it out"},
        ReaderCase{"another_unit", "units = \"in\"\n" + kLater, "", "",
                   "the machine's unit is mm, that of the setup in"}),
    [](const auto& each) { return each.param.name; });

TEST(ReaderOfAnotherControl, StatesNothing) {
  const machine::ProgramReader reader{.control = "rs274ngc", .startup_code = "G91"};
  const auto setup = interpreter::parse_setup("");
  EXPECT_TRUE(check_reader(reader, **interpreter::find_dialect("fanuc"), *setup));
  EXPECT_TRUE(check_reader(std::nullopt, **interpreter::find_dialect("rs274ngc"), *setup));
}

}  // namespace
}  // namespace dripline::gateway
