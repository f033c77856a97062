#include "clients/tools/comparison/motion_comparison.hpp"

#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "gateway/interpreter/registry.hpp"

namespace dripline::comparison {
namespace {

using interpreter::MemorySource;

struct Text {
  std::string_view control;
  std::string text;
};

const interpreter::Dialect& dialect(std::string_view control) {
  const auto found = interpreter::find_dialect(control);
  EXPECT_TRUE(found);
  return **found;
}

MotionResult compare(const Text& a, const Text& b, MotionOptions options = {},
                     const interpreter::Setup& setup = {}) {
  MemorySource first(a.text), second(b.text);
  const auto result = compare_motion({dialect(a.control), setup, first},
                                     {dialect(b.control), setup, second}, options);
  EXPECT_TRUE(result) << result.error().what;
  return result ? *result : MotionResult{};
}
MotionResult compare_fanuc(const std::string& a, const std::string& b, MotionOptions options = {}) {
  return compare({"fanuc", a}, {"fanuc", b}, options);
}

std::vector<std::string> words_of(const MotionResult& result) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < kDifferenceCount; ++i) {
    if (result.counts[i] > 0) words.emplace_back(word_of(static_cast<Difference>(i)));
  }
  return words;
}
using Words = std::vector<std::string>;

const std::string kPart = "G21 G90\nG0 X0 Y0 Z5.\nS1000 M3\nG1 Z-1. F100\nX10.\nY10.\nM5\nM30\n";

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, from.size(), to);
}

/// One part for both families of this language: contour with compensation, corners, a helix, a
/// repeat.
TEST(MotionComparison, APartForATnc155AndOneForAnItncAreTheSameMotion) {
  const std::string older =
      "0 BEGIN PGM 7 MM\n1 TOOL DEF 1 L+0 R+4,5\n2 TOOL CALL 1 Z S2000\n3 L Z+5 R0 F MAX M03\n"
      "4 L X-20 Y+20 R0 F MAX\n5 L Z-2 F200\n6 L X+0 Y+20 RL F300\n7 L X+0 Y+40\n8 RND R3\n"
      "9 L X+40 Y+40\n10 L 4\n11 L X+40 Y+0\n12 L X+0 Y+0\n13 L X+0 Y+20\n"
      "14 L X-20 Y+20 R0 F MAX\n15 CC X-10 Y+20\n16 CP IPA+720 IZ-4 DR+ F300\n"
      "17 LBL 1\n18 L IX+5 F MAX\n19 CALL LBL 1 REP 2/2\n20 L Z+5 F MAX M05\n"
      "21 END PGM 7 MM\n";
  const std::string later =
      "BEGIN PGM PART_7 MM\n; the same\nTOOL DEF 1 L+0 R+5\nTOOL CALL 1 Z S2000 F300 DR-0.5\n"
      "L Z+5 R0 FMAX M3\nL X-20 Y+20 R0 FMAX\n* - contour\nL Z-2 F200\nL X+0 Y+20 RL FAUTO\n"
      "L Y+40 X+0\nRND R3\nQ1 = 4 * (7 + 3)\nL X+Q1 Y+Q1\nCHF 4\nL X+40 Y+0\nL X+0 Y+0\n"
      "L X+0 Y+20\nL X-20 Y+20 FMAX R0\nCC X-10 Y+20\nCP IPA+720 IZ-4 DR+ F300\n"
      "LBL \"STEP\"\nL IX+5 FMAX\nCALL LBL \"STEP\" REP 2\nL Z+5 FMAX M5\nEND PGM PART_7 MM\n";
  const auto same = compare({"tnc155", older}, {"itnc", later});
  EXPECT_TRUE(same.is_same) << testing::PrintToString(words_of(same));
  const auto other = compare({"tnc155", older}, {"itnc", replaced(later, "DR-0.5", "DR-0.4")});
  EXPECT_FALSE(other.is_same);
}

TEST(MotionComparison, AnotherTextOfTheSameMovesIsTheSameMotion) {
  const auto result =
      compare_fanuc(kPart,
                    "(A)\nG21 G90\nG0 X0 Y0 Z5.0\nS1000\nM3\nG91 G1 Z-6. F100\nX10.\nY10.\n"
                    "M5\nM30\n");
  EXPECT_TRUE(result.is_unconditional())
      << (result.places.empty() ? "" : result.places[0].first_text);
  EXPECT_EQ(result.first_actions, result.second_actions);
}

TEST(MotionComparison, AChangedCoordinateIsAPathWithBothLines) {
  const auto result = compare_fanuc(kPart, "(A)\n" + replaced(kPart, "X10.\n", "X10.5\n"));
  EXPECT_FALSE(result.is_same);
  ASSERT_EQ(result.places.size(), 2u);  // the move to it, and the one from it
  EXPECT_EQ(words_of(result), Words{"path"});
  EXPECT_EQ(result.places[0].first.line, 5u);
  EXPECT_EQ(result.places[0].second.line, 6u);
  EXPECT_NEAR(result.places[0].distance, 0.5, 1e-9);
  EXPECT_NEAR(result.max_distance, 0.5, 1e-9);
}

struct OneChange {
  std::string_view name, from, to;
  std::string expected;
};
class MotionDifference : public testing::TestWithParam<OneChange> {};
TEST_P(MotionDifference, IsNamed) {
  const auto result = compare_fanuc(kPart, replaced(kPart, GetParam().from, GetParam().to));
  EXPECT_EQ(words_of(result), Words{GetParam().expected});
  ASSERT_FALSE(result.places.empty());
  EXPECT_NE(result.places[0].first_text + result.places[0].second_text, "");
}
INSTANTIATE_TEST_SUITE_P(
    , MotionDifference,
    testing::Values(
        OneChange{"feed", "F100", "F120", "feed"}, OneChange{"speed", "S1000", "S900", "speed"},
        OneChange{"spindle", "M3", "M4", "spindle"}, OneChange{"tool", "M5", "T2 M6\nM5", "tool"},
        OneChange{"coolant", "M5", "M8\nM5", "coolant"},
        OneChange{"dwell", "M5", "G4 X1.\nM5", "dwell"}, OneChange{"stop", "M5", "M0\nM5", "stop"},
        OneChange{"function", "M5", "M77\nM5", "function"},
        OneChange{"exact_stop", "X10.\n", "G9 X10.\n", "exact_stop"},
        OneChange{"output", "M5", "POPEN\nDPRNT[X]\nM5", "output"},
        OneChange{"a_move_more", "M5", "X3.\nM5", "path"},
        OneChange{"order", "X10.\nY10.\nM5\n", "X10.\nM5\nY10.\n", "order"}),
    [](const auto& tested) { return std::string(tested.param.name); });

/// Tools 1 and 2 of length 50 and 80.
interpreter::Setup with_tools() {
  interpreter::Setup setup;
  for (const auto& [number, length] : {std::pair(1, 50.0), std::pair(2, 80.0)}) {
    interpreter::ToolRecord tool;
    tool.number = number;
    tool.length.set(interpreter::Axis::Z, Length::mm(length));
    setup.tools.push_back(tool);
  }
  return setup;
}

class LengthDifference : public testing::TestWithParam<OneChange> {};
TEST_P(LengthDifference, IsAnOffsetOfEachMoveOfItsAxis) {
  const std::string part = "G21 G90\nT1 M6\nG0 X0 Y0\nG43 H1 Z10.\nG1 Z-5. F100.\nX5.\nM30\n";
  const auto result = compare(
      {"fanuc", part}, {"fanuc", replaced(part, GetParam().from, GetParam().to)}, {}, with_tools());
  EXPECT_FALSE(result.is_same);
  EXPECT_EQ(words_of(result), Words{GetParam().expected});
}
INSTANTIATE_TEST_SUITE_P(, LengthDifference,
                         testing::Values(OneChange{"none", "G43 H1 Z10.", "Z10.", "offset"},
                                         OneChange{"subtracted", "G43", "G44", "offset"},
                                         OneChange{"of_another_tool", "H1", "H2", "offset"},
                                         OneChange{"dropped", "G1 Z-5.", "G49 G1 Z-5.", "offset"}),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST(MotionComparison, ALengthThatNoMoveTakesInIsNoDifference) {
  const std::string part = "G21 G90\nT1 M6\nG43 H1 Z10.\nG49\nX5.\nM30\n";
  EXPECT_TRUE(
      compare({"fanuc", part}, {"fanuc", replaced(part, "G49\n", "")}, {}, with_tools()).is_same);
}

TEST(MotionComparison, ToolCallsDifferByTheirLengths) {
  const std::string part =
      "BEGIN PGM A MM\nTOOL DEF 1 L+10 R+3\nTOOL CALL 1 Z S1000\nL Z+5 R0 FMAX\nL X+5 F100\n"
      "END PGM A MM\n";
  const auto longer = compare({"itnc", part}, {"itnc", replaced(part, "S1000", "S1000 DL+3")});
  EXPECT_EQ(words_of(longer), Words{"offset"});
  const auto other = compare({"itnc", part}, {"itnc", replaced(part, "1 Z S", "1 Y S")});
  EXPECT_FALSE(other.is_same);
}

/// The next program moves by them.
TEST(MotionComparison, WhatTheControlKeepsIsCompared) {
  const std::string part = "G21\n#501=3.\nG0 X1.\nM30\n";
  const auto result = compare_fanuc(part, replaced(part, "=3.", "=4."));
  EXPECT_EQ(words_of(result), Words{"function"});
  ASSERT_EQ(result.places.size(), 1u);
  EXPECT_EQ(result.places[0].first_text, "leaves #501 = 3");
  EXPECT_EQ(result.places[0].second_text, "leaves #501 = 4");
  const auto without = compare_fanuc(part, replaced(part, "#501=3.\n", ""));
  EXPECT_EQ(without.places.at(0).second_text, "leaves #501 empty");
  const auto ngc =
      compare({"rs274ngc", "G21\n#5161=7\nG0 X1\nM2\n"}, {"rs274ngc", "G21\n#5161=8\nG0 X1\nM2\n"});
  EXPECT_FALSE(ngc.is_same);
}

TEST(MotionComparison, APathWithinTheToleranceIsTheSame) {
  const std::string other = replaced(kPart, "X10.\n", "X10.001\n");
  EXPECT_TRUE(compare_fanuc(kPart, other, {.tolerance = 0.0011}).is_same);
  EXPECT_FALSE(compare_fanuc(kPart, other, {.tolerance = 0.0009}).is_same);
}

TEST(MotionComparison, AnArcByItsRadiusIsTheArcByItsCenter) {
  const std::string a = "G21\nG0 X0 Y0\nG2 X10. Y10. I10. J0 F100\nM30\n";
  EXPECT_TRUE(compare_fanuc(a, replaced(a, "I10. J0", "R10.")).is_unconditional());
  EXPECT_FALSE(compare_fanuc(a, replaced(a, "I10. J0", "R10.5")).is_same);
  EXPECT_FALSE(compare_fanuc(a, replaced(a, "I10. J0", "R-10.")).is_same);
  EXPECT_FALSE(compare_fanuc(a, replaced(a, "G2 X10. Y10. I10. J0", "G1 X10. Y10.")).is_same);
}

TEST(MotionComparison, AMoveSplitInTwoIsADifference) {
  EXPECT_FALSE(compare_fanuc(kPart, replaced(kPart, "X10.\n", "X5.\nX10.\n")).is_same);
}

TEST(MotionComparison, ARapidForAFeedIsAPath) {
  EXPECT_EQ(words_of(compare_fanuc(kPart, replaced(kPart, "X10.\n", "G0 X10.\nG1\n"))).front(),
            "path");
}

/// One contour with an arc, written in four languages for three controls.
const std::vector<Text>& one_part() {
  static const std::vector<Text> texts{
      {"tnc155",
       "0 BEGIN PGM 1 MM\n1 TOOL DEF 1 L+0 R+0\n2 TOOL CALL 1 Z S1000\n"
       "3 L X+0 Y+0 Z+50 R0 F9999 M3\n4 L Z-1 R0 F100 M8\n5 L X+10 R0 F200 M\n6 CC X+10 Y+10\n"
       "7 C X+20 Y+10 DR+ R0 F M\n8 L Z+50 R0 F9999 M9\n9 L X+0 R0 F9999 M5\n10 END PGM 1 MM\n"},
      {"tnc155",
       "%1 G71 *\nN10 G99 T1 L+0 R+0 *\nN20 T1 G17 S1000 *\nN30 G01 G40 G90 X+0 Y+0 Z+50 F9999 "
       "M03 *\nN40 Z-1 F100 M08 *\nN50 X+10 F200 *\nN60 I+10 J+10 *\nN70 G03 X+20 Y+10 *\n"
       "N80 G01 G40 Z+50 F9999 M09 *\nN90 G01 X+0 F9999 M05 *\nN9999 %1 G71 *\n"},
      {"fanuc",
       "O0001\nG21 G90 G94 G17 G40 G80\nT1 M6\nS1000 M3\nG1 X0. Y0. Z50. F9999.\nM8\n"
       "Z-1. F100.\nX10. F200.\nG3 X20. Y10. R10.\nG1 Z50. F9999.\nM9\nX0.\nM5\nM30\n"},
      {"rs274ngc",
       "G21 G90 G94 G17 G40\nT1 M6\nS1000 M3\nG1 X0 Y0 Z50 F9999\nM8\nZ-1 F100\nX10 F200\n"
       "G3 X20 Y10 I0 J10\nG1 Z50 F9999\nM9\nX0\nM5\nM2\n"}};
  return texts;
}

TEST(MotionComparison, HoldsAcrossControls) {
  for (const Text& a : one_part()) {
    for (const Text& b : one_part()) {
      const auto result = compare(a, b);
      EXPECT_TRUE(result.is_unconditional()) << a.control << " and " << b.control;
      EXPECT_EQ(result.across_controls, a.control != b.control);
      for (const auto& place : result.places)
        ADD_FAILURE() << place.first_text << " / " << place.second_text;
    }
  }
}

TEST(MotionComparison, AcrossControlsADifferenceIsStillOne) {
  for (const auto& [from, to] : {std::pair{"R10.", "R11."},
                                 {"F200.", "F210."},
                                 {"S1000", "S900"},
                                 {"Z50. F9999.\nM9", "M9\nZ50. F9999."},
                                 {"M8\n", ""}}) {
    Text changed = one_part()[2];
    changed.text = replaced(changed.text, from, to);
    EXPECT_FALSE(compare(one_part()[0], changed).is_same) << from;
    EXPECT_FALSE(compare(changed, one_part()[3]).is_same) << from;
  }
}

TEST(MotionComparison, WhatDependsOnTheMachineIsACondition) {
  const std::string ask = "G21\nG0 X1.\nG31 Z-5. F10\nM30\n";
  auto result = compare_fanuc(ask, "(A)\n" + ask);
  EXPECT_TRUE(result.is_same);
  EXPECT_FALSE(result.is_unconditional());
  ASSERT_FALSE(result.conditions.empty());
  EXPECT_EQ(word_of(result.conditions[0].kind), "probe");
  EXPECT_EQ(result.conditions[0].place.line, 3u);

  result = compare_fanuc("G21\nG0 X#500\nM30\n", "G21\nG0 X#500 (A)\nM30\n");
  ASSERT_EQ(result.conditions.size(), 2u);
  EXPECT_EQ(result.conditions[0].text, "#500");
  EXPECT_TRUE(result.conditions[1].is_second);
}

TEST(MotionComparison, ThePositionAtTheStartIsACondition) {
  const std::string all = "G21 G90\nG0 X0 Y5.\nG0 X3.\nM30\n";
  for (const auto& [from, to] : {std::pair{"X0 Y5.", "Y5."}, {"X0 Y5.", "G91 X0 Y5.\nG90"}}) {
    const auto result = compare_fanuc(all, replaced(all, from, to));
    EXPECT_TRUE(result.is_same) << to;  // X is at 0 already
    ASSERT_EQ(result.conditions.size(), 1u) << to;
    EXPECT_EQ(word_of(result.conditions[0].kind), "start");
    EXPECT_EQ(result.conditions[0].place.line, 2u);
  }
  EXPECT_TRUE(compare_fanuc(all, "(A)\n" + all).is_unconditional());
}

TEST(MotionComparison, AVariableThatTheProgramHasSetIsNoCondition) {
  const std::string text =
      "O0100\nG21\n#1=5.\nG0 X[#1+1.]\nWHILE[#1 GT 1]DO1\n#1=#1-1\nEND1\nM30\n";
  const auto result = compare_fanuc(text, text);
  EXPECT_TRUE(result.is_unconditional())
      << (result.conditions.empty() ? "" : result.conditions[0].text);
}

TEST(MotionComparison, AnAlarmIsNeverTheSameWithoutSayingSo) {
  const std::string bad = "G21\nG0 X1.\nG1 X2.\nM30\n";  // no feed
  auto result = compare_fanuc(bad, bad);
  EXPECT_TRUE(result.is_same);
  EXPECT_FALSE(result.is_unconditional());
  result = compare_fanuc(bad, replaced(bad, "G1 X2.", "G1 X2. F9"));
  EXPECT_FALSE(result.is_same);
  EXPECT_TRUE(result.differences.has(Difference::Alarm));
}

TEST(MotionComparison, MovesPutInAreOnePlaceAndTheRestIsCompared) {
  std::string a = "G21 G90\nG1 F100\n", b = a;
  for (int i = 0; i < 9000; ++i)
    a += "X" + std::to_string(i % 777) + ". Y" + std::to_string(i) + ".\n";
  b = a;
  std::string more;
  for (int i = 0; i < 5000; ++i) more += "Z" + std::to_string(i + 1) + ".\n";
  const auto middle = b.find("X400. Y400.");
  b.insert(middle, more + "Z0\n");
  b = replaced(b, "Y8000.", "Y8000.5");
  const auto result = compare_fanuc(a, b);
  ASSERT_EQ(result.place_count, 3u);
  EXPECT_GE(result.places[0].second_actions, 5000u);
  EXPECT_NEAR(result.places[1].distance, 0.5, 1e-9);
}

TEST(MotionComparison, AProgramMovedAsAWholeIsCountedAndKeptBounded) {
  std::string a = "G21 G90\nG1 F100\n", b;
  for (int i = 0; i < 100'000; ++i)
    a += "X" + std::to_string(i % 777) + "." + std::to_string(i % 7) + "\n";
  b = "G52 X1.\n" + a;
  const auto result = compare_fanuc(a, b, {.max_places = 10});
  EXPECT_FALSE(result.is_same);
  EXPECT_EQ(result.places.size(), 10u);
}

}  // namespace
}  // namespace dripline::comparison
