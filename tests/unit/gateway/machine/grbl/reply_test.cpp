#include "gateway/machine/grbl/reply.hpp"

#include <gtest/gtest.h>

#include "gateway/machine/grbl/codes.hpp"

namespace dripline::machine::grbl {
namespace {

template <class Kind>
Kind parsed(std::string_view line) {
  const Reply reply = parse_reply(line);
  EXPECT_TRUE(std::holds_alternative<Kind>(reply)) << line;
  const Kind* found = std::get_if<Kind>(&reply);
  return found ? *found : Kind{};
}

TEST(BoardReply, ReadsAStatusReportWithAllItsMembers) {
  const auto report = parsed<StatusReport>(
      "<Hold:1|MPos:1.250,-2.000,3.500|Bf:14,120|Ln:77|FS:500,8000|Pn:XD|WCO:0.000,0.000,1.000|"
      "Ov:110,50,90|A:SF>");
  EXPECT_EQ(report.state, BoardState::Hold);
  EXPECT_EQ(report.substate, 1);
  ASSERT_TRUE(report.machine_position);
  EXPECT_EQ(report.machine_position->count, 3U);
  EXPECT_EQ(report.machine_position->value[1], -2);
  EXPECT_EQ(report.buffers->free_blocks, 14);
  EXPECT_EQ(report.buffers->free_bytes, 120);
  EXPECT_EQ(report.line, 77U);
  EXPECT_EQ(report.feed, 500);
  EXPECT_EQ(report.spindle, 8000);
  EXPECT_EQ(report.pins, "XD");
  EXPECT_EQ(report.work_offset->value[2], 1);
  EXPECT_EQ(*report.overrides, (StatusReport::Overrides{110, 50, 90}));
}

TEST(BoardReply, LeavesOutWhatTheReportLeavesOut) {
  const auto report = parsed<StatusReport>("<Idle|WPos:0.000,0.000,0.000,0.000|F:0>");
  EXPECT_EQ(report.state, BoardState::Idle);
  EXPECT_FALSE(report.machine_position || report.buffers || report.line || report.overrides);
  EXPECT_EQ(report.work_position->count, 4U);
  EXPECT_FALSE(report.spindle);
}

TEST(BoardReply, ReadsAnswersAlarmsAndGreetings) {
  parsed<OkReply>("ok");
  EXPECT_EQ(parsed<ErrorReply>("error:20").code, 20);
  EXPECT_EQ(parsed<AlarmReply>("ALARM:3").code, 3);
  EXPECT_FALSE(parsed<Greeting>("Grbl 1.1h ['$' for help]").is_grbl_hal);
  EXPECT_EQ(parsed<Greeting>("Grbl 1.1h ['$' for help]").version, "1.1h");
  EXPECT_TRUE(parsed<Greeting>("GrblHAL 1.1f ['$' or '$HELP' for help]").is_grbl_hal);
}

TEST(BoardReply, ReadsSettingsBuildProbeOffsetsAndModes) {
  EXPECT_EQ(parsed<SettingReply>("$110=500.000").number, 110);
  EXPECT_EQ(parsed<SettingReply>("$110=500.000").value, 500);
  parsed<UnusedReply>("$N0=G54");
  const auto build = parsed<BuildReply>("[OPT:VNML+,100,1024,3,0]");
  EXPECT_EQ(build.letters, "VNML+");
  EXPECT_EQ(build.blocks, 100);
  EXPECT_EQ(build.bytes, 1024);
  EXPECT_EQ(parsed<AxesReply>("[AXS:4:XYZB]").letters, "XYZB");
  EXPECT_TRUE(parsed<ProbeReply>("[PRB:1.000,2.000,-3.250:1]").tripped);
  EXPECT_EQ(parsed<ProbeReply>("[PRB:1.000,2.000,-3.250:1]").at.value[2], -3.25);
  EXPECT_EQ(parsed<OffsetReply>("[G54:4.000,0.000,0.000]").name, "G54");
  EXPECT_EQ(parsed<OffsetReply>("[TLO:0.000]").value.count, 1U);
  EXPECT_EQ(parsed<ModesReply>("[GC:G0 G54 G17 G21 G90 G94 M5 M9 T0 F0 S0]").words.size(), 11U);
  EXPECT_EQ(parsed<NoticeReply>("[MSG:Caution: Unlocked]").text, "Caution: Unlocked");
  parsed<UnusedReply>("[VER:1.1f.20170801:]");
}

class Garbage : public testing::TestWithParam<const char*> {};
TEST_P(Garbage, IsNeverAValue) {
  parsed<GarbageReply>(GetParam());
}
INSTANTIATE_TEST_SUITE_P(, Garbage,
                         testing::Values("<", "<>", "<Rum|MPos:0,0,0>", "<Idle|MPos:a,b>",
                                         "<Idle|MPos:nan,0,0>", "<Idle|MPos:1e300,0,0>",
                                         "<Idle|MPos:>", "<Idle|Bf:15>", "<Idle|Bf:-1,3>",
                                         "<Idle|Ln:-4>", "<Idle|Ov:100,100>", "<Run:x|MPos:0,0>",
                                         "error:", "error:x", "ALARM:-1", "okay", "o",
                                         "[PRB:0,0:2]", "[PRB:1,0]", "[OPT:V,15]", "[AXS:3:XY]",
                                         "[G54:x]"));

TEST(LineSplitter, GivesTheSameLinesForAnyPieces) {
  const std::string text = "ok\r\n<Idle|MPos:0,0,0>\r\n\r\nerror:2\n";
  LineSplitter whole;
  const auto expected = whole.feed(std::as_bytes(std::span(text)));
  EXPECT_EQ(expected.size(), 4U);
  LineSplitter pieces;
  std::vector<std::string> lines;
  for (const char c : text)
    for (std::string& line : pieces.feed(std::as_bytes(std::span(&c, 1)))) lines.push_back(line);
  EXPECT_EQ(lines, expected);
}

TEST(LineSplitter, MakesGarbageOfALineWithoutEnd) {
  LineSplitter splitter;
  const std::string flood = "ok" + std::string(10'000, ' ') + "\n";
  const auto lines = splitter.feed(std::as_bytes(std::span(flood)));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].size(), LineSplitter::kMaxLine);
  EXPECT_TRUE(std::holds_alternative<GarbageReply>(parse_reply(lines[0])));
}

TEST(BoardCodes, HaveATextForEachNumber) {
  for (int code = 1; code <= 9; ++code) EXPECT_GT(alarm_text(code).size(), 20U);
  EXPECT_EQ(error_text(22), "no feed is in force");
  EXPECT_EQ(error_text(999), "an error that only the firmware's manual explains");
}

}  // namespace
}  // namespace dripline::machine::grbl
