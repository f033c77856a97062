#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"
#include "tests/support/event_log.hpp"

/// A tape of several programs: where the reader is after each, and what the next start reads. Row
/// TK-59.
namespace dripline::interpreter {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A tape in the reader of a control that its operator starts again and again.
class Reader {
 public:
  explicit Reader(std::string tape, std::int64_t part = 1)
      : tape_(std::move(tape)), source_(tape_) {
    Setup setup;
    setup.control.set("part", {part, 0});
    interpreter_ = *(*find_dialect("tektronix-1704"))->make(setup, source_, log_);
    run();
  }

  StepState run() {
    StepState state = StepState::Ran;
    while (state == StepState::Ran) state = interpreter_->step(100);
    return state;
  }
  Interpreter& control() { return *interpreter_; }
  /// Where the axes went to, and each end.
  std::vector<std::string> path() const {
    std::vector<std::string> lines;
    for (const std::string& line : log_.lines())
      if (line.starts_with("line ") || line.starts_with("end ")) lines.push_back(line);
    return lines;
  }
  std::string log() const { return testing::PrintToString(log_.lines()); }

 private:
  const std::string tape_;
  MemorySource source_;
  EventLog log_;
  std::unique_ptr<Interpreter> interpreter_;
};

struct TapeCase {
  const char* name;
  std::string tape;
  std::int64_t part;   ///< that is read
  std::uint32_t next;  ///< which the next start reads
};

class TapeStop : public testing::TestWithParam<TapeCase> {};

TEST_P(TapeStop, DecidesWhatTheNextStartReads) {
  Reader reader(GetParam().tape, GetParam().part);
  EXPECT_EQ(reader.control().step(1), StepState::Ended) << reader.log();
  EXPECT_EQ(reader.control().next_part(), GetParam().next);
  EXPECT_EQ(reader.control().next_part(), GetParam().next) << "asking changes nothing";
}

const std::string kFirst = "%\nN1F500X10000\nN2M02\n", kSecond = "%\nN1X20000\nN2M02\n";
const std::string kWoundBack = "%\nN1F500X30000\nN2M30\n";

INSTANTIATE_TEST_SUITE_P(
    , TapeStop,
    testing::Values(
        TapeCase{"m02_reads_on", kFirst + kSecond, 1, 2},
        TapeCase{"m02_reads_on_over_a_gap", kFirst + "\n\n" + kSecond, 1, 2},
        TapeCase{"the_last_program_is_followed_by_the_first", kFirst + kFirst, 2, 1},
        TapeCase{"one_program_is_followed_by_itself", kFirst, 1, 1},
        TapeCase{"a_title_at_the_end_is_no_program", kFirst + "(END OF TAPE)\n(X1)\n", 1, 1},
        TapeCase{"a_block_after_m02_is_not_passed_over", kFirst + "N40X30000\n", 1, 2},
        TapeCase{"m30_goes_back_to_its_own_rewind_stop", kFirst + kWoundBack + kSecond, 2, 2},
        TapeCase{"m30_without_one_goes_back_further", kFirst + "\nN1F500X30000\nN2M30\n" + kSecond,
                 2, 1},
        TapeCase{"m30_of_the_first_program", kWoundBack + kSecond, 1, 1},
        TapeCase{"the_stop_code_ends_a_program_too", "%\nN1F500X10000\n" + kSecond, 1, 2}),
    [](const auto& row) { return std::string(row.param.name); });

// Feed, center and position are what the program before has left (U12).
TEST(TapePrograms, AreReadOnOneAfterTheOther) {
  Reader reader(kFirst + kSecond);
  ASSERT_TRUE(reader.control().read_on());
  EXPECT_EQ(reader.run(), StepState::Ended);
  EXPECT_THAT(reader.path(), ElementsAre(HasSubstr("X25.4"), HasSubstr("end"), HasSubstr("X50.8"),
                                         HasSubstr("end")))
      << reader.log();
  EXPECT_EQ(reader.control().blocks(), 4);
}

TEST(TapePrograms, EndWithTheTape) {
  Reader reader(kFirst + "(trailer)\n");
  const auto before = reader.path();
  ASSERT_TRUE(reader.control().read_on());
  EXPECT_EQ(reader.run(), StepState::Ended);
  EXPECT_EQ(reader.path(), before) << "there was nothing more";
  EXPECT_FALSE(reader.control().read_on());
}

TEST(TapePrograms, AreNotReadOnAfterRewinding) {
  Reader reader(kWoundBack + kSecond);
  EXPECT_FALSE(reader.control().read_on());
}

struct LeaderCase {
  const char* name;
  const char* line;  ///< directly after M02
  bool is_block;
};

class TapeLeader : public testing::TestWithParam<LeaderCase> {};

// No block between two programs is lost without an alarm; what is no block may be there.
TEST_P(TapeLeader, HoldsNoBlock) {
  for (const std::int64_t part : {1, 2}) {
    Reader reader(kFirst + GetParam().line + "\n" + kFirst, part);
    const bool is_read_on = part == 1 && reader.control().read_on();
    EXPECT_EQ(is_read_on, part == 1);
    EXPECT_EQ(reader.run(), GetParam().is_block ? StepState::Alarmed : StepState::Ended);
    EXPECT_EQ(reader.log().find("TEK0114") != std::string::npos, GetParam().is_block);
  }
}

INSTANTIATE_TEST_SUITE_P(, TapeLeader,
                         testing::Values(LeaderCase{"axis_word", "N40X30000", true},
                                         LeaderCase{"axis_word_among_others", "G91 Y-5 #", true},
                                         LeaderCase{"axis_word_after_a_comment", "(A) Z+1", true},
                                         LeaderCase{"mode", "G91", true},
                                         LeaderCase{"spindle", "N40 S20 M03", true},
                                         LeaderCase{"blank_tape", "", false},
                                         LeaderCase{"title", "PART NO 17 OF THE SERIES", false},
                                         LeaderCase{"name_with_digits", "MAX2 BY 3", false},
                                         LeaderCase{"comment", "(X3)", false},
                                         LeaderCase{"stop_code", "%", false},
                                         LeaderCase{"title_before_code", "SPARE PART 7 %", false},
                                         LeaderCase{"title_after_code", "% PART NO 17", false},
                                         LeaderCase{"number_after_code", "%100", false},
                                         LeaderCase{"comment_after_code", "%(X3)", false},
                                         LeaderCase{"block_before_code", "N40X3 %", true},
                                         LeaderCase{"block_after_code", "%N40X3F500", true},
                                         LeaderCase{"after_code_and_blank", "% N40X3", true},
                                         LeaderCase{"after_code_and_comment", "%(5)N40X3", true},
                                         LeaderCase{"number_and_title", "%N40 AND MORE", true},
                                         LeaderCase{"mode_after_code", "%G91", true}),
                         [](const auto& row) { return std::string(row.param.name); });

// Words without an end of block before the code, and words that are hunted over after it.
TEST(TapePrograms, LoseNoBlockOnTheLineOfALaterStopCode) {
  const std::string first = "%\nN10F500X10000\n";
  for (const std::string line : {"N20X20000%", "N20X20000 %", "%N20X20000", "% (A) N20X20000"}) {
    Reader reader(first + line + "\nN30Y10000\nN40M02\n");
    EXPECT_EQ(reader.run(), StepState::Alarmed) << line;
    EXPECT_THAT(reader.log(), HasSubstr("TEK0114")) << line;
  }
  for (const std::string line : {"%", "% PART NO 18", "(END) %"}) {
    Reader reader(first + line + "\nN30Y10000\nN40M02\n");
    EXPECT_EQ(reader.run(), StepState::Ended) << line;
    EXPECT_THAT(reader.log(), testing::Not(HasSubstr("TEK0114"))) << line;
  }
}

// What the gateway does at the next start: the modes of the program before, and the tape.
TEST(TapePrograms, BeginWithTheModesOfTheOneBefore) {
  Reader first(kFirst + kSecond);
  EXPECT_EQ(first.control().next_part(), 2U);
  ASSERT_TRUE(first.control().begin_next_text());
  const Snapshot modes = first.control().snapshot();
  const std::string tape = kFirst + kSecond;
  MemorySource source(tape);
  EventLog log;
  interpreter::Setup setup;
  setup.control.set("part", {std::int64_t{2}, 0});
  auto next = *(*find_dialect("tektronix-1704"))->make(setup, source, log);
  ASSERT_TRUE(next->restore(modes));
  EXPECT_EQ(next->step(100), StepState::Ended) << testing::PrintToString(log.lines());
  EXPECT_EQ(next->blocks(), 2);
  EXPECT_THAT(log.lines(), testing::Contains(HasSubstr(" X50.8")));
  EXPECT_THAT(log.lines(), testing::Not(testing::Contains(HasSubstr(" X25.4"))));
}

}  // namespace
}  // namespace dripline::interpreter
