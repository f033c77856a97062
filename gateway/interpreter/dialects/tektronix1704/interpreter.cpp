#include "gateway/interpreter/dialects/tektronix1704/interpreter.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "gateway/interpreter/dialects/tektronix1704/block_reader.hpp"
#include "gateway/interpreter/dialects/tektronix1704/execution.hpp"
#include "gateway/interpreter/dialects/tektronix1704/machine_functions.hpp"
#include "gateway/interpreter/dialects/tektronix1704/path_rules.hpp"

namespace dripline::interpreter::tektronix1704 {
namespace {

/// Titles in a leader are long; a comment may be too.
constexpr LineRules kLineRules{.max_bytes = 16 * 1024, .skip_percent = false};

/// For a message: the beginning of a line that may hold any characters.
std::string shown(std::string_view line) {
  constexpr std::size_t kMaxShown = 40;
  std::string text(line.substr(0, kMaxShown));
  std::ranges::replace_if(
      text, [](char c) { return c < ' ' || c > '~'; }, '?');
  return line.size() > kMaxShown ? text + "..." : text;
}

}  // namespace

TektronixInterpreter::TektronixInterpreter(ControlOptions options, ProgramSource& source,
                                           EventSink& sink)
    : run_(std::move(options), sink), reader_(source, kLineRules) {
  if (run_.options.is_mdi) run_.state.reader = ReaderState::Data;
  run_.state.wanted = run_.options.part;
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
    return hunt(line);
  if (!run_.state.block.is_begun) begin_block(line.place);
  switch (read_line(run_, line.text)) {
    case ReadOutcome::Block:
      break;
    case ReadOutcome::GoesOn:
      return BlockOutcome::NoBlock;
    case ReadOutcome::EndCode:
      return has_words_at_stop(line.text) ? lose_block(line) : end_of_data(true);
    case ReadOutcome::Alarm:
      return BlockOutcome::Paused;
  }
  if (run_.state.reader == ReaderState::Pass) [[unlikely]]
    return pass();
  if (!run_.state.has_block && !run_.state.block.words.empty()) [[unlikely]]
    begin_part();
  if (run_.state.reader == ReaderState::Search) [[unlikely]]
    return search();
  return execute();
}

/// Of a line with the rewind stop code, of which what is before the code has been read.
bool TektronixInterpreter::has_words_at_stop(std::string_view line) const {
  const BlockInProgress& block = run_.state.block;
  if (block.has_word || !block.words.empty()) return true;
  return looks_like_block(line.substr(line.find(kRewindStop)));
}

BlockOutcome TektronixInterpreter::meet(LineState state) {
  switch (state) {
    case LineState::NotYet:
      return BlockOutcome::NeedsText;
    case LineState::End:
      return end_of_text();
    case LineState::TooLong:
      run_.fail(Fault::BlockTooLong, 0,
                fmt::format("more than {} characters", kLineRules.max_bytes));
      return BlockOutcome::Paused;
    default:
      run_.fail(Fault::TextFailed, 0, reader_.reason());
      return BlockOutcome::Paused;
  }
}

/// The text up to the first end of block: leader, titles, the rewind stop code. The control would
/// lose a block that is there.
BlockOutcome TektronixInterpreter::hunt(const SourceLine& line) {
  State& state = run_.state;
  if (looks_like_block(line.text)) {
    begin_block(line.place);
    if (line.text.find(kRewindStop) != std::string_view::npos) return lose_block(line);
    run_.fail(Fault::BlockInLeader, 1,
              fmt::format("{}: program {} of the tape has no rewind stop code and end of block "
                          "before it",
                          shown(line.text), state.part));
    return BlockOutcome::Paused;
  }
  const bool is_wanted = state.part >= state.wanted;
  state.reader = !is_wanted            ? ReaderState::Pass
                 : run_.options.search ? ReaderState::Search
                                       : ReaderState::Data;
  if (line.text.find(kRewindStop) != std::string_view::npos) {
    state.head = state.part;
  } else if (is_wanted && state.part == 1) {
    warn_of_head(line.place.line);
  }
  return BlockOutcome::NoBlock;
}

/// Words before the rewind stop code have no end of block, those after it are hunted over.
BlockOutcome TektronixInterpreter::lose_block(const SourceLine& line) {
  run_.fail(
      Fault::BlockInLeader, 1,
      fmt::format("{}: the line of the rewind stop code holds words of a block", shown(line.text)));
  return BlockOutcome::Paused;
}

void TektronixInterpreter::warn_of_head(std::uint64_t line) {
  Origin at = run_.origin;
  at.line = line;
  run_.warn(Fault::Tape, at, 0, "no rewind stop code before the first end of block");
}

/// The first block: what was hunted over was the head of a program, and not the end of the tape.
void TektronixInterpreter::begin_part() {
  State& state = run_.state;
  state.has_block = true;
  if (state.part > 1 && state.head != state.part) warn_of_head(run_.origin.line);
}

/// A block of a program before the wanted one changes nothing but where the reader is.
BlockOutcome TektronixInterpreter::pass() {
  State& state = run_.state;
  const Words& words = state.block.words;
  state.has_block |= !words.empty();
  const bool ends = words.has(Address::M) && (words[Address::M] == 2 || words[Address::M] == 30);
  state.block = {};
  if (ends) end_part(false);
  return BlockOutcome::NoBlock;
}

/// What is under the reader from here on is the next program.
void TektronixInterpreter::end_part(bool is_end_code) {
  State& state = run_.state;
  ++state.part;
  state.has_block = false;
  state.reader = ReaderState::Hunt;
  if (!is_end_code) return;
  // The end of block after the code is the one that is hunted for.
  state.head = state.part;
  if (state.part < state.wanted) {
    state.reader = ReaderState::Pass;
  } else {
    state.reader = run_.options.search ? ReaderState::Search : ReaderState::Data;
  }
}

/// Skipped blocks change nothing at all.
BlockOutcome TektronixInterpreter::search() {
  BlockInProgress& block = run_.state.block;
  if (!block.words.has(Address::N) || block.words[Address::N] != *run_.options.search) {
    block = {};
    return BlockOutcome::NoBlock;
  }
  run_.state.reader = ReaderState::Data;
  if (run_.options.stops_at_search) {
    run_.origin.sequence = *run_.options.search;
    run_.events().on_message(
        {run_.origin,
         fmt::format("tape search: N{:03} is the next block; what the blocks before it "
                     "had set is not in force",
                     *run_.options.search)});
    run_.events().on_stop({run_.origin, StopKind::Operator});
  }
  return execute();
}

BlockOutcome TektronixInterpreter::execute() {
  State& state = run_.state;
  const Words& words = state.block.words;
  if (words.has(Address::N)) run_.origin.sequence = words[Address::N];
  const bool winds_back = words.has(Address::M) && words[Address::M] == 30;
  if (!state.block.is_bad && !words.empty() && !execute_block(run_)) return BlockOutcome::Paused;
  close_block();
  if (state.phase == RunPhase::Ended) {
    state.is_rewound = winds_back;
    end_part(false);
  }
  return BlockOutcome::Finished;
}

void TektronixInterpreter::close_block() {
  run_.state.block = {};
  ++run_.state.blocks;
  run_.sink.on_block_end(run_.origin);
}

/// The rewind stop code, or the end of the text, where no M word has ended the program.
BlockOutcome TektronixInterpreter::end_of_data(bool is_end_code) {
  State& state = run_.state;
  state.block = {};
  if (run_.options.is_mdi) {
    run_.events().on_end({run_.origin, state.blocks, false});
    state.phase = RunPhase::Ended;
    return BlockOutcome::NoBlock;
  }
  if (is_end_code && !state.has_block && (state.part > 1 || state.reader == ReaderState::Pass)) {
    state.head = state.part;  // of this program, after an end of block in the leader
    return BlockOutcome::NoBlock;
  }
  if (is_end_code && state.reader == ReaderState::Pass) {
    end_part(true);
    return BlockOutcome::NoBlock;
  }
  if (state.reader == ReaderState::Search) {
    run_.fail(Fault::NumberNotFound, 0, fmt::format("N{:03}", *run_.options.search));
    return BlockOutcome::Paused;
  }
  if (!check_stop(run_) || !run_.object(Fault::EndWithoutM)) return BlockOutcome::Paused;
  end_run(run_, state.blocks, false);
  end_part(is_end_code);
  return BlockOutcome::NoBlock;
}

/// After the last program a looped tape begins again; a tape that was read on is over.
BlockOutcome TektronixInterpreter::end_of_text() {
  State& state = run_.state;
  if (run_.options.is_mdi || (state.part == 1 && state.wanted == 1)) return end_of_data(false);
  if (!state.has_block && state.reads_on) {
    state.phase = RunPhase::Ended;
    state.is_tape_over = true;
    return BlockOutcome::NoBlock;
  }
  const std::uint32_t programs = state.has_block ? state.part : state.part - 1;
  if (state.wanted == programs + 1) {
    run_.warn(Fault::Tape, run_.origin, 0,
              fmt::format("no program comes after program {}: the tape begins again", programs));
    state.part = state.wanted = 1;
    state.has_block = false;
    state.reader = ReaderState::Hunt;
    state.place = {};
    read_from_place();
    return BlockOutcome::NoBlock;
  }
  if (state.part < state.wanted) {
    run_.fail(Fault::ProgramNotFound, 0,
              fmt::format("program {}: it has {}", state.wanted, programs));
    return BlockOutcome::Paused;
  }
  return end_of_data(false);
}

/// Whether a block comes in the text after the program that has ended; also when it is not known.
bool TektronixInterpreter::has_more() {
  constexpr int kMaxLines = 100;
  reader_.drop_window();
  bool is_hunting = run_.state.reader == ReaderState::Hunt;
  for (int count = 0; count < kMaxLines; ++count) {
    SourceLine line;
    const LineState state = reader_.next(line);
    if (state == LineState::End) return false;
    if (state != LineState::Ready) return true;
    if (std::exchange(is_hunting, false)) {
      if (looks_like_block(line.text)) return true;  // the next start reports it
      continue;
    }
    const std::size_t first = line.text.find_first_of(kLetters);
    if (first != std::string_view::npos && first < line.text.find('(')) return true;
  }
  return true;
}

std::uint32_t TektronixInterpreter::next_part() {
  const State& state = run_.state;
  if (state.phase != RunPhase::Ended || run_.options.is_mdi) return 1;
  if (state.is_rewound) return std::max(state.head, std::uint32_t{1});
  const bool follows = has_more();
  read_from_place();
  return follows ? state.part : 1;
}

bool TektronixInterpreter::read_on() {
  State& state = run_.state;
  const bool is_possible =
      state.phase == RunPhase::Ended && !state.is_rewound && !state.is_tape_over;
  if (!is_possible || run_.options.is_mdi) return false;
  state.phase = RunPhase::Running;
  state.reads_on = true;
  state.wanted = state.part;
  return true;
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
  state.part = state.wanted = 1;
  state.head = 0;
  state.has_block = state.is_rewound = state.is_tape_over = state.reads_on = false;
  state.block = {};
  run_.origin = {};
  read_from_place();
  return {};
}

/// A jog moves the position in the program with that in the machine (README, "Decided here").
void TektronixInterpreter::find_axes(const Position& at) {
  constexpr double kSamePlace = 1e-6;  // mm
  State& state = run_.state;
  for (std::size_t i = 0; i < run_.options.axes; ++i) {
    const auto axis = static_cast<Axis>(i);
    if (std::fabs(at.raw(axis) - run_.position.raw(axis)) <= kSamePlace) continue;
    const std::int64_t from_zero = std::llround(at.raw(axis) / run_.mm_per_count) - state.origin[i];
    state.program[i] = run_.options.mirror[i] ? -from_zero : from_zero;
    run_.position.set(axis, at.linear(axis));
  }
}

ActiveModes TektronixInterpreter::modes() const {
  ActiveModes modes;
  modes.units = run_.options.is_metric() ? Units::Millimeter : Units::Inch;
  modes.is_incremental = run_.state.is_incremental;
  modes.feed = Feed::per_minute(Length::mm(run_.state.last.feed));
  return modes;
}

/// After begin_next_text: under the modes that the program before has left, the tape is read, and
/// nothing is keyed in again.
void TektronixInterpreter::begin_tape() {
  run_.state.reader = ReaderState::Hunt;
  run_.state.wanted = run_.options.part;
  run_.state.mdi_done = static_cast<std::uint32_t>(run_.options.mdi.size());
}

void TektronixInterpreter::after_restore() {
  const State& state = run_.state;
  const bool is_at_begin = state.blocks == 0 && state.place == TextPlace{};
  if (is_at_begin && state.reader == ReaderState::Data && !run_.options.is_mdi) begin_tape();
  read_from_place();
}

void TektronixInterpreter::read_from_place() {
  reader_.drop_window();
  reader_.seek(run_.state.place);
}

}  // namespace dripline::interpreter::tektronix1704

namespace dripline::interpreter {
template class BlockInterpreter<tektronix1704::TektronixInterpreter>;
}
