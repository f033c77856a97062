#include <vector>

#include <gtest/gtest.h>

#include "clients/cli/setup/setup_changes.hpp"
#include "clients/cli/setup/setup_forms.hpp"

namespace dripline::cli {

namespace {

std::string edited(std::string_view toml, const std::vector<SetupChange>& changes) {
  const auto text = with_numbers(toml, changes);
  return text ? *text : "! " + text.error().what;
}

TEST(SetupEdit, ChangesNumbersAndNothingElse) {
  EXPECT_EQ(edited("# Fräser\nunits = \"mm\"\n[[tool]]\nnumber = 1\npocket = 3   # vorn\n\n"
                   "[[tool]]\nnumber = 2\npocket=12\r\n",
                   {{"tool[0].pocket", "12"}, {"tool[1].pocket", "0"}}),
            "# Fräser\nunits = \"mm\"\n[[tool]]\nnumber = 1\npocket = 12   # vorn\n\n"
            "[[tool]]\nnumber = 2\npocket=0\r\n");
}

TEST(SetupEdit, FindsNumbersAfterOtherLetters) {
  EXPECT_EQ(
      edited("[control]\nuser_parameters = [ { text = \"Kühlmittel än\", value = -1.5e3 }, "
             "{ text = \"日本\", value = +7 } ]\nmachine_parameters = { MP7 = 0x10, MP8 = 2 }",
             {{"control.user_parameters[1].value", "8"},
              {"control.user_parameters[0].value", "2.25"},
              {"control.machine_parameters.MP7", "5"}}),
      "[control]\nuser_parameters = [ { text = \"Kühlmittel än\", value = 2.25 }, "
      "{ text = \"日本\", value = 8 } ]\nmachine_parameters = { MP7 = 5, MP8 = 2 }");
  EXPECT_EQ(edited("a = 1", {{"a", "22"}}), "a = 22") << "without a line end";
  EXPECT_EQ(edited("a = 1\n", {}), "a = 1\n");
}

TEST(SetupEdit, SaysWhatIsNotThere) {
  EXPECT_EQ(edited("a = 1\n", {{"b", "2"}}), "! the setup has no number at b");
  EXPECT_EQ(edited("a = \"1\"\n", {{"a", "2"}}), "! the setup has no number at a");
  EXPECT_EQ(edited("[[tool]]\npocket = 1\n", {{"tool[1].pocket", "2"}}),
            "! the setup has no number at tool[1].pocket");
  EXPECT_TRUE(edited("a = \n", {}).starts_with("! line 1: "));
}

// HD-234, HD-238: what goes out to a control is what that control has.
TEST(SetupForms, SendOnlyParametersThatTheControlHas) {
  const auto sent = [](const std::string& control) {
    const auto text = machine_parameters_text("[control]\n" + control +
                                              "machine_parameters = { MP222 = 168, MP235 = 1 }\n");
    return text ? *text : text.error().what;
  };
  EXPECT_EQ(sent(""), "MP222: 168\r\nMP235: 1\r\n");
  EXPECT_EQ(sent("software = 5\nmodel = \"TNC 151 P\"\n"), "MP222: 168\r\nMP235: 1\r\n");
  EXPECT_EQ(sent("software = 5\n"),
            "option machine_parameters, line 3: MP235: a TNC 155 A with software 05 has no machine "
            "parameters 235 and 236 (from software 06)");
}

TEST(SetupForms, SendAToolStoreToAControlThatHasOne) {
  const auto sent = [](const std::string& control) {
    const auto text =
        control_form_of("[control]\n" + control + "[[tool]]\nnumber = 1\nlength = 2.0\n", "tnc155");
    return text ? *text : text.error().what;
  };
  const std::string store = "0 BEGIN PGM 0 MM\r\nT1 P L+2,000 R+0,000\r\n2 END PGM 0 MM\r\n";
  EXPECT_EQ(sent(""), store);
  EXPECT_EQ(sent("software = 3\n"), store);
  EXPECT_EQ(sent("software = 2\n"),
            "a TNC 155 A with software 02 has no central tool store (from software 03)");
}

/// CEN-220: a Centurion's numbers are not known without a map.
TEST(SetupForms, GiveACenturionOnlyNumbersThatAreKnown) {
  const std::string toml = "[[offset]]\nname = \"G54\"\nZ = 1.5\n";
  const auto ours = control_form_of(toml, "centurion");
  ASSERT_TRUE(ours);
  EXPECT_TRUE(ours->starts_with("(DRIPLINE'S OWN NUMBERS OF PARAMETERS: NOT FOR A CONTROL)\n"));
  EXPECT_TRUE(setup_of_control_form(*ours, {}));
  const auto mapped = control_form_of(toml, "centurion", "P500 = P7010\n");
  ASSERT_TRUE(mapped);
  EXPECT_EQ(*mapped, "G20\nP188=1\nP189=1\nG10\nP7010=1.5\nG11\nM30\n");
  EXPECT_FALSE(setup_of_control_form(*mapped, {}));
  EXPECT_TRUE(setup_of_control_form(*mapped, {}, "P500 = P7010\n"));
  EXPECT_EQ(control_form_of(toml, "centurion", "P500 7010").error().what,
            "map: line 1: \"P500 7010\": expected a row as P500 = P7012");
}

TEST(SetupForms, GiveAFanucControlAProgramOfG10) {
  const std::string toml = "[[tool]]\nnumber = 3\nwear = { X = 0.01, Z = -0.02 }\n";
  EXPECT_EQ(*control_form_of(toml, "fanuc-t"),
            "%\n(TOOLS AND OFFSETS)\nG21\nG10 P10003 X0. Z0. R0. Q0\nG10 P3 X0.02 Z-0.02 R0.\n"
            "M30\n%\n");
  EXPECT_NE(
      control_form_of("[[tool]]\nnumber = 3\nlength = 80\n", "fanuc")->find("G10 L11 P3 R80."),
      std::string::npos);
  EXPECT_NE(control_form_of(toml, "tektronix-1704").error().what.find("no form of a setup"),
            std::string::npos);
}

TEST(SetupForms, AreTheTablesOfLinuxCnc) {
  const std::string tools = "T3 P2 Z80 D6 ;drill\n", parameters = "5221 1.5\n";
  EXPECT_TRUE(is_table_file(tools));
  EXPECT_FALSE(is_table_file("0 BEGIN PGM 0 MM\n"));
  const auto toml = setup_of_table_files({parameters, tools}, interpreter::Units::Inch);
  ASSERT_TRUE(toml) << toml.error().what;
  EXPECT_EQ(*control_form_of(*toml, "rs274ngc"), "T3 P2 Z80 D6\n");
  EXPECT_NE(machine_parameters_text(*toml, "rs274ngc")->find("5221\t1.500000\n"),
            std::string::npos);
  EXPECT_EQ(setup_of_table_files({tools, tools}, interpreter::Units::Inch).error().what,
            "both files are tool tables");
  EXPECT_EQ(setup_of_table_files({"T9 P12 L+1,5"}, interpreter::Units::Inch).error().what,
            "tool table, line 1: L+1,5 is no word of a tool");
  EXPECT_FALSE(is_table_file("T9 P12 L+1,5 R+0,25\n")) << "a TNC's tool store";
}

}  // namespace

TEST(SetupForms, AreNotMadeForAControlThatHasNone) {
  const auto refused = control_form_of("[[tool]]\nnumber = 1\nlength = 2.0\n", "prototrak-plus");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Unsupported);
  EXPECT_NE(refused.error().what.find("control prototrak-plus"), std::string::npos)
      << refused.error().what;
}

TEST(SetupForms, OfATncDoNotLeaveAWearOutUnseen) {
  const auto refused =
      control_form_of("[[tool]]\nnumber = 3\nlength = 2.0\nwear = { Z = -0.1 }\n", "tnc155");
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().what.find("tool 3 has a wear"), std::string::npos)
      << refused.error().what;
}

}  // namespace dripline::cli
