#include "clients/tools/offline/offline_run.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gateway/interpreter/core/language/line_reader.hpp"
#include "gateway/interpreter/core/program_source.hpp"
#include "gateway/interpreter/registry.hpp"

namespace dripline::interpreter {
namespace {

using testing::HasSubstr;

/// A control of one word a line: ask, probe, pin, time, warn, alarm, loop, end.
class WordInterpreter final : public Interpreter {
 public:
  WordInterpreter(ProgramSource& source, EventSink& sink) : reader_(source), sink_(sink) {}

  StepState step(std::uint64_t max_blocks) override {
    for (std::uint64_t i = 0; i < max_blocks; ++i) {
      SourceLine line;
      const LineState state = reader_.next(line);
      if (state == LineState::NotYet) return StepState::NeedsText;
      if (state != LineState::Ready) return StepState::Ended;
      origin_.line = line.place.line;
      origin_.block = ++blocks_;
      if (const auto stop = execute(line)) return *stop;
    }
    return StepState::Ran;
  }
  const Question& question() const override { return question_; }
  Result<void> answer(const Answer& answer) override {
    answers.push_back(answer);
    return {};
  }
  std::uint64_t blocks() const override { return blocks_; }
  const Origin& origin() const override { return origin_; }
  Snapshot snapshot() const override { return {}; }
  Result<void> restore(const Snapshot&) override { return {}; }

  static inline std::vector<Answer> answers;

 private:
  std::optional<StepState> execute(const SourceLine& line) {
    const std::string_view word = line.text;
    if (word == "loop") reader_.seek(line.place);
    if (word == "warn") sink_.on_warning({origin_, {"W1", "careful", origin_.line, 0}});
    if (word == "alarm") {
      sink_.on_alarm({origin_, {"A1", "broken", origin_.line, 0}});
      return StepState::Alarmed;
    }
    if (word == "end") {
      sink_.on_end({origin_, blocks_, true});
      return StepState::Ended;
    }
    if (word == "ask") question_ = PromptQuestion{"HOW MUCH", "P1"};
    if (word == "time") question_ = TimeQuestion{};
    if (word == "pin") question_ = InputQuestion{1000};
    if (word == "probe") {
      Probe probe;
      probe.to.set(Axis::Z, Length::mm(-10));
      question_ = ProbeQuestion{probe};
    }
    const bool asks = word == "ask" || word == "time" || word == "pin" || word == "probe";
    return asks ? std::optional(StepState::NeedsAnswer) : std::nullopt;
  }

  LineReader reader_;
  EventSink& sink_;
  Question question_;
  Origin origin_;
  std::uint64_t blocks_ = 0;
};

const Dialect kWords{"words", "one word a line",
                     [](std::string_view, std::string_view) { return 0; },
                     [](const Setup& setup, ProgramSource& source,
                        EventSink& sink) -> Result<std::unique_ptr<Interpreter>> {
                       if (auto known = setup.control.check_known({"pins"}); !known) {
                         return fail(known.error());
                       }
                       return std::make_unique<WordInterpreter>(source, sink);
                     }};

Result<OfflineOutcome> run(std::string_view text, std::string_view setup_text = "",
                           OfflineLimits limits = {}) {
  WordInterpreter::answers.clear();
  MemorySource source(text);
  EventSink nowhere;
  return run_offline(kWords, parse_setup(setup_text).value(), source, nowhere, limits);
}

TEST(OfflineRun, ReachesTheEnd) {
  const auto outcome = run("a\nb\nwarn\nend\n");
  ASSERT_TRUE(outcome);
  EXPECT_TRUE(outcome->ended);
  EXPECT_EQ(outcome->blocks, 4U);
  EXPECT_EQ(outcome->warnings, 1U);
  EXPECT_FALSE(outcome->alarm);
}

TEST(OfflineRun, AnAlarmIsAnOutcome) {
  const auto outcome = run("a\nalarm\nend\n");
  ASSERT_TRUE(outcome);
  EXPECT_FALSE(outcome->ended);
  ASSERT_TRUE(outcome->alarm);
  EXPECT_EQ(outcome->alarm->id, "A1");
  EXPECT_EQ(outcome->alarm->line, 2U);
}

TEST(OfflineRun, QuestionsAreAnsweredFromTheSetup) {
  const auto outcome = run("ask\nprobe\npin\ntime\nask\nend\n", R"(
answers = ["1.5", "2.5"]
date_time = "1993-12-17T12:51:52"
[probe]
surface = [ { axis = "Z", at = -4 } ]
[control]
pins = [1000]
)");
  ASSERT_TRUE(outcome) << outcome.error().what;
  const auto& answers = WordInterpreter::answers;
  ASSERT_EQ(answers.size(), 5U);
  EXPECT_EQ(std::get<PromptAnswer>(answers[0]).text, "1.5");
  EXPECT_DOUBLE_EQ(std::get<ProbeResult>(answers[1]).at.linear(Axis::Z).mm(), -4);
  EXPECT_TRUE(std::get<bool>(answers[2]));
  EXPECT_EQ(std::get<LocalTime>(answers[3]).year, 1993);
  EXPECT_EQ(std::get<PromptAnswer>(answers[4]).text, "2.5");
}

TEST(OfflineRun, WithoutASetupPinsReadZeroAndTheClockIsFixed) {
  ASSERT_TRUE(run("pin\ntime\nend\n"));
  EXPECT_FALSE(std::get<bool>(WordInterpreter::answers[0]));
  EXPECT_EQ(std::get<LocalTime>(WordInterpreter::answers[1]).year, 2000);
}

TEST(OfflineRun, AQuestionTooManyIsAnErrorThatNamesIt) {
  const auto outcome = run("a\nask\nask\nend\n", "answers = [\"1\"]");
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, Errc::NotFound);
  EXPECT_THAT(outcome.error().what, testing::AllOf(HasSubstr("line 3"), HasSubstr("HOW MUCH")));
}

TEST(OfflineRun, AProgramThatNeverEndsIsStopped) {
  const auto outcome = run("loop\n", "", {200'000});
  ASSERT_FALSE(outcome);
  EXPECT_EQ(outcome.error().code, Errc::LimitExceeded);
  EXPECT_THAT(outcome.error().what, HasSubstr("200000"));
}

TEST(OfflineRun, WhatTheControlRefusesOfASetupIsAnError) {
  const auto outcome = run("end\n", "[control]\nspeed = 1");
  ASSERT_FALSE(outcome);
  EXPECT_THAT(outcome.error().what, HasSubstr("speed"));
}

/// The control's clock has to go on where nothing else takes time.
TEST(OfflineRun, AProgramThatWaitsForItsClockGoesOn) {
  const auto dialect = find_dialect("fanuc");
  ASSERT_TRUE(dialect);
  MemorySource source(
      "O1\n#3001=0\nWHILE[#3001LT2500]DO1\nEND1\n#3001=0\nG04P250\nIF[#3001LT200]GOTO9\nG00X1.\n"
      "N9M30\n");
  struct Rapids final : EventSink {
    void on_rapid(const Rapid&) override { ++count; }
    int count = 0;
  } sink;
  const auto outcome = run_offline(**dialect, interpreter::Setup{}, source, sink);
  ASSERT_TRUE(outcome) << outcome.error().what;
  EXPECT_TRUE(outcome->ended) << (outcome->alarm ? outcome->alarm->text : "");
  EXPECT_LT(outcome->blocks, 20U);
  EXPECT_EQ(sink.count, 1) << "the dwell has not moved the clock";
}

}  // namespace
}  // namespace dripline::interpreter
