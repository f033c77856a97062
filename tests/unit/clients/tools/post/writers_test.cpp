#include <gtest/gtest.h>
#include <algorithm>

#include "tests/unit/clients/tools/post/converted.hpp"

namespace dripline::post {
namespace {

/// All that mills have in common: tool, spindle, coolant, rapid, lines, arcs, full circle, dwell,
/// stop.
const std::string kMilled =
    "%\nO1234\n(COVER)\nG21 G17 G90 G94\nT3 M06\nS1200 M03\nM08\nG00 X-10. Y-5.5 Z50.\nZ2.\n"
    "G01 Z-4. F120.\nX40. F300.\nG03 X50. Y4.5 I0 J10.\nG02 X50. Y4.5 I-5. J0 (BOSS)\n"
    "G04 X1.5\nG00 Z50.\nM09\nM05\nM00\nM30\n%\n";

const std::string kTurned =
    "%\nO0045\nG21 G40 G97 G99\nT0303\nS800 M03\nM08\nG00 X42. Z2.\nG01 X30. F0.2\nZ-20.\n"
    "G02 X40. Z-25. R5.\nG98 G01 X42. F100.\nG00 X80. Z50.\nM09\nM05\nM30\n%\n";

struct Written {
  std::string_view target;
  const std::string& source;
  std::string_view control;
  std::string_view text;
};

class Writers : public testing::TestWithParam<Written> {};

TEST_P(Writers, WriteWhatTheirControlReads) {
  const auto& param = GetParam();
  ConversionOptions options;
  options.is_as_set_up = param.target == "centurion";  // at its tool change point
  const auto converted = convert({param.control, param.source}, param.target, options);
  EXPECT_TRUE(converted.is_proved) << converted.reason() << '\n' << converted.text;
  EXPECT_EQ(converted.text, param.text);
}

INSTANTIATE_TEST_SUITE_P(
    , Writers,
    testing::Values(
        Written{"fanuc", kMilled, "fanuc",
                "%\nO1234\nG21 G17 G40 G49 G80 G90 G94 G54\n(COVER)\nT3 M06\nS1200 M03\nM08\n"
                "G00 G43 H3 X-10. Y-5.5 Z50.\nZ2.\nG01 Z-4. F120.\nX40. F300.\n"
                "G03 X50. Y4.5 I0. J10.\n(BOSS)\nG02 X50. Y4.5 I-5. J0.\nG04 P1500\nG00 Z50.\nM09\n"
                "M05\nM00\nM30\n%\n"},
        Written{"rs274ngc", kMilled, "fanuc",
                "%\nG21 G17 G40 G49 G80 G90 G94 G54\n(COVER)\nT3 M6\nS1200 M3\nM8\n"
                "G0 G43 H3 X-10 Y-5.5 Z50\nZ2\nG1 Z-4 F120\nX40 F300\nG3 X50 Y4.5 I0 J10\n(BOSS)\n"
                "G2 X50 Y4.5 I-5 J0\nG4 P1.5\nG0 Z50\nM9\nM5\nM0\nM2\n%\n"},
        Written{"linuxcnc", kMilled, "fanuc",
                "%\nG21 G17 G40 G49 G80 G90 G91.1 G94 G97 G54\n(COVER)\nT3 M6\nS1200 M3\nM8\n"
                "G0 G43 X-10 Y-5.5 Z50\nZ2\nG1 Z-4 F120\nX40 F300\nG3 X50 Y4.5 I0 J10\n(BOSS)\n"
                "G2 X50 Y4.5 I-5 J0\nG4 P1.5\nG0 Z50\nM9\nM5\nM0\nM2\n%\n"},
        Written{"tnc155", kMilled, "fanuc",
                "0 BEGIN PGM 1234 MM\r\n1 TOOL CALL Z\r\n2 TOOL DEF 3 L+0 R+0\r\n"
                "3 TOOL CALL 3 Z\r\n4 TOOL CALL S1200\r\n5 L M3\r\n6 L M8\r\n"
                "7 L X-10 Y-5,5 Z+50 R0 FMAX\r\n8 L Z+2 R0 FMAX\r\n9 L Z-4 R0 F120\r\n"
                "10 L X+40 R0 F300\r\n11 CC X+40 Y+4,5\r\n12 C X+50 Y+4,5 DR+ R0\r\n"
                "13 CC X+45 Y+4,5\r\n14 C X+50 Y+4,5 DR- R0\r\n15 CYCL DEF 9.0 DWELL TIME\r\n"
                "16 CYCL DEF 9.1 DWELL 1,5\r\n17 L Z+50 R0 FMAX\r\n18 L M9\r\n19 L M5\r\n"
                "20 STOP\r\n21 L M30\r\n22 END PGM 1234 MM\r\n"},
        Written{"itnc", kMilled, "fanuc",
                "0 BEGIN PGM 1234 MM\r\n; COVER\r\n1 TOOL CALL 3 Z\r\n2 TOOL CALL S1200\r\n"
                "3 L M3\r\n4 L M8\r\n5 L X-10 Y-5.5 Z+50 R0 FMAX\r\n6 L Z+2 R0 FMAX\r\n"
                "7 L Z-4 R0 F120\r\n8 L X+40 R0 F300\r\n9 CC X+40 Y+4.5\r\n"
                "10 C X+50 Y+4.5 DR+ R0\r\n; BOSS\r\n11 CC X+45 Y+4.5\r\n"
                "12 C X+50 Y+4.5 DR- R0\r\n13 CYCL DEF 9.0 DWELL TIME\r\n"
                "14 CYCL DEF 9.1 DWELL 1.5\r\n15 L Z+50 R0 FMAX\r\n16 L M9\r\n17 L M5\r\n"
                "18 STOP\r\n19 L M30\r\n20 END PGM 1234 MM\r\n"},
        Written{"fanuc-t", kTurned, "fanuc-t",
                "%\nO0045\nG21 G40 G97 G54\nT0303\nS800 M03\nM08\nG00 X42. Z2.\n"
                "G99 G01 X30. F0.2\nZ-20.\nG02 X40. Z-25. I5. K0.\nG98 G01 X42. F100.\n"
                "G00 X80. Z50.\nM09\nM05\nM30\n%\n"},
        Written{"centurion", kTurned, "fanuc-t",
                "O0045\nG21 G40 G80 G93 G97 G501 G550 G569 G54\nT0303 M6\nS800 M3\nM8\n"
                "G0 X42. Z2.\nG99 G1 X30. F0.2\nZ-20.\nG2 X40. Z-25. I5. K0.\nG98 G1 X42. F100.\n"
                "G0 X80. Z50.\nM9\nM5\nM30\n"}),
    [](const auto& one) {
      std::string name(one.param.target);
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

TEST(TapeWriter, CountsInItsUnitAndSplitsArcsAtQuadrants) {
  const std::string source =
      "G21 G17 G90 G94\nM03\nM08\nG00 X10. Y0 Z1.\nG01 Z-0.5 F100.\nG03 X10. Y0 I-10. J0\n"
      "G04 X2.5\nG01 X12.345 F90.\nM09\nM05\nM30\n";
  ConversionOptions options;
  options.target_setup = setup_from("[control]\nunits = \"metric\"\n");
  const auto converted = convert({"fanuc", source}, "tektronix-1704", options);
  EXPECT_TRUE(converted.is_proved) << converted.reason() << '\n' << converted.text;
  EXPECT_EQ(converted.text,
            "%\nG90\nM03\nM08\nG50X10000Y0Z1000\nG00Z-500F100\nG30X0Y10000I0J0\n"
            "G30X-10000Y0I0J0\nG30X0Y-10000I0J0\nG30X10000Y0I0J0\nG04F25\nG00X12345F90\nM09\nM05\n"
            "M30\n");
}

TEST(TapeWriter, InchTapesTakeProgramsInMillimeters) {
  const std::string source = "G21 G90 G94\nG00 X25.4 Y0 Z1.\nG01 X50.8 F254.\nM30\n";
  const auto converted = convert({"fanuc", source}, "tektronix-1704");
  EXPECT_TRUE(converted.is_proved) << converted.reason();
  EXPECT_EQ(converted.text, "%\nG90\nG50X10000Y0Z394\nG00X20000F100\nM30\n");
}

TEST(PlainLanguageWriter, WritesAHelixByItsAngle) {
  const std::string source =
      "G21 G17 G90 G94\nG00 X20. Y0 Z0\nG03 X0 Y20. Z-2. I-20. J0 F200.\nG01 X0 Y30.\nM30\n";
  const auto converted = convert({"fanuc", source}, "tnc155");
  EXPECT_TRUE(converted.is_proved) << converted.reason();
  EXPECT_NE(converted.text.find("CC X+0 Y+0\r\n"), std::string::npos) << converted.text;
  EXPECT_NE(converted.text.find("CP IPA+90 Z-2 DR+ R0 F200\r\n"), std::string::npos)
      << converted.text;
  // The end of a helix is only as exact as its angle: both axes are named again.
  EXPECT_NE(converted.text.find("L X+0 Y+30 R0\r\n"), std::string::npos) << converted.text;
}

TEST(PlainLanguageWriter, CallsToolsOfTheTableByNumberOrName) {
  const std::string source = "G21 G90\nT3 M06\nG00 X1. Y1. Z5.\nT4 M06\nG00 X2. Y2. Z5.\nM30\n";
  ConversionOptions options;
  options.target_setup = setup_from(
      "[[tool]]\nnumber = 4\nname = \"MILL 8\"\n[[tool]]\nnumber = 5\nname = \"DRILL\"\n");
  const auto converted = convert({"fanuc", source}, "itnc", options);
  EXPECT_TRUE(converted.is_proved) << converted.reason();
  EXPECT_NE(converted.text.find("TOOL CALL 3 Z\r\n"), std::string::npos) << converted.text;
  EXPECT_NE(converted.text.find("TOOL CALL \"MILL 8\" Z\r\n"), std::string::npos);
  EXPECT_EQ(converted.text.find("TOOL DEF"), std::string::npos) << converted.text;
}

/// A name of two tools is none: the number is.
TEST(PlainLanguageWriter, CallsNoToolByANameOfTwo) {
  ConversionOptions options;
  options.target_setup =
      setup_from("[[tool]]\nnumber = 4\nname = \"MILL\"\n[[tool]]\nnumber = 5\nname = \"MILL\"\n");
  const auto converted =
      convert({"fanuc", "G21 G90\nT4 M06\nG00 X1. Y1. Z5.\nM30\n"}, "itnc", options);
  EXPECT_TRUE(converted.is_proved) << converted.reason();
  EXPECT_NE(converted.text.find("TOOL CALL 4 Z\r\n"), std::string::npos) << converted.text;
}

TEST(PlainLanguageWriter, WritesPlanesAndTenthsOfMicrometers) {
  const std::string source =
      "G21 G90 G94\nG0 X0 Y0 Z0\nG18 G2 X10.0002 Z10.0002 I10.0002 K0 F100.25\n"
      "G19 G3 Y10 Z20.0002 J0 K10\nG17 G2 X20.0002 Y20 I10 J0\nM2\n";
  const auto converted = convert({"rs274ngc", source}, "itnc");
  EXPECT_TRUE(converted.is_proved) << converted.reason() << converted.text;
  EXPECT_NE(converted.text.find("CC Z+0 X+10.0002\r\n"), std::string::npos) << converted.text;
  EXPECT_NE(converted.text.find("TOOL CALL Z\r\n"), std::string::npos) << converted.text;
  EXPECT_NE(converted.text.find(" F100.25\r\n"), std::string::npos) << converted.text;
}

/// F of a helix is the speed along its circle there: 100 along a helix of 62.832 and 50.
TEST(WordWriter, WritesTheFeedOfAFanucHelixAlongItsCircle) {
  const std::string source =
      "G21 G90 G94\nG0 X10 Y0 Z0\nG3 X10 Y0 Z-50 I-10 J0 F100\nG1 X0 F200\nM2\n";
  const auto converted = convert({"rs274ngc", source}, "fanuc");
  EXPECT_TRUE(converted.is_proved) << converted.reason() << converted.text;
  EXPECT_NE(converted.text.find("Z-50. I-10. J0. F78.2\n"), std::string::npos) << converted.text;
}

TEST(WordWriter, WritesPlanesWhereTheyChange) {
  const std::string source =
      "G21 G90 G94\nG00 X0 Y0 Z0\nG18 G02 X10. Z10. I10. K0 F100.\nG19 G03 Y10. Z20. J0 K10.\n"
      "G17 G02 X20. Y20. I10. J0\nM30\n";
  const auto converted = convert({"fanuc", source}, "rs274ngc");
  EXPECT_TRUE(converted.is_proved) << converted.reason() << converted.text;
  EXPECT_NE(converted.text.find("G18 G2 "), std::string::npos) << converted.text;
  EXPECT_NE(converted.text.find("G19 G3 "), std::string::npos) << converted.text;
  EXPECT_NE(converted.text.find("G17 G2 "), std::string::npos) << converted.text;
}

TEST(WordWriter, KeepsInchesAndConvertsThem) {
  const std::string source = "G20 G90 G94\nG00 X1. Y.5 Z.1\nG01 X2.3456 F10.\nM30\n";
  const auto kept = convert({"fanuc", source}, "rs274ngc");
  EXPECT_TRUE(kept.is_proved) << kept.reason();
  EXPECT_NE(kept.text.find("G20 "), std::string::npos);
  EXPECT_NE(kept.text.find("G1 X2.3456 F10\n"), std::string::npos) << kept.text;
  ConversionOptions options;
  options.units = interpreter::Units::Millimeter;
  const auto changed = convert({"fanuc", source}, "rs274ngc", options);
  EXPECT_TRUE(changed.is_proved) << changed.reason();
  EXPECT_NE(changed.text.find("G1 X59.5782 F254\n"), std::string::npos) << changed.text;
}

TEST(WordWriter, WritesSurfaceSpeedWithItsLimit) {
  const std::string source =
      "G21 G40 G97 G99\nT0101\nG50 S2000\nG96 S150 M03\nG00 X50. Z1.\nG01 Z-5. F0.1\n"
      "G97 S600 M03\nG01 X60.\nM30\n";
  const auto elsewhere = convert({"fanuc-t", source}, "centurion");
  EXPECT_FALSE(elsewhere.is_proved) << "M6 of a Centurion moves to the tool change point";
  ConversionOptions options;
  options.is_as_set_up = true;
  const auto converted = convert({"fanuc-t", source}, "centurion", options);
  EXPECT_TRUE(converted.is_proved) << converted.reason() << converted.text;
  EXPECT_NE(converted.text.find("G50 S2000\nG96 S150 M3\n"), std::string::npos) << converted.text;
  EXPECT_NE(converted.text.find("G97 S600 M3\n"), std::string::npos) << converted.text;
}

TEST(WordWriter, WritesThreadsInTheLeadOfEachControl) {
  const std::string source =
      "G21 G40 G97 G99\nT0101\nS600 M03\nG00 X30. Z5.\nG32 Z-20. F2.\nX40. Z-40. F2.\n"
      "G32 Z-60. F1.5 Q90000\nG01 X50. F0.2\nM30\n";
  ConversionOptions options;
  options.is_as_set_up = true;  // at the tool change point, to which M6 of a Centurion moves
  const auto there = convert({"fanuc-t", source}, "centurion", options);
  EXPECT_TRUE(there.is_proved) << there.reason() << there.text;
  EXPECT_NE(there.text.find("G99 G32 G1 Z-20. F2.\n"), std::string::npos) << there.text;
  EXPECT_NE(there.text.find("G32 G1 Z-60. F1.5 Q90\n"), std::string::npos) << there.text;
  EXPECT_NE(there.text.find("X50. F0.2\n"), std::string::npos) << there.text;
  const auto back = convert({"centurion", there.text}, "fanuc-t", options);
  EXPECT_TRUE(back.is_proved) << back.reason() << back.text;
  EXPECT_NE(back.text.find("G32 X40. Z-40. F2.\n"), std::string::npos) << back.text;
}

TEST(WordWriter, MarksCommentsThatLinuxcncWouldActUpon) {
  const auto converted =
      convert({"fanuc", "(MSG, hello)\n(Print it)\n(plate)\nG21 G00 X1.\nM30\n"}, "linuxcnc");
  EXPECT_TRUE(converted.is_proved) << converted.reason();
  EXPECT_EQ(converted.text.find("(MSG"), std::string::npos);
  EXPECT_EQ(converted.text.find("(Print"), std::string::npos);
  EXPECT_NE(converted.text.find("(plate)"), std::string::npos) << converted.text;
}

TEST(ProgramNumber, IsThatOfTheSourceOrTheOneAskedFor) {
  const std::string source = "0 BEGIN PGM 77 MM\n1 L X+1 Y+1 R0 FMAX\n2 END PGM 77 MM\n";
  EXPECT_NE(convert({"tnc155", source}, "fanuc").text.find("\nO0077\n"), std::string::npos);
  ConversionOptions options;
  options.name = 9123;
  EXPECT_NE(convert({"tnc155", source}, "fanuc", options).text.find("\nO9123\n"),
            std::string::npos);
  options.name = 10'000;
  EXPECT_EQ(convert({"tnc155", source}, "fanuc", options).reason(),
            "program number 10000: fanuc takes 1 to 9999");
}

}  // namespace
}  // namespace dripline::post
