#include <filesystem>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/tools/offline/offline_run.hpp"
#include "gateway/interpreter/dialects/centurion/reading/chart_index.hpp"
#include "gateway/interpreter/dialects/centurion/reading/program_extraction.hpp"
#include "tests/golden/golden_case.hpp"

/// Files of the control that are no program: several programs in one text, and help pages.

namespace dripline::interpreter {

namespace {

class Report final : public EventSink {
 public:
  void on_output(const Output& event) override {
    if (event.device == OutputDevice::File) lines.emplace_back(event.text);
  }
  std::vector<std::string> lines;
};

/// The golden case's profile passes through the points that the control's manual prints for its
/// digitizing program; the report must have its 525 moves with exactly those figures.
TEST(DigitizedProgram, HasTheMovesOfTheManual) {
  const GoldenCase golden = read_golden_case("centurion", "digitize");
  const Dialect& dialect = **find_dialect("centurion");
  const std::string program = golden.program();
  MemorySource source(program);
  Report report;
  ASSERT_TRUE(run_offline(dialect, setup_of(golden, dialect), source, report));
  ASSERT_EQ(report.lines.size(), 10U + 525U + 5U);
  const std::vector<std::string> moves(report.lines.begin() + 10, report.lines.end() - 5);
  EXPECT_EQ(moves[0], "G1 X16.4856Z-0.1214");
  EXPECT_EQ(moves[1], "G1 X16.4656Z-0.0931");
  EXPECT_EQ(moves[4], "G1 X16.4056Z-0.0500");
  EXPECT_EQ(moves[7], "G1 X16.3456Z-0.0246");
  EXPECT_EQ(moves[518], "G1 X6.1256Z-0.3276");
  EXPECT_EQ(moves[524], "G1 X6.0056Z-0.3172");
  EXPECT_EQ(report.lines[535], "G0R.1AB0");
  EXPECT_EQ(report.lines.back(), "X16.4856");
}

}  // namespace

}  // namespace dripline::interpreter

namespace dripline::interpreter::centurion {

namespace {

/// CEN-202.
TEST(Extraction, SplitsAtEachLineThatBeginsWithO) {
  const auto programs =
      extract_programs("%\r\nO12 (FIRST)\r\nG0 X1\r\nO0007\r\n o 15\r\nX[P1]\r\n%\r\n");
  ASSERT_EQ(programs.size(), 3U);
  EXPECT_EQ(programs[0].number, 12U);
  EXPECT_EQ(programs[0].text, "O12 (FIRST)\r\nG0 X1\r\n");
  EXPECT_EQ(programs[1].number, 7U);
  EXPECT_EQ(programs[1].text, "O0007\r\n");
  EXPECT_EQ(programs[2].number, 15U);
  EXPECT_EQ(programs[2].text, " o 15\r\nX[P1]\r\n");
}

TEST(Extraction, KeepsTheBytesOfAProgramWhateverEndsItsLines) {
  for (const std::string end : {"\r", "\n", "\r\n"}) {
    const std::string first = fmt::format("O1{0}{0}X1 (O9 IN A COMMENT){0}", end);
    const std::string second = fmt::format("O2{0}G65 P5 A1{0}", end);
    const std::string both = first + second;
    const auto programs = extract_programs(both);
    ASSERT_EQ(programs.size(), 2U);
    EXPECT_EQ(programs[0].text, first);
    EXPECT_EQ(programs[1].text, second);
  }
}

TEST(Extraction, ReportsBlocksBeforeTheFirstNumber) {
  const auto programs = extract_programs("X1\nO3\nX2\n");
  ASSERT_EQ(programs.size(), 2U);
  EXPECT_EQ(programs[0].number, 0U);
  EXPECT_EQ(programs[0].text, "X1\n");
  EXPECT_TRUE(extract_programs("").empty());
  EXPECT_TRUE(extract_programs("\r\n % \r\n").empty());
  EXPECT_EQ(extract_programs("O5").size(), 1U) << "the last line may have no end";
}

TEST(Extraction, AddsLeadingCommentsToTheFirstProgram) {
  const auto programs = extract_programs("%\n\n(SHIFT 2)\nO3\nX2\n%\nO4\n");
  ASSERT_EQ(programs.size(), 2U);
  EXPECT_EQ(programs[0].number, 3U);
  EXPECT_EQ(programs[0].text, "(SHIFT 2)\nO3\nX2\n");
  EXPECT_EQ(programs[1].text, "O4\n");
}

TEST(Extraction, SplitsLineByLine) {
  ProgramSplitter splitter;
  EXPECT_FALSE(splitter.begins_next("%"));
  EXPECT_FALSE(splitter.begins_next("(A)"));
  EXPECT_FALSE(splitter.begins_next("O1 (FIRST)"));
  EXPECT_EQ(splitter.number(), 1U);
  EXPECT_FALSE(splitter.begins_next("G65 P5 (O9)"));
  EXPECT_TRUE(splitter.begins_next("O1"));
  ProgramSplitter after_blocks;
  EXPECT_FALSE(after_blocks.begins_next("G0 X1"));
  EXPECT_TRUE(after_blocks.begins_next("O2"));
  EXPECT_FALSE(after_blocks.begins_next("O"));
  EXPECT_FALSE(after_blocks.begins_next(std::string(5000, 'O')));
}

/// CEN-230.
TEST(Charts, TheFirstTwelveCharactersNameThePage) {
  const auto lines = parse_chart_index(
      "            SHOP CHARTS\r\nTAPS.DAT    * Tapping\r\n\r\nFITS.DAT\r\n  ODD.DAT   x  \r\n");
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0].file, "");
  EXPECT_EQ(lines[0].text, "SHOP CHARTS");
  EXPECT_EQ(lines[1].file, "TAPS.DAT");
  EXPECT_EQ(lines[1].text, "* Tapping");
  EXPECT_EQ(lines[2].file + lines[2].text, "");
  EXPECT_EQ(lines[3].file, "FITS.DAT");
  EXPECT_EQ(lines[4].file, "ODD.DAT");
  EXPECT_EQ(lines[4].text, "x");
}

TEST(Charts, APageHasSixteenLines) {
  std::string page;
  for (int line = 1; line <= 20; ++line) page += std::to_string(line) + "\n";
  EXPECT_TRUE(first_chart_page(page).ends_with("15\n16\n"));
  EXPECT_EQ(first_chart_page("one\ntwo"), "one\ntwo");
}

}  // namespace

}  // namespace dripline::interpreter::centurion
