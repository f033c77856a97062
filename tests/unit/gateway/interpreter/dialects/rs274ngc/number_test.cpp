#include <gtest/gtest.h>

#include "gateway/interpreter/dialects/rs274ngc/interpreter.hpp"
#include "tests/unit/gateway/interpreter/dialects/rs274ngc/control_run.hpp"

/// Rows: NGC-001
///
/// Numbers that the reader of usual words takes, and their neighbors that it leaves to the slow
/// one: the values are the nearest doubles in both.
namespace dripline::interpreter::rs274ngc {
namespace {

struct NumberCase {
  const char* name;
  const char* words;  ///< after X
  double x;
  double y = 0;
};

class Rs274Number : public testing::TestWithParam<NumberCase> {};

TEST_P(Rs274Number, IsTheNearestDouble) {
  const std::string words = GetParam().words;
  for (const std::string& text : {"G21 G0 X" + words + "\n", "G21 G0 x" + words + "\r\nM2\n"}) {
    ControlRun run(text, "[control]\nprofile = \"linuxcnc\"\n");
    run.step(1);
    const auto& interpreter = dynamic_cast<const Rs274NgcInterpreter&>(run.interpreter());
    EXPECT_EQ(interpreter.state()[Axis::X], GetParam().x) << run.last();
    EXPECT_EQ(interpreter.state()[Axis::Y], GetParam().y) << run.last();
  }
}

INSTANTIATE_TEST_SUITE_P(
    , Rs274Number,
    testing::Values(NumberCase{"whole", "12", 12}, NumberCase{"fraction", "12.345", 12.345},
                    NumberCase{"below_zero", "-1.5", -1.5}, NumberCase{"plus", "+1.5", 1.5},
                    NumberCase{"no_leading_digit", "-.25", -.25},
                    NumberCase{"no_trailing_digit", "5.", 5},
                    NumberCase{"leading_zeros", "000.0010", .001},
                    NumberCase{"blanks_around", " \t7.5 \t", 7.5},
                    NumberCase{"blanks_within", "1 2 . 3\t4", 12.34},
                    NumberCase{"blank_after_sign", "- 2.5", -2.5},
                    NumberCase{"a_word_follows", "1.25Y-2.5", 1.25, -2.5},
                    NumberCase{"a_word_follows_blanks", "1 .5  Y 3", 1.5, 3},
                    NumberCase{"fifteen_digits", "1234567.89012345", 1234567.89012345},
                    NumberCase{"sixteen_digits", "1234567.890123456", 1234567.890123456},
                    NumberCase{"seventeen_digits", "98765432109.876543", 98765432109.876543},
                    NumberCase{"nineteen_digits", "0.1234567890123456789", 0.1234567890123456789},
                    NumberCase{"fifteen_places", "0.000000000000001", 1e-15},
                    NumberCase{"expression", "[1.5+.25]Y2", 1.75, 2}),
    [](const auto& each) { return each.param.name; });

class Rs274BadNumber : public testing::TestWithParam<const char*> {};

TEST_P(Rs274BadNumber, IsRefused) {
  ControlRun run(std::string("G0 X") + GetParam() + "\n", "[control]\nprofile = \"linuxcnc\"\n");
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_TRUE(run.log().lines().back().starts_with("alarm")) << run.last();
}

INSTANTIATE_TEST_SUITE_P(, Rs274BadNumber,
                         testing::Values("", ".", "-", "-.", "1.2.3", "1.2 .3", "--1", "1-2",
                                         "1 X2", "1x2"));

}  // namespace
}  // namespace dripline::interpreter::rs274ngc
