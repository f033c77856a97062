#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "clients/tools/tnc_conversion/conversion.hpp"

namespace dripline::tnc_conversion {

// A conversion for a control that has not everything: rows HD-238 and HD-239.

namespace {

using namespace interpreter;
using namespace interpreter::tnc155;

/// For the control that `options` describe; "" where the program converts.
std::string refusal(const std::string& text, Form form, const std::string& options) {
  const auto control = read_options(*parse_setup("[control]\n" + options));
  EXPECT_TRUE(control) << control.error().what;
  if (!control) return "no such control";
  const auto done = convert_program(text, form, conversion_options(*control));
  return done ? "" : done.error().what;
}
std::string plain(const std::string& blocks, const std::string& options, Form form = Form::Iso) {
  return refusal("0 BEGIN PGM 7 MM\n1 TOOL CALL 3 Z S 800\n" + blocks + "9 END PGM 7 MM\n", form,
                 options);
}
std::string iso(const std::string& blocks, const std::string& options) {
  return refusal("%7 G71 *\nN10 T3 G17 S800 *\n" + blocks + "N9999 %7 G71 *\n", Form::Plain,
                 options);
}

// HD-049, HD-238
TEST(Tnc155VersionConversion, MakesNoG38ForSoftwareThatDoesNotKnowIt) {
  EXPECT_EQ(plain("2 STOP M05\n", "software = 8"), "");
  EXPECT_EQ(plain("2 STOP M05\n", "software = 7"),
            "line 3: STOP is G38 in ISO: a TNC 155 A with software 07 has no G38 (from software "
            "08)");
  EXPECT_EQ(plain("2 STOP M05\n", "software = 7", Form::Plain), "");
  EXPECT_EQ(iso("N20 G38 *\n", "software = 7"),
            "line 3, column 1: ILLEGAL G-CODE: G38: a TNC 155 A with software 07 has no G38 (from "
            "software 08)");
}

// HD-238
TEST(Tnc155VersionConversion, RefusesWhatTheSoftwareHasNotInEitherForm) {
  const std::string no_probe =
      "a TNC 155 A with software 05 has no touch probe functions (from software 06)";
  EXPECT_EQ(
      plain("2 TCH PROBE 0.0 REF. PLANE Q5 Z-\n3 TCH PROBE 0.1 X+1 Y+1 Z-2\n", "software = 5"),
      "line 3, column 1: NOT SUPPORTED: TCH PROBE: " + no_probe);
  EXPECT_EQ(iso("N20 G55 P01 5 P02 Z- P03 G90 X+1 Y+1 Z-2 *\n", "software = 5"),
            "line 3, column 1: ILLEGAL G-CODE: G55: " + no_probe);
  EXPECT_EQ(iso("N20 G51 T4 *\n", "software = 1").substr(0, 36),
            "line 3, column 1: ILLEGAL G-CODE: G5");
  EXPECT_EQ(iso("N20 S9500 *\n", "software = 5").substr(0, 33),
            "line 3, column 1: WRONG RPM: S 95");
  EXPECT_EQ(plain("2 TOOL CALL S 9500\n", "software = 5").substr(0, 33),
            "line 3, column 1: WRONG RPM: S 95");
}

// HD-239
TEST(Tnc155VersionConversion, RefusesThreeAxesAndHelicesForEAndV) {
  const std::string line = "2 L X+1 Y+2 R0 F90\n3 L X+2 Y+3 Z+4\n";
  const std::string iso_line = "N20 G01 G40 G90 X+1 Y+2 F90 *\nN30 X+2 Y+3 Z+4 *\n";
  EXPECT_EQ(plain(line, "model = \"TNC 155 A\""), "");
  EXPECT_EQ(iso(iso_line, "model = \"TNC 155 A\""), "");
  const std::string no_lines =
      "NOT SUPPORTED: XYZ in one block: a TNC 155 V has no straight lines of three axes at once";
  EXPECT_EQ(plain(line, "model = \"TNC 155 V\""), "line 4, column 1: " + no_lines);
  EXPECT_EQ(iso(iso_line, "model = \"TNC 155 V\""), "line 4, column 1: " + no_lines);
  EXPECT_EQ(
      plain("2 CC X+0 Y+0\n3 L X+5 Y+0 R0 F90\n4 CP IPA+720 IZ+4 DR+\n", "model = \"TNC 151 E\""),
      "line 5, column 1: NOT SUPPORTED: an arc with Z: a TNC 151 E has no helices");
}

using namespace interpreter;
using namespace interpreter::tnc155;

const ConversionOptions kOptions{.layout = {.line_end = "\n"}};

std::string converted(std::string_view text, Form form) {
  const auto result = convert_program(text, form, kOptions);
  return result ? *result : "! " + result.error().what;
}

struct Pair {
  const char* name;
  const char* plain;
  const char* iso;
};

class Tnc155Conversion : public testing::TestWithParam<Pair> {};

constexpr const char* kPlainHead = "0 BEGIN PGM 7 MM\n1 TOOL CALL 3 Z S 800,000\n";
constexpr const char* kIsoHead = "%7 G71 *\nN10 T3 G17 S800 *\n";

constexpr const char* kIsoEnd = "N9999 %7 G71 *\n";

/// The pairs hold in both directions; the end of the text becomes the last block.
TEST_P(Tnc155Conversion, PlainBecomesIso) {
  EXPECT_EQ(converted(std::string(kPlainHead) + GetParam().plain, Form::Iso),
            std::string(kIsoHead) + GetParam().iso + kIsoEnd);
}
TEST_P(Tnc155Conversion, IsoBecomesPlain) {
  const std::string plain = std::string(kPlainHead) + GetParam().plain;
  const auto blocks = std::count(plain.begin(), plain.end(), '\n');
  EXPECT_EQ(converted(std::string(kIsoHead) + GetParam().iso, Form::Plain),
            plain + std::to_string(blocks) + " END PGM 7 MM\n");
}

// HD-039, HD-040, HD-041, HD-043, HD-045, HD-046, HD-047, HD-048, HD-049, HD-050
const Pair kPairs[] = {
    {"Lines", "2 L X+1,000 Y+2,000 R0 F MAX M03\n3 L Z-1,500 R F80 M\n4 L IX+3,000 R F M\n",
     "N20 G00 G40 G90 X+1 Y+2 M03 *\nN30 G01 Z-1,5 F80 *\nN40 G91 X+3 *\n"},
    {"MixedDistances", "2 L X+1,000 IY+2,000 R0 F90 M\n3 L IX+1,000 Y+2,000 R F M\n",
     "N20 G01 G40 G90 X+1 G91 Y+2 F90 *\nN30 X+1 G90 Y+2 *\n"},
    {"Circles",
     "2 L X+5,000 Y+0,000 R0 F90 M\n3 CC X+0,000 Y+0,000\n4 C X+0,000 Y+5,000 DR+ R F M\n5 CT "
     "X-5,000 Y+9,000 R F M\n6 CC\n",
     "N20 G01 G40 G90 X+5 Y+0 F90 *\nN30 I+0 J+0 *\nN40 G03 X+0 Y+5 *\nN50 G06 X-5 Y+9 *\nN60 G29 "
     "*\n"},
    {"Polar",
     "2 LP PR+5,000 PA+30,000 R0 F MAX M\n3 LP IPA+10,000 R F70 M\n4 CP IPA+720,000 IZ-4,000 DR- R "
     "F M\n",
     "N20 G10 G40 G90 R+5 H+30 *\nN30 G11 G91 H+10 F70 *\nN40 G12 Z-4 H+720 *\n"},
    {"SingleAxis",
     "2 L X+0,000 R0 F90 M\n3 Y+8,000 R+ F M\n4 IX-2,000 R- F40 M\n5 L X+1,000 R0 F M\n",
     "N20 G01 G40 G90 X+0 F90 *\nN30 G07 G43 Y+8 *\nN40 G07 G44 G91 X-2 F40 *\nN50 G40 G90 X+1 "
     "*\n"},
    {"Rounding",
     "2 L X+0,000 Y+0,000 R0 F90 M\n3 L X+10,000 Y+0,000 RL F M\n4 RND R2,000\n5 L X+20,000 "
     "Y+0,000 R F M\n6 RND R1,000\n7 L X+20,000 Y+10,000 R F M\n8 RND R2,500\n9 L X+30,000 "
     "Y+30,000 R0 F M\n",
     "N20 G01 G40 G90 X+0 Y+0 F90 *\nN30 G41 X+10 Y+0 *\nN40 G26 R2 *\nN50 X+20 Y+0 *\nN60 G25 R1 "
     "*\nN70 X+20 Y+10 *\nN80 G27 R2,5 *\nN90 G40 X+30 Y+30 *\n"},
    {"Chamfer", "2 L X+0,000 Y+0,000 R0 F90 M\n3 L 1,500\n",
     "N20 G01 G40 G90 X+0 Y+0 F90 *\nN30 G24 R1,5 *\n"},
    {"Tools", "2 TOOL DEF 4 L+1,000 R-0,500\n3 TOOL DEF 5\n4 TOOL CALL 4 IV\n5 STOP M09\n",
     "N20 G99 T4 L+1 R-0,5 *\nN30 G51 T5 *\nN40 T4 G20 *\nN50 G38 M09 *\n"},
    {"Functions",
     "2 FN 0: Q1 = +4,000\n3 FN 4: Q2 = +Q1 DIV -2,500\n4 FN 7: Q3 = COS -Q2\n5 FN 8: Q4 = +Q1 LEN "
     "+Q2\n",
     "N20 D00 Q1 P01 +4 *\nN30 D04 Q2 P01 +Q1 P02 -2,5 *\nN40 D07 Q3 P01 -Q2 *\nN50 D08 Q4 P01 +Q1 "
     "P02 +Q2 *\n"},
    {"Pecking",
     "2 CYCL DEF 1.0 PECKING\n3 CYCL DEF 1.1 SET-UP -2,000\n4 CYCL DEF 1.2 DEPTH -20,000\n5 CYCL "
     "DEF 1.3 PECKG -8,000\n6 CYCL DEF 1.4 DWELL 0,500\n7 CYCL DEF 1.5 F60\n8 CYCL CALL M03\n",
     "N20 G83 P01 -2 P02 -20 P03 -8 P04 0,5 P05 60 *\nN30 G79 M03 *\n"},
    {"Pocket",
     "2 CYCL DEF 4.0 POCKET MILLING\n3 CYCL DEF 4.1 SET-UP -2,000\n4 CYCL DEF 4.2 DEPTH -20,000\n5 "
     "CYCL DEF 4.3 PECKING -8,000 F50\n6 CYCL DEF 4.4 X+60,000\n7 CYCL DEF 4.5 Y+30,000\n8 CYCL "
     "DEF 4.6 F90 DR-\n",
     "N20 G75 P01 -2 P02 -20 P03 -8 P04 50 P05 X+60 P06 Y+30 P07 90 *\n"},
    {"CircularPocket",
     "2 CYCL DEF 5.0 CIRCULAR POCKET\n3 CYCL DEF 5.1 SET-UP -2,000\n4 CYCL DEF 5.2 DEPTH "
     "-20,000\n5 CYCL DEF 5.3 PECKING -8,000 F50\n6 CYCL DEF 5.4 RADIUS 30,000\n7 CYCL DEF 5.5 F90 "
     "DR+\n",
     "N20 G78 P01 -2 P02 -20 P03 -8 P04 50 P05 30 P06 90 *\n"},
    {"Transformations",
     "2 CYCL DEF 7.0 DATUM SHIFT\n3 CYCL DEF 7.1 X+5,000\n4 CYCL DEF 7.2 IY+1,000\n5 CYCL DEF 8.0 "
     "MIRROR IMAGE\n6 CYCL DEF 8.1 X\n7 CYCL DEF 10.0 ROTATION\n8 CYCL DEF 10.1 IROT +30,000\n9 "
     "CYCL DEF 11.0 SCALING\n10 CYCL DEF 11.1 SCL 0,750000\n11 CYCL DEF 9.0 DWELL TIME\n12 CYCL "
     "DEF 9.1 DWELL 1,500\n",
     "N20 G54 G90 X+5 G91 Y+1 *\nN30 G28 X *\nN40 G73 H+30 *\nN50 G72 F0,75 *\nN60 G04 F1,5 *\n"},
    {"Probe", "2 TCH PROBE 0.0 REF. PLANE Q10 Z-\n3 TCH PROBE 0.1 X+5,000 IZ-1,000\n",
     "N20 G55 P01 10 P02 Z- P03 G90 X+5 G91 Z-1 *\n"},
    {"ProgramAsCycle", "2 CYCL DEF 12.0 PGM CALL\n3 CYCL DEF 12.1 PGM 12345678\n4 CYCL CALL M\n",
     "N20 G39 P01 12345678 *\nN30 G79 *\n"},
    {"Blank",
     "2 DEF BLK FORM MIN Y X+0,000 Y+0,000 Z+0,000\n3 DEF BLK FORM MAX IX+9,000 IY+8,000 "
     "IZ+7,000\n",
     "N20 G30 G18 G90 X+0 Y+0 Z+0 *\nN30 G31 G91 X+9 Y+8 Z+7 *\n"},
};

INSTANTIATE_TEST_SUITE_P(Blocks, Tnc155Conversion, testing::ValuesIn(kPairs),
                         [](const auto& test) { return std::string(test.param.name); });

// HD-047: G90 may be left out in G30.
TEST(Tnc155ConversionOfFlow, ABlankTakesNothingFromBefore) {
  EXPECT_EQ(converted("%1 G71 *\nN1 G98 L1\nN2 G30 G17 X5 Y5 Z-10\nN3 G31 G91 X95 Y95 Z10\nN4 "
                      "L1.2",
                      Form::Plain),
            "0 BEGIN PGM 1 MM\n1 LBL 1\n2 DEF BLK FORM MIN Z X+5,000 Y+5,000 Z-10,000\n"
            "3 DEF BLK FORM MAX IX+95,000 IY+95,000 IZ+10,000\n4 CALL LBL 1 REP 2/2\n5 END PGM 1 "
            "MM\n");
}

// HD-046: where the run can come from elsewhere, the ISO text says everything again.
TEST(Tnc155ConversionOfFlow, SaysModesAgainAfterLabelsAndCalls) {
  const std::string plain =
      "0 BEGIN PGM 7 MM\n1 L X+0,000 R0 F90 M\n2 LBL 4\n3 L IX+2,000 R F M\n4 CALL LBL 4 REP 3/3\n"
      "5 L IY+2,000 R F M\n6 CALL LBL 9 REP\n7 CALL PGM 12\n8 L R F M30\n9 LBL 9\n10 LBL 0\n11 END "
      "PGM 7 MM\n";
  const std::string iso =
      "%7 G71 *\nN10 G17 *\nN20 G01 G40 G90 X+0 F90 *\nN30 G98 L4 *\nN40 G01 G91 X+2 *\nN50 L4.3 "
      "*\n"
      "N60 G01 G91 Y+2 *\nN70 L9 *\nN80 %12 *\nN90 M30 *\nN100 G98 L9 *\nN110 G98 L0 *\nN9999 %7 "
      "G71 *\n";
  EXPECT_EQ(converted(plain, Form::Iso), iso);
}

TEST(Tnc155ConversionOfFlow, FollowsRepeatsAndReturns) {
  const std::string head = "%7 G71 *\nN10 G17 G01 G40 G90 X0 F90\n";
  EXPECT_EQ(converted(head + "N20 G98 L4\nN30 X5\nN40 L4.2\nN50 L9\nN60 X6\nN70 M30\nN80 G98 "
                             "L9\nN90 X7\nN95 G98 L0",
                      Form::Plain),
            "0 BEGIN PGM 7 MM\n1 TOOL CALL Z\n2 L X+0,000 R0 F90 M\n3 LBL 4\n4 L X+5,000 R F M\n"
            "5 CALL LBL 4 REP 2/2\n6 CALL LBL 9 REP\n7 L X+6,000 R F M\n8 L R F M30\n9 LBL 9\n"
            "10 L X+7,000 R F M\n11 LBL 0\n12 END PGM 7 MM\n");
  EXPECT_EQ(converted(head + "N20 G98 L4\nN30 X5\nN40 G00 X6\nN50 L4.2", Form::Plain),
            "! line 4: the path function in force depends on where the run comes from");
  // a called program has modes of its own
  EXPECT_EQ(converted(head + "N20 %12\nN30 X5", Form::Plain),
            "0 BEGIN PGM 7 MM\n1 TOOL CALL Z\n2 L X+0,000 R0 F90 M\n3 CALL PGM 12\n"
            "4 L X+5,000 R F M\n5 END PGM 7 MM\n");
}

// HD-042: what a control shows of an ISO program in plain language.
TEST(Tnc155ConversionOfStars, TakesThePathFunctionOfTheBlockBefore) {
  EXPECT_EQ(converted("0 BEGIN PGM 7 MM\n1 TOOL CALL 1 Z\n2 L X+1,000 R0 F MAX M\n3 * K X+2,000 R "
                      "F MAX M\n4 END PGM 7 MM",
                      Form::Plain),
            "0 BEGIN PGM 7 MM\n1 TOOL CALL 1 Z\n2 L X+1,000 R0 F MAX M\n3 L X+2,000 R F MAX M\n4 "
            "END PGM 7 MM\n");
}

// HD-005, HD-036, HD-056, HD-057: both ends of a program say the same; in ISO its beginning says
// that it is protected, and its end may be left out.
TEST(Tnc155ConversionOfFrames, GivesBothTheirWords) {
  const std::string iso = "%22 G70 G50 *\nN10 G99 T1 L+0 R+1 *\n";
  const std::string plain =
      "0 BEGIN PGM 22 INCH P\n1 TOOL DEF 1 L+0,0000 R+1,0000\n2 END PGM 22 INCH P\n";
  EXPECT_EQ(converted(iso + "N9999 %22 G70 *\n", Form::Plain), plain);
  EXPECT_EQ(converted(iso, Form::Plain), plain);
  EXPECT_EQ(converted(plain, Form::Iso), iso + "N9999 %22 G70 *\n");
  EXPECT_EQ(converted(plain.substr(0, plain.find("2 END")), Form::Iso), iso + "N9999 %22 G70 *\n");
  EXPECT_EQ(converted("N10 G99 T1 L+0 R+1 *\n", Form::Plain), "1 TOOL DEF 1 L+0,000 R+1,000\n")
      << "a part of a program stays one";
}

// HD-039, HD-038: a first move without a plane gets that of the first TOOL CALL or BLK FORM, and
// G17, in which it runs, where it makes a difference.
TEST(Tnc155ConversionOfPlanes, LooksForTheFirstToolCallOrBlank) {
  const std::string begin = "0 BEGIN PGM 7 MM\n";
  const auto start_of = [&](const std::string& plain) {
    const std::string iso = converted(begin + plain, Form::Iso);
    const auto plane = iso.find("0 G1");
    return plane == std::string::npos ? iso : iso.substr(plane + 2, 3);
  };
  const std::string first_move = "3 L X+1,000 Z+1,000 R0 F100 M\n";
  const std::string call = "9 TOOL CALL 1 X S 100,000\n";
  EXPECT_EQ(start_of(first_move), "G17");
  EXPECT_EQ(start_of(first_move + call), "G19");
  EXPECT_EQ(start_of(first_move + "4 X+3,000 R0 F M\n5 STOP M\n6 LBL 1\n" + call), "G19");
  const std::string blank =
      "1 DEF BLK FORM MIN Y X+0,000 Y+0,000 Z+0,000\n2 DEF BLK FORM MAX X+9,000 Y+9,000 Z+9,000\n";
  const std::string with_blank = converted(begin + blank + first_move + call, Form::Iso);
  EXPECT_NE(with_blank.find("\nN30 G18 *\nN40 G01 G40 X+1 Z+1"), std::string::npos) << with_blank;
  for (const char* in_the_plane :
       {"4 CC X+0,000 Y+0,000\n", "4 LP PR+5,000 PA+30,000 R0 F M\n", "4 L Y+5,000 RL F M\n",
        "4 X+5,000 R+ F M\n", "4 CALL LBL 3 REP\n", "4 CALL PGM 8\n", "4 TOOL CALL 1\n",
        "4 CYCL DEF 10.0 ROTATION\n5 CYCL DEF 10.1 ROT +30,000\n"}) {
    EXPECT_EQ(start_of(fmt::format("{}{}{}", first_move, in_the_plane, call)), "G17")
        << in_the_plane;
  }
}

// HD-039, HD-105: where nothing switches RL or RR on, RND is a rounding wherever the run comes
// from.
TEST(Tnc155ConversionOfRoundings, BetweenLabelsWithoutCompensationIsG25) {
  const std::string plain =
      "0 BEGIN PGM 7 MM\n1 TOOL CALL 1 Z\n2 L X+1,000 Y+1,000 R0 F9 M\n3 LBL 3\n4 L IX+9,000 "
      "Y+1,000 R F M\n5 RND R1,000\n6 L IX+0,000 Y+9,000 R F M\n7 CALL LBL 3 REP 2/2\n8 END PGM 7 "
      "MM\n";
  const std::string iso = converted(plain, Form::Iso);
  EXPECT_NE(iso.find(" G25 R1 *"), std::string::npos) << iso;
  EXPECT_EQ(converted(iso, Form::Plain), plain);
  for (const char* switches : {"2 L X+1,000 Y+1,000 RL F9 M\n", "2 CALL PGM 8\n",
                               "2 CYCL DEF 12.0 PGM CALL\n2 CYCL DEF 12.1 PGM 8\n"}) {
    EXPECT_TRUE(
        converted("0 BEGIN PGM 7 MM\n1 TOOL CALL 1 Z\n" + std::string(switches) +
                      plain.substr(plain.find("3 LBL")),
                  Form::Iso)
            .ends_with("whether RND is G25, G26 or G27 depends on where the run comes from"))
        << switches;
  }
}

// HD-044
TEST(Tnc155ConversionOfDirections, AreResolved) {
  EXPECT_EQ(
      converted("%7 G71\nN1 G17 G40 G90 G02 I0 J0 X5 Y0 F9\nN2 G05 X-5 Y0\nN3 G15 H90",
                Form::Plain),
      "0 BEGIN PGM 7 MM\n1 TOOL CALL Z\n2 CC X+0,000 Y+0,000\n3 C X+5,000 Y+0,000 DR- R0 F9 M\n"
      "4 C X-5,000 Y+0,000 DR- R F M\n5 CP PA+90,000 DR- R F M\n6 END PGM 7 MM\n");
}

TEST(Tnc155ConversionRefuses, WhatHasNoCounterpart) {
  const std::string plain = "0 BEGIN PGM 7 MM\n1 TOOL CALL 1 Z\n";
  EXPECT_EQ(converted(plain + "2 BEGIN PGM 8 MM", Form::Iso),
            "! line 3: BEGIN PGM within a program");
  EXPECT_EQ(converted(plain + "2 C X1 Y2 DR+ R0 F MAX M", Form::Iso),
            "! line 3: F MAX of this block has no counterpart in ISO");
  EXPECT_EQ(converted(plain + "2 TOOL CALL 1 U", Form::Iso),
            "! line 3: TOOL CALL with this axis has no counterpart in ISO; IV has: G20");
  EXPECT_EQ(converted(plain + "2 CYCL DEF 1.0 PECKING\n3 LBL 1", Form::Iso),
            "! line 3: CYCL INCOMPLETE: the sub-blocks of the cycle are not complete");
  EXPECT_EQ(converted(plain + "2 TCH PROBE 0.0 REF. PLANE Q1 X+", Form::Iso),
            "! line 3: TCH PROBE 0.0 and 0.1 do not follow one another");
  EXPECT_EQ(converted(plain + "2 L X1 Y1 RL F9\n3 LBL 3\n4 RND R1", Form::Iso),
            "! line 5: whether RND is G25, G26 or G27 depends on where the run comes from");
  EXPECT_EQ(
      converted("%7 G71\nN1 G17 G40 G90 G01 X0 Y0\nN2 G41 X5 Y5\nN3 G25 R1\nN4 X9 Y5", Form::Plain),
      "! line 4: RND in this place would not be the rounding, approach or departure that the G "
      "code says");
  EXPECT_EQ(converted("%7 G71\nN1 G43", Form::Plain),
            "! line 2: G43 or G44 without an axis has no counterpart in plain language");
  EXPECT_EQ(converted("%7 G71\nN1 G73 G18 G90 H5", Form::Plain),
            "! line 2: G73 names another plane than that of the tool, which CYCL DEF 10 cannot");
  EXPECT_EQ(converted("0 BEGIN PGM 7 MM\n1 L X1 R0 F9 M03\n2 CYCL CALL", Form::Iso),
            "! line 3: this needs a TOOL CALL with the spindle axis before all moves, labels and "
            "calls");
  EXPECT_EQ(converted("%7 G71\nN1 G17 G40 G90 G01 X0 Y0 F9\nN2 I1 J1\nN3 G02 C+5", Form::Plain),
            "! line 4: an arc that names C alone cannot be distinguished from CC");
  EXPECT_EQ(converted("%7 G71\nN1 G17 G40 G90 G01 X0 Y0 F9\nN2 X5\nN3 G91\nN4 G25 R1\nN5 Y5",
                      Form::Plain),
            "! line 5: a corner after a block that plain language has none for");
  EXPECT_EQ(
      converted("%7 G71\nN1 L3\nN2 G17 G40 G90 G01 X0 F9\nN3 G98 L3\nN4 G90 G01 X5", Form::Plain),
      "! line 5: whether a plane and a compensation were programmed depends on where the run "
      "comes from");
  EXPECT_EQ(converted("%7 G71\nN1 X1?", Form::Plain),
            "! line 2, column 6: BLOCK FORMAT INCORRECT: '?' is not expected here");
  EXPECT_EQ(converted("O0100", Form::Plain), "! line 1: neither plain language nor ISO of a TNC");
}

// HD-001, HD-028: what the control wrote is given back byte for byte.
TEST(Tnc155Rewriting, KeepsTheControlsOwnLayout) {
  const std::string plain =
      "0 BEGIN PGM 81 INCH P\r\n1 L X+1,2500 IY-0,0625 R0 F MAX M13\r\n2 CC X+0,0000 Y+0,0000\r\n"
      "3 CP PA-90,000 DR- RL F120 M\r\n4 END PGM 81 INCH P\r\n";
  EXPECT_EQ(rewrite_program(plain).value(), plain);
  const std::string iso =
      "%81 G70 G50 *\r\nN5 G17 G00 G40 G90 X+1,25 G91 Y-0,0625 M13 *\r\nN9999 %81 G70 *\r\n";
  EXPECT_EQ(rewrite_program(iso).value(), iso);
  ConversionOptions point;
  point.layout = {'.', "\n"};
  EXPECT_EQ(rewrite_program("0 BEGIN PGM 81 MM\n1 L X1,5", point).value(),
            "0 BEGIN PGM 81 MM\n1 L X+1.500 R F M\n");
}

// HD-066
TEST(Tnc155Numbering, GoesByTheIncrement) {
  ConversionOptions options = kOptions;
  options.increment = 5;
  const std::string plain = "0 BEGIN PGM 7 MM\n1 TOOL CALL 1 Z\n2 CC\n3 END PGM 7 MM\n";
  EXPECT_EQ(convert_program(plain, Form::Iso, options).value(),
            "%7 G71 *\nN5 T1 G17 *\nN10 G29 *\nN9999 %7 G71 *\n");
  options.increment = 0;
  EXPECT_EQ(convert_program(plain, Form::Iso, options).value(),
            "%7 G71 *\nT1 G17 *\nG29 *\nN9999 %7 G71 *\n");
}

// HD-066: what is written in ISO is numbered as the menu says.
TEST(BlockIncrement, IsThatOfTheMenu) {
  const auto written = [](const std::string& control) {
    const auto options = read_options(*parse_setup("[control]\n" + control));
    EXPECT_TRUE(options) << options.error().what;
    return *convert_program("0 BEGIN PGM 7 MM\n1 L X+1 R0 F100\n2 END PGM 7 MM\n", Form::Iso,
                            conversion_options(*options));
  };
  EXPECT_NE(written("").find("N10 "), std::string::npos);
  EXPECT_NE(written("block_increment = 3").find("N3 "), std::string::npos);
  EXPECT_EQ(written("block_increment = 0").find("N0"), std::string::npos);
}

}  // namespace

}  // namespace dripline::tnc_conversion
