#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <algorithm>

#include "gateway/interpreter/core/retained_memory.hpp"
#include "tests/unit/gateway/interpreter/dialects/rs274ngc/control_run.hpp"

/// Rows: NGC-050, NGC-086, NGC-090, NGC-091
namespace dripline::interpreter::rs274ngc {
namespace {

using testing::Contains;
using testing::HasSubstr;

constexpr std::string_view kLater =
    "[control]\nprofile = \"linuxcnc\"\n[[tool]]\nnumber = 1\nradius = 2.0\n";

TEST(Rs274State, APinIsAskedForInTheMiddleOfALine) {
  ControlRun run("G21 S100 M66 P4 G0 X7 M3\nG0 Y#5399\nM2\n", kLater);
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  ASSERT_TRUE(std::holds_alternative<InputQuestion>(run.interpreter().question()));
  EXPECT_EQ(std::get<InputQuestion>(run.interpreter().question()).pin, 4);
  EXPECT_FALSE(run.interpreter().answer(ProbeResult{}));
  ASSERT_TRUE(run.interpreter().answer(true));
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_THAT(run.log().lines(), Contains(HasSubstr("rapid 2:")).Times(1));
  EXPECT_THAT(run.log().lines(), Contains(HasSubstr(" X7 Y1")).Times(1));
}

TEST(Rs274State, AnAnalogInputIsAPinOfHal) {
  const std::string text = "G21 G0 X7\nM66 E1\nG0 X#5399\nM2\n";
  for (const std::optional<double> value : {std::optional(-2.5), std::optional<double>()}) {
    ControlRun run(text, kLater);
    ASSERT_EQ(run.step(), StepState::NeedsAnswer);
    EXPECT_EQ(std::get<SignalQuestion>(run.interpreter().question()).name, "motion.analog-in-01");
    ASSERT_TRUE(run.interpreter().answer(SignalValue{value, "this machine has no signals"}));
    EXPECT_EQ(run.step(), StepState::Ended);
    EXPECT_THAT(run.log().lines(), Contains(HasSubstr(value ? " X-2.5" : " X0")));
  }
  ControlRun listed(text,
                    "[control]\nprofile = \"linuxcnc\"\nhal = {\"motion.analog-in-01\" = 3}\n");
  EXPECT_EQ(listed.step(), StepState::Ended);
  EXPECT_THAT(listed.log().lines(), Contains(HasSubstr(" X3")));
}

TEST(Rs274State, AWaitForAPinThatIsOverLeavesMinusOne) {
  for (const auto& [fulfilled, result] : {std::pair{true, " X0"}, {false, " X-1"}}) {
    ControlRun run("#5399 = 7\nM66 P2 L4 Q1.5\nG21 G0 X5\nX#5399\nM2\n", kLater);
    ASSERT_EQ(run.step(), StepState::NeedsAnswer);
    const auto asked = std::get<InputQuestion>(run.interpreter().question());
    EXPECT_EQ(asked.pin, 2);
    EXPECT_EQ(asked.wait, InputWait::Low);
    EXPECT_EQ(asked.seconds, 1.5);
    ASSERT_TRUE(run.interpreter().answer(fulfilled));
    EXPECT_EQ(run.step(), StepState::Ended);
    EXPECT_THAT(run.log().lines(), Contains(HasSubstr(result)));
  }
}

// A line is read again with each answer, and everything of it happens once.
TEST(Rs274State, HalPinsAreAskedForWhileALineIsRead) {
  ControlRun run(
      "#1 = 5\no1 while [#<_hal[part.count]> LT 2]\n#1 = [#1 + #<_hal[a]> + #<_hal[b]>] G0 X#1\n"
      "o1 endwhile\no2 call [#<_hal[a]>]\nM2\no2 sub\nG0 Y#1\no2 endsub\n",
      "[control]\nprofile = \"linuxcnc\"\n");
  int counted = 0;
  std::vector<std::string> asked;
  StepState state = run.step();
  for (; state == StepState::NeedsAnswer; state = run.step()) {
    asked.push_back(std::get<SignalQuestion>(run.interpreter().question()).name);
    double value = asked.back() == "a" ? 10 : 20;
    if (asked.back() == "part.count") value = counted++;
    EXPECT_FALSE(run.interpreter().answer(true)) << "another kind of answer";
    ASSERT_TRUE(run.interpreter().answer(SignalValue{value, ""}));
  }
  EXPECT_EQ(state, StepState::Ended) << testing::PrintToString(run.log().lines());
  EXPECT_THAT(asked, testing::ElementsAre("part.count", "a", "b", "part.count", "a", "b",
                                          "part.count", "a"));
  EXPECT_THAT(run.log().lines(), Contains(HasSubstr(" X35")));
  EXPECT_THAT(run.log().lines(), Contains(HasSubstr(" Y10")));
}

TEST(Rs274State, AHalPinWithoutAValueIsAnAlarmWithItsReason) {
  ControlRun run("G0 X#<_hal[a.b]>\nM2\n", "[control]\nprofile = \"linuxcnc\"\n");
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  ASSERT_TRUE(run.interpreter().answer(SignalValue{std::nullopt, "not connected"}));
  EXPECT_EQ(run.step(), StepState::Alarmed);
  EXPECT_THAT(run.log().lines(), Contains(HasSubstr("HAL pin cannot be read: a.b: not connected")));
}

TEST(Rs274State, AProbeAnswerMovesTheTool) {
  ControlRun run("G21 F50 G0 Z9\nG38.2 Z-9\nG0 X#5063\nM2\n");
  ASSERT_EQ(run.step(), StepState::NeedsAnswer);
  ProbeResult result{true, {}};
  result.at.set(Axis::Z, Length::mm(-2));
  ASSERT_TRUE(run.interpreter().answer(result));
  EXPECT_EQ(run.step(), StepState::Ended);
  EXPECT_THAT(run.log().lines(), Contains(HasSubstr(" X-2 Z-2")));
}

TEST(Rs274State, AProbeThatWasInContactBeforeItsMoveIsAnAlarmOfG382) {
  for (const char* code : {"G38.2", "G38.3"}) {
    ControlRun run(fmt::format("G21 F50 G0 Z9\n{} Z-9\nG0 X#5070\nM2\n", code), kLater);
    ASSERT_EQ(run.step(), StepState::NeedsAnswer);
    ProbeResult result{true, {}};
    result.at.set(Axis::Z, Length::mm(9));
    ASSERT_TRUE(run.interpreter().answer(result));
    const bool must_move = std::string_view(code) == "G38.2";
    EXPECT_EQ(run.step(), must_move ? StepState::Alarmed : StepState::Ended);
    EXPECT_THAT(run.log().lines(), Contains(HasSubstr(must_move ? "NGC0245" : "X1")));
  }
}

/// Where `G0 X1` goes in a program that begins with what the first one has left in the memory.
std::string next_move(const std::string& text, const std::string& setup) {
  ControlRun first(text, setup);
  EXPECT_EQ(first.step(), StepState::Ended) << text;
  auto& memory = dynamic_cast<RetainedMemory&>(first.interpreter());
  std::vector<double> values;
  memory.read_memory(values);
  std::string next = setup;
  const auto cells = memory.memory_cells();
  for (std::size_t i = 0; i < cells.size(); ++i)
    next += fmt::format("[[variable]]\nname = \"{}\"\nvalue = {:.6f}\n", cells[i].name, values[i]);
  ControlRun second("G21 G0 X1\nM2\n", next);
  EXPECT_EQ(second.step(), StepState::Ended) << text;
  const auto& lines = second.log().lines();
  const auto move = std::ranges::find_if(
      lines, [](const std::string& line) { return line.find("rapid") != std::string::npos; });
  return move == lines.end() ? "no move" : move->substr(move->find(" X") + 1, 2);
}

// G92.2 leaves the values for G92.3, and they must not come into force with the next program.
TEST(Rs274State, AnAxisOffsetOutOfForceStaysSoInTheNextProgram) {
  const std::string later(kLater), nist, with_record = "[[offset]]\nname = \"G92\"\nX = 7.0\n";
  EXPECT_EQ(next_move("G21 G0 X4\nG92 X1\nM2\n", later), "X4") << "LinuxCNC's M2 leaves it";
  EXPECT_EQ(next_move("G21 G0 X4\nG92 X1\nG92.2\nM2\n", later), "X1");
  EXPECT_EQ(next_move("G21 G0 X4\nG92 X1\nG92.2\nG92.3\nM2\n", later), "X4");
  EXPECT_EQ(next_move("G21 G0 X4\nG92 X1\nM2\n", nist), "X1") << "M2 is like G92.2";
  EXPECT_EQ(next_move("G21 G0 X4\nM2\n", later + with_record), "X8");
  EXPECT_EQ(next_move("G92.2\nG21 G0 X4\nM2\n", later + with_record), "X1");
}

// LinuxCNC's M2 leaves them for MDI.
TEST(Rs274State, AbsoluteCentersStayAfterTheEnd) {
  ControlRun program("G21 G90.1 G0 X2\nM2\n", kLater);
  ASSERT_EQ(program.step(), StepState::Ended);
  ASSERT_TRUE(program.interpreter().begin_next_text());
  ControlRun next("F100 G2 X0 I1 J0\nM2\n", kLater);
  ASSERT_TRUE(next.interpreter().restore(program.interpreter().snapshot()));
  EXPECT_EQ(next.step(), StepState::Ended) << testing::PrintToString(next.log().lines());
}

TEST(Rs274State, MovesThatWaitSurviveASnapshot) {
  const std::string program =
      "G21 F100 G0 X0 Y0\nG41 D1 G1 X10\nM8\nG4 P1\n(DEBUG,waits)\nY20\nG40\nG0 X0\nM2\n";
  ControlRun whole(program, kLater);
  ASSERT_EQ(whole.step(), StepState::Ended);
  ControlRun first(program, kLater);
  ASSERT_EQ(first.step(5), StepState::Ran);
  ControlRun second(program, kLater);
  ASSERT_TRUE(second.interpreter().restore(first.interpreter().snapshot()));
  EXPECT_EQ(second.step(), StepState::Ended);
  std::vector<std::string> both = first.log().lines();
  both.insert(both.end(), second.log().lines().begin(), second.log().lines().end());
  EXPECT_EQ(both, whole.log().lines());
}

TEST(Rs274State, ADamagedSnapshotChangesNothing) {
  ControlRun run("#7=3 #8=4\nG0 X#7\nG0 X#8\nM2\n");
  ASSERT_EQ(run.step(2), StepState::Ran);
  const Snapshot good = run.interpreter().snapshot();
  for (std::size_t size = 0; size < good.bytes.size(); size += 13) {
    Snapshot cut = good;
    cut.bytes.resize(size);
    EXPECT_FALSE(run.interpreter().restore(cut)) << size;
  }
  EXPECT_EQ(run.interpreter().snapshot().digest(), good.digest());
  EXPECT_EQ(run.step(), StepState::Ended);
}

TEST(Rs274Detection, FilesOfThisKindAreKnown) {
  const auto by_name = detect_dialect("G20\nG0 X1\n", "part.ngc");
  ASSERT_FALSE(by_name.empty());
  EXPECT_EQ(by_name.front()->name, "rs274ngc");
  const auto by_words = detect_dialect("G20\no1 while [#1 lt 2]\no1 endwhile\n", "part");
  ASSERT_FALSE(by_words.empty());
  EXPECT_EQ(by_words.front()->name, "rs274ngc");
}

}  // namespace
}  // namespace dripline::interpreter::rs274ngc
