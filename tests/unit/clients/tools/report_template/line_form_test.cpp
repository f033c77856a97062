#include "clients/tools/report_template/line_form.hpp"

#include <gtest/gtest.h>

namespace dripline::report_template {
namespace {

/// `name=text` of the fields, or `no`.
std::string matched(const Result<LineForm>& form, std::string_view line) {
  if (!form) return form.error().what;
  const auto found = form->match(line);
  if (!found) return "no";
  std::string all;
  for (const auto& [field, text] : *found) {
    all += fmt::format("{}{}{}={}", all.empty() ? "" : " ", field->name,
                       field->of.empty() ? "" : "." + field->of, trimmed(text));
  }
  return all;
}

struct FormCase {
  std::string name, form, line, expected;
};
class Form : public testing::TestWithParam<FormCase> {};

TEST_P(Form, Matches) {
  EXPECT_EQ(matched(LineForm::of_form(GetParam().form, false), GetParam().line),
            GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(
    , Form,
    testing::Values(
        FormCase{"literal", "BORE {feature}", "BORE    12", "feature=12"},
        FormCase{"other_literal", "BORE {feature}", "BOSS 12", "no"},
        FormCase{"sign_before_blanks", "D {actual} E", "D -    0.027 E", "actual=-    0.027"},
        FormCase{"no_blank_beside_a_number", "X{actual.X} Z{actual.Z}", "X1.5Z-2.",
                 "actual.X=1.5 actual.Z=-2."},
        FormCase{"point_first", "X{actual}", "X-.5", "actual=-.5"},
        FormCase{"blank_between_words", "S {serial}", "S17", "no"},
        FormCase{"text_has_blanks", "OP {who:text} END", "OP A. B. C END", "who=A. B. C"},
        FormCase{"word_has_none", "OP {who} END", "OP A. B. C END", "no"},
        FormCase{"braces", "{{{actual}}}", "{1.5}", "actual=1.5"},
        FormCase{"bars", "|{feature} | {actual} |", "|Cir|  7.5036|", "feature=Cir actual=7.5036"},
        FormCase{"ends_do_not_matter", "D {actual}", "\x12 D 1.5 \r\n\x14", "actual=1.5"},
        FormCase{"special_characters", "[PRB:{actual.X},{actual.Y}:{hit}]", "[PRB:1.0,2.0:1]",
                 "actual.X=1.0 actual.Y=2.0 hit=1"},
        FormCase{"word_is_no_number", "D {actual}", "D 1.5X", "no"},
        FormCase{"not_closed", "D {actual", "", "form 'D {actual': no '}' for '{' at 3"},
        FormCase{"lonely_brace", "D }", "", "form 'D }': '}' without '{' at 3"},
        FormCase{"bad_name", "{a b}", "",
                 "form '{a b}': 'a b' is no name of a field: letters, digits and '_'"},
        FormCase{"number_as_text", "{actual:text}", "",
                 "form '{actual:text}': field actual is a number"},
        FormCase{"empty", " ", "", "a form is empty"}),
    [](const auto& i) { return i.param.name; });

TEST(LineForm, HasABound) {
  EXPECT_EQ(LineForm::of_form(std::string(kMaxForm + 1, 'x'), false).error().code,
            Errc::LimitExceeded);
  std::string fields;
  for (std::size_t i = 0; i <= kMaxFields; ++i) fields += fmt::format("{{f{}}} ", i);
  EXPECT_EQ(LineForm::of_form(fields, false).error().code, Errc::LimitExceeded);
  const auto form = LineForm::of_form("{all:text}", false);
  EXPECT_TRUE(form->match(std::string(kMaxLine, 'x')));
  EXPECT_FALSE(form->match(std::string(kMaxLine + 1, 'x')));
}

TEST(LineForm, TakesADecimalCommaWhereItIsSaid) {
  EXPECT_EQ(matched(LineForm::of_form("Q = {actual}", true), "Q = +49,987"), "actual=+49,987");
  EXPECT_EQ(matched(LineForm::of_form("Q = {actual}", false), "Q = +49,987"), "no");
}

TEST(Pattern, HasFieldsByTheNamesOfItsGroups) {
  const auto pattern = LineForm::of_pattern(
      R"((?P<axis>[XYZ])(?: (?P<actual_X>\S+))? (?P<upper_deviation_D>\S+) (?P<my_field>\S+))");
  EXPECT_EQ(matched(pattern, "X 1.0 2.0 c"),
            "actual.X=1.0 axis=X my_field=c upper_deviation.D=2.0");
  EXPECT_EQ(matched(pattern, "X 2.0 c"), "axis=X my_field=c upper_deviation.D=2.0");
  EXPECT_EQ(LineForm::of_pattern("(").error().code, Errc::Syntax);
  EXPECT_EQ(LineForm::of_pattern(R"((a)\1)").error().code, Errc::Syntax) << "never backtracks";
}

TEST(Pattern, IsForTheWholeLine) {
  EXPECT_EQ(matched(LineForm::of_pattern("D(?P<actual>.)"), "XD1"), "no");
}

TEST(ReadNumber, KeepsDecimals) {
  EXPECT_EQ(read_number("-    0.027")->value, -0.027);
  EXPECT_EQ(read_number("12.500")->decimals, 3);
  EXPECT_EQ(read_number("1,25")->value, 1.25);
  EXPECT_EQ(read_number("1.2.3").error().code, Errc::Syntax);
  EXPECT_EQ(read_number("999999999999999")->value, 999999999999999.0);
  EXPECT_EQ(read_number("0.5000000000000000")->decimals, 16);
  const auto changed = read_number("99999999999999999");
  ASSERT_FALSE(changed);
  EXPECT_EQ(changed.error().what,
            "99999999999999999 has more digits than are kept (15 always are)");
  EXPECT_EQ(read_number("40.0900000000000012").error().code, Errc::LimitExceeded);
  EXPECT_EQ(read_number("1234567890123456789.0").error().code, Errc::LimitExceeded);
}

}  // namespace
}  // namespace dripline::report_template
