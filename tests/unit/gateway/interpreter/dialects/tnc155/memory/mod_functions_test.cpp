#include "gateway/interpreter/dialects/tnc155/memory/mod_functions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace dripline::interpreter::tnc155 {
namespace {

using testing::ElementsAre;

Result<ModSettings> settings_of(const std::string& control, const std::string& head = "") {
  const auto setup = parse_setup(head + "[control]\n" + control);
  EXPECT_TRUE(setup) << setup.error().what;
  return read_mod_settings(setup->control);
}

/// "NAME = value" of each line of the menu.
std::vector<std::string> menu_of(const ModSettings& settings) {
  std::vector<std::string> lines;
  for (const ModFunction& function : mod_functions(settings, 3'059)) {
    lines.push_back(function.name + " = " + function.value);
  }
  return lines;
}

// HD-081: everything the menu holds, in the order in which the control pages.
TEST(ModFunctions, StandInTheControlsOrder) {
  EXPECT_THAT(menu_of({}),
              ElementsAre("VACANT BLOCKS = 3059", "CHANGE MM/INCH = mm", "POSITION DATA = ACTL",
                          "POSITION DISPLAY = small", "BLOCK NUMBER INCREMENT = 10",
                          "BAUD RATE = -", "LIMIT X+ = off", "LIMIT X- = off", "LIMIT Y+ = off",
                          "LIMIT Y- = off", "LIMIT Z+ = off", "LIMIT Z- = off", "LIMIT IV+ = off",
                          "LIMIT IV- = off", "NC SOFTWARE NUMBER = -", "PLC SOFTWARE NUMBER = -",
                          "USER PARAMETERS = 0", "CODE NUMBER = -"));
  EXPECT_EQ(mod_functions({}, 1)[0].range, "of 3100");
  EXPECT_EQ(mod_functions({}, 1)[6].range, "-30000.000 mm to +30000.000 mm");
}

// HD-081, HD-082, HD-083, HD-087.
TEST(ModFunctions, AreOptionsOfASetup) {
  const auto settings = settings_of(
      "display_units = \"inch\"\nposition_display = \"DIST\"\ndisplay_size = \"large\"\n"
      "block_increment = 5\nbaud_rate = 4800\nfourth_axis = \"C\"\nmemory_blocks = 1200\n"
      "limit_low = { X = -25.4, C = -90 }\nlimit_high = { X = 30000 }\n"
      "nc_software = \"227 020 08\"\nplc_software = \"228 601 01\"\n");
  ASSERT_TRUE(settings) << settings.error().what;
  EXPECT_THAT(
      menu_of(*settings),
      ElementsAre("VACANT BLOCKS = 3059", "CHANGE MM/INCH = inch", "POSITION DATA = DIST",
                  "POSITION DISPLAY = large", "BLOCK NUMBER INCREMENT = 5", "BAUD RATE = 4800",
                  "LIMIT X+ = off", "LIMIT X- = -1.0000 inch", "LIMIT Y+ = off", "LIMIT Y- = off",
                  "LIMIT Z+ = off", "LIMIT Z- = off", "LIMIT IV+ = off", "LIMIT IV- = -90.000 deg",
                  "NC SOFTWARE NUMBER = 227 020 08", "PLC SOFTWARE NUMBER = 228 601 01",
                  "USER PARAMETERS = 0", "CODE NUMBER = -"));
  EXPECT_EQ(mod_functions(*settings, 1)[0].range, "of 1200");
}

struct WrongOption {
  const char* name;
  std::string control, error;
};
class WrongModOption : public testing::TestWithParam<WrongOption> {};

// HD-081, HD-082, HD-083, HD-086, HD-087: what no control holds is named with its limit.
TEST_P(WrongModOption, IsRefused) {
  const auto settings = settings_of(GetParam().control);
  ASSERT_FALSE(settings);
  EXPECT_EQ(settings.error().what, GetParam().error);
}

std::string parameters(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) {
    text += "[[control.user_parameters]]\nparameter = " + std::to_string(i) + "\nvalue = 1\n";
  }
  return text;
}
std::string one(const std::string& entries) {
  return "[[control.user_parameters]]\n" + entries;
}

INSTANTIATE_TEST_SUITE_P(
    , WrongModOption,
    testing::Values(
        WrongOption{"units", "display_units = \"cm\"",
                    "option display_units: \"cm\" is none of mm, inch"},
        WrongOption{"position", "position_display = \"ACTUAL\"",
                    "option position_display: \"ACTUAL\" is none of ACTL, REF, LAG, NOML, DIST"},
        WrongOption{"size", "display_size = \"huge\"",
                    "option display_size: \"huge\" is none of small, large"},
        WrongOption{"increment", "block_increment = 100",
                    "option block_increment: 100 is not 0 to 99"},
        WrongOption{"baud", "baud_rate = 19200",
                    "option baud_rate: 19200 is none of 110, 150, 300, 600, 1200, 2400, 4800, "
                    "9600"},
        WrongOption{"limit", "limit_high = { Y = 30001 }",
                    "option limit_high: Y 30001 is not -30000 to 30000"},
        WrongOption{"nc", "nc_software = \"227 020\"",
                    "option nc_software: \"227 020\" is no software number as 227 020 08"},
        WrongOption{"plc", "plc_software = \"228-601-01\"",
                    "option plc_software: \"228-601-01\" is no software number as 227 020 08"},
        WrongOption{"seventeen", parameters(17),
                    "option user_parameters: 17 are given, the control has 16"},
        WrongOption{"no_list", "user_parameters = 3",
                    "option user_parameters: expected a list of tables, "
                    "[[control.user_parameters]]"},
        WrongOption{"no_number", one("value = 1"),
                    "option user_parameters: 1: parameter is missing: the number of a machine "
                    "parameter"},
        WrongOption{"no_value", one("parameter = 7"),
                    "option user_parameters: 1: value of MP7 is missing"},
        WrongOption{"beyond", one("parameter = 237\nvalue = 1"),
                    "option user_parameters: 1: MP237: there are MP0 to MP236"},
        WrongOption{"unknown_key", one("parameter = 7\nvalue = 1\ncolor = 2"),
                    "option user_parameters: 1: color is nothing a user parameter has; it has "
                    "parameter, text, value, min, max"},
        WrongOption{"out_of_range",
                    one("parameter = 7\nvalue = 9\nmin = 0\nmax = 8\n"
                        "text = \"COOLANT\""),
                    "option user_parameters: 1: COOLANT (MP7): 9 is not 0 to 8"},
        WrongOption{"below", one("parameter = 7\nvalue = -1\nmin = 0"),
                    "option user_parameters: 1: USER PAR. 1 (MP7): -1 is not at least 0"},
        WrongOption{"range", one("parameter = 7\nvalue = 1\nmin = 2\nmax = 1"),
                    "option user_parameters: 1: min, 2, is more than max, 1"},
        WrongOption{"twice", one("parameter = 7\nvalue = 1\n") + one("parameter = 7\nvalue = 1\n"),
                    "option user_parameters: 2: MP7 is one already"},
        WrongOption{"named_twice",
                    one("parameter = 7\nvalue = 1\ntext = \"A\"\n") +
                        one("parameter = 8\nvalue = 1\ntext = \"A\"\n"),
                    "option user_parameters: 2: \"A\" names another one already"},
        WrongOption{"other_value",
                    "machine_parameters = { MP7 = 3 }\n" + one("parameter = 7\nvalue = 1\n"),
                    "option user_parameters: 1: 1, but machine_parameters has MP7 = 3"}),
    [](const auto& i) { return std::string(i.param.name); });

// HD-086: up to 16, with the builder's text or the control's own.
TEST(UserParameters, HaveTextsAndAreFoundByThem) {
  const auto settings =
      settings_of(one("parameter = 173\ntext = \"KEEP DATUM\"\nvalue = 1\nmin = 0\nmax = 1\n") +
                  one("parameter = 80\nvalue = 2.5\n"));
  ASSERT_TRUE(settings) << settings.error().what;
  ASSERT_EQ(settings->user_parameters.size(), 2u);
  EXPECT_EQ(settings->user_parameters[0].text, "KEEP DATUM");
  EXPECT_EQ(settings->user_parameters[1].text, "USER PAR. 2");
  EXPECT_EQ(settings->user_parameters[1].value, 2.5);
  for (const char* name : {"USER PAR. 2", "2", "MP80"}) {
    EXPECT_EQ(*find_user_parameter(*settings, name), 1u) << name;
  }
  for (const char* name : {"3", "0", "80", "MP81", "KEEP"}) {
    const auto found = find_user_parameter(*settings, name);
    ASSERT_FALSE(found) << name;
    EXPECT_EQ(found.error().what, "'" + std::string(name) +
                                      "' is no user parameter; there are: 1 KEEP DATUM (MP173), "
                                      "2 USER PAR. 2 (MP80)");
  }
  EXPECT_EQ(find_user_parameter({}, "1").error().what,
            "'1' is no user parameter; the setup has none");
  EXPECT_TRUE(settings_of(parameters(16)));
}

}  // namespace
}  // namespace dripline::interpreter::tnc155
