#include <cstdlib>
#include <ctime>

#include <gtest/gtest.h>

#include "clients/cli/text/table.hpp"
#include "clients/cli/text/terminal.hpp"
#include "clients/cli/text/value_text.hpp"

namespace dripline::cli {

namespace {

TEST(Table, AlignsColumnsAndLeavesNoBlanksAtTheEnd) {
  Table table({"NAME", right("SIZE"), "COMMENT"});
  table.add({"O1", "5 B", "first"});
  table.add({"O0200", "12.0 MB", ""});
  EXPECT_EQ(table.render(false),
            "NAME      SIZE  COMMENT\n"
            "O1         5 B  first\n"
            "O0200  12.0 MB  -\n");
}

TEST(Table, ColorsOnlyWhenAsked) {
  Table table({"STATE"});
  table.add({Cell("alarmed", Style::Bad)});
  EXPECT_EQ(visible(table.render(true)), "\x1b[1mSTATE\x1b[0m\n\x1b[31malarmed\x1b[0m\n");
  EXPECT_EQ(table.render(false), "STATE\nalarmed\n");
}

TEST(Table, CountsCharactersNotBytes) {
  Table table({"NAME", "X"});
  table.add({"M\u00fcller", "1"});
  table.add({"Muller", "2"});
  EXPECT_EQ(table.render(false), "NAME    X\nM\u00fcller  1\nMuller  2\n");
}

TEST(Table, LetsNoTextSteerTheTerminal) {
  Table table({"COMMENT"});
  table.add({"a\x1b[2Jb\nc"});
  EXPECT_EQ(table.render(false), "COMMENT\na [2Jb c\n");
}

TEST(Details, AlignsValues) {
  Details details;
  details.add("run", "r1");
  details.add("last line", "");
  EXPECT_EQ(details.render(false), "run        r1\nlast line  -\n");
}

TEST(Terminal, CutsAtCharacters) {
  EXPECT_EQ(cut("M\u00fcller", 6), "M\u00fcller");
  EXPECT_EQ(cut("M\u00fcllers", 4), "M\u00fcl\u2026");
  EXPECT_EQ(cut("abc", 0), "");
  EXPECT_EQ(cut("abc", 1), "\u2026");
}

TEST(BytesText, UsesSiUnits) {
  EXPECT_EQ(bytes_text(0), "0 B");
  EXPECT_EQ(bytes_text(999), "999 B");
  EXPECT_EQ(bytes_text(1000), "1.0 kB");
  EXPECT_EQ(bytes_text(999'960), "1.0 MB");
  EXPECT_EQ(bytes_text(1ull << 30), "1.07 GB");
  EXPECT_EQ(bytes_text(5'000'000'000'000'000), "5000.00 TB");
}

TEST(DurationText, RoundsDown) {
  EXPECT_EQ(duration_text(-1), "0:00");
  EXPECT_EQ(duration_text(7.9), "0:07");
  EXPECT_EQ(duration_text(754), "12:34");
  EXPECT_EQ(duration_text(3723), "1:02:03");
}

TEST(TimeText, ShowsLocalTime) {
  ::setenv("TZ", "CET-1", 1);
  ::tzset();
  EXPECT_EQ(time_text("2026-11-21T07:40:06.123456Z"), "2026-11-21 08:40:06");
  EXPECT_EQ(time_text("yesterday"), "yesterday");
  EXPECT_EQ(time_text(""), "");
}

TEST(ControlValueText, LeavesOutTheNoiseOfConverting) {
  EXPECT_EQ(control_value_text(25.4 * 0.7 / 25.4), "0.7");
  EXPECT_EQ(control_value_text(17.779999999999998), "17.78");
  EXPECT_EQ(control_value_text(-0.00012), "-0.00012");
  EXPECT_EQ(control_value_text(1234567.891), "1234567.891");
  EXPECT_EQ(control_value_text(std::nullopt), "vacant");
}

TEST(SecondsBetween, CountsFractions) {
  EXPECT_DOUBLE_EQ(seconds_between("2026-11-21T07:40:06.5Z", "2026-11-21T07:41:06.75Z"), 60.25);
  EXPECT_EQ(seconds_between("", "2026-11-21T07:41:06Z"), 0);
}

}  // namespace

}  // namespace dripline::cli
