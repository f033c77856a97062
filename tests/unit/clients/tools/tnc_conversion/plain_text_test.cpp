#include <gtest/gtest.h>

#include "tests/unit/clients/tools/tnc_conversion/rewriting.hpp"

namespace dripline::tnc_conversion {
namespace {

using namespace interpreter;
using namespace interpreter::tnc155;

struct PlainCase {
  const char* name;
  const char* read;
  const char* written;
};

class Tnc155PlainBlock : public testing::TestWithParam<PlainCase> {};

TEST_P(Tnc155PlainBlock, IsWrittenAsTheControlWritesIt) {
  EXPECT_EQ(rewritten(GetParam().read, Form::Plain), GetParam().written);
}

// HD-001, HD-002, HD-003, HD-004, HD-005, HD-006, HD-007, HD-008, HD-009, HD-010, HD-011, HD-012,
// HD-013, HD-014, HD-015, HD-016, HD-017, HD-018, HD-019, HD-020, HD-021, HD-022, HD-023, HD-024,
// HD-025, HD-026, HD-059
const PlainCase kBlocks[] = {
    {"ContinuationLines", "41 L X+12,5\n   Y-3\n   R F M\n42 CC",
     "41 L X+12,500 Y-3,000 R F M\n42 CC\n"},
    {"BlanksWithinWords", "7 L X + 12,5 I Y - 3 R 0 F 250 M 3\n",
     "7 L X+12,500 IY-3,000 R0 F250 M03\n"},
    {"NoBlanks", "7LX1Y2RLF250M08\n", "7 L X+1,000 Y+2,000 RL F250 M08\n"},
    {"Point", "7 L X1.25 Y-,5 F40\n", "7 L X+1,250 Y-0,500 R F40 M\n"},
    {"InchHasFourDecimals", "0 BEGIN PGM 4 INCH\n1 L X1.23456\n",
     "0 BEGIN PGM 4 INCH\n2:6 ENTRY VALUE INCORRECT: X 1.23456 has more than 4 decimals"},
    {"InchNumbers", "0 BEGIN PGM 4 INCH\n1 L X1.2345 A90\n",
     "0 BEGIN PGM 4 INCH\n1 L X+1,2345 A+90,000 R F M\n"},
    {"MetricHasThreeDecimals", "1 L X1,2345",
     "1:6 ENTRY VALUE INCORRECT: X 1,2345 has more than 3 decimals"},
    {"TrailingZeros", "1 L X1,230000", "1 L X+1,230 R F M\n"},
    {"Incremental", "3 LP IPR-2 IPA+400 R F M", "3 LP IPR-2,000 IPA+400,000 R F M\n"},
    {"Placeholders", "3 C X1 Y2 DR- R F M", "3 C X+1,000 Y+2,000 DR- R F M\n"},
    {"Frame", "0 BEGIN PGM 70 MM P\n1 END PGM 70 MM P", "0 BEGIN PGM 70 MM P\n1 END PGM 70 MM P\n"},
    {"FrameWithoutNumber", "BEGIN PGM 70 MM\n1 END PGM 70 MM",
     "BEGIN PGM 70 MM\n1 END PGM 70 MM\n"},
    {"ToolDef", "2 TOOL DEF 17 L-1,5 R+Q8", "2 TOOL DEF 17 L-1,500 R+Q8\n"},
    {"NextTool", "2 TOOL DEF 17", "2 TOOL DEF 17\n"},
    {"ToolZeroCannotBeDefined", "2 TOOL DEF 0 L1",
     "1:12 ENTRY VALUE INCORRECT: TOOL DEF 0 is not within 1 to 254"},
    {"ToolCall", "2 TOOL CALL 17 Y S 630,5", "2 TOOL CALL 17 Y S 630,500\n"},
    {"ToolCallSpeedOnly", "2 TOOL CALL S 900", "2 TOOL CALL S 900,000\n"},
    {"ToolCallFourth", "2 TOOL CALL 4 IV", "2 TOOL CALL 4 IV\n"},
    {"Stop", "2 STOP", "2 STOP M\n"},
    {"StopWithM", "2 STOP M9", "2 STOP M09\n"},
    {"ThreeAxes", "2 L X1 Y2 Z3 RR F MAX M13", "2 L X+1,000 Y+2,000 Z+3,000 RR F MAX M13\n"},
    {"FourAxes", "2 L X1 Y2 Z3 A4", "1:14 BLOCK FORMAT INCORRECT: more than 3 coordinates"},
    {"Chamfer", "2 L 1,75", "2 L 1,750\n"},
    {"PolarLine", "2 LP PR+8 PA-30,5 RL F80", "2 LP PR+8,000 PA-30,500 RL F80 M\n"},
    {"CenterNone", "2 CC", "2 CC\n"},
    {"CenterOne", "2 CC IY-4", "2 CC IY-4,000\n"},
    {"CenterTwo", "2 CC X1 Y2", "2 CC X+1,000 Y+2,000\n"},
    {"ArcNeedsDirection", "2 C X1 Y2 F100", "1:15 BLOCK FORMAT INCORRECT: DR has no value"},
    {"PolarArc", "2 CP PA+90 DR+ RR", "2 CP PA+90,000 DR+ RR F M\n"},
    {"Helix", "2 CP IPA-1080 IZ-4,5 DR- F90", "2 CP IPA-1080,000 IZ-4,500 DR- R F90 M\n"},
    {"TangentArc", "2 CT X3 IY4 F70 M8", "2 CT X+3,000 IY+4,000 R F70 M08\n"},
    {"Rounding", "2 RND 2,5", "2 RND R2,500\n"},
    {"RoundingWithR", "2 RND R 2,5", "2 RND R2,500\n"},
    {"RoundingIsNotNegative", "2 RND R-1",
     "1:8 ENTRY VALUE INCORRECT: RND -1 is not within 0 to 19999.999"},
    {"SingleAxisLonger", "2 IX-8 R+ F30 M3", "2 IX-8,000 R+ F30 M03\n"},
    {"SingleAxisShorter", "2 Z8 R-", "2 Z+8,000 R- F M\n"},
    {"SingleAxisHasNoPath", "2 Z8 RL",
     "1:8 BLOCK FORMAT INCORRECT: a single-axis block has R0, R+ or R-"},
    {"Label", "2 LBL 61", "2 LBL 61\n"},
    {"LabelZero", "2 LBL 0", "2 LBL 0\n"},
    {"Subprogram", "2 CALL LBL 61 REP", "2 CALL LBL 61 REP\n"},
    {"Repeat", "2 CALL LBL 61 REP 5/3", "2 CALL LBL 61 REP 5/3\n"},
    {"RepeatWithoutCountdown", "2 CALL LBL 61 REP 5", "2 CALL LBL 61 REP 5/5\n"},
    {"CallOfLabelZero", "2 CALL LBL 0 REP", "1:12 JUMP TO LABEL 0 NOT PERMITTED: CALL LBL 0"},
    {"ProgramCall", "2 CALL PGM 87654321", "2 CALL PGM 87654321\n"},
    {"ProgramNumberTooLong", "2 CALL PGM 123456789",
     "1:12 ENTRY VALUE INCORRECT: CALL PGM 123456789 is not within 0 to 99999999"},
    {"Fn0", "2 FN 0: Q7 = -1,5", "2 FN 0: Q7 = -1,500\n"},
    {"Fn1", "2 FN1:Q7=Q8+-2", "2 FN 1: Q7 = +Q8 + -2,000\n"},
    {"Fn2", "2 FN 2: Q7 = 4 - -Q8", "2 FN 2: Q7 = +4,000 - -Q8\n"},
    {"Fn3", "2 FN 3: Q7 = 4 * 5", "2 FN 3: Q7 = +4,000 * +5,000\n"},
    {"Fn4", "2 FN 4: Q7 = Q7\n   DIV Q9", "2 FN 4: Q7 = +Q7 DIV +Q9\n"},
    {"Fn5", "2 FN 5: Q99 = SQRT 3", "2 FN 5: Q99 = SQRT +3,000\n"},
    {"Fn6", "2 FN 6: Q0 = SIN Q1", "2 FN 6: Q0 = SIN +Q1\n"},
    {"Fn7", "2 FN 7: Q0 = COS -Q1", "2 FN 7: Q0 = COS -Q1\n"},
    {"Fn8", "2 FN 8: Q0 = 5 LEN 12", "2 FN 8: Q0 = +5,000 LEN +12,000\n"},
    {"Fn9", "2 FN 9: IF Q1 EQU 3 GOTO LBL 7", "2 FN 9: IF +Q1 EQU +3,000 GOTO LBL 7\n"},
    {"Fn10", "2 FN 10: IF Q1 NE 3 GOTO LBL 7", "2 FN 10: IF +Q1 NE +3,000 GOTO LBL 7\n"},
    {"Fn11", "2 FN 11: IF Q1 GT 3 GOTO LBL 7", "2 FN 11: IF +Q1 GT +3,000 GOTO LBL 7\n"},
    {"Fn12", "2 FN 12: IF Q1 LT 3 GOTO LBL 7", "2 FN 12: IF +Q1 LT +3,000 GOTO LBL 7\n"},
    {"Fn13", "2 FN 13: Q1 = 3", "1:6 ENTRY VALUE INCORRECT: FN 13 is not within 0 to 12"},
    {"FnOfQ100", "2 FN 0: Q100 = 3", "1:10 ENTRY VALUE INCORRECT: Q 100 is not within 0 to 99"},
    {"Pecking",
     "1 CYCL DEF 1.0 PECKING\n2 CYCL DEF 1.1 SET-UP -1,5\n3 CYCL DEF 1.2 DEPTH -9\n4 CYCL DEF 1.3 "
     "PECKING -3\n5 CYCL DEF 1.4 DWELL 0,25\n6 CYCL DEF 1.5 F70",
     "1 CYCL DEF 1.0 PECKING\n2 CYCL DEF 1.1 SET-UP -1,500\n3 CYCL DEF 1.2 DEPTH -9,000\n4 CYCL "
     "DEF 1.3 PECKG -3,000\n5 CYCL DEF 1.4 DWELL 0,250\n6 CYCL DEF 1.5 F70\n"},
    {"SetUpAsTwoWords", "5 CYCL DEF 5.1 SET UP-2,000", "5 CYCL DEF 5.1 SET-UP -2,000\n"},
    {"Tapping",
     "1 CYCL DEF 2.0 TAPPING\n2 CYCL DEF 2.1 SET-UP -1\n3 CYCL DEF 2.2 DEPTH -Q4\n4 CYCL DEF 2.3 "
     "DWELL 1\n5 CYCL DEF 2.4 F 70",
     "1 CYCL DEF 2.0 TAPPING\n2 CYCL DEF 2.1 SET-UP -1,000\n3 CYCL DEF 2.2 DEPTH -Q4\n4 CYCL DEF "
     "2.3 DWELL 1,000\n5 CYCL DEF 2.4 F70\n"},
    {"Slot",
     "3 CYCL DEF 3.0 SLOT MILLING\n4 CYCL DEF 3.3 PECKG -3\n   F60\n5 CYCL DEF 3.4 X-40\n6 CYCL "
     "DEF 3.5 Y 12\n7 CYCL DEF 3.6 F90",
     "3 CYCL DEF 3.0 SLOT MILLING\n4 CYCL DEF 3.3 PECKING -3,000 F60\n5 CYCL DEF 3.4 X-40,000\n6 "
     "CYCL DEF 3.5 Y+12,000\n7 CYCL DEF 3.6 F90\n"},
    {"Pocket", "3 CYCL DEF 4.0 POCKET MILLING\n4 CYCL DEF 4.6 F90 DR-",
     "3 CYCL DEF 4.0 POCKET MILLING\n4 CYCL DEF 4.6 F90 DR-\n"},
    {"CircularPocket",
     "3 CYCL DEF 5.0 CIRCULAR POCKET\n4 CYCL DEF 5.4 RADIUS 17\n5 CYCL DEF 5.5 F90 DR+",
     "3 CYCL DEF 5.0 CIRCULAR POCKET\n4 CYCL DEF 5.4 RADIUS 17,000\n5 CYCL DEF 5.5 F90 DR+\n"},
    {"Shift", "3 CYCL DEF 7.0 DATUM SHIFT\n4 CYCL DEF 7.1 X 4\n5 CYCL DEF 7.2 IC-15",
     "3 CYCL DEF 7.0 DATUM SHIFT\n4 CYCL DEF 7.1 X+4,000\n5 CYCL DEF 7.2 IC-15,000\n"},
    {"Mirror", "3 CYCL DEF 8.0 MIRROR IMAGE\n4 CYCL DEF 8.1 X Y\n5 CYCL DEF 8.1",
     "3 CYCL DEF 8.0 MIRROR IMAGE\n4 CYCL DEF 8.1 X Y\n5 CYCL DEF 8.1\n"},
    {"MirrorWithValue", "3 CYCL DEF 8.1 X5",
     "1:17 WRONG AXIS PROGRAMMED: mirrored axes have no values"},
    {"Dwell", "3 CYCL DEF 9.0 DWELL TIME\n4 CYCL DEF 9.1 DWELL 2,5",
     "3 CYCL DEF 9.0 DWELL TIME\n4 CYCL DEF 9.1 DWELL 2,500\n"},
    {"Rotation", "3 CYCL DEF 10.0 ROTATION\n4 CYCL DEF 10.1 ROT 30\n5 CYCL DEF 10.1 IROT-Q3",
     "3 CYCL DEF 10.0 ROTATION\n4 CYCL DEF 10.1 ROT +30,000\n5 CYCL DEF 10.1 IROT -Q3\n"},
    {"Scaling", "3 CYCL DEF 11.0 SCALING\n4 CYCL DEF 11.1 SCL 1,000025",
     "3 CYCL DEF 11.0 SCALING\n4 CYCL DEF 11.1 SCL 1,000025\n"},
    {"ScalingCannotBeQ", "4 CYCL DEF 11.1 SCL Q3", "1:21 BLOCK FORMAT INCORRECT: SCL has no value"},
    {"ProgramAsCycle", "3 CYCL DEF 12.0 PGM CALL\n4 CYCL DEF 12.1 PGM 808",
     "3 CYCL DEF 12.0 PGM CALL\n4 CYCL DEF 12.1 PGM 808\n"},
    {"CycleSix", "3 CYCL DEF 6.0 ROUGH OUT",
     "1:12 BLOCK FORMAT INCORRECT: there is no CYCL DEF 6.0"},
    {"CycleCall", "3 CYCL CALL", "3 CYCL CALL M\n"},
    {"CycleCallWithM", "3 CYCL CALL M3", "3 CYCL CALL M03\n"},
    {"BlankMin", "1 DEF BLK FORM MIN X0 Y0 Z-15", "1 DEF BLK FORM MIN X+0,000 Y+0,000 Z-15,000\n"},
    {"BlankMax", "1 DEF BLK FORM MAX IX70 IY50 IZ15",
     "1 DEF BLK FORM MAX IX+70,000 IY+50,000 IZ+15,000\n"},
    {"BlankLaterSpelling", "1 BLK FORM 0.1 Y X0 Y0 Z-15\n2 BLK FORM 0.2 X70 Y50 Z0",
     "1 DEF BLK FORM MIN Y X+0,000 Y+0,000 Z-15,000\n2 DEF BLK FORM MAX X+70,000 Y+50,000 "
     "Z+0,000\n"},
    {"BlankMinIsAbsolute", "1 DEF BLK FORM MIN IX0 Y0 Z-15",
     "1:31 BLK FORM DEFINITION INCORRECT: the MIN corner is not incremental"},
    {"Probe", "1 TCH PROBE 0.0 REF. PLANE Q6 X+\n2 TCH PROBE 0.1 X5\n   Y-3 IZ2",
     "1 TCH PROBE 0.0 REF. PLANE Q6 X+\n2 TCH PROBE 0.1 X+5,000 Y-3,000 IZ+2,000\n"},
    {"CircleOrAxis", "1 C X1 Y2 DR+\n2 C+45\n3 CQ4\n4 IC-5 F90",
     "1 C X+1,000 Y+2,000 DR+ R F M\n2 C+45,000 R F M\n3 C+Q4 R F M\n4 IC-5,000 R F90 M\n"},
    {"IncrementalCircle", "1 CIX1 IY2 DR+", "1 C IX+1,000 IY+2,000 DR+ R F M\n"},
    {"QInWords", "1 L X-Q3 IYQ4 FQ5", "1 L X-Q3 IY+Q4 R F+Q5 M\n"},
    {"QForbiddenInSpeed", "1 TOOL CALL 1 Z SQ4",
     "1:18 BLOCK FORMAT INCORRECT: S cannot be a Q parameter"},
    {"QForbiddenInM", "1 L X1 MQ4", "1:9 BLOCK FORMAT INCORRECT: 'Q' is not expected here"},
    {"FeedIsWhole", "1 L X1 F 1,5",
     "1:10 ENTRY VALUE INCORRECT: F 1,5 is not a whole number within 0 to 15999"},
    {"FeedLimit", "1 L X1 F16000",
     "1:9 ENTRY VALUE INCORRECT: F 16000 is not a whole number within 0 to 15999"},
    {"InchFeedLimit", "0 BEGIN PGM 1 INCH\n1 L X1 F6300",
     "0 BEGIN PGM 1 INCH\n2:9 ENTRY VALUE INCORRECT: F 6300 is not a whole number within 0 to "
     "6299"},
    {"CoordinateLimit", "1 L X30000,001",
     "1:6 ENTRY VALUE INCORRECT: X 30000,001 is not within -30000 to 30000"},
    {"AngleLimit", "1 LP PR1 PA360,001",
     "1:12 ENTRY VALUE INCORRECT: PA 360,001 is not within -360 to 360"},
    {"BlockNumbers", "65534 CC", "65534 CC\n"},
    {"LowerCase", "1 l x1", "1:3 BLOCK FORMAT INCORRECT: 'l' is not expected here"},
    {"FaultInContinuationLine", "1 L X1\n   Y2\n   F16000",
     "3:5 ENTRY VALUE INCORRECT: F 16000 is not a whole number within 0 to 15999"},
    {"WithoutNumbers", "LBL 4\nL X1\n  Y2\nCALL LBL 4 REP 2/2",
     "LBL 4\nL X+1,000 Y+2,000 R F M\nCALL LBL 4 REP 2/2\n"},
    {"StarLines",
     "1 L X1 F90\n2 * K X2\n3 C X1 Y1 DR-\n4 * X2 Y2\n5 LP PR1 PA2\n6 * P PR2\n7 * PA3",
     "1 L X+1,000 R F90 M\n2 L X+2,000 R F M\n3 C X+1,000 Y+1,000 DR- R F M\n4 C X+2,000 Y+2,000 "
     "DR- R F M\n"
     "5 LP PR+1,000 PA+2,000 R F M\n6 LP PR+2,000 R F M\n7 LP PA+3,000 R F M\n"},
    {"StarWithoutPath", "1 * X2",
     "1:4 PROGRAM START UNDEFINED: * repeats a path function, and there is none yet"},
};

INSTANTIATE_TEST_SUITE_P(Blocks, Tnc155PlainBlock, testing::ValuesIn(kBlocks),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Tnc155PlainText, ComesOutTheSameForAllWindows) {
  const std::string text =
      std::string(50, '\0') +
      "\r\n0 BEGIN PGM 5 MM\r\n1 L X+1,5\r\n    Y+2 R0 F100 M\r\n2 CC\r\r\n3 LBL 7\n\n4 CALL "
      "LBL 7 REP 2/2\r"
      "5 END PGM 5 MM\r\n\x03";
  const std::string whole = rewritten(text);
  EXPECT_EQ(whole,
            "0 BEGIN PGM 5 MM\n1 L X+1,500 Y+2,000 R0 F100 M\n2 CC\n3 LBL 7\n"
            "4 CALL LBL 7 REP 2/2\n5 END PGM 5 MM\n");
  for (std::size_t window = 1; window < 60; ++window) {
    EXPECT_EQ(rewritten_in_windows(text, window), whole) << window;
  }
}

}  // namespace
}  // namespace dripline::tnc_conversion
