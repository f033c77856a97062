#include "clients/cli/kept_memory.hpp"

#include <gtest/gtest.h>

namespace dripline::cli {
namespace {

TEST(KeptMemory, IsReadPartByPart) {
  KeptMemory memory;
  ASSERT_TRUE(
      add_memory_text(R"({"part":1,"parts":2,"cells":{"P10":[7.5,0],"PB50":[2,1]}})", memory));
  ASSERT_TRUE(add_memory_text(R"({"part":2,"parts":2,"cells":{"#500":[null,3]}})", memory));
  ASSERT_EQ(memory.size(), 3U);
  EXPECT_EQ(memory["P10"], (KeptCell{7.5, 0}));
  EXPECT_EQ(memory["#500"], (KeptCell{std::nullopt, 3}));
  EXPECT_EQ(filtered(memory, "P").size(), 2U);
  EXPECT_EQ(filtered(memory, "").size(), 3U);
}

TEST(KeptMemory, IsNotReadFromOtherTexts) {
  for (const char* text :
       {"", "DRILL", "[]", R"({"cells":[]})", R"({"cells":{"P1":1}})", R"({"cells":{"P1":[1]}})",
        R"({"cells":{"a\"b":[1,2]}})", R"({"cells":{"P1":["1",2]}})", "[[[[[[[[[[[["}) {
    KeptMemory memory;
    EXPECT_FALSE(add_memory_text(text, memory)) << text;
  }
}

TEST(KeptMemory, BecomesVariablesOfASetup) {
  const std::string setup =
      "# the lathe\n[[variable]]\nname = \"P10\"  # wear\nvalue = 3\n\n[control]\nx = 1\n";
  const auto text = with_variables(setup, {{"P10", 7.5}, {"P511", 0.5}});
  ASSERT_TRUE(text) << text.error().what;
  EXPECT_EQ(*text,
            "# the lathe\n[[variable]]\nname = \"P10\"  # wear\nvalue = 7.5\n\n[control]\nx = 1\n"
            "\n[[variable]]\nname = \"P511\"\nvalue = 0.5\n");
  EXPECT_EQ(with_variables(*text, {{"P10", 7.5}, {"P511", 0.5}}).value(), *text);
}

TEST(KeptMemory, LeavesASetupAloneThatItCanNotAddTo) {
  EXPECT_FALSE(with_variables("variable = []\n", {{"P1", 1}}));
  EXPECT_FALSE(with_variables("= nonsense", {{"P1", 1}}));
}

}  // namespace
}  // namespace dripline::cli
