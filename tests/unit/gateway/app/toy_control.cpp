#include "tests/unit/gateway/app/toy_control.hpp"

#include <charconv>

namespace dripline::gateway {
namespace {

using namespace interpreter;

const Feed kFeed = Feed::per_minute(Length::mm(6000));

class ToyInterpreter final : public Interpreter {
 public:
  ToyInterpreter(const Setup& setup, ProgramSource& source, EventSink& sink)
      : setup_(setup), source_(source), sink_(sink) {}

  StepState step(std::uint64_t max_blocks) override {
    for (std::uint64_t i = 0; i < max_blocks; ++i) {
      const StepState state = one_block();
      if (state != StepState::Ran) return state;
    }
    return StepState::Ran;
  }
  const Question& question() const override { return question_; }
  Result<void> answer(const Answer& given) override {
    if (const auto* text = std::get_if<PromptAnswer>(&given)) answer_ = text->text.value_or("");
    if (const auto* probed = std::get_if<ProbeResult>(&given))
      answer_ = probed->tripped ? "tripped" : "free";
    if (const auto* is_high = std::get_if<bool>(&given)) answer_ = *is_high ? "high" : "low";
    return {};
  }
  std::uint64_t blocks() const override { return blocks_; }
  const Origin& origin() const override { return origin_; }
  /// A radius that names the block it belongs to.
  ActiveModes modes() const override {
    ActiveModes modes;
    modes.tool_radius = Length::mm(static_cast<double>(blocks_));
    modes.work_system = 541;
    modes.work_page = 7;
    modes.cycle = "drill";
    return modes;
  }
  Snapshot snapshot() const override { return {}; }
  Result<void> restore(const Snapshot&) override { return fail(Errc::Unsupported, "toy"); }

 private:
  StepState one_block() {
    const TextWindow window = source_.fetch(kMainProgram, offset_, 64);
    if (window.state == TextWindow::State::NotYet) return StepState::NeedsText;
    origin_ = {blocks_ + 1, offset_, line_ + 1, Origin::kNone, kMainProgram};
    if (window.state == TextWindow::State::Failed) return alarm(window.reason);
    const std::string line(window.text.substr(0, window.text.find('\n')));
    if (line.starts_with("CALL ")) {
      const ProgramLookup found = source_.find(line.substr(5));
      if (found.state == ProgramLookup::State::NotYet) return StepState::NeedsText;
      if (found.state == ProgramLookup::State::NotFound) return alarm("not found");
      const TextWindow called = source_.fetch(found.program, 0, 8);
      if (called.state == TextWindow::State::NotYet) return StepState::NeedsText;
      sink_.on_output({origin_, OutputDevice::File, called.text.substr(0, called.text.find('\n'))});
    }
    if (line.starts_with("ASK ")) {
      if (!answer_) return ask(PromptQuestion{line.substr(4), "P1"});
      sink_.on_output({origin_, OutputDevice::File, *answer_});
    }
    if (line == "PROBE" && !answer_) {
      Probe probe;
      probe.origin = origin_;
      probe.to.set(Axis::X, Length::mm(-10));
      probe.feed = kFeed;
      return ask(ProbeQuestion{probe});
    }
    if (line.starts_with("PIN ")) {
      if (!answer_) return ask(InputQuestion{line[4] - '0'});
      sink_.on_output({origin_, OutputDevice::File, *answer_});
    }
    answer_.reset();
    if (line == "ARC") {
      Arc arc;
      arc.origin = origin_;
      arc.feed = kFeed;
      sink_.on_arc(arc);
    }
    if (line == "THREAD") {
      Thread thread;
      thread.origin = origin_;
      thread.lead = Length::mm(1);
      sink_.on_thread(thread);
    }
    if (line == "TOOLS") {
      const std::string count = std::to_string(setup_.tools.size());
      sink_.on_output({origin_, OutputDevice::File, count});
    }
    if (line == "BAD") return alarm("bad word");
    if (line.starts_with("OUT ")) sink_.on_output({origin_, OutputDevice::File, line.substr(4)});
    if (line.starts_with("X")) move(line);
    if (line == "STOP") sink_.on_stop({origin_, StopKind::Program});
    ++blocks_;
    const bool jumps = line == "JUMP" && jumps_++ < 2;
    offset_ = jumps ? 0 : offset_ + line.size() + 1;
    line_ = jumps ? 0 : line_ + 1;
    const bool ends = line == "END";
    if (ends) sink_.on_end({origin_, blocks_, false});
    sink_.on_block_end(origin_);
    return ends ? StepState::Ended : StepState::Ran;
  }
  void move(const std::string& line) {
    double x = 0;
    std::from_chars(line.data() + 1, line.data() + line.size(), x);
    Line event;
    event.origin = origin_;
    event.to.set(Axis::X, Length::mm(x));
    const bool is_per_revolution = line.ends_with(" PER REVOLUTION");
    event.feed = is_per_revolution ? Feed::per_revolution(Length::mm(0.1)) : kFeed;
    sink_.on_line(event);
  }
  StepState ask(Question question) {
    question_ = std::move(question);
    return StepState::NeedsAnswer;
  }
  StepState alarm(std::string text) {
    sink_.on_alarm({origin_, {"TOY0001", std::move(text), origin_.line, 1}});
    return StepState::Alarmed;
  }

  Setup setup_;
  ProgramSource& source_;
  EventSink& sink_;
  std::uint64_t offset_ = 0, line_ = 0, blocks_ = 0;
  int jumps_ = 0;
  Origin origin_;
  Question question_;
  std::optional<std::string> answer_;
};

}  // namespace

const Dialect& toy_control() {
  static const Dialect kToy{
      .name = "toy",
      .title = "Toy",
      .likelihood = [](std::string_view, std::string_view) { return 0; },
      .make = [](const Setup& setup, ProgramSource& source,
                 EventSink& sink) -> Result<std::unique_ptr<Interpreter>> {
        return std::unique_ptr<Interpreter>(std::make_unique<ToyInterpreter>(setup, source, sink));
      },
      .feed_override_switch = {.step = 0.05, .most = 2, .fastest = std::nullopt}};
  return kToy;
}

}  // namespace dripline::gateway
