#include "gateway/interpreter/core/language/line_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/core/program_source.hpp"
#include "tests/unit/gateway/interpreter/core/chunked_source.hpp"

namespace dripline::interpreter {
namespace {

using testing::ElementsAre;

struct ReadLine {
  std::string text;
  std::uint64_t offset;
  std::uint64_t line;
  bool operator==(const ReadLine&) const = default;
};

std::vector<ReadLine> read_all(LineReader& reader) {
  std::vector<ReadLine> lines;
  SourceLine line;
  for (int waits = 0; waits < 100'000;) {
    const LineState state = reader.next(line);
    if (state == LineState::NotYet) {
      ++waits;
      continue;
    }
    if (state != LineState::Ready) {
      EXPECT_EQ(state, LineState::End);
      return lines;
    }
    lines.push_back({std::string(line.text), line.place.offset, line.place.line});
  }
  ADD_FAILURE() << "the reader never came to an end";
  return lines;
}

std::vector<std::string> texts_of(std::string_view text, LineRules rules = {}) {
  MemorySource source(text);
  LineReader reader(source, rules);
  std::vector<std::string> texts;
  for (auto& line : read_all(reader)) texts.push_back(std::move(line.text));
  return texts;
}

LineState first_state(std::string_view text, std::size_t max_bytes) {
  MemorySource source(text);
  LineReader reader(source, {max_bytes, true});
  SourceLine line;
  return reader.next(line);
}

TEST(LineReader, CutsAtEveryKindOfLineEnd) {
  EXPECT_THAT(texts_of("G0\nX1\r\nZ2\rM30"), ElementsAre("G0", "X1", "Z2", "M30"));
  EXPECT_THAT(texts_of("G0\n\r\n\rM30\r"), ElementsAre("G0", "", "", "M30"));
  EXPECT_THAT(texts_of("\n"), ElementsAre(""));
  EXPECT_THAT(texts_of(""), ElementsAre());
}

TEST(LineReader, PercentLinesAreCountedButNotDelivered) {
  MemorySource source("%\nG0\n % \n%%\nM30 %\n%");
  LineReader reader(source);
  EXPECT_THAT(read_all(reader),
              ElementsAre(ReadLine{"G0", 2, 2}, ReadLine{" % ", 5, 3}, ReadLine{"M30 %", 12, 5}));
  EXPECT_THAT(texts_of("%\nG0\n", {4096, false}), ElementsAre("%", "G0"));
}

TEST(LineReader, EveryChunkingGivesTheSameLinesAndPlaces) {
  const std::string text =
      "%\r\nO0100 (FIRST)\nN10 G0 X1.5\r\n\r\nN20 G1 Z-2.25 F8\rN30 (A LONGER LINE OF TEXT)\n\n"
      "\r\r\nN40 M30\n%\r";
  MemorySource whole(text);
  LineReader reference(whole, {32, true});
  const auto expected = read_all(reference);
  ASSERT_EQ(expected.size(), 9U);
  for (std::size_t chunk = 1; chunk <= text.size(); ++chunk) {
    for (const int delays : {0, 1, 3}) {
      ChunkedSource source(text, chunk, delays);
      LineReader reader(source, {32, true});
      EXPECT_EQ(read_all(reader), expected) << "chunk " << chunk << ", delays " << delays;
    }
  }
}

TEST(LineReader, LineLengthIsBoundedWhateverTheChunking) {
  EXPECT_EQ(first_state("12345678", 8), LineState::Ready);
  EXPECT_EQ(first_state("12345678\r\n", 8), LineState::Ready);
  EXPECT_EQ(first_state("123456789", 8), LineState::TooLong);
  EXPECT_EQ(first_state("123456789\n", 8), LineState::TooLong);
  EXPECT_EQ(first_state(std::string(1 << 20, 'X'), 4096), LineState::TooLong);
  for (std::size_t chunk = 1; chunk < 40; ++chunk) {
    ChunkedSource source("G0\n" + std::string(100, 'X') + "\nM30", chunk);
    LineReader reader(source, {16, true});
    SourceLine line;
    ASSERT_EQ(reader.next(line), LineState::Ready);
    EXPECT_EQ(reader.next(line), LineState::TooLong);
    EXPECT_EQ(reader.place(), (TextPlace{0, 3, 2})) << "the place stays before the line";
    EXPECT_EQ(reader.next(line), LineState::TooLong);
  }
}

TEST(LineReader, NotYetKeepsThePlace) {
  ChunkedSource source("G0\nM30\n", 3, 1);
  LineReader reader(source);
  SourceLine line;
  EXPECT_EQ(reader.next(line), LineState::NotYet);
  EXPECT_EQ(reader.place(), TextPlace{});
  ASSERT_EQ(reader.next(line), LineState::Ready);
  EXPECT_EQ(line.text, "G0");
}

TEST(LineReader, SeekGoesBackAndForth) {
  const std::string text = "A\nBB\nCCC\nDDDD\n";
  for (std::size_t chunk = 1; chunk <= text.size() + 1; ++chunk) {
    ChunkedSource source(text, chunk);
    LineReader reader(source);
    SourceLine line;
    ASSERT_EQ(reader.next(line), LineState::Ready);
    const TextPlace second = reader.place();
    ASSERT_EQ(reader.next(line), LineState::Ready);
    ASSERT_EQ(reader.next(line), LineState::Ready);
    const TextPlace fourth = reader.place();
    reader.seek(second);
    ASSERT_EQ(reader.next(line), LineState::Ready);
    EXPECT_EQ(line.text, "BB");
    EXPECT_EQ(line.place, second);
    reader.seek(fourth);
    ASSERT_EQ(reader.next(line), LineState::Ready);
    EXPECT_EQ(line.text, "DDDD");
    EXPECT_EQ(reader.next(line), LineState::End);
  }
}

TEST(LineReader, SeekWithinTheWindowAsksTheSourceNothing) {
  ChunkedSource source("A\nB\nC\n", 100);
  LineReader reader(source);
  SourceLine line;
  for (int pass = 0; pass < 1000; ++pass) {
    reader.seek(TextPlace{});
    for (int i = 0; i < 3; ++i) ASSERT_EQ(reader.next(line), LineState::Ready);
  }
  EXPECT_EQ(source.fetches, 1);
}

TEST(LineReader, FailedHasAReason) {
  MemorySource source("M30");
  LineReader reader(source);
  reader.seek({7, 0, 1});
  SourceLine line;
  EXPECT_EQ(reader.next(line), LineState::Failed);
  EXPECT_THAT(reader.reason(), testing::HasSubstr("program 7"));
}

TEST(LineReader, CalledProgramsAreReadFromTheSameSource) {
  MemorySource source("M98 P2\nM30", [](std::string_view name) -> std::optional<std::string> {
    if (name != "O0002") return std::nullopt;
    return "X1\nM99\n";
  });
  LineReader reader(source);
  SourceLine line;
  ASSERT_EQ(reader.next(line), LineState::Ready);
  const TextPlace back = reader.place();
  const ProgramLookup called = reader.find("O0002");
  ASSERT_EQ(called.state, ProgramLookup::State::Found);
  reader.seek({called.program, 0, 1});
  ASSERT_EQ(reader.next(line), LineState::Ready);
  EXPECT_EQ(line.text, "X1");
  reader.seek(back);
  ASSERT_EQ(reader.next(line), LineState::Ready);
  EXPECT_EQ(line.text, "M30");
}

}  // namespace
}  // namespace dripline::interpreter
