#include <gtest/gtest.h>

#include "tests/unit/clients/tools/tnc_conversion/rewriting.hpp"

namespace dripline::tnc_conversion {
namespace {

using namespace interpreter;
using namespace interpreter::tnc155;

struct IsoCase {
  const char* name;
  const char* read;
  const char* written;
};

class Tnc155IsoBlock : public testing::TestWithParam<IsoCase> {};

TEST_P(Tnc155IsoBlock, IsWrittenAsTheControlSortsIt) {
  EXPECT_EQ(rewritten(std::string("%1 G71\nN1 G17 G40 G90 G01 X0\n") + GetParam().read, Form::Iso),
            std::string("%1 G71 *\nN1 G17 G01 G40 G90 X+0 *\n") + GetParam().written);
}

// HD-027, HD-028, HD-029, HD-030, HD-031, HD-032, HD-033, HD-034, HD-035, HD-036, HD-037
const IsoCase kWords[] = {
    {"Move", "N20 G1X+12.5Y-3F250M3*", "N20 G01 X+12,5 Y-3 F250 M03 *\n"},
    {"WordOrder", "N20 M8 F80 Y4 G91 X3 G41 G01", "N20 G01 G41 Y+4 G91 X+3 F80 M08 *\n"},
    {"DistancePerCoordinate", "N20 G91 Y4 G90 X3", "N20 G90 X+3 G91 Y+4 *\n"},
    {"WordsOfBeforeComeFirst", "N20 X3 G91 I4 J5 G02", "N20 G02 X+3 G91 I+4 J+5 *\n"},
    {"DistanceAlone", "N20 G91", "N20 G91 *\n"},
    {"Center", "N20 G02 J5 I4 Y6 X7", "N20 G02 I+4 J+5 X+7 Y+6 *\n"},
    {"PolarLine", "N20 H30,5 R+8 G11", "N20 G11 R+8 H+30,5 *\n"},
    {"Rounding", "N20 X5 Y5 G25 R2,5", "N20 G25 X+5 Y+5 R2,5 *\n"},
    {"CornerAlone", "N20 G24 R 1.75", "N20 G24 R1,75 *\n"},
    {"ToolDefinition", "N20 R5 L-1,5 T4 G99", "N20 G99 T4 L-1,5 R+5 *\n"},
    {"ToolCall", "N20 S630.5 G18 T4", "N20 T4 G18 S630,5 *\n"},
    {"NextTool", "N20 G51 T9", "N20 G51 T9 *\n"},
    {"SetLabel", "N20 G98 L15 X1", "N20 G98 L15 X+1 *\n"},
    {"CallLabel", "N20 L15", "N20 L15 *\n"},
    {"Repeat", "N20 L15.8", "N20 L15.8 *\n"},
    {"ProgramCall", "N20 % 808", "N20 %808 *\n"},
    {"Pecking", "N20 G83 P01-1,5 P02 -9 P03-3 P04 0,25 P05 70",
     "N20 G83 P01 -1,5 P02 -9 P03 -3 P04 0,25 P05 70 *\n"},
    {"Pocket", "N20 G76 P01-1 P02-9 P03-3 P04 40\n   P05 X 60 P06Y+40 P07 150",
     "N20 G76 P01 -1 P02 -9 P03 -3 P04 40 P05 X+60 P06 Y+40 P07 150 *\n"},
    {"CallWithM", "N20 M3 G79", "N20 G79 M03 *\n"},
    {"Shift", "N20 X50 G91 Y15 Z-10 G54", "N20 G54 X+50 G91 Y+15 Z-10 *\n"},
    {"Mirror", "N20 G28 X Y", "N20 G28 X Y *\n"},
    {"MirrorOff", "N20 G28", "N20 G28 *\n"},
    {"Dwell", "N20 G04 F2,5", "N20 G04 F2,5 *\n"},
    {"Scaling", "N20 G72 F1.000025", "N20 G72 F1,000025 *\n"},
    {"Rotation", "N20 G91 G73 H30 G19", "N20 G73 G19 G91 H+30 *\n"},
    {"ProgramAsCycle", "N20 G39 P01 808", "N20 G39 P01 808 *\n"},
    {"ProgramAsCycleOfEightDigits", "N20 P01 12345678 G39\nN30 G39 P01 +99999",
     "N20 G39 P01 12345678 *\nN30 G39 P01 99999 *\n"},
    {"Blank", "N20 G30 G17 X5 Y6 Z-7\nN30 G31 G91 X70 Y60 Z7",
     "N20 G30 G17 X+5 Y+6 Z-7 *\nN30 G31 G91 X+70 Y+60 Z+7 *\n"},
    {"Probe", "N20 G55 P01 10 P02 Z- P03 G90 X5 Y6\n   Z-2",
     "N20 G55 P01 10 P02 Z- P03 G90 X+5 Y+6 Z-2 *\n"},
    {"Calculation", "N20 D03 Q12 P01 Q2 P02-62", "N20 D03 Q12 P01 +Q2 P02 -62 *\n"},
    {"Jump", "N20 D12 P01 Q6 P02 +Q5 P03 3", "N20 D12 P01 +Q6 P02 +Q5 P03 3 *\n"},
    {"Root", "N20 D5 Q98 P01 2", "N20 D05 Q98 P01 +2 *\n"},
    {"StopBlock", "N20 G38 M9", "N20 G38 M09 *\n"},
    {"LastBlock", "N9999 %1 G71 *", "N9999 %1 G71 *\n"},
    {"LastBlockWithoutUnit", "N9999 %1", "N9999 %1 *\n"},
    {"SeveralInOneLine", "N20 X1 * N30 X2 *", "N20 X+1 *\nN30 X+2 *\n"},
    {"ContinuationLine", "N20 X1\nY2\nN30 X2", "N20 X+1 Y+2 *\nN30 X+2 *\n"},
    {"StarEndsTheBlock", "N20 X1 *\nY2\nN30 X2", "N20 X+1 *\nY+2 *\nN30 X+2 *\n"},

    {"GroupTwice", "N20 G02 G03 X1", "3:9 G-CODE GROUP ALREADY ASSIGNED: G03 after G02"},
    {"UnknownCode", "N20 G35 R1", "3:5 ILLEGAL G-CODE: G35"},
    {"UnknownLongCode", "N20 G101", "3:5 ILLEGAL G-CODE: G101"},
    {"NineCodes", "N20 G17 G01 G41 G25 R1 G79 G29 G51 T1 G98 L1 G38 X1",
     "3:52 BLOCK FORMAT INCORRECT: more than 8 G functions"},
    {"FourCoordinates", "N20 X1 Y1 Z1 A1", "3:16 BLOCK FORMAT INCORRECT: more than 3 coordinates"},
    {"CoordinateTwice", "N20 X1 X2", "3:8 BLOCK FORMAT INCORRECT: X is programmed twice"},
    {"TwoAuxiliaryFunctions", "N20 X1 M3 M8", "3:11 BLOCK FORMAT INCORRECT: M is programmed twice"},
    {"LabelZeroCalled", "N20 L0", "3:6 JUMP TO LABEL 0 NOT PERMITTED: L0"},
    {"SetAndCall", "N20 G98 L1 L2", "3:12 BLOCK FORMAT INCORRECT: L is programmed twice"},
    {"BareCoordinate", "N20 X", "3:6 BLOCK FORMAT INCORRECT: a coordinate has no value"},
    {"CornerAndPolarMove", "N20 G11 G25 R5 H10",
     "3:1 BLOCK FORMAT INCORRECT: a corner and a polar move need R both"},
    {"CornerAfterADefinition", "N20 G04 F1 G25 R5",
     "3:1 BLOCK FORMAT INCORRECT: a definition is between the corner and its move"},
    {"PocketWithoutSides", "N20 G75 P01 -1 P02 -9 P03 -3 P04 40 P05 18,5 P06 100",
     "3:1 BLOCK FORMAT INCORRECT: P05 of G75 is an axis and a length"},
    {"MissingParameter", "N20 G84 P01 -1 P02 -9 P03 0",
     "3:1 BLOCK FORMAT INCORRECT: P04 of G84 is missing"},
    {"ParameterTooMany", "N20 G84 P01 -1 P02 -9 P03 0 P04 80 P05 1",
     "3:1 BLOCK FORMAT INCORRECT: G84 has no P05"},
    {"BlankWithoutPlane", "N20 G30 X1 Y2 Z3",
     "3:1 BLK FORM DEFINITION INCORRECT: G30 has no plane"},
    {"DirectionNeverProgrammed", "N20 G05 X1 Y2",
     "3:1 PROGRAM START UNDEFINED: G05 repeats a direction, and there is none yet"},
    {"QForbiddenInSpeed", "N20 SQ4", "3:6 BLOCK FORMAT INCORRECT: S cannot be a Q parameter"},
    {"ProgramAsCycleOfNineDigits", "N20 G39 P01 123456789",
     "3:13 ENTRY VALUE INCORRECT: P01 123456789 is not within 0 to 99999999"},
    {"ProgramAsCycleNegative", "N20 G39 P01 -5",
     "3:15 BLOCK FORMAT INCORRECT: P01 of G39 is the number of a program, 0 to 99999999"},
    {"ProgramAsCycleWithDecimals", "N20 P01 0,8 G39",
     "3:16 BLOCK FORMAT INCORRECT: P01 of G39 is the number of a program, 0 to 99999999"},
    {"LongOperand", "N20 D00 Q1 P01 123456",
     "3:16 ENTRY VALUE INCORRECT: P 123456 is not within -99999.9999 to 99999.9999"},
    {"FeedAndMore", "N20 X1 F+500+5", "3:13 BLOCK FORMAT INCORRECT: '+' is not expected here"},
    {"FeedInParts", "N20 X1 F+5 00", "3:12 BLOCK FORMAT INCORRECT: '0' is not expected here"},
    {"FactorAndMore", "N20 G72 F0,5Q5", "3:13 BLOCK FORMAT INCORRECT: 'Q' is not expected here"},
    {"DwellAndMore", "N20 G04 F2,5,5", "3:13 BLOCK FORMAT INCORRECT: ',' is not expected here"},
    {"LengthAndMore", "N20 G99 T5 L1,5Q5 R3",
     "3:16 BLOCK FORMAT INCORRECT: 'Q' is not expected here"},
    {"FeedAtRapid", "N20 G00 X1 F100",
     "3:1 BLOCK FORMAT INCORRECT: F with G00: it belongs in the block that has this feed"},
    {"FunctionNotAlone", "N20 D00 Q1 P01 4 X1",
     "3:20 BLOCK FORMAT INCORRECT: a D function must be alone in its block"},
    {"BadCharacter", "N20 ?", "3:5 BLOCK FORMAT INCORRECT: '?' is not expected here"},
};

INSTANTIATE_TEST_SUITE_P(Words, Tnc155IsoBlock, testing::ValuesIn(kWords),
                         [](const auto& test) { return std::string(test.param.name); });

// HD-027
TEST(Tnc155IsoText, HeadSaysUnitAndProtection) {
  EXPECT_EQ(rewritten("% 2 G70 G50 *"), "%2 G70 G50 *\n");
  EXPECT_EQ(parts_of("% 2 G70 G50 *"), "BEGIN PGM 2 INCH P\n");
  EXPECT_EQ(rewritten("%2 *"), "1:1 BLOCK FORMAT INCORRECT: % has no G70 or G71");
}

// HD-038: nothing is preset.
TEST(Tnc155IsoText, FirstMoveNeedsOneCodeOfEachGroup) {
  const std::string head = "%1 G71\n";
  EXPECT_EQ(parts_of(head + "N1 G01 G40 G90 X1"),
            "BEGIN PGM 1 MM\n2:1 PROGRAM START UNDEFINED: the first move has no plane (G code)");
  EXPECT_EQ(
      parts_of(head + "N1 G17 G40 G90 X1"),
      "BEGIN PGM 1 MM\n2:1 PROGRAM START UNDEFINED: the first move has no path function (G code)");
  EXPECT_EQ(
      parts_of(head + "N1 G17 G01 G90 X1"),
      "BEGIN PGM 1 MM\n2:1 PROGRAM START UNDEFINED: the first move has no compensation (G code)");
  EXPECT_EQ(
      parts_of(head + "N1 G17 G01 G40 X1"),
      "BEGIN PGM 1 MM\n2:1 PROGRAM START UNDEFINED: no G90 or G91 before the first coordinate");
  EXPECT_EQ(parts_of(head + "N1 G17 G01 G40 G90 X1"),
            "BEGIN PGM 1 MM\nTOOL CALL Z\nL X+1,000 R0 F M\n");
}

// HD-038, HD-199: the MIN corner is absolute with or without G90; the plane has to be
// there.
TEST(Tnc155IsoText, TheBlankNeedsNoG90ButAPlane) {
  const std::string head = "%1 G71\n", begin = "BEGIN PGM 1 MM\n";
  EXPECT_EQ(parts_of(head + "G30 G17 X+5 Y+5 Z-10\nG31 G91 X+95 Y+95 Z+10"),
            begin +
                "DEF BLK FORM MIN Z X+5,000 Y+5,000 Z-10,000\n"
                "DEF BLK FORM MAX IX+95,000 IY+95,000 IZ+10,000\n");
  // what is in force before it says nothing about MIN and is still in force after it
  EXPECT_EQ(parts_of(head + "G17 G40 G91 G01 X1\nG30 G17 X5 Y5 Z-10\nX2"),
            begin +
                "TOOL CALL Z\nL IX+1,000 R0 F M\n"
                "DEF BLK FORM MIN Z X+5,000 Y+5,000 Z-10,000\nL IX+2,000 R F M\n");
  for (const char* g90 : {"", "G90 "}) {
    EXPECT_EQ(parts_of(head + "G30 " + g90 + "X5 Y5 Z-10"),
              begin + "2:1 BLK FORM DEFINITION INCORRECT: G30 has no plane");
  }
  EXPECT_EQ(parts_of(head + "G30 G17 G91 X5 Y5 Z-10"),
            begin + "2:1 BLK FORM DEFINITION INCORRECT: the MIN corner is not incremental");
  EXPECT_EQ(parts_of(head + "G30 G17 X5 Y5 Z-10\nG31 X9 Y9 Z0"),
            begin +
                "DEF BLK FORM MIN Z X+5,000 Y+5,000 Z-10,000\n"
                "3:1 PROGRAM START UNDEFINED: no G90 or G91 before the first coordinate");
}

struct PartsCase {
  const char* name;
  const char* text;
  const char* parts;
};
class Tnc155IsoParts : public testing::TestWithParam<PartsCase> {};

TEST_P(Tnc155IsoParts, AreThePlainBlocksThatDoTheSame) {
  EXPECT_EQ(parts_of(std::string("%1 G71\nN1 G17 G40 G90 G01 X0\n") + GetParam().text),
            std::string("BEGIN PGM 1 MM\nTOOL CALL Z\nL X+0,000 R0 F M\n") + GetParam().parts);
}

// HD-029, HD-031, HD-032, HD-040, HD-041, HD-043, HD-044, HD-045, HD-046, HD-047, HD-048, HD-049
const PartsCase kParts[] = {
    {"ModalPath", "N2 G02 I5 J6 X1 Y2\nN3 X3 Y4\nN4 G05 X5 Y6",
     "CC X+5,000 Y+6,000\nC X+1,000 Y+2,000 DR- R F M\nC X+3,000 Y+4,000 DR- R F M\nC X+5,000 "
     "Y+6,000 DR- R F M\n"},
    {"PolarRepeatsDirection", "N2 G13 H90\nN3 G15 H180",
     "CP PA+90,000 DR+ R F M\nCP PA+180,000 DR+ R F M\n"},
    {"MixedDistances", "N2 G91 X1 G90 Y2\nN3 X3\nN4 G91\nN5 X4",
     "L IX+1,000 Y+2,000 R F M\nL X+3,000 R F M\nL IX+4,000 R F M\n"},
    {"SingleAxisIsOneShot", "N2 G07 G43 Y8\nN3 X3 Y4", "Y+8,000 R+ F M\nL X+3,000 Y+4,000 R F M\n"},
    {"RapidHasNoFeed", "N2 G00 X1\nN3 G01 X2", "L X+1,000 R F MAX M\nL X+2,000 R F M\n"},
    {"Helix", "N2 G91 G12 H720 Z-6 F80", "CP IPA+720,000 IZ-6,000 DR- R F80 M\n"},
    {"PolarRapid", "N2 G10 R5 G91 H20", "LP PR+5,000 IPA+20,000 R F MAX M\n"},
    {"TakeOver", "N2 G29", "CC\n"},
    {"CenterIncremental", "N2 G91 I3", "CC IX+3,000\n"},
    {"AllAtOnce", "N2 G98 L7 T3 G18 S800 I1 J2 G03 X4 Y5 G25 R1 M8",
     "LBL 7\nL R F M08\nTOOL CALL 3 Y S 800,000\nCC X+1,000 Y+2,000\nC X+4,000 Y+5,000 DR+ R F "
     "M\nRND R1,000\n"},
    {"ToolChangeM", "N2 T3 M6", "TOOL CALL 3\nL R F M06\n"},
    {"AuxiliaryAlone", "N2 M30", "L R F M30\n"},
    {"Stop", "N2 G38 M9", "STOP M09\n"},
    {"StopAfterACall", "N2 G38 G79 M5", "CYCL CALL M05\nSTOP M\n"},
    {"StopAfterAMove", "N2 G38 G01 G40 G90 X1 F9 M9", "L X+1,000 R0 F9 M09\nSTOP M\n"},
    {"ToolDefinition", "N2 G99 T4 L-2 R5\nN3 G51 T5", "TOOL DEF 4 L-2,000 R+5,000\nTOOL DEF 5\n"},
    {"Chamfer", "N2 X5 Y5 G24 R2", "L X+5,000 Y+5,000 R F M\nL 2,000\n"},
    {"CallAfterMove", "N2 X5 Y5 G79", "L X+5,000 Y+5,000 R F M\nCYCL CALL M\n"},
    {"CycleMoveCall", "N2 G83 P01 -1 P02 -9 P03 -3 P04 0 P05 70 X5 Y5 M99",
     "CYCL DEF 1.0 PECKING\nCYCL DEF 1.1 SET-UP -1,000\nCYCL DEF 1.2 DEPTH -9,000\nCYCL DEF 1.3 "
     "PECKG -3,000\nCYCL DEF 1.4 DWELL 0,000\nCYCL DEF 1.5 F70\nL X+5,000 Y+5,000 R F M99\n"},
    {"CircularPocket", "N2 G78 P01 -1 P02 -9 P03 -3 P04 40 P05 30 P06 90",
     "CYCL DEF 5.0 CIRCULAR POCKET\nCYCL DEF 5.1 SET-UP -1,000\nCYCL DEF 5.2 DEPTH -9,000\nCYCL "
     "DEF 5.3 PECKING -3,000 F40\nCYCL DEF 5.4 RADIUS 30,000\nCYCL DEF 5.5 F90 DR+\n"},
    {"Slot", "N2 G74 P01 -1 P02 -9 P03 -3 P04 40 P05 X-30 P06 Y8 P07 90",
     "CYCL DEF 3.0 SLOT MILLING\nCYCL DEF 3.1 SET-UP -1,000\nCYCL DEF 3.2 DEPTH -9,000\nCYCL DEF "
     "3.3 PECKING -3,000 F40\nCYCL DEF 3.4 X-30,000\nCYCL DEF 3.5 Y+8,000\nCYCL DEF 3.6 F90\n"},
    {"Shift", "N2 G54 X5 G91 Y1",
     "CYCL DEF 7.0 DATUM SHIFT\nCYCL DEF 7.1 X+5,000\nCYCL DEF 7.2 IY+1,000\n"},
    {"Mirror", "N2 G28 Y", "CYCL DEF 8.0 MIRROR IMAGE\nCYCL DEF 8.1 Y\n"},
    {"Dwell", "N2 G04 F1,5", "CYCL DEF 9.0 DWELL TIME\nCYCL DEF 9.1 DWELL 1,500\n"},
    {"Rotation", "N2 G91 G73 H5", "CYCL DEF 10.0 ROTATION\nCYCL DEF 10.1 IROT +5,000\n"},
    {"Scaling", "N2 G72 F0,5", "CYCL DEF 11.0 SCALING\nCYCL DEF 11.1 SCL 0,500000\n"},
    {"ProgramAsCycle", "N2 G39 P01 55\nN3 G79",
     "CYCL DEF 12.0 PGM CALL\nCYCL DEF 12.1 PGM 55\nCYCL CALL M\n"},
    {"Labels", "N2 L7\nN3 L7.4\nN4 %55\nN5 G98 L0",
     "CALL LBL 7 REP\nCALL LBL 7 REP 4/4\nCALL PGM 55\nLBL 0\n"},
    {"Blank", "N2 G30 G18 X1 Y2 Z3\nN3 G31 G91 X4 Y5 Z6",
     "DEF BLK FORM MIN Y X+1,000 Y+2,000 Z+3,000\nDEF BLK FORM MAX IX+4,000 IY+5,000 IZ+6,000\n"},
    {"Probe", "N2 G55 P01 4 P02 Y+ P03 G91 X1",
     "TCH PROBE 0.0 REF. PLANE Q4 Y+\nTCH PROBE 0.1 IX+1,000\n"},
    {"End", "N9999 %1 G71", "END PGM 1 MM\n"},
    {"EndWithoutUnit", "N9999 %1", "END PGM 1 MM\n"},
};

INSTANTIATE_TEST_SUITE_P(Parts, Tnc155IsoParts, testing::ValuesIn(kParts),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Tnc155IsoText, ComesOutTheSameForAllWindows) {
  const std::string text =
      "%5 G71 *\r\nN10 G01 G40 G17 G90 X+1,5 Y+2 F100 *\r\nN20 G98 L7\r\nN30 G74 P01 -1 P02 -2 P03 "
      "-1\r\n"
      "      P04 40 P05 X+20 P06 Y+8 P07 60\r\nN40 X1 * N50 Y2 *\rN60 L7.2\nN9999 %5 G71\r\n";
  const std::string whole = rewritten(text);
  EXPECT_EQ(whole,
            "%5 G71 *\nN10 G17 G01 G40 G90 X+1,5 Y+2 F100 *\nN20 G98 L7 *\n"
            "N30 G74 P01 -1 P02 -2 P03 -1 P04 40 P05 X+20 P06 Y+8 P07 60 *\nN40 X+1 *\nN50 Y+2 *\n"
            "N60 L7.2 *\nN9999 %5 G71 *\n");
  for (std::size_t window = 1; window < 60; ++window) {
    EXPECT_EQ(rewritten_in_windows(text, window), whole) << window;
  }
}

// Which form a text is in.
TEST(Tnc155Form, IsFoundFromTheFirstLine) {
  for (const char* plain : {"0 BEGIN PGM 1 MM", "BEGIN PGM 1 INCH", "12 L X1", "X+5 R0 F M", "L X1",
                            "CYCL DEF 1.0 PECKING", "\r\n  3 CC", "* K X1", "IX+4"}) {
    EXPECT_EQ(detect_form(plain), Form::Plain) << plain;
  }
  for (const char* iso :
       {"%1 G71", "N10 G01", "G00 X1", "L15.8", "D00 Q1 P01 1", "X5 G01", "T1 G17"}) {
    EXPECT_EQ(detect_form(iso), Form::Iso) << iso;
  }
  for (const char* neither : {"", "  \r\n", "?", "O0100", "123"}) {
    EXPECT_EQ(detect_form(neither), Form::Unknown) << neither;
  }
}

}  // namespace
}  // namespace dripline::tnc_conversion
