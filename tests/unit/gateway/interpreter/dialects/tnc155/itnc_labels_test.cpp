#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/registry.hpp"

/// The dialect itnc: what a label that is set twice does to a run, wherever it is.
namespace dripline::interpreter {
namespace {

using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// X of each move, and the text of an alarm.
class Moves final : public EventSink {
 public:
  std::vector<double> x;
  std::string alarm;
  void on_rapid(const Rapid& event) override { x.push_back(event.to.raw(Axis::X)); }
  void on_line(const Line& event) override { x.push_back(event.to.raw(Axis::X)); }
  void on_alarm(const Alarm& event) override { alarm = event.diagnostic.text; }
};

/// Counts what it was asked for.
class WatchedSource final : public ProgramSource {
 public:
  explicit WatchedSource(std::string_view text) : text_(text) {}
  std::uint64_t farthest = 0;
  TextWindow fetch(ProgramIndex, std::uint64_t offset, std::size_t min_bytes) override {
    const std::string_view text = text_.substr(std::min<std::size_t>(offset, text_.size()),
                                               std::max<std::size_t>(min_bytes, 64));
    farthest = std::max<std::uint64_t>(farthest, offset + text.size());
    return {TextWindow::State::Ready, text, offset + text.size() == text_.size(), {}};
  }
  ProgramLookup find(std::string_view) override { return {ProgramLookup::State::NotFound, 0}; }

 private:
  std::string_view text_;
};

std::unique_ptr<Interpreter> made(ProgramSource& source, EventSink& sink,
                                  std::string_view setup = "") {
  const auto read = parse_setup(setup);
  EXPECT_TRUE(read) << read.error().what;
  auto interpreter = (*find_dialect("itnc"))->make(*read, source, sink);
  EXPECT_TRUE(interpreter) << interpreter.error().what;
  return *std::move(interpreter);
}

void run(Interpreter& interpreter) {
  while (interpreter.step(1000) == StepState::Ran) continue;
}

/// `begin`, then so many moves to X 0, then `end`.
std::string program(std::string_view begin, int moves, std::string_view end) {
  std::string text = fmt::format("BEGIN PGM P MM\nL X+1 R0 F100\n{}", begin);
  for (int i = 0; i < moves; ++i) text += "L X+0\n";
  return text + std::string(end) + "END PGM P MM\n";
}

constexpr int kBeyondTheFirstBlocks = 4000;

TEST(ItncLabels, TwiceInTheFirstBlocksAreRefusedBeforeTheProgramMoves) {
  const std::string text = program("", 100, "LBL 3\nLBL 3\n");
  MemorySource source(text);
  Moves moves;
  run(*made(source, moves));
  EXPECT_THAT(moves.x, IsEmpty());
  EXPECT_THAT(moves.alarm, HasSubstr("LBL 3 is set in line 103 and in line 104"));
}

TEST(ItncLabels, TwiceFarBehindAreRefusedBeforeTheFirstJump) {
  const std::string text = program("CALL LBL \"A\"\nL X+7\nM30\nLBL \"A\"\n", kBeyondTheFirstBlocks,
                                   "LBL 0\nLBL 3\nLBL 3\n");
  MemorySource source(text);
  Moves moves;
  run(*made(source, moves));
  EXPECT_THAT(moves.x, ElementsAre(1.0));
  EXPECT_THAT(moves.alarm, HasSubstr("LBL 3 is set in line 4008 and in line 4009"));
}

TEST(ItncLabels, TwiceFarBehindAreRefusedAtARepeatOfAPartThatJustRan) {
  const std::string text =
      program("LBL 1\nL X+7\nCALL LBL 1 REP 2\n", kBeyondTheFirstBlocks, "LBL 1\n");
  MemorySource source(text);
  Moves moves;
  run(*made(source, moves));
  EXPECT_THAT(moves.x, ElementsAre(1.0, 7.0));
  EXPECT_THAT(moves.alarm, HasSubstr("NUMBER ALREADY ALLOCATED: LBL 1 is set in line 3 and in"));
}

TEST(ItncLabels, TwiceWithoutAJumpAreRefusedWhereTheSecondOneIsMet) {
  const std::string text = program("LBL \"A\"\n", kBeyondTheFirstBlocks, "LBL \"A\"\nL X+7\n");
  MemorySource source(text);
  Moves moves;
  run(*made(source, moves));
  EXPECT_THAT(moves.x, ElementsAre(1.0, 0.0));
  EXPECT_THAT(moves.alarm, HasSubstr("LBL \"A\" is set in line 3 and in line 4004"));
}

TEST(ItncLabels, TwiceAreRefusedAfterAResumptionToo) {
  const std::string text =
      program("L X+2\nCALL LBL 1\nM30\nLBL 1\n", kBeyondTheFirstBlocks, "LBL 0\nLBL 3\nLBL 3\n");
  MemorySource source(text), again(text);
  Moves moves, rest;
  const auto first = made(source, moves);
  ASSERT_EQ(first->step(3), StepState::Ran);
  const auto second = made(again, rest);
  ASSERT_TRUE(second->restore(first->snapshot()));
  run(*second);
  EXPECT_THAT(rest.x, IsEmpty());
  EXPECT_THAT(rest.alarm, HasSubstr("LBL 3 is set in"));
}

TEST(ItncLabels, TwiceRefuseAStartInTheMiddle) {
  const std::string text = "0 BEGIN PGM P MM\n1 L X+1 Y+0 R0 F100\n2 L X+2 Y+1\n3 LBL 4\n4 LBL 4\n";
  MemorySource source(text);
  Moves moves;
  run(*made(source, moves, "[control]\nstart_block = 2\n"));
  EXPECT_THAT(moves.x, IsEmpty());
  EXPECT_THAT(moves.alarm, HasSubstr("LBL 4 is set in block 3 (line 4) and in block 4 (line 5)"));
}

/// A start after a label with a name that a later block leads back to is refused, as with a number.
TEST(ItncLabels, WithNamesAreSeenByAStartInTheMiddle) {
  for (const std::string_view label : {"7", "\"A\""}) {
    const std::string text = fmt::format(
        "0 BEGIN PGM P MM\n1 LBL {0}\n2 L X+2 Y+1 R0 F100\n3 CALL LBL {0} REP 3\n4 END PGM P MM\n",
        label);
    MemorySource source(text);
    Moves moves;
    run(*made(source, moves, "[control]\nstart_block = 2\n"));
    EXPECT_THAT(moves.x, IsEmpty());
    EXPECT_THAT(moves.alarm, HasSubstr("how often block 3 leads back over it")) << label;
  }
}

TEST(ItncLabels, HaveNamesOfABoundedLength) {
  for (const std::size_t size : {64u, 65u}) {
    const std::string text =
        fmt::format("BEGIN PGM P MM\nLBL \"{}\"\nL X+1 R0 F100\n", std::string(size, 'N'));
    MemorySource source(text);
    Moves moves;
    run(*made(source, moves));
    EXPECT_EQ(moves.alarm,
              size == 64 ? "" : "ENTRY VALUE INCORRECT: a label of 65 characters, at most 64");
  }
}

TEST(ItncLabels, OfSubprogramsThatOthersCallDoNotRefuseAStart) {
  for (const std::string_view label : {"700", "\"A\""}) {
    const std::string text = fmt::format(
        "0 BEGIN PGM P MM\n1 CALL LBL {0}\n2 L X+2 Y+1 R0 F100\n3 CALL LBL {0}\n4 M30\n"
        "5 LBL {0}\n6 L IX+10 R0 F100\n7 LBL 0\n8 END PGM P MM\n",
        label);
    MemorySource source(text);
    Moves moves;
    run(*made(source, moves, "[control]\nstart_block = 2\n"));
    EXPECT_THAT(moves.x, ElementsAre(2.0, 12.0)) << label << moves.alarm;
  }
}

TEST(ItncLabels, AProgramWithoutJumpsIsReadOnceAndAheadInItsFirstBlocksOnly) {
  const std::string text = program("", 100'000, "");
  WatchedSource source(text);
  Moves moves;
  const auto interpreter = made(source, moves);
  ASSERT_EQ(interpreter->step(10), StepState::Ran);
  EXPECT_LT(source.farthest, 3'200u * 6);
}

TEST(ItncBlockSkip, RefusesALabelAndTheEndInBothPositionsOfTheSwitch) {
  for (const std::string_view block : {"/ LBL 4", "/3 LBL \"A\"", "3 / END PGM P MM"}) {
    for (const std::string_view setup : {"", "[switches]\nblock_skip = true\n"}) {
      const std::string text = fmt::format("BEGIN PGM P MM\n{}\nL X+2 R0 F100\n", block);
      MemorySource source(text);
      Moves moves;
      run(*made(source, moves, setup));
      EXPECT_THAT(moves.x, IsEmpty()) << block << setup;
      EXPECT_THAT(moves.alarm, AnyOf(HasSubstr("NOT SUPPORTED: /"), HasSubstr("behind a slash")))
          << block << setup;
    }
  }
}

TEST(ItncBlockSkip, FollowsTheSwitchFromTheNextBlockOn) {
  const std::string text = "BEGIN PGM P MM\n/ L X+1 R0 F100\nL X+2 R0 F100\n/ L X+3\nL X+4\n";
  MemorySource source(text);
  Moves moves;
  const auto interpreter = made(source, moves);
  ASSERT_EQ(interpreter->step(2), StepState::Ran);
  ASSERT_TRUE(interpreter->set_block_skip(1u << 1));
  run(*interpreter);
  EXPECT_THAT(moves.x, ElementsAre(1.0, 2.0, 4.0));
}

}  // namespace
}  // namespace dripline::interpreter
