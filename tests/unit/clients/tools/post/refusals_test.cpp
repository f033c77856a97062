#include <gtest/gtest.h>

#include "tests/unit/clients/tools/post/converted.hpp"

/// What a target does not have is refused with its name, its value, its limit and its line.
namespace dripline::post {
namespace {

struct Refused {
  const char* name;
  const char* control;
  const char* target;
  const char* text;
  const char* reason;  ///< begins with it
};

class Refusals : public testing::TestWithParam<Refused> {};

TEST_P(Refusals, NameWhatTheTargetDoesNotHave) {
  const auto& param = GetParam();
  const auto converted = convert({param.control, param.text}, param.target);
  EXPECT_FALSE(converted.is_proved) << converted.text;
  EXPECT_TRUE(converted.reason().starts_with(param.reason)) << converted.reason();
}

INSTANTIATE_TEST_SUITE_P(
    , Refusals,
    testing::Values(
        Refused{"tool", "fanuc", "tnc155", "T300 M06\nG00 X1.\nM30\n",
                "line 1: tool 300: tnc155 has tools up to 254"},
        Refused{"no_tools", "fanuc", "tektronix-1704", "T3 M06\nG00 X1.\nM30\n",
                "line 1: tool 3: tektronix-1704 has no tool numbers"},
        Refused{"axis", "fanuc", "tnc155", "G00 X1.\nG00 A30.\nM30\n",
                "line 2: axis A: tnc155 has XYZC"},
        Refused{"axes", "rs274ngc", "tnc155", "G21 G0 X1 Y1 Z1 C5\nM2\n",
                "line 1: move of 4 axes: tnc155 has up to 3 in a block"},
        Refused{"reserved_m", "tnc155", "fanuc",
                "0 BEGIN PGM 1 MM\n1 L X+1 Y+1 R0 FMAX M7\n2 END PGM 1 MM\n",
                "line 2: M7: M functions of the machine are 10 to 99 at fanuc"},
        Refused{"helix_plane", "fanuc", "itnc",
                "G00 X0 Y0 Z0\nG18 G02 X10. Z10. Y5. I10. K0 F100.\nM30\n",
                "line 2: helix in the plane ZX: itnc has helices in XY"},
        Refused{"optional_stop_of_m", "fanuc", "itnc", "G00 X1.\nM01\nM30\n",
                "line 2: optional stop: itnc has none"},
        Refused{"path_m", "fanuc", "itnc", "G00 X1.\nM89\nM30\n",
                "line 2: M89: M functions of the machine are 10 to 88 at itnc"},
        Refused{"rotary_feed", "fanuc", "rs274ngc", "G00 X1.\nG01 A30. F100.\nM30\n",
                "line 2: feed move of the rotary axis A"},
        Refused{"coordinate", "fanuc", "tnc155", "G00 X1.\nG00 X31000.\nM30\n",
                "line 2: coordinate X31000.000: tnc155 takes up to 30000"},
        Refused{"feed_form", "fanuc", "tnc155", "G00 X0 Y0\nG01 X5. F12.4\nM30\n",
                "line 2: feed of 12.4 mm/min: tnc155 takes 0 decimals, so 12"},
        Refused{"feed_range", "fanuc", "tnc155", "G00 X0 Y0\nG01 X5. F20000.\nM30\n",
                "line 2: feed of 20000 mm/min: tnc155 takes up to 15999"},
        Refused{"per_revolution", "fanuc", "rs274ngc", "G00 X0 Y0\nG95 G01 X5. F.1\nM30\n",
                "line 2: feed of 0.1 mm per revolution: rs274ngc has feeds per minute alone"},
        Refused{"no_speed", "fanuc", "linuxcnc", "G00 X0 Y0\nG95 G01 X5. F.1\nM30\n",
                "line 2: feed per revolution: linuxcnc needs a spindle speed"},
        Refused{"speed_form", "rs274ngc", "fanuc", "G21 S1.2 M3\nG0 X1\nM2\n",
                "line 1: spindle speed of 1.2 rpm: fanuc takes 0 decimals, so 1"},
        Refused{"speed_range", "rs274ngc", "fanuc", "G21 S30000 M3\nG0 X1\nM2\n",
                "line 1: spindle speed of 30000 rpm: fanuc takes up to 20000"},
        Refused{"mist", "fanuc", "tnc155", "M07\nG00 X1.\nM30\n",
                "line 1: mist coolant: tnc155 has none"},
        Refused{"optional_stop", "fanuc", "tnc155", "G00 X1.\nM01\nM30\n",
                "line 2: optional stop: tnc155 has none"},
        Refused{"plane", "fanuc", "tnc155", "G00 X0 Y0 Z0\nG18 G02 X10. Z10. I10. F100.\nM30\n",
                "line 2: arc in the plane ZX: tnc155 has arcs in XY"},
        Refused{"helix", "fanuc", "tektronix-1704",
                "G00 X0 Y0 Z0\nG02 X10. Y10. Z1. I10. F100.\nM30\n", "line 2: helix"},
        Refused{"oriented", "fanuc", "tnc155", "G00 X1.\nM19\nM30\n",
                "line 2: oriented spindle: tnc155 has none"},
        Refused{"m_function", "fanuc", "rs274ngc", "G00 X1.\nM17\nM30\n",
                "line 2: M17: rs274ngc has no M functions of the machine"},
        Refused{"probe", "rs274ngc", "fanuc", "G21 G0 X0 Y0 Z5\nG38.2 Z-5 F100\nM2\n",
                "line 2: probing move"},
        Refused{"output", "fanuc", "rs274ngc", "G00 X1.\nPOPEN\nDPRNT[HELLO]\nPCLOS\nM30\n",
                "line 2: an output is opened"},
        Refused{"thread_lead", "fanuc-t", "centurion", "G00 X20. Z5.\nG34 Z-20. F1.5 K0.1\nM30\n",
                "line 2: thread of lead 1.5 mm that changes"},
        Refused{"tapping", "fanuc", "rs274ngc",
                "S500 M03\nG00 X0 Y0 Z5.\nG84 R2. Z-10. F500.\nG80\nM30\n", "line 3: "},
        Refused{"alarm", "fanuc", "rs274ngc", "G00 X1.\nG01 X5.\nM30\n", "line 2: alarm "},
        Refused{"lathe", "fanuc-t", "fanuc", "G00 X20. Z5.\nM30\n",
                "a program of fanuc-t, a lathe: fanuc is a mill"},
        Refused{"mill", "fanuc", "centurion", "G00 X20. Z5.\nM30\n",
                "a program of fanuc, a mill: centurion is a lathe"},
        Refused{"variable", "fanuc", "rs274ngc", "G00 X#500\nM30\n",
                "condition: variable: line 1: #500"},
        Refused{"block_skip", "fanuc", "rs274ngc", "G00 X1. Y1.\n/G00 X2.\nM30\n",
                "condition: block_skip: line 2"},
        Refused{"start", "fanuc", "rs274ngc", "G91 G00 X5.\nM30\n", "difference: "},
        Refused{"surface_speed", "rs274ngc", "fanuc", "G21 G0 X1\nG96 S100 M3\nM2\n", ""}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(AsSetUp, WritesWhatDependsOnTheSetup) {
  ConversionOptions options;
  options.is_as_set_up = true;
  const auto variable = convert({"fanuc", "#500=#500+1.\nG00 X#500 Y0\nM30\n",
                                 setup_from("[[variable]]\nname = \"#500\"\nvalue = 4.0\n")},
                                "rs274ngc", options);
  EXPECT_TRUE(variable.is_proved) << variable.reason();
  EXPECT_NE(variable.text.find("G0 X5"), std::string::npos) << variable.text;
  EXPECT_FALSE(variable.result->conditions.empty());
  const auto start = convert({"fanuc", "G91 G00 X5.\nM30\n", setup_from("[start]\nX = 10.0\n")},
                             "rs274ngc", options);
  EXPECT_TRUE(start.is_proved) << start.reason();
  EXPECT_NE(start.text.find("G0 X15\n"), std::string::npos) << start.text;
}

/// M61 says which tool is there. A change would take another one.
TEST(ToolInTheSpindle, IsRefused) {
  const auto setup = setup_from("[control]\nprofile = \"linuxcnc\"\n");
  const auto converted = convert({"rs274ngc", "G21 G0 X1\nM61 Q3\nG0 X2\nM2\n", setup}, "fanuc");
  EXPECT_FALSE(converted.is_proved) << converted.text;
  EXPECT_TRUE(converted.reason().starts_with("line 2: tool 3 is to be in the spindle"))
      << converted.reason();
}

TEST(WordsOfAFunction, AreRefused) {
  const auto setup = setup_from("[control]\nprofile = \"linuxcnc\"\n");
  const auto plain = convert({"rs274ngc", "G21 G0 X1\nM101\nG0 X2\nM2\n", setup}, "linuxcnc");
  EXPECT_TRUE(plain.is_proved) << plain.reason();
  const auto words = convert({"rs274ngc", "G21 G0 X1\nM101 P5\nG0 X2\nM2\n", setup}, "linuxcnc");
  EXPECT_FALSE(words.is_proved) << words.text;
  EXPECT_TRUE(words.reason().starts_with("line 2: M101 with E, P or Q")) << words.reason();
}

/// A probing move stays refused.
TEST(AsSetUp, DoesNotWriteWhatOnlyTheMachineKnows) {
  ConversionOptions options;
  options.is_as_set_up = true;
  const auto converted =
      convert({"rs274ngc", "G21 G0 X0 Y0 Z5\nG38.2 Z-5 F100\nM2\n"}, "fanuc", options);
  EXPECT_FALSE(converted.is_proved);
}

constexpr std::string_view kTools =
    "[[tool]]\nnumber = 1\nlength = 50.0\n[[tool]]\nnumber = 12\nlength = 120.0\n";

struct LengthCase {
  const char* name;
  const char* control;
  const char* text;
  const char* reason;  ///< empty: converted
};

class Lengths : public testing::TestWithParam<LengthCase> {};

/// A program that is written calls each tool with its own length.
TEST_P(Lengths, AreThoseOfTheToolOrRefused) {
  auto setup = setup_from(kTools);
  ConversionOptions options;
  options.is_as_set_up = true;
  options.target_setup.tools = setup.tools;
  for (const char* target : {"fanuc", "linuxcnc", "tnc155"}) {
    const auto converted = convert({GetParam().control, GetParam().text, setup}, target, options);
    const std::string reason = converted.reason();
    if (*GetParam().reason == '\0') {
      EXPECT_TRUE(converted.is_proved) << target << ": " << reason;
    } else {
      EXPECT_NE(reason.find(GetParam().reason), std::string::npos) << target << ": " << reason;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    , Lengths,
    testing::Values(
        LengthCase{"its_own", "fanuc", "O1\nT1 M6\nG0 X0 Y0\nG43 H1 Z10.\nG1 Z-5. F100.\nM30\n",
                   ""},
        LengthCase{"of_another_number", "fanuc", "O1\nT1 M6\nG43 H12 Z10.\nG1 Z-5. F100.\nM30\n",
                   "a length of 120.0000 mm in force"},
        LengthCase{"subtracted", "fanuc", "O1\nT1 M6\nG44 H1 Z10.\nM30\n",
                   "a length of -50.0000 mm in force"},
        LengthCase{"never_called", "fanuc", "O1\nT1 M6\nG0 Z10.\nM30\n",
                   "a length of 0.0000 mm in force"},
        LengthCase{"canceled", "fanuc", "O1\nT1 M6\nG43 H1 Z10.\nG49 G0 Z100.\nM30\n",
                   "a length of 0.0000 mm in force"},
        LengthCase{"by_itself", "rs274ngc",
                   "T1 M6\nG43 H1\nG0 X0 Y0 Z10\nG43.1 Z7\nG1 Z-5 F100\nM2\n", "line"},
        LengthCase{"corrected", "itnc",
                   "BEGIN PGM A MM\nTOOL CALL 1 Z S1000 DL+3\nL Z+5 R0 FMAX\nEND PGM A MM\n",
                   "a length of 53.0000 mm in force"}),
    [](const auto& tested) { return std::string(tested.param.name); });

/// TOOL DEF of a program in plain language has length 0, where the control has no tools of its own.
TEST(ToolLengths, OfToolsThatTheTargetDoesNotHave) {
  const Original original{"fanuc", "O1\nT1 M6\nG0 X0 Y0\nG43 H1 Z10.\nG1 Z-5. F100.\nM30\n",
                          setup_from(kTools)};
  ConversionOptions options;
  options.is_as_set_up = true;
  EXPECT_TRUE(convert(original, "linuxcnc", options).is_proved);
  EXPECT_NE(convert(original, "tnc155", options).reason().find("that of tool 1, 0.0000 mm"),
            std::string::npos);
}

TEST(FindTarget, NamesWhatCanBeWritten) {
  const auto unknown = find_target("sinumerik");
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().what.find("centurion, fanuc, fanuc-t"), std::string::npos);
  for (const Target& target : targets())
    EXPECT_NE(unknown.error().what.find(target.name), std::string::npos) << target.name;
}

}  // namespace
}  // namespace dripline::post
