#include "gateway/interpreter/core/memory_source.hpp"

#include <gtest/gtest.h>

namespace dripline::interpreter {
namespace {

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
