#include "gateway/interpreter/dialects/prototrak/interpreter.hpp"

#include <fmt/format.h>

#include "gateway/interpreter/core/language/state_archive.hpp"

namespace dripline::interpreter::prototrak {

/// What a snapshot stores.
struct KeptState {
  std::uint8_t phase = 0;  ///< 0: receiving, the rest is unused; 1 running, 2 ended, 3 alarmed
  StoredProgram program;
  ExecutionState execution;
  std::vector<std::byte> path;  ///< the compensator's
};

// Not in the unnamed namespace, where the archives would not find them.
template <class Archive>
void visit(Archive& archive, ProgramEvent& event) {
  archive(event.kind, event.is_metric, event.is_counterclockwise, event.is_connected, event.begin,
          event.end, event.center, event.radius, event.conrad, event.angle, event.diameter,
          event.finish_cut, event.feed, event.side, event.tool, event.holes, event.from_event,
          event.to_event, event.passes, event.has_diameter, event.has_tool, event.is_converted,
          event.offset, event.line, event.sequence);
}
template <class Archive>
void visit(Archive& archive, KeptState& state) {
  archive(state.phase);
  if (state.phase != 0) archive(state.program, state.execution, state.path);
}

namespace {

constexpr std::string_view kDialect = "prototrak-plus";
constexpr std::uint32_t kVersion = 3;

bool is_plausible(const ProgramEvent& event) {
  return event.kind <= EventKind::CircularFrame && event.side <= ToolSide::Left &&
         event.tool <= 99 && event.holes <= 999;
}

bool is_plausible(const KeptState& state) {
  if (state.program.events.size() > kMaxEvents || state.execution.frames.size() > kMaxNesting + 1) {
    return false;
  }
  const auto most = static_cast<std::uint16_t>(state.program.events.size());
  for (const ProgramEvent& event : state.program.events) {
    if (!is_plausible(event)) return false;
  }
  for (const Frame& frame : state.execution.frames) {
    const bool is_range = frame.first >= 1 && frame.first <= frame.index &&
                          frame.index <= frame.last && frame.last <= most;
    if (!is_range || frame.pass < 1 || frame.pass > frame.passes || frame.passes > 99) return false;
  }
  const bool has_previous =
      !state.execution.frames.empty() &&
      state.execution.frames.back().index > state.execution.frames.back().first;
  if (state.execution.is_in_chain && !has_previous) return false;
  return state.phase <= 3 && (state.phase != 1 || !state.execution.frames.empty());
}

/// Ends of lines are layout: a whole program may be on one.
constexpr LineRules kLineRules{.max_bytes = 60'000, .skip_percent = false};
constexpr int kLinesAtOnce = 256;

}  // namespace

ProtoTrakInterpreter::ProtoTrakInterpreter(ControlOptions options, const Position& start,
                                           ProgramSource& source, EventSink& sink)
    : options_(options),
      reader_(source, kLineRules),
      sink_(sink),
      executor_(options_, program_, sink, start),
      begun_(executor_.state()),
      begun_path_(executor_.path().state()) {}

const Origin& ProtoTrakInterpreter::origin() const {
  return phase_ == Phase::Receiving || executor_.origin().block == 0 ? received_at_
                                                                     : executor_.origin();
}

StepState ProtoTrakInterpreter::step(std::uint64_t max_blocks) {
  reader_.drop_window();
  switch (phase_) {
    case Phase::Receiving:
      return receive();
    case Phase::Running:
      return run(max_blocks);
    case Phase::Ended:
      return StepState::Ended;
    case Phase::Alarmed:
      break;
  }
  return StepState::Alarmed;
}

/// Takes a bounded number of lines; no event comes before the last one.
StepState ProtoTrakInterpreter::receive() {
  for (int i = 0; i < kLinesAtOnce; ++i) {
    SourceLine line;
    auto state = Receiver::State::Failed;
    switch (reader_.next(line)) {
      case LineState::Ready:
        state = receiver_.take(line);
        break;
      case LineState::NotYet:
        return StepState::NeedsText;
      case LineState::End:
        state = receiver_.end_of_text(reader_.place().line);
        break;
      case LineState::TooLong:
        state = receiver_.fail_line(Fault::NoBlockEnd, "a line of more than 60000 characters");
        break;
      case LineState::Failed:
        state = receiver_.fail_line(Fault::TextFailed, reader_.reason());
        break;
    }
    if (state == Receiver::State::Failed) return refuse_program();
    if (state == Receiver::State::Receiving) continue;
    deliver_header();
    if (options_.names_start && !can_begin()) return refuse_start();
    executor_.begin();
    if (options_.names_start) announce_start();
    phase_ = Phase::Running;
    return executor_.is_done() ? end() : StepState::Ran;
  }
  return StepState::Ran;
}

/// Delivers the header, then the warnings of receiving.
void ProtoTrakInterpreter::deliver_header() {
  program_ = receiver_.program();
  ProgramHeader header;
  header.control = "prototrak-plus";
  const std::string name = fmt::format("{}", program_.part_number);
  if (program_.has_part_number) header.name = name;
  header.units = program_.is_metric ? Units::Millimeter : Units::Inch;
  sink_.on_program(header);
  for (const Notice& notice : receiver_.notices()) {
    sink_.on_warning(
        {{0, notice.offset, notice.line, Origin::kNone, kMainProgram}, notice.diagnostic});
  }
}

StepState ProtoTrakInterpreter::refuse_program() {
  deliver_header();
  const Notice& failure = receiver_.failure();
  received_at_ = {0, failure.offset, failure.line, Origin::kNone, kMainProgram};
  sink_.on_alarm({received_at_, failure.diagnostic});
  phase_ = Phase::Alarmed;
  return StepState::Alarmed;
}

/// At the event that the start names.
bool ProtoTrakInterpreter::can_begin() const {
  return options_.start_event <= program_.events.size() &&
         executor_.first_to_begin_with(options_.start_event) == options_.start_event;
}

StepState ProtoTrakInterpreter::refuse_start() {
  const std::uint16_t number = options_.start_event;
  phase_ = Phase::Alarmed;
  if (number > program_.events.size()) {
    const std::string detail =
        fmt::format("a start at event {}, it has {}", number, program_.events.size());
    sink_.on_alarm({received_at_, diagnostic(Fault::NoStartEvent, detail, 0, 0)});
    return StepState::Alarmed;
  }
  const ProgramEvent& event = program_.events[number - 1U];
  received_at_ = {0, event.offset, event.line, event.sequence, kMainProgram};
  const std::string detail = fmt::format(
      "event {} is connected to event {} with a tool offset or a conrad; begin at "
      "event {}",
      number, number - 1, executor_.first_to_begin_with(number));
  sink_.on_alarm({received_at_, diagnostic(Fault::StartInChain, detail, event.line)});
  return StepState::Alarmed;
}

/// Each event holds everything it needs; where the axes are is for the operator to see.
void ProtoTrakInterpreter::announce_start() {
  const ProgramEvent& event = program_.events[options_.start_event - 1U];
  const Origin at{0, event.offset, event.line, event.sequence, kMainProgram};
  sink_.on_message({at, fmt::format("start at event {}: the events before it are not executed",
                                    options_.start_event)});
  sink_.on_stop({at, StopKind::Operator});
}

StepState ProtoTrakInterpreter::run(std::uint64_t max_blocks) {
  for (std::uint64_t left = max_blocks; left > 0; --left) {
    if (!executor_.step()) {
      executor_.events().on_alarm({executor_.origin(), executor_.alarm()});
      phase_ = Phase::Alarmed;
      return StepState::Alarmed;
    }
    if (executor_.is_done()) return end();
  }
  return StepState::Ran;
}

StepState ProtoTrakInterpreter::end() {
  phase_ = Phase::Ended;
  executor_.events().on_end({executor_.origin(), blocks(), true});
  return StepState::Ended;
}

Result<void> ProtoTrakInterpreter::answer(const Answer&) {
  return fail(Errc::Syntax, "no question is open");
}

ActiveModes ProtoTrakInterpreter::modes() const {
  const bool is_running = phase_ != Phase::Receiving;
  const Executor::Shown& shown = executor_.shown();
  ActiveModes modes;
  // While it is received, a program has no unit yet: the control is in inches at power on.
  modes.units = is_running && executor_.state().is_metric ? Units::Millimeter : Units::Inch;
  if (shown.side == ToolSide::Left) modes.compensation = CompensationSide::Left;
  if (shown.side == ToolSide::Right) modes.compensation = CompensationSide::Right;
  modes.tool_radius = Length::mm(shown.tool_radius);
  modes.feed = Feed::per_minute(Length::mm(shown.feed));
  return modes;
}

/// A snapshot taken while receiving is that of the start, because nothing has been executed.
Snapshot ProtoTrakInterpreter::snapshot() const {
  const bool is_receiving = phase_ == Phase::Receiving;
  KeptState state{static_cast<std::uint8_t>(phase_), program_, executor_.state(),
                  is_receiving ? std::vector<std::byte>{} : executor_.path().state()};
  language::StateWriter writer;
  writer(state);
  return {std::string(kDialect), kVersion, writer.take()};
}

Result<void> ProtoTrakInterpreter::restore(const Snapshot& snapshot) {
  if (auto kind = snapshot.check_kind(kDialect, kVersion); !kind) return kind;
  language::StateReader reader(snapshot.bytes, language::Numbers::Finite);
  KeptState kept;
  reader(kept);
  if (!reader.is_complete() || !is_plausible(kept)) return snapshot.damage();
  if (kept.phase == static_cast<std::uint8_t>(Phase::Receiving)) {
    if (auto reset = executor_.restore(begun_, begun_path_); !reset) return reset;
    program_ = {};
    receiver_ = Receiver();
    reader_.drop_window();
    reader_.seek(TextPlace{});
    phase_ = Phase::Receiving;
    return {};
  }
  if (const auto done = executor_.restore(std::move(kept.execution), kept.path); !done) {
    return done;
  }
  program_ = std::move(kept.program);
  phase_ = static_cast<Phase>(kept.phase);
  return {};
}

}  // namespace dripline::interpreter::prototrak
