#include "clients/cli/setup/setup_edit.hpp"

#include <gtest/gtest.h>

#include <vector>

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

}  // namespace
}  // namespace dripline::cli
