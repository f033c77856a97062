#include "gateway/interpreter/dialects/tektronix1704/interpreter.hpp"

#include <fmt/format.h>

#include "gateway/interpreter/dialects/tektronix1704/block_reader.hpp"
#include "gateway/interpreter/dialects/tektronix1704/execution.hpp"
#include "gateway/interpreter/dialects/tektronix1704/machine_functions.hpp"
#include "gateway/interpreter/dialects/tektronix1704/path_rules.hpp"

namespace dripline::interpreter::tektronix1704 {
namespace {

/// Titles in a leader are long; a comment may be too.
constexpr LineRules kLineRules{.max_bytes = 16 * 1024, .skip_percent = false};

}  // namespace

TektronixInterpreter::TektronixInterpreter(ControlOptions options, ProgramSource& source,
                                           EventSink& sink)
    : run_(std::move(options), sink), reader_(source, kLineRules) {
  if (run_.options.is_mdi) run_.state.reader = ReaderState::Data;
}

BlockOutcome TektronixInterpreter::run_block() {
  return run_.state.mdi_done < run_.options.mdi.size() ? run_mdi_block() : run_line();
}

void TektronixInterpreter::begin_block(const TextPlace& place) {
  place_origin(place);
  run_.state.block.is_begun = true;
}

BlockOutcome TektronixInterpreter::run_line() {
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
      return BlockOutcome::NoBlock;
    case ReadOutcome::EndCode:
      return end_of_tape();
    case ReadOutcome::Alarm:
      return BlockOutcome::Paused;
  }
  if (run_.state.reader == ReaderState::Search) [[unlikely]]
    return search();
  return execute();
}

BlockOutcome TektronixInterpreter::meet(LineState state) {
  switch (state) {
    case LineState::NotYet:
      return BlockOutcome::NeedsText;
    case LineState::End:
      return end_of_tape();
    case LineState::TooLong:
      run_.fail(Fault::BlockTooLong, 0,
                fmt::format("more than {} characters", kLineRules.max_bytes));
      return BlockOutcome::Paused;
    default:
      run_.fail(Fault::TextFailed, 0, reader_.reason());
      return BlockOutcome::Paused;
  }
}

/// The text up to the first end of block: leader, titles, the rewind stop code.
BlockOutcome TektronixInterpreter::hunt(std::string_view line) {
  run_.state.reader = run_.options.search ? ReaderState::Search : ReaderState::Data;
  if (line.find('%') == std::string_view::npos) {
    run_.origin.line = 1;
    run_.warn(Fault::Tape, run_.origin, 0, "no rewind stop code before the first end of block");
  }
  return BlockOutcome::NoBlock;
}

/// Skipped blocks change nothing at all.
BlockOutcome TektronixInterpreter::search() {
  BlockInProgress& block = run_.state.block;
  if (!block.words.has(Address::N) || block.words[Address::N] != *run_.options.search) {
    block = {};
    return BlockOutcome::NoBlock;
  }
  run_.state.reader = ReaderState::Data;
  return execute();
}

BlockOutcome TektronixInterpreter::execute() {
  State& state = run_.state;
  const Words& words = state.block.words;
  if (words.has(Address::N)) run_.origin.sequence = words[Address::N];
  if (!state.block.is_bad && !words.empty() && !execute_block(run_)) return BlockOutcome::Paused;
  close_block();
  return BlockOutcome::Finished;
}

void TektronixInterpreter::close_block() {
  run_.state.block = {};
  ++run_.state.blocks;
  run_.sink.on_block_end(run_.origin);
}

BlockOutcome TektronixInterpreter::end_of_tape() {
  run_.state.block = {};
  if (run_.options.is_mdi) {
    run_.events().on_end({run_.origin, run_.state.blocks, false});
    run_.state.phase = RunPhase::Ended;
    return BlockOutcome::NoBlock;
  }
  if (run_.state.reader == ReaderState::Search) {
    run_.fail(Fault::NumberNotFound, 0, fmt::format("N{:03}", *run_.options.search));
    return BlockOutcome::Paused;
  }
  if (!check_stop(run_) || !run_.object(Fault::EndWithoutM)) return BlockOutcome::Paused;
  end_run(run_, run_.state.blocks, false);
  return BlockOutcome::NoBlock;
}

/// Blocks that the operator entered before CYCLE START are executed like blocks of the tape.
BlockOutcome TektronixInterpreter::run_mdi_block() {
  begin_block(TextPlace{});
  const std::string& text = run_.options.mdi[run_.state.mdi_done++];
  if (read_line(run_, text) != ReadOutcome::Block) {
    if (run_.alarm.id.empty()) run_.fail(Fault::Character, 0, text);
    return BlockOutcome::Paused;
  }
  if (!execute_block(run_)) return BlockOutcome::Paused;
  run_.state.block = {};
  return BlockOutcome::NoBlock;
}

Result<void> TektronixInterpreter::begin_next_text() {
  State& state = run_.state;
  state.phase = RunPhase::Running;
  state.reader = ReaderState::Data;
  state.has_header = false;
  state.blocks = 0;
  state.mdi_done = 0;
  state.place = {};
  state.block = {};
  run_.origin = {};
  after_restore();
  return {};
}

ActiveModes TektronixInterpreter::modes() const {
  ActiveModes modes;
  modes.units = run_.options.is_metric() ? Units::Millimeter : Units::Inch;
  modes.is_incremental = run_.state.is_incremental;
  modes.feed = Feed::per_minute(Length::mm(run_.state.last.feed));
  return modes;
}

void TektronixInterpreter::after_restore() {
  reader_.drop_window();
  reader_.seek(run_.state.place);
}

}  // namespace dripline::interpreter::tektronix1704

namespace dripline::interpreter {
template class BlockInterpreter<tektronix1704::TektronixInterpreter>;
}
