#include "gateway/interpreter/dialects/centurion/interpreter.hpp"

#include "gateway/interpreter/dialects/centurion/codes/execution.hpp"
#include "gateway/interpreter/dialects/centurion/codes/machine_functions.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/pattern_cycles.hpp"
#include "gateway/interpreter/dialects/centurion/flow/flow.hpp"
#include "gateway/interpreter/dialects/centurion/flow/statements.hpp"
#include "gateway/interpreter/dialects/centurion/reading/block_reader.hpp"
#include "protocol/base/invariant.hpp"

namespace dripline::interpreter::centurion {
namespace {

/// The parts of a block at its begin. Blocks copy this object, because one composed on the spot is
/// copied before its parts have reached the memory, and waits for them.
const Block::Parts kFreshParts{};

std::unique_ptr<DryRun> dry_run_of(const ControlOptions& options, EventSink& sink) {
  if (!options.is_dry_run) return nullptr;
  const Feed feed = Feed::per_minute(Length::mm(options.dry_run_feed_mm));
  return std::make_unique<DryRun>(sink, feed, options.dry_run_turns_spindle);
}
std::unique_ptr<StartSearch> start_search_of(const ControlOptions& options, EventSink& sink) {
  return options.start_at ? std::make_unique<StartSearch>(sink, *options.start_at) : nullptr;
}
EventSink& front_of(StartSearch* start, DryRun* dry_run, EventSink& sink) {
  if (start != nullptr) return *start;
  if (dry_run != nullptr) return *dry_run;
  return sink;
}

/// A cycle that follows a pattern lasts for many blocks, all others for their own.
std::string_view cycle_of(const Run& run) {
  if (run.state.pattern.phase != PatternPhase::None)
    return g_row(g_row_index(run.state.pattern.code)).name;
  if (run.block.parts.thread_code != 0) return g_row(g_row_index(run.block.parts.thread_code)).name;
  const std::uint8_t row = run.block.parts.axis_row;
  return row != kNoRow && g_row(row).kind == GKind::Cycle ? g_row(row).name : std::string_view();
}

}  // namespace

CenturionInterpreter::CenturionInterpreter(ControlOptions options, ModalState state,
                                           Parameters parameters, ProgramSource& source,
                                           EventSink& sink)
    : dry_run_(dry_run_of(options, sink)),
      start_(start_search_of(options, dry_run_ ? *dry_run_ : sink)),
      run_(std::move(options), source, front_of(start_.get(), dry_run_.get(), sink)),
      search_(run_.text),
      block_skip_(run_.options.block_skip),
      memory_units_(state.units) {
  run_.state = std::move(state);
  run_.parameters = parameters;
  run_.update_origin();
  run_.blender.set_plane(Plane::ZX);
  run_.blender.reset(run_.present_position());
  if (start_) {
    first_ = take_snapshot(run_);
    start_->attach(run_.state, run_.start);
    run_.state.is_searching = true;
    run_.start.begin();
  }
}

BlockOutcome CenturionInterpreter::run_block() {
  const BlockOutcome outcome = next_block();
  const bool has_missed_start = run_.state.phase == RunPhase::Ended && run_.state.is_searching;
  if (has_missed_start && outcome != BlockOutcome::Paused && !begin_at_first()) [[unlikely]]
    return BlockOutcome::Paused;
  return outcome;
}

BlockOutcome CenturionInterpreter::next_block() {
  if (run_.state.jump.kind != JumpKind::None) [[unlikely]] {
    if (const BlockOutcome jump = take_jump(run_, search_); jump != BlockOutcome::NoBlock)
      return jump;
  }
  if (has_pattern_pass(run_.state)) [[unlikely]] {
    make_pattern_pass(run_);
    run_.end_block();
    if (run_.may_have_failed() && !check_path(run_)) return BlockOutcome::Paused;
    ++run_.state.blocks;
    return BlockOutcome::Finished;
  }
  if (is_looking_back_) [[unlikely]] {
    if (const BlockOutcome back = find_way_back(); back != BlockOutcome::Finished) return back;
  }
  if (start_ && start_->needs_place()) [[unlikely]] {
    if (const BlockOutcome place = find_place(); place != BlockOutcome::Finished) return place;
  }
  const TextCursor::State loaded = run_.text.load(run_.state.at);
  if (loaded != TextCursor::State::Ready) [[unlikely]]
    return meet_line_state(loaded);
  Block::Parts& parts = run_.block.parts;
  if (run_.state.is_searching && !is_way_back_known_ && may_start_here()) [[unlikely]]
    return look_back();
  if (parts.stage == Stage::Start) {
    if (!begin_block()) [[unlikely]] {
      return end_without_code(run_) ? BlockOutcome::NoBlock : BlockOutcome::Paused;
    }
    if (run_.pause != Pause::None) [[unlikely]]
      return BlockOutcome::Paused;
    if (!run_.state.has_header && !run_.is_name_final) [[unlikely]]
      determine_name();
  }
  if (parts.stage == Stage::Items) {
    if (!read_items(run_) || !fits_mode()) [[unlikely]]
      return BlockOutcome::Paused;
    parts.stage = Stage::Execution;
  }
  if (run_.state.is_searching && parts.tool && start_->is_tool(run_, *parts.tool)) [[unlikely]] {
    if (!is_way_back_known_ && start_->needs_jump_back(run_)) return look_back();
    if (!start_->arrive(run_)) return BlockOutcome::Paused;
  }
  if (!execute_block(run_) || !finish_block()) [[unlikely]]
    return BlockOutcome::Paused;
  return BlockOutcome::Finished;
}

/// No block is visible: more text is needed, the program is over, or it cannot continue.
BlockOutcome CenturionInterpreter::meet_line_state(TextCursor::State state) {
  switch (state) {
    case TextCursor::State::NotYet:
      return BlockOutcome::NeedsText;
    case TextCursor::State::EndOfText:
      return end_without_code(run_) ? BlockOutcome::NoBlock : BlockOutcome::Paused;
    case TextCursor::State::TooLong:
      place_origin(run_.state.at);
      run_.fail(ErrorCode::BlockTooLong, 0, "more than 4096 characters");
      return BlockOutcome::Paused;
    default:
      place_origin(run_.state.at);
      run_.fail(ErrorCode::TextFailed, 0, run_.text.failure());
      return BlockOutcome::Paused;
  }
}

/// False at the O line of the next program in the file.
bool CenturionInterpreter::begin_block() {
  const char* begin = run_.text.begin();
  const bool is_plain = kind_of(*begin) == CharKind::Letter && upper(*begin) != 'O';
  if (!is_plain && is_end_of_segment()) [[unlikely]]
    return false;
  place_origin(run_.state.at);
  run_.origin.offset = run_.text.offset();
  run_.block.words.clear();
  run_.block.parts = kFreshParts;
  run_.block.parts.stage = Stage::Items;
  if (run_.state.is_searching && starts_here() && !start_->arrive(run_)) [[unlikely]]
    return true;  // an alarm
  if (!is_plain && is_skipped()) [[unlikely]] {
    run_.block.parts.has_code = true;
    run_.block.parts.resume = run_.offset(run_.text.end());
  }
  return true;
}

/// MDI takes one block.
bool CenturionInterpreter::fits_mode() {
  if (!run_.options.is_mdi || run_.state.blocks == 0 || !run_.block.parts.has_code) return true;
  return run_.fail(ErrorCode::IllegalStatement, 0, "a second block in MDI");
}

bool CenturionInterpreter::starts_here() const {
  const BlockHead head = read_head(run_.text.begin());
  const bool has_number = head.kind == BlockHead::Kind::Label;
  return start_->is_here(run_, has_number ? std::optional(head.number) : std::nullopt);
}

/// Whether the start may be at a block that has not been begun.
bool CenturionInterpreter::may_start_here() {
  if (run_.block.parts.stage != Stage::Start || !start_->needs_jump_back(run_)) return false;
  place_origin(run_.state.at);
  run_.origin.offset = run_.text.offset();
  return starts_here();
}

BlockOutcome CenturionInterpreter::look_back() {
  is_looking_back_ = true;
  return BlockOutcome::NoBlock;
}

/// Finished: the search has ended, and has found it or not.
BlockOutcome CenturionInterpreter::outcome_of_search(TextSearch::Outcome outcome) {
  const bool is_known =
      outcome == TextSearch::Outcome::Found || outcome == TextSearch::Outcome::Missing;
  return is_known ? BlockOutcome::Finished : refuse_search(run_, outcome);
}

BlockOutcome CenturionInterpreter::find_place() {
  std::uint64_t offset = 0;
  const TextSearch::Outcome outcome = search_.find_block(start_->wanted_place(), offset);
  const BlockOutcome result = outcome_of_search(outcome);
  if (result != BlockOutcome::Finished) return result;
  const bool is_found = outcome == TextSearch::Outcome::Found;
  start_->note_place(is_found ? std::optional(offset) : std::nullopt);
  return result;
}

BlockOutcome CenturionInterpreter::find_way_back() {
  std::uint64_t line = 0;
  const TextSearch::Outcome outcome = search_.find_jump_back(run_.state.at, line);
  const BlockOutcome result = outcome_of_search(outcome);
  if (result != BlockOutcome::Finished) return result;
  const bool is_found = outcome == TextSearch::Outcome::Found;
  start_->note_jump_back(is_found ? std::optional(line) : std::nullopt);
  is_way_back_known_ = true;
  is_looking_back_ = false;
  return result;
}

/// The program has ended before the start that was asked for.
bool CenturionInterpreter::begin_at_first() {
  if (run_.start.arrivals > 0 || start_->is_in_text()) {
    run_.state.phase = RunPhase::Running;
    return start_->begin_at_first(run_);
  }
  const bool has_header = run_.state.has_header;
  const bool is_restored = restore(*first_).has_value();
  invariant(is_restored, "the state of a moment ago reads back");
  run_.state.has_header = has_header;
  return start_->begin_at_first(run_);
}

bool CenturionInterpreter::is_end_of_segment() const {
  return run_.state.at.code_seen && read_head(run_.text.begin()).kind == BlockHead::Kind::Program;
}

bool CenturionInterpreter::is_skipped() const {
  return block_skip_ && *skip_blanks(run_.text.begin()) == '/';
}

/// The program's name comes from its first block that is not empty: the O word (block_reader.cpp
/// has it then) or else the comment; and before that block is executed (manual: program numbers).
void CenturionInterpreter::determine_name() {
  const char* at = skip_blanks(run_.text.begin());
  if (*at == '%' || is_end_of_block(*at)) return;
  const BlockHead head = read_head(at);
  if (head.kind == BlockHead::Kind::Program) return;
  if (*at == '(') {
    const char* close = at;
    while (*close != ')' && !is_end_of_block(*close)) ++close;
    if (run_.name.empty() && *close == ')') run_.name.assign(at + 1, close);
  }
  run_.is_name_final = head.kind != BlockHead::Kind::Empty;
}

bool CenturionInterpreter::finish_block() {
  if (!leave_block(run_)) return false;
  if (run_.state.pattern.phase != PatternPhase::None && !leave_pattern_block(run_)) [[unlikely]]
    return false;
  run_.end_block();
  if (run_.may_have_failed() && !check_path(run_)) [[unlikely]]
    return false;
  ++run_.state.blocks;
  run_.block.parts.stage = Stage::Start;
  return true;
}

Result<void> CenturionInterpreter::take_answer(const Answer& answer) {
  if (const auto* prompt = std::get_if<PromptAnswer>(&answer)) {
    if (prompt->text && !is_input_answer(*prompt->text)) {
      return fail(Errc::Syntax, "{}: \"{}\" is not a number",
                  std::get<PromptQuestion>(run_.question).variable, *prompt->text);
    }
  }
  run_.answers.push_back(answer);
  run_.answers_used = 0;
  return {};
}

/// What the control's status window shows for the block that was executed last.
ActiveModes CenturionInterpreter::modes() const {
  const ModalState& state = run_.state;
  const auto tool = [&](ToolField field) {
    return run_.length(run_.parameters.tool(state.tool.offset, field));
  };
  ActiveModes modes;
  modes.units = state.units;
  modes.is_incremental = state.modes.is_incremental;
  modes.compensation = static_cast<CompensationSide>(state.modes.compensation);
  modes.work_system = static_cast<std::uint16_t>(540 + 10 * state.modes.work_system);
  if (!state.tool.has_no_length) {
    modes.tool_length_x = tool(ToolField::LengthX);
    modes.tool_length_z = tool(ToolField::LengthZ);
  }
  modes.tool_radius = tool(ToolField::Radius);
  modes.is_shifted =
      state.local_zero != Point{} || state.floating_zero != Point{} || state.transformation.is_on();
  modes.feed = run_.active_feed();
  modes.cycle = cycle_of(run_);
  return modes;
}

Result<void> CenturionInterpreter::begin_next_text() {
  ModalState& state = run_.state;
  if (state.modes.compensation != 0 || state.is_searching)
    return fail(Errc::Unsupported, "nose compensation is on");
  state.phase = RunPhase::Running;
  state.has_header = false;
  state.blocks = 0;
  state.at = {};
  state.uses_compensator = false;
  state.open_device.reset();
  state.calls.clear();
  state.gosubs.clear();
  state.loops.clear();
  state.jump = {};
  state.pattern = {};
  state.before_pattern.clear();
  run_.origin = {};
  run_.name.clear();
  run_.is_name_final = false;
  after_restore();
  return {};
}

void CenturionInterpreter::after_restore() {
  run_.text.invalidate();
  run_.block.clear();
  run_.answers.clear();
  run_.answers_used = 0;
}

}  // namespace dripline::interpreter::centurion

namespace dripline::interpreter {
template class BlockInterpreter<centurion::CenturionInterpreter>;
}
