#include <gtest/gtest.h>

#include "clients/tools/post/compensation_reader.hpp"
#include "tests/unit/clients/tools/post/converted.hpp"

/// Contours that are written as programmed, with the compensation of the target.
namespace dripline::post {
namespace {

ConversionOptions keeping(std::string_view setup = {}) {
  ConversionOptions options;
  options.keeps_compensation = true;
  options.target_setup = setup_from(setup);
  return options;
}

/// A pocket whose corners all lie inside: the tool never goes round one.
const std::string kPocket =
    "0 BEGIN PGM 1 MM\n1 TOOL DEF 3 L+0 R+4\n2 TOOL CALL 3 Z S800\n"
    "3 L X+30 Y+20 Z+5 R0 FMAX M3\n4 L Z-3 R0 F80\n5 L X+30 Y+0 RL F200\n6 L X+60 Y+0\n"
    "7 L Y+40\n8 L X+0\n9 L Y+0\n10 L X+40\n11 L X+30 Y+20 R0\n12 L Z+50 R0 FMAX M30\n"
    "13 END PGM 1 MM\n";
/// Outside, around corners.
const std::string kBoss =
    "0 BEGIN PGM 1 MM\n1 TOOL DEF 3 L+0 R+4\n2 TOOL CALL 3 Z S800\n"
    "3 L X-20 Y-20 Z+5 R0 FMAX M3\n4 L X+0 Y+0 RL F200\n5 L Y+30\n6 L X+40 Y+30\n7 RND R4\n8 L "
    "X+40 Y+0\n"
    "9 L X+0\n10 L X-20 Y-20 R0 FMAX\n11 L Z+50 R0 FMAX M30\n12 END PGM 1 MM\n";
const std::string kOneTool = "[[tool]]\nnumber = 3\nradius = 4.0\n";

TEST(KeptCompensation, IsThatOfTheTool) {
  for (const auto& [control, target] : {std::pair{"tnc155", "itnc"}, std::pair{"tnc155", "tnc155"},
                                        std::pair{"itnc", "tnc155"}, std::pair{"itnc", "itnc"}}) {
    const auto converted = convert({control, kBoss}, target, keeping());
    ASSERT_TRUE(converted.is_proved) << target << converted.reason() << converted.text;
    EXPECT_NE(converted.text.find(" L X+0 Y+0 RL F200\r\n"), std::string::npos) << converted.text;
    EXPECT_NE(converted.text.find(" L X-20 Y-20 R0 FMAX\r\n"), std::string::npos) << converted.text;
    EXPECT_EQ(converted.written->compensation.radii, (std::map<int, double>{{3, 4.0}}));
  }
  const auto defined = convert({"tnc155", kBoss}, "tnc155", keeping());
  EXPECT_NE(defined.text.find("TOOL DEF 3 L+0 R+4\r\n"), std::string::npos) << defined.text;
}

TEST(KeptCompensation, IsThatOfD) {
  const std::string source =
      "%\nO1\nG21 G17 G90 G94 G40\nT3 M06\nG00 X30. Y20.\nG43 H3 Z5.\nG01 Z-3. F80.\n"
      "G41 D7 X30. Y0 F200.\nX60.\nG03 X70. Y10. J10.\nG01 Y40.\nX0\nY0\nX40.\n"
      "G40 X30. Y20.\nG00 Z50.\nM30\n%\n";
  const auto setup = setup_from("[[tool]]\nnumber = 3\n[[tool]]\nnumber = 7\nradius = 4.0\n");
  const auto converted = convert({"fanuc", source, setup}, "fanuc", keeping());
  EXPECT_TRUE(converted.is_proved) << converted.reason() << converted.text;
  EXPECT_NE(converted.text.find("G41 D7 Y0. F200.\n"), std::string::npos) << converted.text;
  EXPECT_NE(converted.text.find("G03 X70. Y10. I0. J10.\n"), std::string::npos) << converted.text;
  EXPECT_NE(converted.text.find("G40 X30. Y20.\n"), std::string::npos) << converted.text;
  const auto of_tool = convert({"fanuc", source, setup}, "itnc", keeping());
  EXPECT_EQ(of_tool.reason(),
            "line 8: compensation cannot be kept: radius 7 with tool 3: itnc has that of the tool");
}

/// The contour is written as it is programmed; without the option the path of the tool is.
TEST(KeptCompensation, HasTheCoordinatesOfTheContour) {
  const auto kept = convert({"tnc155", kPocket}, "itnc", keeping());
  EXPECT_TRUE(kept.is_proved) << kept.reason() << kept.text;
  EXPECT_NE(kept.text.find("L X+60 RL\r\n"), std::string::npos) << kept.text;
  const auto resolved = convert({"tnc155", kPocket}, "itnc");
  EXPECT_TRUE(resolved.is_proved) << resolved.reason();
  EXPECT_NE(resolved.text.find("L X+56 R0\r\n"), std::string::npos) << resolved.text;
}

/// A Fanuc lengthens lines around a corner, a TNC goes around it on an arc.
TEST(KeptCompensation, IsRefusedWhereTheMotionDiffers) {
  const auto converted = convert({"tnc155", kBoss}, "fanuc", keeping());
  EXPECT_FALSE(converted.is_proved);
  EXPECT_TRUE(converted.reason().starts_with("difference: line ")) << converted.reason();
}

/// What is the same with one radius alone is no proof.
TEST(KeptCompensation, IsProvedWithAnotherRadius) {
  const auto kept = convert({"tnc155", kPocket}, "itnc", keeping());
  ASSERT_TRUE(kept.is_proved) << kept.reason();
  // The path with a radius of 4, as lines without compensation, with the same radius.
  const auto resolved = convert({"tnc155", kPocket}, "itnc");
  ASSERT_TRUE(resolved.is_proved) << resolved.reason();
  interpreter::MemorySource first(kPocket), second(resolved.text);
  const interpreter::Setup setup;
  const auto result = prove({**interpreter::find_dialect("tnc155"), setup, first, kPocket},
                            *kept.written, second, {});
  ASSERT_TRUE(result) << result.error().what;
  EXPECT_FALSE(result->is_same);
  ASSERT_FALSE(result->places.empty());
  EXPECT_NEAR(result->places.front().distance, 1, 1e-6);  // at Y3, and at Y4 with the first radius
}

struct NotKept {
  const char* name;
  const char* control;
  const char* target;
  std::string text;
  std::string setup;
  const char* reason;
};
class NotKeptCompensation : public testing::TestWithParam<NotKept> {};

TEST_P(NotKeptCompensation, IsRefusedWithTheBlock) {
  const auto& param = GetParam();
  const auto converted =
      convert({param.control, param.text, setup_from(param.setup)}, param.target, keeping());
  EXPECT_FALSE(converted.is_proved) << converted.text;
  EXPECT_EQ(converted.reason(), param.reason);
}

const std::string kWithD =
    "G21 G90 G00 X30. Y20.\nG41 D3 G01 X30. Y0 F200.\nX60.\nY40.\nG40 X30. Y20.\nM30\n";

INSTANTIATE_TEST_SUITE_P(
    , NotKeptCompensation,
    testing::Values(
        NotKept{"no_radius", "fanuc", "rs274ngc", kWithD, "[[tool]]\nnumber = 3\n",
                "line 2: compensation cannot be kept: its radius is not one above 0 of a tool of "
                "the setup or of TOOL DEF"},
        NotKept{"no_radius_of_tool", "tnc155", "itnc",
                "0 BEGIN PGM 1 MM\n1 TOOL DEF 3 L+0 R+0\n2 TOOL CALL 3 Z\n"
                "3 L X+0 Y+0 R0 F200\n4 L X+5 RL\n5 L X+9 R0 M30\n6 END PGM 1 MM\n",
                "",
                "line 5: compensation cannot be kept: the radius of tool 3 is 0 mm: there is "
                "nothing to compare"},
        NotKept{"radius_of_program", "fanuc", "rs274ngc", "G10 P3 R4.\n" + kWithD, kOneTool,
                "line 3: compensation cannot be kept: its radius is not one above 0 of a tool of "
                "the setup or of TOOL DEF"},
        NotKept{"diameters", "fanuc", "rs274ngc", kWithD,
                kOneTool + "[control]\ndiameter_offset = true\n",
                "compensation cannot be kept with diameter_offset: radii are compared"},
        NotKept{"tape", "fanuc", "tektronix-1704", kWithD, kOneTool,
                "tektronix-1704 has no cutter compensation that programs are written with"},
        NotKept{"two_axes", "fanuc", "prototrak-plus", kWithD, kOneTool,
                "prototrak-plus has no cutter compensation that programs are written with"},
        NotKept{"lathe", "fanuc-t", "fanuc-t", "G00 X1. Z1.\nM30\n", "",
                "the compensation of a program of fanuc-t cannot be kept"}),
    [](const auto& one) { return std::string(one.param.name); });

TEST(ScaledDefinitions, ChangeTheRadiiOfTools) {
  EXPECT_EQ(scaled_definitions("1 TOOL DEF 3 L+10 R+4\r\n2 TOOL CALL 3 Z\r\n3 RND R4\r\n", 0.75),
            "1 TOOL DEF 3 L+10 R+3\r\n2 TOOL CALL 3 Z\r\n3 RND R4\r\n");
  EXPECT_EQ(scaled_definitions("TOOL DEF 3 L+10 R2,5", 0.75), "TOOL DEF 3 L+10 R1,875");
  EXPECT_EQ(scaled_definitions("N10 G99 T1 L+0 R+5*", 0), "N10 G99 T1 L+0 R+0*");
  EXPECT_EQ(scaled_definitions("TOOL DEF 3 L+10 RQ5\n", 0.75), "TOOL DEF 3 L+10 RQ5\n");
  EXPECT_EQ(scaled_definitions("", 0.75), "");
}

}  // namespace
}  // namespace dripline::post
