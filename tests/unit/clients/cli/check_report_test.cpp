#include "clients/cli/offline/check_report.hpp"

#include <gtest/gtest.h>

namespace dripline::cli {
namespace {

using interpreter::Diagnostic;
using interpreter::Origin;

CheckReport lathe_report() {
  CheckReport report;
  report.file = "shaft.nc";
  report.elapsed_seconds = 0.5;
  auto& summary = report.summary;
  summary.control = "centurion";
  summary.program = "O0200";
  summary.units = interpreter::Units::Inch;
  summary.x_is_diameter = true;
  summary.blocks = 100;
  summary.moves = 90;
  summary.rapid_length = Length::inch(2);
  summary.feed_length = Length::inch(10.5);
  summary.seconds = 65;
  summary.extents[0] = interpreter::AxisExtent{12.7, 25.4};
  summary.ended = true;
  return report;
}

TEST(CheckText, SpeaksInTheProgramsUnitsAndDiameters) {
  EXPECT_EQ(check_text(lathe_report(), false),
            "shaft.nc: reaches its end\n"
            "control     centurion\n"
            "program     O0200\n"
            "blocks      100\n"
            "moves       90, 2.000 in rapid, 10.500 in at feed\n"
            "time        1:05 estimated, without acceleration, stops and tool changes\n"
            "X           1.0000 to 2.0000 in diameter\n"
            "warnings    0\n"
            "checked in  0.50 s, 200 blocks/s\n");
}

TEST(CheckText, PlacesWarningsAndTheAlarm) {
  CheckReport report = lathe_report();
  report.summary.ended = false;
  report.summary.warnings = {{{}, Diagnostic{"CEN0001", "odd", 3, 7}}};
  report.summary.warning_count = 5;
  report.summary.alarm = {{}, Diagnostic{"CEN0103", "bad", 9, 0}};
  const std::string text = check_text(report, false);
  EXPECT_TRUE(
      text.starts_with("shaft.nc:3:7: warning CEN0001: odd\n"
                       "shaft.nc: 4 more warnings\n"
                       "shaft.nc:9: alarm CEN0103: bad\n"
                       "shaft.nc: raises an alarm in line 9\n"))
      << text;
}

Origin in_program(interpreter::ProgramIndex program, std::uint64_t line, std::int64_t sequence) {
  return {.block = 1, .offset = 0, .line = line, .sequence = sequence, .program = program};
}

TEST(CheckText, NamesTheFileOfACalledProgram) {
  CheckReport report = lathe_report();
  report.called = {"O2.nc", "lib/O3.nc"};
  report.summary.ended = false;
  report.summary.warnings = {{in_program(1, 3, -1), Diagnostic{"CEN0001", "odd", 3, 7}}};
  report.summary.warning_count = 1;
  report.summary.alarm = {in_program(2, 9, -1), Diagnostic{"CEN0103", "bad", 9, 2}};
  const std::string text = check_text(report, false);
  EXPECT_TRUE(
      text.starts_with("O2.nc:3:7: warning CEN0001: odd\n"
                       "lib/O3.nc:9:2: alarm CEN0103: bad\n"
                       "shaft.nc: raises an alarm in line 9 of lib/O3.nc\n"))
      << text;
  const auto json = check_json(report);
  EXPECT_EQ(json.at("alarm").at("file"), "lib/O3.nc");
  EXPECT_EQ(json.at("warnings").at(0).at("file"), "O2.nc");
}

// HD-197
TEST(CheckText, ListsStopsWithTheirKindAndBlock) {
  using interpreter::StopKind;
  CheckReport report = lathe_report();
  report.called = {"2.h"};
  report.stops = {.places = {{{in_program(0, 5, 4), StopKind::Program}, 1, "4 STOP M"},
                             {{in_program(1, 7, -1), StopKind::ToolChange}, 3, "M6"},
                             {{in_program(0, 8, 7), StopKind::Optional}, 1, "7 M1"},
                             {{in_program(0, 9, 8), StopKind::Operator}, 1, "8 ASK"}},
                  .count = 6};
  const std::string text = check_text(report, false);
  EXPECT_TRUE(
      text.starts_with("shaft.nc:5: stop: program stop, block 4: 4 STOP M\n"
                       "2.h:7: stop: tool change by hand, met 3 times: M6\n"
                       "shaft.nc:8: stop: optional stop, block 7: 7 M1\n"
                       "shaft.nc:9: stop: waits for the operator, block 8: 8 ASK\n"
                       "shaft.nc: reaches its end\n"))
      << text;
  EXPECT_NE(text.find("stops       6\n"), std::string::npos) << text;
  const auto json = check_json(report);
  EXPECT_EQ(json.at("stop_count"), 6);
  EXPECT_EQ(json.at("stops").at(1).dump(),
            R"({"file":"2.h","line":7,"block":null,"kind":"tool_change","text":"M6","times":3})");
  EXPECT_EQ(json.at("stops").at(0).at("block"), 4);
}

TEST(CheckJson, HasTheDocumentedMembers) {
  CheckReport report = lathe_report();
  report.summary.warnings = {{{}, Diagnostic{"CEN0001", "odd", 3, 7}}};
  report.summary.warning_count = 1;
  EXPECT_EQ(
      check_json(report).dump(),
      R"({"file":"shaft.nc","control":"centurion","program":"O0200","ended":true,)"
      R"("programs":0,"blocks":100,"moves":90,"units":"in","x":"diameter","rapid_length":2.0,)"
      R"("feed_length":10.5,"seconds":65.0,"has_acceleration":false,"extents":{"X":{"min":1.0,"max":2.0}},)"
      R"("warnings":[{"code":"CEN0001","text":"odd","line":3,"column":7,"file":"shaft.nc"}],)"
      R"("warning_count":1,"alarm":null,"elapsed_seconds":0.5,"blocks_per_second":200.0})");
}

}  // namespace
}  // namespace dripline::cli
