#include "gateway/interpreter/tnc155/memory_files.hpp"

#include <gtest/gtest.h>

// Rows: HD-067 (tool store), HD-068 (special tools), HD-234 (both files on the line).
namespace dripline::interpreter::tnc155 {
namespace {

ToolRecord tool(int number, double length, double radius) {
  ToolRecord record;
  record.number = number;
  record.length.set(Axis::Z, Length::mm(length));
  record.radius = Length::mm(radius);
  return record;
}

TEST(ToolStore, IsWrittenALineATool) {
  std::vector<ToolRecord> tools{tool(3, 81.25, 5), tool(4, -2.5, 10), tool(99, 0, 0)};
  tools[0].pocket = 12;
  tools[1].pocket = 20;
  tools[1].is_special = true;
  EXPECT_EQ(*write_tool_store(tools, Units::Millimetre),
            "0 BEGIN PGM 0 MM\r\n"
            "T3 P12 L+81,250 R+5,000\r\n"
            "T4 SP20 L-2,500 R+10,000\r\n"
            "T99 P L+0,000 R+0,000\r\n"
            "4 END PGM 0 MM\r\n");
}

TEST(ToolStore, ComesBackAsItWas) {
  std::vector<ToolRecord> tools{tool(1, 25.4, 12.7), tool(17, 100.0014, 3.175)};
  tools[0].pocket = 7;
  for (const Units units : {Units::Millimetre, Units::Inch}) {
    const std::string text = *write_tool_store(tools, units);
    const auto read = read_tool_store(text);
    ASSERT_TRUE(read) << read.error().what;
    ASSERT_EQ(read->size(), 2u);
    EXPECT_EQ(read->at(0).pocket, 7);
    EXPECT_FALSE(read->at(1).pocket);
    EXPECT_NEAR(read->at(0).length.linear(Axis::Z).mm(), 25.4, 1e-9);
    EXPECT_NEAR(read->at(1).radius.mm(), 3.175, 1e-9);
    EXPECT_EQ(*write_tool_store(*read, units), text);
  }
}

TEST(ToolStore, TakesPointsAndBlanks) {
  const auto read = read_tool_store("BEGIN PGM 0 INCH\nT 9 P 12 L +1.5000 R +0.2500\n\n");
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_NEAR(read->at(0).radius.mm(), 6.35, 1e-9);
}

TEST(ToolStore, HasTheDecimalSignThatTheControlIsSetTo) {
  EXPECT_EQ(*write_tool_store({tool(7, 1.5, 0.25)}, Units::Millimetre, '.'),
            "0 BEGIN PGM 0 MM\r\nT7 P L+1.500 R+0.250\r\n2 END PGM 0 MM\r\n");
}

TEST(ToolStore, NamesWhatIsWrong) {
  EXPECT_EQ(read_tool_store("T0 P L+1 R+1").error().code, Errc::LimitExceeded);
  EXPECT_EQ(read_tool_store("T100 P L+1 R+1").error().code, Errc::LimitExceeded);
  const auto twice = read_tool_store("T5 P L+1 R+1\nT5 P L+2 R+1\n");
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().what, "line 2: tool 5 is there twice");
  EXPECT_FALSE(read_tool_store("T5 P L+1\n"));
  EXPECT_FALSE(read_tool_store("T5 P L+1 R+1 X\n"));
  EXPECT_EQ(write_tool_store({tool(100, 0, 0)}, Units::Millimetre).error().code,
            Errc::LimitExceeded);
}

TEST(MachineParameters, AreALineEach) {
  const MachineParameters parameters{{0, 0}, {7, 1.5}, {226, 1819}, {236, -3}};
  const std::string text = write_machine_parameters(parameters);
  EXPECT_EQ(text, "MP0: 0\r\nMP7: 1.5\r\nMP226: 1819\r\nMP236: -3\r\n");
  EXPECT_EQ(*read_machine_parameters(text), parameters);
  EXPECT_EQ(read_machine_parameters("MP237: 0").error().code, Errc::LimitExceeded);
  EXPECT_EQ(read_machine_parameters("MP1: 0\nMP1: 0").error().what, "line 2: MP1 is there twice");
  EXPECT_FALSE(read_machine_parameters("MP1 0"));
  EXPECT_FALSE(read_machine_parameters("MP1: x"));
}

}  // namespace
}  // namespace dripline::interpreter::tnc155
