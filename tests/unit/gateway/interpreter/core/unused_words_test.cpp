#include <gtest/gtest.h>
#include <algorithm>
#include <string>

#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"
#include "tests/support/event_log.hpp"
#include "tests/support/vanished_words.hpp"

/// No word that moves the tool is left out without a word about it, on any control.
namespace dripline::interpreter {
namespace {

EventLog log_of(const char* control, std::string_view program, const Setup& setup = {}) {
  MemorySource source(program);
  EventLog log;
  auto interpreter = (*find_dialect(control))->make(setup, source, log);
  EXPECT_TRUE(interpreter) << interpreter.error().what;
  while ((*interpreter)->step(1000) == StepState::Ran) {
  }
  return log;
}

struct WordCase {
  const char* name;
  const char* control;
  const char* program;
  const char* message;  ///< the begin of its log line, and a part of the line
  const char* part;
};
class UnusedWord : public testing::TestWithParam<WordCase> {};

TEST_P(UnusedWord, IsNamed) {
  const auto& row = GetParam();
  const EventLog log = log_of(row.control, row.program);
  const auto names_it = [&](const std::string& line) {
    return line.starts_with(row.message) && line.find(row.part) != std::string::npos;
  };
  std::string all;
  for (const auto& line : log.lines()) all += line + "\n";
  EXPECT_TRUE(std::any_of(log.lines().begin(), log.lines().end(), names_it)) << all;
}

INSTANTIATE_TEST_SUITE_P(
    , UnusedWord,
    testing::Values(
        WordCase{"fanuc_second_axis_of_a_dwell", "fanuc", "G4X1.Y5.\nM30\n", "alarm", "Y5"},
        WordCase{"fanuc_radius_of_a_line", "fanuc", "G1X5.R3.F100.\nM30\n", "warning", "R3"},
        WordCase{"fanuc_radius_alone", "fanuc", "G2R3.F100.\nM30\n", "warning", "R"},
        WordCase{"fanuc_center_of_a_rapid", "fanuc", "G0X5.I3.\nM30\n", "warning", "I3"},
        WordCase{"fanuc_g53_in_increments", "fanuc", "G91G53X5.\nM30\n", "warning", "G53"},
        WordCase{"prototrak_level", "prototrak-plus", "G101 XE1. Z-1. F10. ;\n%\n", "warning", "Z"},
        WordCase{"prototrak_circle_word", "prototrak-plus", "G100 X1. HL5 ;\n%\n", "warning", "HL"},
        WordCase{"prototrak_begin_of_a_position", "prototrak-plus", "G00 X1. XB2. ;\n%\n", "alarm",
                 "XB"},
        WordCase{"centurion_axis_of_a_dwell", "centurion", "G28 X1 R2\nM2\n", "alarm", "R2"}),
    [](const auto& row) { return std::string{row.param.name}; });

TEST(UnusedWords, RepeatsThatTheControlDoesNotTakeAreAnAlarm) {
  const auto setup = parse_setup("[control]\nrepeat_address = \"L\"\n").value();
  const EventLog log = log_of("fanuc", "G91G81X10.Z-5.R1.K5F100.\nM30\n", setup);
  EXPECT_NE(log.lines().back().find("PS009"), std::string::npos) << log.lines().back();
  EXPECT_NE(log.lines().back().find("K5"), std::string::npos) << log.lines().back();
}

TEST(UnusedWords, AnAxisOfNoCycleIsAnAlarm) {
  const auto setup = parse_setup("[control]\nprofile = \"linuxcnc\"\naxes = \"XYZUVW\"\n").value();
  const EventLog log = log_of("rs274ngc", "G90 G81 X1 Z-1 R1 U5 F100\nM2\n", setup);
  EXPECT_NE(log.lines().back().find("NGC0351"), std::string::npos) << log.lines().back();
}

/// The search that the fuzz targets and the golden programs are put to finds what it is for.
TEST(VanishedWord, IsFoundWhereAControlDropsIt) {
  struct Deaf final : Interpreter {
    Deaf(ProgramSource& text, EventSink& out) : source(text), sink(out) {}
    StepState step(std::uint64_t) override {
      if (done == 1) return StepState::Ended;
      const bool is_word = source.fetch(kMainProgram, 0, 1).text.front() == 'G';
      if (!is_word) return StepState::Alarmed;
      sink.on_block_end(at = {++done, 0, 1, Origin::kNone, kMainProgram});
      return StepState::Ran;
    }
    const Question& question() const override { return asked; }
    Result<void> answer(const Answer&) override { return {}; }
    std::uint64_t blocks() const override { return done; }
    const Origin& origin() const override { return at; }
    Snapshot snapshot() const override { return {"deaf", static_cast<std::uint32_t>(done), {}}; }
    Result<void> restore(const Snapshot& kept) override {
      done = kept.version;
      return {};
    }
    ProgramSource& source;
    EventSink& sink;
    std::uint64_t done = 0;
    Origin at;
    Question asked;
  };
  const Dialect deaf{"deaf", "hears nothing", [](std::string_view, std::string_view) { return 0; },
                     [](const interpreter::Setup&, ProgramSource& source,
                        EventSink& sink) -> Result<std::unique_ptr<Interpreter>> {
                       return std::make_unique<Deaf>(source, sink);
                     }};
  const auto found = find_vanished_word(deaf, "G1 X5 F10\n", {}, 10);
  ASSERT_TRUE(found);
  EXPECT_NE(found->find("X5"), std::string::npos) << *found;
  EXPECT_FALSE(find_vanished_word(deaf, "G1 (X5) F10\n", {}, 10));
}

}  // namespace
}  // namespace dripline::interpreter
