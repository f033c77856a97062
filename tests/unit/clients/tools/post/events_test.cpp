#include <gtest/gtest.h>
#include <algorithm>

#include "tests/unit/clients/tools/post/converted.hpp"

/// Programs of two axes for a ProtoTRAK Plus, whose Z is the operator's.
namespace dripline::post {
namespace {

const std::string kPlate =
    "%\nO12\n(PLATE 100% FLAT)\nG21 G17 G90 G94\nT2 M06\nS800 M03\nG00 X10. Y5.\nM08\nZ2.\n"
    "G01 Z-4. F120.\nX40. F300.\nG03 X50. Y15. I0 J10. (CORNER)\nG01 Y30.\nG00 Z10.\n"
    "X60. Y30.\nG01 Z-4. F120.\nG02 X60. Y30. I-5. J0 F200.\nG00 Z50.\nM09\nM05\nM30\n%\n";

/// The text without comments, and by lines that end with CR LF.
std::string without_comments(const std::string& text) {
  std::string kept;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    if (text[at] != '(') kept += text.substr(at, end - at);
    at = end;
  }
  return kept;
}

TEST(EventWriter, WritesEventsAndWhatTheOperatorDoes) {
  const auto converted = convert({"fanuc", kPlate}, "prototrak-plus");
  EXPECT_TRUE(converted.is_proved) << converted.reason() << '\n' << converted.text;
  EXPECT_EQ(converted.text,
            "PN12 G21 ;\r\n(PLATE 100  FLAT)\r\n(SPINDLE CW 800 RPM)\r\n"
            "N001 G100 X10.A Y5.A T2 ;\r\n(COOLANT ON)\r\n(Z TO 2.)\r\n(Z TO -4. FEED 120)\r\n"
            "N002 G101 XB10.A YB5.A XE40.A YE5.A F300 TC0 D0. CR0. T2 ;\r\n(CORNER)\r\n"
            "N003 G103 XB40.A YB5.A XE50.A YE15.A XC40.A YC15.A F300 TC0 D0. CR0. T2 ;\r\n"
            "N004 G101 XB50.A YB15.A XE50.A YE30.A F300 TC0 D0. CR- T2 ;\r\n(Z TO 10.)\r\n"
            "N005 G100 X60.A Y30.A T2 ;\r\n(Z TO -4. FEED 120)\r\n"
            "N006 G102 XB60.A YB30.A XE60.A YE30.A XC55.A YC30.A F200 TC0 D0. CR- T2 ;\r\n"
            "(Z TO 50.)\r\n(COOLANT OFF)\r\n(SPINDLE OFF)\r\n%\r\n");
  EXPECT_EQ(converted.written->adapted.operator_actions, 9u);
  EXPECT_EQ(converted.written->adapted.assumed_tools, 0u);
}

TEST(EventWriter, WritesWhatTheControlWouldSendBack) {
  for (const auto units : {interpreter::Units::Inch, interpreter::Units::Millimeter}) {
    ConversionOptions options;
    options.units = units;
    const auto converted = convert({"fanuc", kPlate}, "prototrak-plus", options);
    ASSERT_TRUE(converted.is_proved) << converted.reason();
    const auto listed = (*interpreter::find_dialect("prototrak-plus"))->list(converted.text);
    ASSERT_TRUE(listed) << listed.error().what;
    EXPECT_EQ(without_comments(converted.text), *listed);
  }
}

/// What comes before the first event is done while the control waits for its tool.
TEST(EventWriter, BeginsWithWhatTheOperatorDoes) {
  const auto converted = convert(
      {"fanuc", "G21 G90 S500 M03\nG00 Z5.\nX1. Y1.\nG01 X5. F100.\nM30\n"}, "prototrak-plus");
  EXPECT_TRUE(converted.is_proved) << converted.reason() << converted.text;
  EXPECT_NE(converted.text.find("(SPINDLE CW 500 RPM)\r\n(Z TO 5.)\r\nN001 G100 X1.A Y1.A T1 ;"),
            std::string::npos)
      << converted.text;
}

TEST(EventWriter, AsksForTheFirstToolWhereTheProgramCallsNone) {
  const auto converted =
      convert({"fanuc", "G21 G90 G00 X1. Y1.\nG01 X5. F100.\nM30\n"}, "prototrak-plus");
  EXPECT_TRUE(converted.is_proved) << converted.reason();
  EXPECT_EQ(converted.written->adapted.assumed_tools, 1u);
  EXPECT_EQ(converted.written->adapted.operator_actions, 0u);
}

/// Each place where Z moves has to be one where the control waits: a chain that runs on is not
/// the same, and neither is another place.
TEST(EventWriter, ProvesEachWaitForTheOperator) {
  const auto converted = convert({"fanuc", kPlate}, "prototrak-plus");
  ASSERT_TRUE(converted.is_proved) << converted.reason();
  const interpreter::Setup setup;
  struct Change {
    const char *from, *to;
  };
  for (const auto& [from, to] :
       {Change{"N005 G100 X60.A Y30.A T2 ;", "N005 G100 X60.A Y30.01A T2 ;"},
        Change{"YE5.A F300 TC0 D0. CR0.", "YE5.A F300 TC0 D0. CR-"},
        Change{"T2 ;\r\n(COOLANT", "T3 ;\r\n(COOLANT"}, Change{"XC55.A", "XC65.A"}}) {
    std::string changed = converted.text;
    const auto at = changed.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    changed.replace(at, std::string_view(from).size(), to);
    interpreter::MemorySource first(kPlate), second(changed);
    const auto result = prove({**interpreter::find_dialect("fanuc"), setup, first, kPlate},
                              *converted.written, second, {});
    ASSERT_TRUE(result) << result.error().what;
    EXPECT_FALSE(result->is_same) << from;
  }
  const std::string through = "G21 G90 G00 X1. Y1.\nG01 X5. F100.\nZ-2.\nX9.\nM30\n";
  const auto stepped = convert({"fanuc", through}, "prototrak-plus");
  EXPECT_TRUE(stepped.is_proved) << stepped.reason();
  std::string joined = stepped.text;
  const auto at = joined.find("CR-");
  ASSERT_NE(at, std::string::npos) << joined;
  joined.replace(at, 3, "CR0.");
  interpreter::MemorySource first(through), second(joined);
  const auto result = prove({**interpreter::find_dialect("fanuc"), setup, first, through},
                            *stepped.written, second, {});
  ASSERT_TRUE(result) << result.error().what;
  EXPECT_FALSE(result->is_same);
}

/// A control that is set up not to wait cuts where the operator has not moved Z.
TEST(EventWriter, IsNoProofWhereTheControlDoesNotWait) {
  ConversionOptions options;
  options.target_setup = setup_from("[control]\nwaits = false\n");
  EXPECT_FALSE(convert({"fanuc", kPlate}, "prototrak-plus", options).is_proved);
}

TEST(EventWriter, WritesItsOwnProgramsAgain) {
  const std::string source =
      "PN7 G20 ;\r\nN001 G100 X1.A Y1.A T3 ;\r\n"
      "N002 G101 XB1.A YB1.A XE2.A YE1.A F10. TC0 D0. CR0. T3 ;\r\n"
      "N003 G103 XB2.A YB1.A XE2.A YE1.A XC2.A YC2.A F9.5 TC0 D0. CR- T3 ;\r\n%\r\n";
  const auto converted = convert({"prototrak-plus", source}, "prototrak-plus");
  EXPECT_TRUE(converted.is_proved) << converted.reason();
  EXPECT_EQ(converted.text, source);
}

struct TwoAxes {
  const char* name;
  const char* text;
  const char* reason;
};
class TwoAxisRefusals : public testing::TestWithParam<TwoAxes> {};

TEST_P(TwoAxisRefusals, NameTheBlock) {
  const auto converted = convert({"fanuc", GetParam().text}, "prototrak-plus");
  EXPECT_FALSE(converted.is_proved) << converted.text;
  EXPECT_EQ(converted.reason(), GetParam().reason);
}

INSTANTIATE_TEST_SUITE_P(
    , TwoAxisRefusals,
    testing::Values(
        TwoAxes{"rapid_of_z", "G21 G90\nG00 X1. Y1. Z5.\nM30\n",
                "line 2: rapid move of Z together with X or Y: Z of prototrak-plus is the "
                "operator's"},
        TwoAxes{"ramp", "G21 G90\nG00 X1. Y1.\nG01 X5. Z-1. F100.\nM30\n",
                "line 3: feed move of Z together with X or Y: Z of prototrak-plus is the "
                "operator's"},
        TwoAxes{"helix", "G21 G90\nG00 X1. Y1.\nZ0\nG03 X5. Z-1. R2. F100.\nM30\n",
                "line 4: helix: Z of prototrak-plus is the operator's, and its arcs lie in a "
                "plane"},
        TwoAxes{"plane", "G21 G90\nG00 X1. Y1.\nZ0\nG18 G03 X5. Z0 R2. F100.\nM30\n",
                "line 4: arc in the plane ZX: prototrak-plus has arcs in XY"},
        TwoAxes{"dwell", "G21 G90\nG00 X1. Y1.\nG04 X1.\nM30\n",
                "line 3: dwell: prototrak-plus has none"},
        TwoAxes{"two_tools", "G21 G90\nT1 M06\nT2 M06\nG00 X1. Y1.\nM30\n",
                "line 3: tool 2 after tool 1 without a move of X or Y: prototrak-plus changes a "
                "tool with its next event"},
        TwoAxes{"tool_at_end", "G21 G90\nT1 M06\nG00 X1. Y1.\nT2 M06\nM30\n",
                "line 5: tool 2 without a move of X or Y after it: prototrak-plus changes a tool "
                "with its next event"},
        TwoAxes{"no_move", "G21 G90\nS500 M03\nG00 Z1.\nM30\n",
                "line 4: no move of X or Y: prototrak-plus has no event at which it waits"},
        TwoAxes{"no_tool", "G21 G90\nT0 M06\nG00 X1. Y1.\nM30\n",
                "line 2: tool 0: prototrak-plus has tools from 1 to 99"},
        TwoAxes{"optional_stop", "G21 G90\nG00 X1. Y1.\nM01\nM30\n",
                "line 3: optional stop: prototrak-plus has none"},
        TwoAxes{"function", "G21 G90\nG00 X1. Y1.\nM21\nM30\n",
                "line 3: M21: prototrak-plus has no M functions of the machine"},
        TwoAxes{"slow_feed", "G21 G90\nG00 X1. Y1.\nG01 X5. F4.\nM30\n",
                "line 3: feed of 4 mm/min: prototrak-plus takes 5 at least"},
        TwoAxes{"axis", "G21 G90\nG00 X1. Y1.\nA5.\nM30\n",
                "line 3: axis A: prototrak-plus has XY"}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(EventWriter, StopsAtTheEventsThatTheControlStores) {
  std::string source = "G21 G90 G00 X0 Y0\nG01 F100.\n";
  for (int i = 1; i <= 255; ++i) source += "X" + std::to_string(i) + ".\n";
  const auto converted = convert({"fanuc", source + "M30\n"}, "prototrak-plus");
  EXPECT_FALSE(converted.is_proved);
  EXPECT_NE(converted.reason().find("more than 255 blocks"), std::string::npos)
      << converted.reason();
}

}  // namespace
}  // namespace dripline::post
