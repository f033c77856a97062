#include "gateway/interpreter/dialects/fanuc/interpreter.hpp"

#include <fmt/core.h>

#include "gateway/interpreter/dialects/fanuc/execution/execution.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/flow.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/length_in_axes.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/tool_offsets.hpp"
#include "gateway/interpreter/dialects/fanuc/reading/block_reader.hpp"

namespace dripline::interpreter::fanuc {
FanucInterpreter::FanucInterpreter(ControlOptions options, ModalState state, const Memory& memory,
                                   ProgramSource& source, EventSink& sink)
    : run_(std::move(options), source, sink), search_(run_) {
  run_.state = std::move(state);
  run_.memory = memory;
  run_.update_increments();
  run_.update_origin();
  run_.update_special();
  run_.lead_stages();
}

BlockOutcome FanucInterpreter::run_block() {
  if (run_.state.jump.kind != JumpKind::None) [[unlikely]] {
    if (const BlockOutcome jump = take_jump(run_, search_); jump != BlockOutcome::NoBlock)
      return jump;
  }
  const bool is_new = run_.block.parts.stage == Stage::Start;
  const TextCursor::State loaded = run_.text.load(run_.state.at);
  if (loaded != TextCursor::State::Ready) [[unlikely]]
    return meet_line_state(loaded);
  if (is_new) {
    const BlockOutcome outcome = read();
    if (outcome != BlockOutcome::Finished) [[unlikely]]
      return outcome;
  } else {
    run_.answers_used = answers_of_reading_;
  }
  if (is_plain()) [[likely]] {
    if (!execute_plain(run_)) return BlockOutcome::Paused;
  } else {
    if (is_new) open_ledger(run_);
    if (!execute_block(run_)) return BlockOutcome::Paused;
    if (run_.ledger.left() != 0 && !report_left_words(run_)) [[unlikely]]
      return BlockOutcome::Paused;
  }
  return finish_block() ? BlockOutcome::Finished : BlockOutcome::Paused;
}

/// Nothing but G00 to G03, the words of a move and F, and no mode that makes more of them.
bool FanucInterpreter::is_plain() const {
  constexpr AddressSet kLineWords = kAxisWords | set_of(F, N);
  constexpr AddressSet kArcWords = kLineWords | kCenterWords | set_of(R);
  const Block& block = run_.block;
  if (block.parts.kind != BlockKind::Nc || run_.state.is_special ||
      (block.parts.groups & ~(1u << kMotionGroup)) != 0 || block.parts.one_shot != Block::kNoCode ||
      block.parts.m_count != 0) {
    return false;
  }
  const std::uint8_t motion =
      block.names(kMotionGroup) ? block.g[kMotionGroup] : run_.state.g[kMotionGroup];
  return motion <= 3 && (block.words.present() & ~(motion <= 1 ? kLineWords : kArcWords)) == 0;
}

BlockOutcome FanucInterpreter::read() {
  const char c = *run_.text.begin();
  place_origin(run_.state.at);
  run_.block.words.clear();
  run_.block.parts = kFreshParts;
  run_.answers_used = 0;
  if (c == '%' || upper(c) == 'O' || c == ':' || c == '(' || kind_of(c) == CharKind::Blank)
      [[unlikely]] {
    is_leader_ = false;
    if (!begin_other_block()) return BlockOutcome::Paused;
    if (is_leader_) return BlockOutcome::NoBlock;
  }
  if (!read_block(run_)) [[unlikely]]
    return BlockOutcome::Paused;
  Block& block = run_.block;
  answers_of_reading_ = run_.answers_used;
  if (!run_.name_is_settled && block.parts.has_code) [[unlikely]]
    determine_name();
  if (run_.origin.sequence != Origin::kNone) {
    run_.state.last.n = static_cast<int>(run_.origin.sequence);
  }
  for (std::size_t i = 0; i < block.parts.warning_count; ++i) {
    const auto& warning = block.warnings[i];
    const bool is_lower_case = *warning.row == WarningCode::LowerCase;
    if (is_lower_case && run_.state.told_lower_case) continue;
    run_.state.told_lower_case |= is_lower_case;
    run_.warn(*warning.row, warning.column);
  }
  block.parts.stage = Stage::Execution;
  return BlockOutcome::Finished;
}

/// A tape's leader is skipped; % after it, or an O word after code, is the end of the record.
bool FanucInterpreter::begin_other_block() {
  TextPosition& at = run_.state.at;
  const BlockHead head = read_head(run_.text.begin(), run_.text.end());
  if (head.kind == BlockHead::Kind::Percent && !at.head_seen) {
    run_.text.advance(at, run_.text.end());
    at.head_seen = true;
    is_leader_ = true;
    return true;
  }
  const bool is_next_program = head.kind == BlockHead::Kind::Program && at.code_seen;
  return (head.kind != BlockHead::Kind::Percent && !is_next_program) || fail_at_end_of_record(run_);
}

/// No block is visible: more text is needed, the record is over, or it cannot continue.
BlockOutcome FanucInterpreter::meet_line_state(TextCursor::State state) {
  if (state == TextCursor::State::NotYet) return BlockOutcome::NeedsText;
  if (state == TextCursor::State::EndOfText && run_.options.is_mdi && run_.state.calls.empty()) {
    if (run_.state.is_compensating()) run_.compensator.cancel();
    run_.events().on_end({run_.origin, run_.state.blocks, false});
    run_.state.phase = RunPhase::Ended;
    return BlockOutcome::NoBlock;
  }
  if (run_.block.parts.stage == Stage::Start) place_origin(run_.state.at);
  switch (state) {
    case TextCursor::State::EndOfText:
      fail_at_end_of_record(run_);
      break;
    case TextCursor::State::TooLong:
      run_.fail(ErrorCode::LineTooLong, 0, fmt::format("more than {} characters", kMaxLineBytes));
      break;
    default:
      run_.fail(ErrorCode::TextFailed, 0, run_.text.failure());
      break;
  }
  return BlockOutcome::Paused;
}

Result<void> FanucInterpreter::begin_next_text() {
  ModalState& state = run_.state;
  if (state.is_compensating()) return fail(Errc::Unsupported, "cutter compensation is on");
  state.phase = RunPhase::Running;
  state.has_header = false;
  state.blocks = 0;
  state.at = {};
  state.uses_compensator = state.uses_blender = false;
  state.calls.clear();
  state.loops.clear();
  state.modals.clear();
  state.modal_active = -1;
  state.locals.resize(1);
  state.jump = {};
  state.limits = {};
  run_.origin = {};
  run_.name.clear();
  run_.name_is_settled = false;
  run_.block.parts = kFreshParts;
  after_restore();
  return {};
}

/// Without an O number, the first block's N names the program.
void FanucInterpreter::determine_name() {
  if (run_.name.empty() && run_.origin.sequence > 0 && run_.origin.sequence <= 9999) {
    run_.name = fmt::format("O{:04}", run_.origin.sequence);
  }
  run_.name_is_settled = true;
}

bool FanucInterpreter::finish_block() {
  if (run_.state.uses_compensator) [[unlikely]] {
    if (!check_compensation(run_) || !check_open_corner(run_) || !leave_block(run_)) return false;
    if (run_.is_recording()) {
      run_.sink.on_block_end(run_.origin);
    } else {
      end_compensated_block(run_);
    }
    if (!check_compensation(run_)) return false;
  } else {
    if (!leave_block(run_)) return false;
    run_.sink.on_block_end(run_.origin);
  }
  ++run_.state.blocks;
  run_.block.parts.stage = Stage::Start;
  if (!run_.answers.empty()) [[unlikely]]
    run_.answers.clear();
  return run_.state.limits.jumps_back == 0 || count_block();
}

/// Only a program that jumps back can run for ever.
bool FanucInterpreter::count_block() {
  if (++run_.state.limits.blocks_after_jumps <= run_.options.max_blocks) return true;
  return run_.fail(ErrorCode::LoopLimit, 0,
                   fmt::format("more than {} blocks since a jump back without a move or a wait",
                               run_.options.max_blocks));
}

Result<void> FanucInterpreter::take_answer(const Answer& answer) {
  run_.answers.push_back(answer);
  return {};
}

namespace {

/// Machine coordinates are those of the axes, those of a program leave the length out.
bool is_placed(const ModalState& state, const ActiveModes& modes) {
  const auto is_there = [&](Axis axis, Length length) {
    return length != Length{} && state.placed.has(axis) &&
           state.placed.raw(axis) == state.position.raw(axis);
  };
  return is_there(Axis::X, modes.tool_length_x) || is_there(modes.length_axis, modes.tool_length_z);
}

}  // namespace

ActiveModes FanucInterpreter::modes() const {
  const ModalState& state = run_.state;
  ActiveModes modes;
  modes.units = state.units;
  modes.is_incremental = state.is_incremental();
  modes.compensation = static_cast<CompensationSide>(state.g[kCompensationGroup] - 40);
  const std::uint8_t system = state.g[kWorkGroup];
  const bool is_paged = system == kMoreWorkSystems;
  modes.work_system = static_cast<std::uint16_t>(is_paged ? 541 : 10 * system);
  if (is_paged) modes.work_page = static_cast<std::uint16_t>(run_.memory.coordinates.more_work);
  if (run_.options.is_lathe) {  // the number after T, until the next one
    const auto offset = static_cast<std::size_t>(state.h_number);
    const ToolOffsets& tools = run_.memory.tools;
    modes.tool_length_x = Length::mm(tools.x_geometry[offset] + tools.x_wear[offset]);
    modes.tool_length_z = Length::mm(length_of_offset(run_, state.h_number));
  } else {
    modes.tool_length_z = Length::mm(state.length_offset);
    modes.length_axis = state.length_axis;
  }
  modes.is_length_plain = !run_.tilted.is_on() && !is_placed(state, modes);
  modes.is_length_certain = !run_.tilted.is_on() && !is_length_doubtful(state, modes);
  modes.bare_axes = bare_axes(state, modes);
  modes.tool_radius = Length::mm(radius_of_offset(run_, state.d_number));
  const Length feed = Length::mm(state.feed[state.is_per_revolution()]);
  modes.feed = state.is_per_revolution() ? Feed::per_revolution(feed) : Feed::per_minute(feed);
  const std::uint8_t cycle = state.g[kCycleGroup];
  modes.cycle = hole_cycle_name(cycle == kRigidTap ? 84 : cycle == kRigidTapLeft ? 74 : cycle);
  modes.frame_changes = run_.frame_changes;
  return modes;
}

std::optional<CoordinateFrame> FanucInterpreter::frame() const {
  return frame_of(run_);
}

bool FanucInterpreter::tilts_tool(const Position& at) const {
  constexpr double kStraight = 1e-9;
  const Kinematics& machine = run_.options.kinematics;
  return machine.exists() && tool_direction(machine, pose_of(machine, at))[2] < 1 - kStraight;
}

std::string FanucInterpreter::travel_fault(const Position& from, const Position& to) {
  if (!run_.options.checks_stroke() && !run_.state.zone.is_on) return {};
  return stroke_fault(run_.options, run_.state.zone, {from, to, run_.length_display()});
}

void FanucInterpreter::after_restore() {
  run_.text.invalidate();
  run_.block.clear();
  run_.answers.clear();
  run_.answers_used = 0;
}

}  // namespace dripline::interpreter::fanuc

namespace dripline::interpreter {
template class BlockInterpreter<fanuc::FanucInterpreter>;
}
