#include "server/offsets/offset_rule.hpp"

#include <gtest/gtest.h>
#include <string>

namespace dripline::offsets {
namespace {

constexpr const char* kRule = R"(
[[rule]]
name = "D40"
characteristic = "D40"
target = "T3.wear.X"
scale = 0.5
max_step = 0.02
automatic = 0.005
lowest = -0.3
)";

TEST(OffsetRule, IsReadWithItsDefaults) {
  const auto rules = parse_offset_rules(kRule);
  ASSERT_TRUE(rules) << rules.error().what;
  ASSERT_EQ(rules->size(), 1U);
  const OffsetRule& rule = rules->front();
  EXPECT_EQ(rule.target, "T3.wear.X");
  EXPECT_EQ(rule.scale, 0.5);
  EXPECT_EQ(rule.gain, 0.5);
  EXPECT_EQ(rule.min_count, 3U);
  EXPECT_EQ(rule.automatic, 0.005);
  EXPECT_EQ(rule.lowest, -0.3);
  EXPECT_FALSE(rule.highest);
  EXPECT_TRUE(parse_offset_rules("")->empty());
}

TEST(OffsetRule, IsLimitedToAProgramAToolAndATemplate) {
  EXPECT_EQ(scope_text(parse_offset_rules(kRule)->front()), "") << "it is for all";
  const auto limited = parse_offset_rules(std::string(kRule) +
                                          "program = \"O0900\"\ntool = 3\ntemplate = \"bore\"\n");
  ASSERT_TRUE(limited) << limited.error().what;
  EXPECT_EQ(scope_text(limited->front()), "of program O0900 by tool T3 read by template bore");
  for (const char* tool : {"T3", "3", "03", "T03", "t3"}) EXPECT_EQ(bare_tool(tool), "3") << tool;
  EXPECT_EQ(bare_tool("TOUCH"), "TOUCH");
  EXPECT_EQ(bare_tool("T3A"), "T3A");
  EXPECT_EQ(bare_tool("000"), "0");
}

struct BadRule {
  const char* name;
  const char* added;
  const char* error;
};
class BadRules : public testing::TestWithParam<BadRule> {};
TEST_P(BadRules, AreRefused) {
  const auto rules = parse_offset_rules(std::string(kRule) + GetParam().added);
  ASSERT_FALSE(rules);
  EXPECT_NE(rules.error().what.find(GetParam().error), std::string::npos) << rules.error().what;
}
INSTANTIATE_TEST_SUITE_P(
    , BadRules,
    testing::Values(BadRule{"unknown_key", "gian = 0.5\n", "gian is not a key of a rule"},
                    BadRule{"gain", "gain = 2\n", "gain is 2: 0.01 to 1 are possible"},
                    BadRule{"kind", "min_count = \"3\"\n", "min_count: a number is expected"},
                    BadRule{"whole", "min_count = 2.5\n", "a whole number is expected"},
                    BadRule{"window", "window = 2\n", "window 2 is less than min_count 3"},
                    BadRule{"program", "program = 900\n", "program: a text is expected"},
                    BadRule{"no_program", "program = \"\"\n", "program: a text is expected"},
                    BadRule{"tool", "tool = -3\n", "tool: tool -3 is below 0"},
                    BadRule{"half_tool", "tool = 3.5\n", "tool: a tool is expected, 3 or"},
                    BadRule{"template", "template = true\n", "template: a text is expected"},
                    BadRule{"infinite", "highest = inf\n", "highest: a number is expected"},
                    BadRule{"bounds", "highest = -0.4\n", "lowest is not below highest"},
                    BadRule{"toml", "x = = 1\n", "line 10"},
                    BadRule{"other_table", "[other]\n", "only [[rule]] is expected"},
                    BadRule{"same_target",
                            "[[rule]]\nname = \"b\"\ncharacteristic = \"b\"\ntarget = "
                            "\"T3.wear.X\"\nmax_step = 1\n",
                            "T3.wear.X is corrected by another rule already"},
                    BadRule{"same_tool",
                            "[[rule]]\nname = \"b\"\ncharacteristic = \"b\"\ntarget = "
                            "\"T03.wear.X\"\nmax_step = 1\n",
                            "T03.wear.X is corrected by another rule already"},
                    BadRule{
                        "no_step",
                        "[[rule]]\nname = \"b\"\ncharacteristic = \"b\"\ntarget = \"T4.wear.X\"\n",
                        "max_step must be given"},
                    BadRule{"target",
                            "[[rule]]\nname = \"b\"\ncharacteristic = \"b\"\ntarget = "
                            "\"T4.wear.Q\"\nmax_step = 1\n",
                            "target 'T4.wear.Q'"}),
    [](const auto& i) { return std::string{i.param.name}; });

}  // namespace
}  // namespace dripline::offsets
