#include "gateway/interpreter/dialects/tnc155/interpreter.hpp"

#include <fmt/core.h>
#include <utility>

#include "gateway/interpreter/dialects/tnc155/cycles/cycles.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/coordinate_frame.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/execution.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/flow.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/path.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/tools.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/blend_ahead.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

std::unique_ptr<StartGate> gate_of(const State& state, EventSink& sink) {
  return state.start.is_searching ? std::make_unique<StartGate>(sink) : nullptr;
}

}  // namespace

TncInterpreter::TncInterpreter(ControlOptions options, State state,
                               std::vector<ToolDefinition> tools, ProgramSource& source,
                               EventSink& sink, std::vector<ToolName> tool_names)
    : gate_(gate_of(state, sink)),
      run_(std::move(options), source, gate_ ? *gate_ : sink),
      search_(source, {run_.options.iso_continuation, {}, run_.options.is_itnc}),
      calls_ahead_(source, {run_.options.iso_continuation, {}, run_.options.is_itnc}),
      definitions_ahead_(source, {run_.options.iso_continuation, {}, run_.options.is_itnc}),
      way_back_(source, {run_.options.iso_continuation, {}, run_.options.is_itnc}) {
  run_.state = std::move(state);
  run_.reader.set_block_skip(run_.options.block_skip);
  if (gate_) gate_->attach(run_.state.start);
  run_.tools = std::move(tools);
  run_.tool_names = std::move(tool_names);
  run_.reset_stages();
}

BlockOutcome TncInterpreter::run_block() {
  if (!run_.state.are_calls_checked) [[unlikely]] {
    BlockOutcome outcome = check_labels();
    if (outcome == BlockOutcome::Finished) outcome = check_calls();
    if (outcome != BlockOutcome::Finished) return outcome;
  }
  if (run_.state.jump.kind != JumpKind::None) [[unlikely]] {
    const BlockOutcome jump = take_jump(run_, search_);
    run_.reader.drop_window();
    if (jump != BlockOutcome::NoBlock) return jump;
  }
  const BlockOutcome outcome = next_block();
  const bool has_ended = outcome == BlockOutcome::Finished && run_.state.phase == RunPhase::Ended;
  if (has_ended && run_.state.start.is_searching) [[unlikely]] {
    run_.fail(ErrorCode::BlockNotAddressed, unmet_start());
    return BlockOutcome::Paused;
  }
  return outcome;
}

BlockOutcome TncInterpreter::next_block() {
  if (!run_.is_in_block) {
    const BlockOutcome outcome = read();
    if (outcome != BlockOutcome::Finished || !run_.is_in_block) [[unlikely]]
      return outcome;
  }
  if (!execute_parts()) [[unlikely]]
    return BlockOutcome::Paused;
  return finish_block() ? BlockOutcome::Finished : BlockOutcome::Paused;
}

/// A label that is set twice is an alarm at the begin of the run.
BlockOutcome TncInterpreter::check_labels() {
  const BlockOutcome outcome = check_first_labels(run_, search_, kMainProgram);
  run_.reader.drop_window();
  if (outcome != BlockOutcome::Paused) return outcome;
  run_.origin.block = blocks() + 1;
  if (name_program()) return outcome;
  run_.pause = Pause::None;
  return BlockOutcome::NeedsText;
}

/// As the first block does, without executing it: for the alarm of a run that does not begin.
/// False: its text is not here.
bool TncInterpreter::name_program() {
  ReadingState& reading = run_.state.reading;
  BlockParts parts;
  run_.reader.seek({});
  const ReadState read = run_.reader.next(reading, parts);
  if (read != ReadState::Ready) return read != ReadState::NotYet;
  run_.state.program_number = reading.program.number;
  run_.state.units = reading.program.units;
  if (run_.options.is_itnc) run_.state.program_name = parts.itnc.name;
  return true;
}

/// A called program that is missing is an alarm at the begin of the run.
BlockOutcome TncInterpreter::check_calls() {
  const bool is_wanted = run_.options.checks_calls && !run_.options.blockwise_restrictions;
  const auto outcome =
      is_wanted ? calls_ahead_.find_missing_program() : AheadSearch::Outcome::Missing;
  run_.reader.drop_window();
  if (outcome == AheadSearch::Outcome::NotYet) return BlockOutcome::NeedsText;
  run_.state.are_calls_checked = true;
  if (outcome != AheadSearch::Outcome::Found) return BlockOutcome::Finished;
  run_.state.program_number = calls_ahead_.program().number;
  run_.state.units = calls_ahead_.program().units;
  place_origin(calls_ahead_.place());
  run_.origin.sequence = calls_ahead_.block_number();
  fail_unavailable(run_, calls_ahead_.missing_program());
  return BlockOutcome::Paused;
}

/// A tool may be defined after its call.
BlockOutcome TncInterpreter::find_definition() {
  for (const Block& part : run_.parts) {
    const std::uint64_t reach = reach_of_definition(run_, part);
    if (reach == 0) continue;
    const auto outcome = definitions_ahead_.find_tool(part.target, reach);
    run_.reader.drop_window();
    if (outcome == AheadSearch::Outcome::NotYet) return BlockOutcome::NeedsText;
    if (outcome == AheadSearch::Outcome::More) return BlockOutcome::MoreFollows;
    if (outcome == AheadSearch::Outcome::Found) {
      run_.definition_ahead = {definitions_ahead_.definition(), definitions_ahead_.units()};
    }
  }
  return BlockOutcome::Finished;
}

/// Reads ahead what the block needs from the text after it.
BlockOutcome TncInterpreter::look_ahead() {
  peeked_blend_ = false;
  if (is_start()) {
    if (const BlockOutcome back = find_way_back(); back != BlockOutcome::Finished) return back;
  }
  const BlockParts& parts = run_.parts;
  if (parts.count == 0) return BlockOutcome::Finished;
  const bool is_move = is_positioning(parts.blocks[parts.count - 1]);
  if (!is_move || parts.count > 1) {
    const BlockOutcome outcome = is_definition_known_ ? BlockOutcome::Finished : find_definition();
    is_definition_known_ = outcome == BlockOutcome::Finished;
    if (!is_definition_known_ || !is_move) return outcome;
  }
  // A corner is known from the block after it: that block is read first.
  std::string_view next;
  const ReadState state = run_.reader.peek(run_.state.reading, next);
  if (state == ReadState::NotYet) return BlockOutcome::NeedsText;
  peeked_blend_ = state == ReadState::Ready && is_blend_next(next);
  run_.contour_begin.reset();  // the direction of an approach is that of the contour after it
  if (parts.blocks[parts.count - 1].kind == BlockKind::Approach && state == ReadState::Ready &&
      run_.reader.read_peeked(run_.state.reading, parts_ahead_))
    run_.contour_begin = parts_ahead_.blocks[0];
  return BlockOutcome::Finished;
}

/// In ISO a corner may come after other words, whose own blocks of plain language come first.
bool TncInterpreter::is_blend_next(std::string_view text) {
  const ReadingState& reading = run_.state.reading;
  return may_be_blend(text, reading.program.form) &&
         run_.reader.read_peeked(reading, parts_ahead_) && parts_ahead_.count != 0 &&
         is_blend(parts_ahead_.blocks[0]);
}

/// A block whose successor has not arrived is kept, and the run stays before it.
BlockOutcome TncInterpreter::read() {
  const ReadingState before = run_.state.reading;
  const bool was_kept = std::exchange(has_kept_block_, false);
  if (was_kept) run_.state.reading = after_kept_block_;
  is_definition_known_ &= was_kept;
  switch (was_kept ? ReadState::Ready : run_.reader.next(run_.state.reading, run_.parts)) {
    case ReadState::Ready:
      break;
    case ReadState::NotYet:
      return BlockOutcome::NeedsText;
    case ReadState::End:
      return meet_end();
    case ReadState::Failed:
      place_origin(run_.reader.place());
      run_.fail(ErrorCode::TextFailed, run_.reader.reason());
      return BlockOutcome::Paused;
    case ReadState::Wrong:
      place_origin(run_.reader.place());
      run_.origin.line = run_.reader.fault_line();
      run_.fail_as(run_.reader.fault().code, run_.reader.fault().text());
      run_.alarm.column = run_.reader.fault().column;
      return BlockOutcome::Paused;
  }
  if (const BlockOutcome ahead = look_ahead(); ahead != BlockOutcome::Finished) {
    after_kept_block_ = std::exchange(run_.state.reading, before);
    has_kept_block_ = true;
    return ahead;
  }
  if (run_.options.strict_numbers && !check_number()) return BlockOutcome::Paused;
  place_origin(run_.reader.block_place());
  if (run_.parts.count != 0) run_.origin.sequence = run_.parts.blocks[0].number;
  run_.state.at = run_.reader.place();
  run_.is_in_block = true;
  part_ = 0;
  if (run_.parts.sorts_distances) [[unlikely]]
    warn_of_distance(run_);
  if (is_start() && !arrive_at_start()) return BlockOutcome::Paused;
  return BlockOutcome::Finished;
}

/// The number of the block read last.
std::int32_t TncInterpreter::block_number() const {
  if (run_.parts.count != 0) return run_.parts.blocks[0].number;
  const bool is_iso = run_.state.reading.program.form == Form::Iso;
  return is_iso ? run_.reader.iso_block().number : Block::kNone;
}

bool TncInterpreter::is_start() const {
  const StartState& start = run_.state.start;
  return start.is_searching && run_.reader.block_place().program == kMainProgram &&
         block_number() == start.block;
}

/// False: the state there cannot be rebuilt.
bool TncInterpreter::arrive_at_start() {
  StartState& start = run_.state.start;
  ++start.arrivals;
  if (start.pass != 0 && start.arrivals != start.pass) return true;
  return begin_at_block(run_, start.block, came_back_.value_or(-1));
}

std::string TncInterpreter::unmet_start() const {
  const StartState& start = run_.state.start;
  if (start.arrivals == 0) return fmt::format("block {}", start.block);
  return fmt::format("pass {} of block {}: the program comes there {} times", start.pass,
                     start.block, start.arrivals);
}

/// Without a label before it the program comes to a block once.
BlockOutcome TncInterpreter::find_way_back() {
  if (came_back_ || run_.state.start.pass != 0 || run_.state.known_labels.empty())
    return BlockOutcome::Finished;
  const TextPlace place = run_.reader.block_place();
  const auto outcome = way_back_.find_return(place);
  run_.reader.drop_window();
  if (outcome == AheadSearch::Outcome::NotYet) return BlockOutcome::NeedsText;
  if (outcome == AheadSearch::Outcome::More) return BlockOutcome::MoreFollows;
  came_back_ = outcome == AheadSearch::Outcome::Found ? way_back_.block_number() : -1;
  return BlockOutcome::Finished;
}

/// Blocks of plain language have consecutive numbers.
bool TncInterpreter::check_number() {
  std::int32_t& due = run_.state.number_due;
  if (run_.state.reading.program.form != Form::Plain) return true;
  const std::int32_t number = run_.parts.blocks[0].number;
  const std::int32_t wanted = std::exchange(due, number == Block::kNone ? 1 : number + 1);
  if (wanted == Block::kNone || number == wanted) return true;
  place_origin(run_.reader.block_place());
  return run_.fail(ErrorCode::BlockNumberOrder,
                   number == Block::kNone ? fmt::format("no number where {} was due", wanted)
                                          : fmt::format("{} where {} was due", number, wanted));
}

/// The text ends without END PGM: the program ends as with it, after a check of the last moves.
BlockOutcome TncInterpreter::meet_end() {
  place_origin(run_.reader.place());
  if (run_.options.is_mdi && is_defining(run_)) {
    run_.fail(ErrorCode::CycleIncomplete, fmt::format("CYCL DEF {}", run_.state.cycle.defining));
    return BlockOutcome::Paused;
  }
  end_program(run_, false);
  return check_moves() ? BlockOutcome::Finished : BlockOutcome::Paused;
}

bool TncInterpreter::execute_parts() {
  const BlockParts& parts = run_.parts;
  for (; part_ < parts.count; ++part_) {
    const bool is_last = part_ + 1 == parts.count;
    run_.blend_follows = is_last ? peeked_blend_ : is_blend(parts.blocks[part_ + 1]);
    if (!execute(run_, parts.blocks[part_])) return false;
    // a fault of this part in the contour comes before the faults of the next part
    if (run_.state.uses_stages && !is_last && !check_stages(run_)) return false;
    if (run_.state.jump.kind != JumpKind::None && !is_last) [[unlikely]] {
      return run_.fail(ErrorCode::BlockFormatIncorrect,
                       "a program is called before the end of its block");
    }
    run_.answer.reset();
    if (run_.state.phase == RunPhase::Ended) [[unlikely]]
      break;
  }
  return true;
}

/// Whether the moves up to here have met a limit or broken a rule of the contour.
bool TncInterpreter::check_moves() {
  if (run_.limits.reached()) [[unlikely]]
    return run_.fail_at_limit();
  if (run_.tilted.fault()) [[unlikely]]
    return run_.fail_in_tilt();
  return !run_.state.uses_stages || check_stages(run_);
}

bool TncInterpreter::finish_block() {
  if (!check_moves()) [[unlikely]]
    return false;
  run_.is_in_block = false;
  if (run_.state.start.is_searching) [[unlikely]]
    note_contour_start(run_, block_number());
  run_.end_block();
  ++run_.state.blocks;
  return !run_.state.uses_stages || check_stages(run_);
}

Result<void> TncInterpreter::take_answer(const Answer& answer) {
  run_.answer = answer;
  return {};
}

ActiveModes TncInterpreter::modes() const {
  const State& state = run_.state;
  ActiveModes modes;
  modes.units = state.units;
  if (state.compensation == Compensation::Left) modes.compensation = CompensationSide::Left;
  if (state.compensation == Compensation::Right) modes.compensation = CompensationSide::Right;
  modes.tool_length_z = Length::mm(state.tool.data.length);
  if (state.tool.is_called) modes.length_axis = state.tool.axis;
  modes.is_length_plain = !run_.tilted.is_on();
  modes.is_length_certain = !run_.is_length_doubtful && !run_.tilted.is_on();
  modes.tool_radius = Length::mm(state.tool.data.radius);
  modes.feed = Feed::per_minute(Length::mm(state.feed));
  if (state.tool.is_called) modes.tool_axis = state.tool.axis;
  modes.frame_changes = run_.frame_changes;
  return modes;
}

std::optional<CoordinateFrame> TncInterpreter::frame() const {
  if (run_.tilted.is_on()) return std::nullopt;
  return frame_of(run_.state);
}

std::vector<std::string> TncInterpreter::live_names() const {
  std::vector<std::string> names;
  names.reserve(run_.state.q.size());
  for (std::size_t i = 0; i < run_.state.q.size(); ++i)
    names.push_back(parameter_name(static_cast<std::int32_t>(i)));
  return names;
}

bool TncInterpreter::read_live(std::vector<double>& values) {
  if (q_seen_ == run_.q_changes) return false;
  q_seen_ = run_.q_changes;
  values = run_.state.q;
  return true;
}

Result<void> TncInterpreter::begin_next_text() {
  State& state = run_.state;
  if (state.is_compensating()) return fail(Errc::Unsupported, "radius compensation is on");
  if (run_.tilted.is_on())
    return fail(Errc::Unsupported,
                "a tilted plane or M128 was in force, and ended with its program");
  state.phase = RunPhase::Running;
  state.has_header = state.are_calls_checked = false;
  state.blocks = 0;
  state.at = {};
  state.number_due = Block::kNone;
  state.reading = {};
  state.units = Units::Millimeter;
  state.program_number = -1;
  state.program_name.clear();
  state.uses_stages = state.joins = state.is_parallel = state.needs_side = false;
  state.has_compensated = state.awaits_contour = state.is_restart = false;
  state.has_positioned = true;
  state.labels.clear();
  state.programs.clear();
  state.known_labels.clear();
  state.jump = {};
  state.start = {};
  run_.origin = {};
  after_restore();
  return {};
}

std::string TncInterpreter::travel_fault(const Position& from, const Position& to) {
  EventSink none;
  TravelLimits limits(none, run_.options.limit_low, run_.options.limit_high);
  limits.check_line({}, from, to);
  return limits.reached() ? text_of(*limits.reached()) : std::string();
}

void TncInterpreter::after_restore() {
  run_.reader.drop_window();
  run_.reader.seek(run_.state.at);
  run_.is_in_block = false;
  has_kept_block_ = false;
  run_.definition_ahead.reset();
  run_.called.reset();
  run_.mask.reset();
  run_.answer.reset();
  ++run_.q_changes;
}

}  // namespace dripline::interpreter::tnc155

namespace dripline::interpreter {
template class BlockInterpreter<tnc155::TncInterpreter>;
}
