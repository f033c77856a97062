#include "gateway/interpreter/dialects/rs274ngc/interpreter.hpp"

#include <algorithm>
#include <span>

#include "gateway/interpreter/dialects/rs274ngc/compensation/compensation.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/coordinates.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/execution.hpp"
#include "gateway/interpreter/dialects/rs274ngc/execution/splines.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/block_reader.hpp"
#include "gateway/interpreter/dialects/rs274ngc/reading/words.hpp"
#include "gateway/interpreter/dialects/rs274ngc/turning/turning.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

/// Lines passed over in one step at most.
constexpr std::uint64_t kMaxPassedOver = 65'536;

/// An editor's, in front of the program.
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

bool is_blank_line(const char* at) {
  return is_end_of_line(*skip_blanks(at));
}

}  // namespace

Rs274NgcInterpreter::Rs274NgcInterpreter(ControlOptions options, std::vector<Tool> tools,
                                         State state, const Parameters& parameters,
                                         ProgramSource& source, EventSink& sink)
    : run_(std::move(options), std::move(tools), source, sink), flow_(run_) {
  run_.state = std::move(state);
  run_.parameters = parameters;
  run_.state.position = to_program(run_, values_of(run_.state.machine));
}

// What `run_block` calls for every line is inline, and used in this file alone: a call of one
// costs as much as what it does.

/// The search for the place that a block leads to belongs to the block: the state after it is the
/// same whether the place was known or not.
BlockOutcome Rs274NgcInterpreter::run_block() {
  BlockOutcome outcome = run_line();
  if (outcome == BlockOutcome::Finished && run_.state.skip.until != SkipFor::Nothing) [[unlikely]] {
    const Origin origin = run_.origin;
    do {
      outcome = run_line();
      if (outcome == BlockOutcome::NoBlock && ++passed_over_ == kMaxPassedOver)
        return BlockOutcome::MoreFollows;
    } while (outcome == BlockOutcome::NoBlock && run_.state.skip.until != SkipFor::Nothing);
    if (outcome != BlockOutcome::NoBlock) return outcome;
    run_.origin = origin;
    return BlockOutcome::Finished;
  }
  if (outcome == BlockOutcome::NoBlock && ++passed_over_ == kMaxPassedOver) [[unlikely]]
    return BlockOutcome::MoreFollows;
  return outcome;
}

/// Makes the next line visible, its end readable.
inline bool Rs274NgcInterpreter::load_line(LineState& outcome) {
  LineReader& reader = run_.reader;
  if (!(reader.place() == run_.state.at)) reader.seek(run_.state.at);
  SourceLine line;
  outcome = reader.next(line);
  place_origin(run_.state.at);
  if (outcome != LineState::Ready) [[unlikely]]
    return false;
  run_.here = line.place;
  // One by one: the reader has only just counted, and a copy of all at once would wait for it.
  run_.next.program = reader.place().program;
  run_.next.offset = reader.place().offset;
  run_.next.line = reader.place().line;
  run_.line_begin = line.text.data();
  if (run_.next.offset - run_.here.offset == line.text.size()) [[unlikely]] {
    std::copy(line.text.begin(), line.text.end(), run_.last_line.begin());
    run_.last_line[line.text.size()] = '\n';
    run_.line_begin = run_.last_line.data();
  }
  run_.line_end = run_.line_begin + line.text.size();
  return true;
}

inline BlockOutcome Rs274NgcInterpreter::run_line() {
  Block& block = run_.block;
  if (block.stage == Stage::Start) [[likely]] {
    LineState line{};
    if (flow_.wants_file()) [[unlikely]] {
      if (!flow_.look_up_file()) return BlockOutcome::Paused;
      run_.state.at = run_.next;
      return BlockOutcome::NoBlock;
    }
    if (!load_line(line)) [[unlikely]]
      return meet_no_line(line);
    if (run_.state.skip.until != SkipFor::Nothing) [[unlikely]] {
      block.clear();
      if (!flow_.pass_over()) return BlockOutcome::Paused;
      run_.state.at = run_.next;
      return BlockOutcome::NoBlock;
    }
    block.clear();
    if (!execute()) [[unlikely]]
      return BlockOutcome::Paused;
  } else if (!finish_words()) {
    return BlockOutcome::Paused;
  }
  return finish_line();
}

BlockOutcome Rs274NgcInterpreter::meet_no_line(LineState state) {
  switch (state) {
    case LineState::NotYet:
      return BlockOutcome::NeedsText;
    case LineState::End:
      if (run_.options.is_mdi && run_.state.calls.empty() && run_.state.frames.empty())
        return end_of_mdi();
      run_.next = run_.state.at;
      if (!flow_.end_of_text()) return BlockOutcome::Paused;
      run_.state.at = run_.next;
      return BlockOutcome::NoBlock;
    case LineState::TooLong:
      run_.fail(ErrorCode::CommandTooLong, 0);
      return BlockOutcome::Paused;
    default:
      run_.fail(ErrorCode::TextFailed, 0, run_.reader.reason());
      return BlockOutcome::Paused;
  }
}

BlockOutcome Rs274NgcInterpreter::end_of_mdi() {
  if (!check_nurbs_closed(run_)) return BlockOutcome::Paused;
  release_held(run_);
  run_.events().on_end({run_.origin, run_.state.blocks, false});
  run_.state.phase = RunPhase::Ended;
  return BlockOutcome::NoBlock;
}

Result<void> Rs274NgcInterpreter::begin_next_text() {
  State& state = run_.state;
  if (state.compensation.side != Side::Off || !run_.held.empty())
    return fail(Errc::Unsupported, "cutter compensation is on");
  state.phase = RunPhase::Running;
  state.has_header = false;
  state.demarcation = Demarcation::Unknown;
  state.blocks = 0;
  state.at = {};
  state.sequence = Origin::kNone;
  state.frames.clear();
  state.calls.clear();
  state.labels.clear();
  state.label_names.clear();
  state.skip = {};
  state.passes = 0;
  if (state.turning.code != 0) end_recording(run_);
  run_.origin = {};
  run_.block.stage = Stage::Start;
  after_restore();
  return {};
}

/// The first line of a program that is not blank shows how its end is marked (NIST 3.3).
bool Rs274NgcInterpreter::meet_percent(const char* at, bool& is_end) {
  State& state = run_.state;
  is_end = false;
  const bool is_alone = is_blank_line(at + 1);
  const bool is_main = state.at.program == kMainProgram;
  if (is_alone && is_main && state.demarcation == Demarcation::Unknown) {
    state.demarcation = Demarcation::Percent;
    return true;
  }
  if (is_alone && (!is_main || state.demarcation == Demarcation::Percent)) {
    is_end = is_main;
    return true;
  }
  return run_.fail(ErrorCode::BadCharacter, run_.column(at), "'%'");
}

inline bool Rs274NgcInterpreter::execute() {
  State& state = run_.state;
  const char* at = skip_blanks(run_.line_begin);
  if (*at == kByteOrderMark.front() && run_.here.offset == 0) [[unlikely]] {
    const std::string_view line(at, static_cast<std::size_t>(run_.line_end - at));
    if (line.starts_with(kByteOrderMark)) at = skip_blanks(at + kByteOrderMark.size());
  }
  if (*at == '%') [[unlikely]] {
    bool is_end = false;
    if (!meet_percent(at, is_end)) return false;
    if (is_end) {
      if (!check_nurbs_closed(run_)) return false;
      release_held(run_);
      state.phase = RunPhase::Ended;
    }
    return true;
  }
  if (state.demarcation == Demarcation::Unknown) [[unlikely]] {
    if (!is_end_of_line(*at)) state.demarcation = Demarcation::None;
  }
  bool is_skip = *at == '/';
  if (is_skip && run_.block_skip && run_.is_linuxcnc()) [[unlikely]]
    return true;
  if ((is_skip || upper(*at) == 'N') && !read_line_head(run_, at, is_skip)) [[unlikely]]
    return false;
  if (upper(*at) == 'O' && run_.is_linuxcnc()) [[unlikely]]
    return execute_oword(at);
  return execute_words(at, is_skip && run_.block_skip);
}

bool Rs274NgcInterpreter::execute_oword(const char* at) {
  if (!flow_.execute(at)) return false;
  return !is_contour_complete(run_.state) || make_turning(run_);
}

inline bool Rs274NgcInterpreter::execute_words(const char* at, bool is_skipped) {
  if (!read_items(run_, at) || !check_line(run_)) [[unlikely]]
    return false;
  if (is_skipped) [[unlikely]] {  // read, so that its errors are reported, and left out
    run_.block.clear();
    return true;
  }
  if (run_.state.turning.code != 0) [[unlikely]]
    return record_contour_line(run_);
  run_.block.stage = Stage::Before;
  return finish_words();
}

inline bool Rs274NgcInterpreter::finish_words() {
  if (!execute_line(run_)) [[unlikely]]
    return false;
  if (is_turning_cycle(run_.block.motion)) [[unlikely]]
    return flow_.call_contour(static_cast<std::int64_t>(run_.block.words['Q']));
  const int stop = run_.block.m(MGroup::Stop);
  return stop < 98 || flow_.execute_fanuc(stop);
}

inline BlockOutcome Rs274NgcInterpreter::finish_line() {
  State& state = run_.state;
  if (state.phase == RunPhase::Ended) [[unlikely]] {
    run_.events().on_end({run_.origin, state.blocks + 1, run_.block.m(MGroup::Stop) == 30});
  }
  if (run_.held.empty()) [[likely]] {
    run_.sink.on_block_end(run_.origin);
  } else {
    run_.held.on_block_end(run_.origin);
  }
  ++state.blocks;
  state.at = run_.next;
  run_.block.stage = Stage::Start;
  run_.signals.clear();
  return BlockOutcome::Finished;
}

Result<void> Rs274NgcInterpreter::take_answer(const Answer& answer) {
  run_.answer = answer;
  return {};
}

ActiveModes Rs274NgcInterpreter::modes() const {
  const State& state = run_.state;
  ActiveModes modes;
  modes.units = state.units;
  modes.is_incremental = state.modes.is_incremental;
  modes.compensation = static_cast<CompensationSide>(state.compensation.side);
  const int system = state.system;  // 7 to 9 are G59.1 to G59.3
  modes.work_system = static_cast<std::uint16_t>(system <= 6 ? 530 + 10 * system : 584 + system);
  modes.tool_length_x = Length::mm(state.tool_length[index_of(Axis::X)]);
  modes.tool_length_y = Length::mm(state.tool_length[index_of(Axis::Y)]);
  modes.tool_length_z = Length::mm(state.tool_length[index_of(Axis::Z)]);
  const auto others = std::span(state.tool_length).subspan(index_of(Axis::Z) + 1);
  modes.is_length_plain = std::ranges::all_of(others, [](double length) { return length == 0; });
  modes.is_length_certain = modes.is_length_plain;
  modes.tool_radius = Length::mm(state.compensation.radius);
  const bool is_inverse = state.modes.feed == FeedMode::InverseTime;
  modes.feed = is_inverse ? Feed::inverse_time(0) : run_.modal_feed();
  modes.cycle = hole_cycle_name(state.modes.motion / 10);
  modes.frame_changes = run_.frame_changes;
  return modes;
}

std::optional<CoordinateFrame> Rs274NgcInterpreter::frame() const {
  return frame_of(run_);
}

void Rs274NgcInterpreter::before_alarm() {
  run_.held.drop();
  if (run_.state.turning.code != 0) end_recording(run_);
}

void Rs274NgcInterpreter::after_restore() {
  run_.reader.drop_window();
  run_.block.clear();
  run_.answer.reset();
  run_.signals.clear();
  run_.expressions.clear();
  flow_.reset();
}

}  // namespace dripline::interpreter::rs274ngc

namespace dripline::interpreter {
template class BlockInterpreter<rs274ngc::Rs274NgcInterpreter>;
}
