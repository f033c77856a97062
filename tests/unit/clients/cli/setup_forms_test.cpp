#include "clients/cli/setup/setup_forms.hpp"

#include <gtest/gtest.h>

namespace dripline::cli {
namespace {

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

}  // namespace
}  // namespace dripline::cli
