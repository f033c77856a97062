#include "clients/cli/setup_forms.hpp"

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

}  // namespace
}  // namespace dripline::cli
