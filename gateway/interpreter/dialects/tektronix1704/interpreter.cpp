#include "gateway/interpreter/dialects/tektronix1704/interpreter.hpp"

#include <fmt/format.h>

#include "gateway/interpreter/dialects/tektronix1704/block_reader.hpp"
#include "gateway/interpreter/dialects/tektronix1704/execution.hpp"
#include "gateway/interpreter/dialects/tektronix1704/machine_functions.hpp"
#include "gateway/interpreter/dialects/tektronix1704/path_rules.hpp"
#include "gateway/interpreter/dialects/tektronix1704/snapshot.hpp"

namespace dripline::interpreter::tektronix1704 {
namespace {

/// Titles in a leader are long; a comment may be too.
constexpr LineRules kLineRules{.max_bytes = 16 * 1024, .skip_percent = false};

}  // namespace

TektronixInterpreter::TektronixInterpreter(ControlOptions options, ProgramSource& source,
                                           EventSink& sink)
    : run_(std::move(options), sink), reader_(source, kLineRules) {}

StepState TektronixInterpreter::step(std::uint64_t max_blocks) {
  if (run_.state.phase == RunPhase::Alarmed) return StepState::Alarmed;
  if (run_.state.phase == RunPhase::Ended) return StepState::Ended;
  reader_.drop_window();
  while (run_.state.mdi_done < run_.options.mdi.size()) {
    const Outcome outcome = run_mdi_block();
    if (outcome == Outcome::Alarmed) return StepState::Alarmed;
    if (outcome == Outcome::Ended) return StepState::Ended;
  }
  for (std::uint64_t left = max_blocks; left > 0;) {
    switch (run_line()) {
      case Outcome::Finished:
        --left;
        break;
      case Outcome::NoBlock:
        break;
      case Outcome::NeedsText:
        return StepState::NeedsText;
      case Outcome::Ended:
        return StepState::Ended;
      case Outcome::Alarmed:
        return StepState::Alarmed;
    }
  }
  return StepState::Ran;
}

TektronixInterpreter::Outcome TektronixInterpreter::alarm() {
  run_.events().on_alarm({run_.state.at, run_.alarm});
  run_.state.phase = RunPhase::Alarmed;
  return Outcome::Alarmed;
}

void TektronixInterpreter::begin_block(const TextPlace& place) {
  Origin& at = run_.state.at;
  at.block = run_.state.blocks + 1;
  at.offset = place.offset;
  at.line = place.line;
  at.sequence = Origin::kNone;
  at.program = place.program;
  run_.state.block.is_begun = true;
}

TektronixInterpreter::Outcome TektronixInterpreter::run_line() {
  SourceLine line;
  const LineState state = reader_.next(line);
  if (state != LineState::Ready) [[unlikely]]
    return meet(state);
  run_.state.place = reader_.place();
  if (run_.state.reader == ReaderState::Hunt) [[unlikely]]
    return hunt(line.text);
  if (!run_.state.block.is_begun) begin_block(line.place);
  switch (read_line(run_, line.text)) {
    case ReadOutcome::Block:
      break;
    case ReadOutcome::GoesOn:
      return Outcome::NoBlock;
    case ReadOutcome::EndCode:
      return end_of_tape();
    case ReadOutcome::Alarm:
      return alarm();
  }
  if (run_.state.reader == ReaderState::Search) [[unlikely]]
    return search();
  return execute();
}

TektronixInterpreter::Outcome TektronixInterpreter::meet(LineState state) {
  switch (state) {
    case LineState::NotYet:
      return Outcome::NeedsText;
    case LineState::End:
      return end_of_tape();
    case LineState::TooLong:
      run_.fail(Fault::BlockTooLong, 0,
                fmt::format("more than {} characters", kLineRules.max_bytes));
      return alarm();
    default:
      run_.fail(Fault::TextFailed, 0, reader_.reason());
      return alarm();
  }
}

/// Everything up to the first end of block: leader, titles, the rewind stop code (spec 3.1).
TektronixInterpreter::Outcome TektronixInterpreter::hunt(std::string_view line) {
  run_.state.reader = run_.options.search ? ReaderState::Search : ReaderState::Data;
  if (line.find('%') == std::string_view::npos) {
    run_.state.at.line = 1;
    run_.warn(Fault::Tape, run_.state.at, 0, "no rewind stop code before the first end of block");
  }
  return Outcome::NoBlock;
}

/// Blocks that are passed over change nothing at all (spec 14.1).
TektronixInterpreter::Outcome TektronixInterpreter::search() {
  BlockInProgress& block = run_.state.block;
  if (!block.words.has(Address::N) || block.words[Address::N] != *run_.options.search) {
    block = {};
    return Outcome::NoBlock;
  }
  run_.state.reader = ReaderState::Data;
  return execute();
}

TektronixInterpreter::Outcome TektronixInterpreter::execute() {
  State& state = run_.state;
  const Words& words = state.block.words;
  if (words.has(Address::N)) state.at.sequence = words[Address::N];
  if (!state.block.is_bad && !words.empty() && !execute_block(run_)) return alarm();
  close_block();
  return state.phase == RunPhase::Ended ? Outcome::Ended : Outcome::Finished;
}

void TektronixInterpreter::close_block() {
  run_.state.block = {};
  ++run_.state.blocks;
  run_.sink.on_block_end(run_.state.at);
}

TektronixInterpreter::Outcome TektronixInterpreter::end_of_tape() {
  run_.state.block = {};
  if (run_.state.reader == ReaderState::Search) {
    run_.fail(Fault::NumberNotFound, 0, fmt::format("N{:03}", *run_.options.search));
    return alarm();
  }
  if (!check_stop(run_) || !run_.object(Fault::EndWithoutM)) return alarm();
  end_run(run_, run_.state.blocks, false);
  return Outcome::Ended;
}

/// What the operator keyed in before CYCLE START: executed like blocks of the tape (spec 14.2).
TektronixInterpreter::Outcome TektronixInterpreter::run_mdi_block() {
  begin_block(TextPlace{});
  const std::string& text = run_.options.mdi[run_.state.mdi_done++];
  if (read_line(run_, text) != ReadOutcome::Block) {
    if (run_.alarm.id.empty()) run_.fail(Fault::Character, 0, text);
    return alarm();
  }
  if (!execute_block(run_)) return alarm();
  run_.state.block = {};
  return run_.state.phase == RunPhase::Ended ? Outcome::Ended : Outcome::Finished;
}

Result<void> TektronixInterpreter::answer(const Answer&) {
  return dripline::fail(Errc::Syntax, "no question is open");
}

ActiveModes TektronixInterpreter::modes() const {
  ActiveModes modes;
  modes.units = run_.options.is_metric() ? Units::Millimetre : Units::Inch;
  modes.is_incremental = run_.state.is_incremental;
  modes.feed = Feed::per_minute(Length::mm(run_.state.last.feed));
  return modes;
}

Snapshot TektronixInterpreter::snapshot() const {
  return take_snapshot(run_);
}

Result<void> TektronixInterpreter::restore(const Snapshot& snapshot) {
  if (auto restored = restore_snapshot(run_, snapshot); !restored) return restored;
  reader_.drop_window();
  reader_.seek(run_.state.place);
  return {};
}

}  // namespace dripline::interpreter::tektronix1704
