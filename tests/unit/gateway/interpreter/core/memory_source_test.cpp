#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"
#include "tests/support/event_log.hpp"

namespace dripline::interpreter {

// An editor's byte order mark in front of a program is leader, whatever the control.

namespace {

struct Marked {
  const char* name;
  const char* control;
  const char* program;
};
class ByteOrderMark : public testing::TestWithParam<Marked> {};

/// Kinds of events, and what has no place in the text.
std::vector<std::string> what_happens(const char* control, const std::string& program) {
  MemorySource source(program);
  EventLog log;
  auto interpreter = (*find_dialect(control))->make(Setup{}, source, log);
  while ((*interpreter)->step(1) == StepState::Ran) {
  }
  std::vector<std::string> events;
  for (const std::string& line : log.lines()) {
    const auto kind = line.find(' ');
    const auto members = std::min(line.find(' ', kind + 1), line.size());
    events.push_back(line.substr(0, kind) + line.substr(members));
  }
  return events;
}

TEST_P(ByteOrderMark, ChangesNothing) {
  const std::string program = GetParam().program;
  const auto without = what_happens(GetParam().control, program);
  EXPECT_EQ(what_happens(GetParam().control, "\xEF\xBB\xBF" + program), without);
  ASSERT_FALSE(without.empty());
  EXPECT_FALSE(without.back().starts_with("alarm")) << without.back();
}

INSTANTIATE_TEST_SUITE_P(
    , ByteOrderMark,
    testing::Values(
        Marked{"fanuc", "fanuc", "%\nO0001\nG0X1.\nX2.\nM30\n%\n"},
        Marked{"fanuc_without_percent", "fanuc", "O0001(A)\nG0X1.\nX2.\nM30\n"},
        Marked{"rs274ngc", "rs274ngc", "%\nG0 X1\nX2\n%\n"},
        Marked{"centurion", "centurion", "O0001\nG0 X1\nX2\nM2\n"},
        Marked{"tektronix", "tektronix-1704", "%\nF2000G01X100\nX200\nM30\n"},
        Marked{"prototrak", "prototrak-plus", "%:A;\nG100 X1. ;\nG100 X2. ;\n%\n"},
        Marked{"tnc155", "tnc155",
               "0 BEGIN PGM 1 MM\n1 TOOL DEF 1 L+0 R+1\n2 TOOL CALL 1 Z S100\n3 L X+1 Y+0 R0 "
               "F100\n4 L X+2\n5 END PGM 1 MM\n"}),
    [](const auto& row) { return std::string{row.param.name}; });

TEST(MemorySource, GivesTheTextFromAnyOffset) {
  MemorySource source("G0 X1\nM30");
  const TextWindow window = source.fetch(kMainProgram, 6, 1);
  EXPECT_EQ(window.state, TextWindow::State::Ready);
  EXPECT_EQ(window.text, "M30");
  EXPECT_TRUE(window.reaches_end);
}

TEST(MemorySource, TheEndAndBeyondAreEmptyWindows) {
  MemorySource source("M30");
  for (const std::uint64_t offset : {3ULL, 4ULL, ~0ULL}) {
    const TextWindow window = source.fetch(kMainProgram, offset, 1);
    EXPECT_EQ(window.state, TextWindow::State::Ready);
    EXPECT_TRUE(window.text.empty());
    EXPECT_TRUE(window.reaches_end);
  }
}

TEST(MemorySource, ACalledProgramIsLoadedOnceAndStays) {
  int loads = 0;
  MemorySource source("M30", [&](std::string_view name) -> std::optional<std::string> {
    ++loads;
    if (name == "missing") return std::nullopt;
    return "text of " + std::string(name);
  });
  const ProgramLookup first = source.find("O0001");
  const ProgramLookup second = source.find("O0002");
  ASSERT_EQ(first.state, ProgramLookup::State::Found);
  EXPECT_EQ(source.find("O0001").program, first.program);
  EXPECT_NE(first.program, second.program);
  EXPECT_EQ(loads, 2);
  EXPECT_EQ(source.fetch(first.program, 8, 1).text, "O0001");
  EXPECT_EQ(source.find("missing").state, ProgramLookup::State::NotFound);
  EXPECT_EQ(source.name_of(second.program), "O0002");
  EXPECT_EQ(source.name_of(kMainProgram), "");
  EXPECT_EQ(source.name_of(second.program + 1), "");
}

TEST(MemorySource, AProgramThatWasNeverOpenedFails) {
  MemorySource source("M30");
  const TextWindow window = source.fetch(3, 0, 1);
  EXPECT_EQ(window.state, TextWindow::State::Failed);
  EXPECT_FALSE(window.reason.empty());
}

TEST(MemorySource, WithoutALoaderNothingIsFound) {
  MemorySource source("M30");
  EXPECT_EQ(source.find("O1").state, ProgramLookup::State::NotFound);
}

}  // namespace

}  // namespace dripline::interpreter
