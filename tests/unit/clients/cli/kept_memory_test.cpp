#include "clients/cli/server/kept_memory.hpp"

#include <gtest/gtest.h>

namespace dripline::cli {
namespace {

TEST(KeptMemory, IsFilteredByName) {
  client::Memory reported;
  reported.cells = {{"P10", 7.5, 0}, {"PB50", 2, 1}, {"#500", std::nullopt, 3}};
  const KeptMemory memory = cells_of(reported);
  EXPECT_EQ(memory.at("#500"), (KeptCell{std::nullopt, 3}));
  EXPECT_EQ(filtered(memory, "P").size(), 2U);
  EXPECT_EQ(filtered(memory, "").size(), 3U);
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

TEST(KeptMemory, LeavesASetupAloneThatItCannotAddTo) {
  EXPECT_FALSE(with_variables("variable = []\n", {{"P1", 1}}));
  EXPECT_FALSE(with_variables("= nonsense", {{"P1", 1}}));
}

}  // namespace
}  // namespace dripline::cli
