#include "clients/tools/program_editing/text_search.hpp"

#include <gtest/gtest.h>

// CEN-209: find and change of the text editor.

namespace dripline::program_editing {
namespace {

const std::string kProgram = "O0001\r\nG1 X1. F.01\r\ng1 X1.5\r\n\r\nP10=P1+P1\r\n";

std::vector<std::int64_t> lines_with(const TextPattern& pattern) {
  std::vector<std::int64_t> lines;
  const auto found = find_text(kProgram, pattern);
  EXPECT_TRUE(found) << found.error().what;
  for (const auto& line : found.value()) lines.push_back(line.block);
  return lines;
}

std::string changed(const TextPattern& pattern, const std::string& replacement) {
  const auto changes = change_text(kProgram, pattern, replacement);
  if (!changes) return "error: " + changes.error().what;
  return edit_lines(kProgram, *changes).value().text;
}

TEST(TextSearch, FindsTextsByCaseWordAndRange) {
  using Lines = std::vector<std::int64_t>;
  EXPECT_EQ(lines_with({.text = "G1"}), Lines{2});
  EXPECT_EQ(lines_with({.text = "G1", .ignores_case = true}), (Lines{2, 3}));
  EXPECT_EQ(lines_with({.text = "X1."}), (Lines{2, 3}));
  EXPECT_EQ(lines_with({.text = "X1.", .lines = std::pair(3, 5)}), Lines{3});
  EXPECT_EQ(lines_with({.text = "P", .is_whole_word = true}), Lines{});
  EXPECT_EQ(lines_with({.text = "P1", .is_whole_word = true}), Lines{5});
}

TEST(TextSearch, TakesANumberAsOneWord) {
  const auto found = [](const std::string& line, const std::string& text) {
    return !find_text(line, {.text = text, .is_whole_word = true}).value().empty();
  };
  for (const std::string line : {"X1.5", "X1.", "G0 X1. Y2", "X10", "X1.5 X1.25"}) {
    EXPECT_FALSE(found(line, "X1")) << line;
  }
  for (const std::string line : {"X1", "G0 X1 Y2", "X1.5 X1", "(X1)"}) {
    EXPECT_TRUE(found(line, "X1")) << line;
  }
  for (const std::string line : {"Y-1", "Y+1", "-1", "P1=-1", "Y.1", "Y0.1", "1.", "1.5"}) {
    EXPECT_FALSE(found(line, "1")) << line;
  }
  for (const std::string line : {"P2=1", "P2=P3-1", "P2=(P3)+1", "LOOP 1"}) {
    EXPECT_TRUE(found(line, "1")) << line;
  }
  EXPECT_FALSE(found("X1.5", "X1."));
  EXPECT_TRUE(found("X1. Y2", "X1."));
  EXPECT_TRUE(found("G0 Y-1", "Y-1"));
  EXPECT_FALSE(found("F-.01", ".01"));
}

TEST(TextSearch, ChangesEveryOccurrenceAndKeepsLineEnds) {
  EXPECT_EQ(changed({.text = "P1", .is_whole_word = true}, "P11"),
            "O0001\r\nG1 X1. F.01\r\ng1 X1.5\r\n\r\nP10=P11+P11\r\n");
  EXPECT_EQ(changed({.text = "P1"}, "P1P1"),
            "O0001\r\nG1 X1. F.01\r\ng1 X1.5\r\n\r\nP1P10=P1P1+P1P1\r\n");
  EXPECT_EQ(changed({.text = " F.01"}, ""), "O0001\r\nG1 X1.\r\ng1 X1.5\r\n\r\nP10=P1+P1\r\n");
}

TEST(TextSearch, RefusesWhatTheEditorCannotDo) {
  EXPECT_EQ(changed({.text = ""}, "A"), "error: the text to find is empty");
  EXPECT_EQ(changed({.text = "G2"}, "G3"), "error: no line has \"G2\"");
  EXPECT_EQ(changed({.text = "O0001"}, " "), "error: line 1 would be blank: delete it instead");
  EXPECT_EQ(changed({.text = "G1"}, "G1\nG4"),
            "error: the text to put in has several lines: expected a part of one");
  EXPECT_EQ(changed({.text = std::string(68, 'X')}, ""),
            "error: the text to find has 68 characters, more than 67");
  EXPECT_EQ(changed({.text = "G1", .lines = std::pair(2, 6)}, "G0"),
            "error: lines 2..6: the program has lines 1 to 5");
  EXPECT_EQ(changed({.text = "G1", .lines = std::pair(3, 2)}, "G0"),
            "error: lines 3..2: the range runs backwards");
}

}  // namespace
}  // namespace dripline::program_editing
