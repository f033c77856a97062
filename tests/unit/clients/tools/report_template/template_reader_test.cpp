#include <gtest/gtest.h>

#include "clients/tools/report_template/report_template.hpp"

namespace dripline::report_template {
namespace {

struct BadCase {
  std::string name, toml, error;
};
class BadTemplate : public testing::TestWithParam<BadCase> {};

TEST_P(BadTemplate, IsRefusedWithItsLine) {
  const auto read = read_template(GetParam().toml);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().what, GetParam().error);
}

const std::string kLine = "[[line]]\nform = 'D {actual}'\n";

INSTANTIATE_TEST_SUITE_P(
    , BadTemplate,
    testing::Values(
        BadCase{"without_lines", "unit = 'mm'\n", "the template has no [[line]]"},
        BadCase{"unknown_key", "units = 'mm'\n" + kLine,
                "line 1: key 'units' of a template is not known"},
        BadCase{"unknown_key_of_a_line", kLine + "nominall = 1\n",
                "line 3: key 'nominall' of a line is not known"},
        BadCase{"without_form", "[[line]]\nnominal = 1\n",
                "line 1: a line needs a form or a pattern"},
        BadCase{"form_and_pattern", kLine + "pattern = 'x'\n",
                "line 3: a line has a form or a pattern"},
        BadCase{"bad_form", "[[line]]\nform = 'D {actual'\n",
                "line 2: form 'D {actual': no '}' for '{' at 3"},
        BadCase{"limits", kLine + "lower = 2\nupper = 1\n", "line 1: lower 2 is above upper 1"},
        BadCase{"tolerance_and_limits", kLine + "tolerance = 2\nupper = 1\n",
                "line 1: a tolerance beside limits"},
        BadCase{"infinite", kLine + "nominal = inf\n", "line 3: nominal must be a number"},
        BadCase{"rework", kLine + "rework = 'left'\n",
                "line 3: rework 'left' is none of none, below, above, both"},
        BadCase{"action", kLine + "[verdict]\nscrap = 'explode'\n",
                "line 4: scrap 'explode' is none of none, hold_queue, hold_machine"},
        BadCase{"characteristic", kLine + "[characteristic]\nD = 1\n",
                "line 4: write [characteristic.NAME]"},
        BadCase{"sources", "sources = ['alarm']\n" + kLine,
                "line 1: sources 'alarm' is none of output, probe, message"}),
    [](const auto& i) { return i.param.name; });

TEST(ReadTemplate, ReadsEverything) {
  const auto read = read_template(R"(
title = "all"
decimal_comma = true
device = "port1"
sources = ["output", "message"]
first_count = 0
expected = 7
rework = "both"
[[line]]
form = ["A {nominal}", "B {actual}"]
characteristic = "D"
[[line]]
pattern = '.*'
ignore = true
[characteristic.D]
name = "bore"
tolerance = 0.1
decimals = 4
required = true
[verdict]
rework = "hold_queue"
scrap = "hold_machine"
)");
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(read->rules.at(0).steps.size(), 2u);
  EXPECT_EQ(read->rules.at(0).line, 9u);
  EXPECT_EQ(read->first_count, 0);
  EXPECT_EQ(read->expected, 7u);
  EXPECT_EQ(read->on_scrap, Action::HoldMachine);
  EXPECT_EQ(read->on_rework, Action::HoldQueue);
  EXPECT_EQ(read->on_unknown, Action::None);
  EXPECT_TRUE(read->characteristics.at("D").is_required);
  EXPECT_EQ(read->characteristics.at("D").decimals, 4);
}

TEST(ReadTemplate, HasBounds) {
  std::string many;
  for (std::size_t i = 0; i <= kMaxRules; ++i) many += kLine;
  EXPECT_EQ(read_template(many).error().code, Errc::LimitExceeded);
  EXPECT_EQ(read_template(std::string(kMaxTemplate + 1, '#')).error().code, Errc::LimitExceeded);
}

}  // namespace
}  // namespace dripline::report_template
