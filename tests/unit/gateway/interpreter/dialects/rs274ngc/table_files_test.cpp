#include "gateway/interpreter/dialects/rs274ngc/memory/table_files.hpp"

#include <gtest/gtest.h>

namespace dripline::interpreter::rs274ngc {
namespace {

constexpr std::string_view kTools =
    "; the shop's\r\n"
    "T1 P3 D+3.175 Z+51.1 ;1/8 end mill\r\n"
    "\n"
    "t10 p10 z-1.5E1 d3.1 I85.0 J95.0 Q7 x0.5 U1.5\n";
constexpr std::string_view kParameters =
    "31\t7.5\n32\t0.0\n5161\t10.0\n5181 0\n5210\t1.0\n5212\t5.5\n5220\t2\n5221\t1.25\n5230\t15\n"
    "5241\t3\n";

Setup setup_of(std::string_view tools, std::string_view parameters, Units units) {
  const auto text = setup_of_table_files(tools, parameters, units);
  EXPECT_TRUE(text) << text.error().what;
  const auto setup = parse_control_data(text.value_or(""));
  EXPECT_TRUE(setup) << setup.error().what;
  return setup.value_or(Setup{});
}

std::string error_of(std::string_view tools, std::string_view parameters = "") {
  const auto text = setup_of_table_files(tools, parameters, Units::Millimeter);
  return text ? "! " + *text : text.error().what;
}

TEST(TableFiles, AreToldByTheirFirstLine) {
  EXPECT_TRUE(is_tool_table(kTools));
  EXPECT_FALSE(is_parameter_file(kTools));
  EXPECT_TRUE(is_parameter_file(kParameters));
  EXPECT_FALSE(is_tool_table(kParameters));
  for (const std::string_view other :
       {"", ";\n", "0 BEGIN PGM 0 MM", "MP0: 1", "T9 P12 L+1,5", "G10\nP500 = 1\nG11"}) {
    EXPECT_FALSE(is_tool_table(other) || is_parameter_file(other)) << other;
  }
}

TEST(TableFiles, AreASetup) {
  const auto setup = setup_of(kTools, kParameters, Units::Inch);
  ASSERT_EQ(setup.tools.size(), 2U);
  EXPECT_EQ(setup.tools[0].pocket, 3);
  EXPECT_DOUBLE_EQ(setup.tools[0].radius.mm(), 3.175 / 2 * 25.4);
  EXPECT_DOUBLE_EQ(setup.tools[0].length.raw(Axis::Z), 51.1 * 25.4);
  EXPECT_EQ(setup.tools[1].tip, 7);
  ASSERT_EQ(setup.offsets.size(), 4U);
  EXPECT_EQ(setup.offsets[0].name, "G28");
  EXPECT_EQ(setup.offsets[1].name, "G92");
  EXPECT_DOUBLE_EQ(setup.offsets[1].value.raw(Axis::Y), 5.5 * 25.4);
  EXPECT_EQ(setup.offsets[2].name, "G54");
  EXPECT_EQ(setup.offsets[3].name, "G55");
}

// What the control would not use is not in force here either.
TEST(TableFiles, LeaveOutG92ThatIsNotInForce) {
  const auto text = setup_of_table_files("", "5210 0\n5211 4\n", Units::Millimeter);
  ASSERT_TRUE(text) << text.error().what;
  EXPECT_EQ(*text,
            "# G92 was not in force: its values are left out.\nunits = \"mm\"\n\n[control]\n"
            "profile = \"linuxcnc\"\n");
}

TEST(TableFiles, AreWrittenAsTheyWereRead) {
  for (const Units units : {Units::Millimeter, Units::Inch}) {
    const auto setup = setup_of(kTools, kParameters, units);
    EXPECT_EQ(write_tool_table(setup).value_or("none"),
              "T1 P3 Z51.1 D3.175\nT10 P10 X0.5 Z-15 U1.5 D3.1 I85 J95 Q7\n");
    const auto file = write_parameter_file(setup);
    ASSERT_TRUE(file) << file.error().what;
    EXPECT_TRUE(file->starts_with("31\t7.500000\n32\t0.000000\n5161\t10.000000\n5162\t0.000000\n"));
    EXPECT_NE(file->find("5210\t1.000000\n5211\t0.000000\n5212\t5.500000\n"), file->npos);
    EXPECT_NE(file->find("5220\t2.000000\n5221\t1.250000\n"), file->npos);
    EXPECT_NE(file->find("5230\t15.000000\n5241\t3.000000\n"), file->npos);
    EXPECT_TRUE(file->ends_with("5390\t0.000000\n"));
    EXPECT_EQ(setup_of_table_files("", *file, units).value_or("none"),
              setup_of_table_files("", kParameters, units).value_or("no"));
  }
}

TEST(TableFiles, SayWhatIsWrongAndWhere) {
  EXPECT_EQ(error_of("T1 P1\nT2 P2 K5"), "tool table, line 2: K5 is no word of a tool");
  EXPECT_EQ(error_of("T1 P1 Z+-5"), "tool table, line 1: Z+-5 is no word of a tool");
  EXPECT_EQ(error_of("T1 P1 Znan"), "tool table, line 1: Znan is no word of a tool");
  EXPECT_EQ(error_of("T1 P1 Z1 Z2"), "tool table, line 1: Z comes twice");
  EXPECT_EQ(error_of("T1 Z1"), "tool table, line 1: a tool needs T and P");
  EXPECT_EQ(error_of("T1.5 P1"), "tool table, line 1: T1.5 is not a number from 0 to 99999");
  EXPECT_EQ(error_of("T1 P1\nT1 P2"), "tool table, line 2: T1 is in line 1 already");
  EXPECT_EQ(error_of("T1 P1 Q10"), "tool table, line 1: Q10 is not from 0 to 9");
  EXPECT_EQ(error_of("", "5221 1\n5221 2\n"), "parameter file, line 2: parameter 5221 comes twice");
  EXPECT_EQ(error_of("", "0 1\n"), "parameter file, line 1: a number from 1 to 5602 and its value");
  EXPECT_EQ(error_of("", "5220 12\n"), "variable #5220: 12 is not a coordinate system, 1 to 9");
}

}  // namespace
}  // namespace dripline::interpreter::rs274ngc
