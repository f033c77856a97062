#include "clients/cli/check_report.hpp"

#include <gtest/gtest.h>

namespace dripline::cli {
namespace {

using interpreter::Diagnostic;

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
  report.summary.warnings = {Diagnostic{"CEN0001", "odd", 3, 7}};
  report.summary.warning_count = 5;
  report.summary.alarm = Diagnostic{"CEN0103", "bad", 9, 0};
  const std::string text = check_text(report, false);
  EXPECT_TRUE(
      text.starts_with("shaft.nc:3:7: warning CEN0001: odd\n"
                       "shaft.nc: 4 more warnings\n"
                       "shaft.nc:9: alarm CEN0103: bad\n"
                       "shaft.nc: raises an alarm in line 9\n"))
      << text;
}

TEST(CheckJson, HasTheDocumentedMembers) {
  CheckReport report = lathe_report();
  report.summary.warnings = {Diagnostic{"CEN0001", "odd", 3, 7}};
  report.summary.warning_count = 1;
  EXPECT_EQ(check_json(report).dump(),
            R"({"file":"shaft.nc","control":"centurion","program":"O0200","ended":true,)"
            R"("blocks":100,"moves":90,"units":"in","x":"diameter","rapid_length":2.0,)"
            R"("feed_length":10.5,"seconds":65.0,"extents":{"X":{"min":1.0,"max":2.0}},)"
            R"("warnings":[{"code":"CEN0001","text":"odd","line":3,"column":7}],)"
            R"("warning_count":1,"alarm":null,"elapsed_seconds":0.5,"blocks_per_second":200.0})");
}

}  // namespace
}  // namespace dripline::cli
