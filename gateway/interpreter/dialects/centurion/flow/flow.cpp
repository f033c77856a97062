#include "gateway/interpreter/dialects/centurion/flow/flow.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/codes/m_codes.hpp"
#include "gateway/interpreter/dialects/centurion/codes/machine_functions.hpp"
#include "gateway/interpreter/dialects/centurion/cycles/pattern_cycles.hpp"
#include "gateway/interpreter/dialects/centurion/flow/macro_calls.hpp"
#include "gateway/interpreter/dialects/centurion/flow/output_text.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr double kMaxRepeats = 9999;
constexpr double kMaxRepeatsOfM98 = 999;

std::size_t gosub_base(const ModalState& state) {
  return state.calls.empty() ? 0 : state.calls.back().gosub_base;
}
std::size_t loop_base(const ModalState& state) {
  if (state.gosubs.size() > gosub_base(state)) return state.gosubs.back().loop_base;
  return state.calls.empty() ? 0 : state.calls.back().loop_base;
}

bool refuse_two(Run& run) {
  return run.fail(ErrorCode::IllegalStatement, 0, "two jumps or ends in one block");
}

bool plan_call(Run& run) {
  Block& block = run.block;
  if (run.options.refuses_loops_and_calls) {
    return run.fail(ErrorCode::NotInDnc, 0, "M98");
  }
  if (run.options.is_mdi) return run.fail(ErrorCode::IllegalStatement, 0, "M98 in MDI");
  if (!block.words.has(Address::P)) return run.fail(ErrorCode::MissingP, 0);
  const double number = block.words[Address::P];
  if (!(number >= 1 && number <= 9999) || number != std::trunc(number)) {
    return run.fail(ErrorCode::InvalidProgramNumber, block.words.column(Address::P),
                    fmt::format("P{}", number));
  }
  block.parts.jump = JumpKind::Call;
  block.parts.jump_number = static_cast<std::uint32_t>(number);
  return true;
}

/// L is an argument here, not a repeat count.
bool plan_macro(Run& run) {
  Block::Parts& parts = run.block.parts;
  if (parts.jump != JumpKind::None || parts.ending != Ending::None) return refuse_two(run);
  parts.jump = JumpKind::Call;
  parts.jump_number = parts.macro;
  if (parts.caller != MacroCaller::M6) pass_arguments(run);
  return true;
}

bool read_passes(Run& run, std::uint32_t& passes) {
  const Block& block = run.block;
  passes = 1;
  if (!block.words.has(Address::L) || block.parts.macro != 0) return true;
  const double repeats = block.words[Address::L];
  const bool is_m98 = block.parts.jump == JumpKind::Call && !block.parts.jump_is_call_word;
  const double most = is_m98 ? kMaxRepeatsOfM98 : kMaxRepeats;
  if (!(repeats >= 0 && repeats <= most) || repeats != std::trunc(repeats)) {
    return run.fail(ErrorCode::LoopCounter, block.words.column(Address::L),
                    fmt::format("L{} is not a whole number from 0 to {}", repeats, most));
  }
  passes = static_cast<std::uint32_t>(repeats);
  return true;
}

/// Zeroes that a subprogram sets end with it (manual: G50).
void restore_zero(Run& run, const Point& floating_zero) {
  run.state.floating_zero = floating_zero;
  run.update_origin();
}

/// Counts a jump or repeat: a program must not repeat without end.
bool count_pass(Run& run) {
  if (run.loops.count_pass()) return true;
  return run.fail(ErrorCode::LoopLimit, 0,
                  fmt::format("more than {} jumps and repeats without a move or a wait",
                              language::LoopGuard::kMaxIdlePasses));
}

bool return_from_gosub(Run& run) {
  ModalState& state = run.state;
  if (state.gosubs.size() <= gosub_base(state)) return run.fail(ErrorCode::ReturnWithoutGosub, 0);
  GosubFrame& frame = state.gosubs.back();
  state.loops.resize(frame.loop_base);
  restore_zero(run, frame.floating_zero);
  if (frame.passes_left > 0) {
    --frame.passes_left;
    state.at = frame.entry;
    return count_pass(run);
  }
  state.at = frame.back;
  state.gosubs.pop_back();
  return true;
}

bool return_from_call(Run& run) {
  ModalState& state = run.state;
  CallFrame& frame = state.calls.back();
  state.gosubs.resize(frame.gosub_base);
  state.loops.resize(frame.loop_base);
  restore_zero(run, frame.floating_zero);
  if (frame.passes_left > 0) {
    --frame.passes_left;
    state.at = frame.entry;
    return count_pass(run);
  }
  const bool changes_tool = frame.changes_tool;
  state.at = frame.back;
  state.calls.pop_back();
  if (changes_tool) finish_tool_change(run);
  return true;
}

bool return_to_while(Run& run, std::uint64_t block_offset) {
  ModalState& state = run.state;
  if (state.loops.size() <= loop_base(state) || state.loops.back().wend_offset != block_offset) {
    return run.fail(ErrorCode::MissingWhile, 0);
  }
  state.at = state.loops.back().head;
  state.loops.pop_back();
  return count_pass(run);
}

void end_program(Run& run, std::uint64_t blocks) {
  close_open_device(run);
  EventSink& events = run.events();
  // a move that waits may be refused: then there is no end
  if (!run.flush_path()) return;
  events.on_end({run.origin, blocks, true});
  run.state.phase = RunPhase::Ended;
}

bool refuse_end_in_pattern(Run& run) {
  return run.fail(ErrorCode::IllegalStatement, 0,
                  fmt::format("the program ends before N{}, the last block of the pattern",
                              run.state.pattern.last_label));
}

bool has_m30(const Run& run) {
  for (std::uint8_t i = 0; i < run.block.parts.m_count; ++i) {
    if (run.block.m[i] == 30) return true;
  }
  return false;
}

bool end_by_code(Run& run) {
  if (has_m30(run)) all_off(run);
  if (!run.state.calls.empty()) return return_from_call(run);
  end_program(run, run.state.blocks + 1);
  return true;
}

bool request_jump(Run& run, const TextPosition& head) {
  const Block::Parts& parts = run.block.parts;
  std::uint32_t passes = 1;
  if (parts.jump == JumpKind::Call || parts.jump == JumpKind::Gosub) {
    if (!read_passes(run, passes)) return false;
    if (passes == 0) return true;
  }
  Jump& jump = run.state.jump;
  jump.kind = parts.jump;
  jump.is_call_word = parts.jump_is_call_word;
  jump.condition = parts.while_condition;
  jump.number = parts.jump_number;
  jump.passes = passes;
  jump.from = head;
  jump.custom = parts.caller == MacroCaller::G65 ? std::uint16_t{0} : parts.macro;
  jump.changes_tool = parts.caller == MacroCaller::M6;
  jump.is_not_in_ram = jump.custom == 0;
  return true;
}

/// A GOTO out of a loop ends it (manual: IF, GOTO, WHILE).
void leave_loops(ModalState& state, const TextPosition& to) {
  while (state.loops.size() > loop_base(state)) {
    const LoopFrame& loop = state.loops.back();
    const bool is_inside = loop.head.program == to.program && to.line > loop.head.line &&
                           to.offset <= loop.wend_offset;
    if (is_inside) return;
    state.loops.pop_back();
  }
}

BlockOutcome refuse_depth(Run& run) {
  run.fail(ErrorCode::NestedTooDeep, 0, fmt::format("more than {} levels", kMaxNesting));
  return BlockOutcome::Paused;
}

BlockOutcome enter_gosub(Run& run, const TextPosition& entry) {
  ModalState& state = run.state;
  if (state.gosubs.size() == kMaxNesting) return refuse_depth(run);
  state.gosubs.push_back({state.at, entry, state.floating_zero, state.jump.passes - 1,
                          static_cast<std::uint8_t>(state.loops.size())});
  state.at = entry;
  return BlockOutcome::NoBlock;
}

BlockOutcome enter_call(Run& run, const TextPosition& entry) {
  ModalState& state = run.state;
  if (state.calls.size() == kMaxNesting) return refuse_depth(run);
  state.calls.push_back({state.at, entry, state.floating_zero, state.jump.passes - 1,
                         static_cast<std::uint8_t>(state.gosubs.size()),
                         static_cast<std::uint8_t>(state.loops.size()), state.jump.custom,
                         state.jump.changes_tool});
  state.at = entry;
  return BlockOutcome::NoBlock;
}

BlockOutcome enter_loop(Run& run, const LoopFrame& loop) {
  ModalState& state = run.state;
  if (!state.jump.condition) {
    state.at = loop.next;
    return BlockOutcome::NoBlock;
  }
  if (state.loops.size() == kMaxNesting) return refuse_depth(run);
  state.loops.push_back(loop);
  return BlockOutcome::NoBlock;
}

/// Asks the owner's library for a program that is not in the text that was started.
BlockOutcome call_library(Run& run) {
  const Jump& jump = run.state.jump;
  const ProgramLookup lookup = run.source.find(fmt::format("O{:04}", jump.number));
  run.text.invalidate();
  if (lookup.state == ProgramLookup::State::NotYet) return BlockOutcome::NeedsText;
  if (lookup.state == ProgramLookup::State::NotFound) {
    run.fail(jump.is_call_word ? ErrorCode::UnresolvedCall : ErrorCode::NoSuchProgram, 0,
             fmt::format("O{:04}", jump.number));
    return BlockOutcome::Paused;
  }
  TextPosition entry;
  entry.program = lookup.program;
  return enter_call(run, entry);
}

/// Of programs that codes of the machine call, those of the RAM directory come before all others
/// (manual: custom G and M codes). True: it was found there, or the source does not know yet.
bool call_ram(Run& run, BlockOutcome& outcome) {
  Jump& jump = run.state.jump;
  const ProgramLookup lookup = run.source.find(fmt::format("RAM-O{:04}", jump.number));
  run.text.invalidate();
  if (lookup.state == ProgramLookup::State::NotFound) {
    jump.is_not_in_ram = true;
    return false;
  }
  outcome = BlockOutcome::NeedsText;
  if (lookup.state == ProgramLookup::State::NotYet) return true;
  TextPosition entry;
  entry.program = lookup.program;
  outcome = enter_call(run, entry);
  if (outcome == BlockOutcome::NoBlock) jump = Jump{};
  return true;
}

BlockOutcome refuse_missing(Run& run) {
  const Jump& jump = run.state.jump;
  if (jump.kind == JumpKind::While) {
    run.fail(ErrorCode::MissingWend, 0);
  } else {
    run.fail(ErrorCode::UnresolvedLabel, 0, fmt::format("N{}", jump.number));
  }
  return BlockOutcome::Paused;
}

BlockOutcome arrive_at(Run& run, const TextPosition& found, const LoopFrame& loop) {
  switch (run.state.jump.kind) {
    case JumpKind::Gosub:
      return enter_gosub(run, found);
    case JumpKind::Call:
      return enter_call(run, found);
    case JumpKind::While:
      return enter_loop(run, loop);
    default:
      leave_loops(run.state, found);
      run.state.at = found;
      return BlockOutcome::NoBlock;
  }
}

}  // namespace

bool plan_flow(Run& run) {
  Block::Parts& parts = run.block.parts;
  for (std::uint8_t i = 0; i < parts.m_count; ++i) {
    const unsigned code = run.block.m[i];
    const bool is_end = code == 2 || code == 30 || code == 99;
    if (!is_end && code != 98) continue;
    if (parts.jump != JumpKind::None || parts.ending != Ending::None) return refuse_two(run);
    if (is_end) {
      parts.ending = Ending::EndOfProgram;
    } else if (!plan_call(run)) {
      return false;
    }
  }
  return parts.macro == 0 || plan_macro(run);
}

bool leave_block(Run& run) {
  const Block::Parts& parts = run.block.parts;
  ModalState& state = run.state;
  state.at.code_seen |= parts.has_code;
  if (parts.jump == JumpKind::None && parts.ending == Ending::None) [[likely]] {
    run.text.advance(state.at);
    return true;
  }
  const TextPosition head = state.at;
  const std::uint64_t offset = run.text.offset();
  run.text.advance(state.at);
  switch (parts.ending) {
    case Ending::Return:
      return return_from_gosub(run);
    case Ending::Wend:
      return return_to_while(run, offset);
    case Ending::OperatorEnd:
      end_program(run, state.blocks + 1);
      return true;
    case Ending::EndOfProgram:
      if (state.calls.empty() && is_reading_pattern(state)) return refuse_end_in_pattern(run);
      return end_by_code(run);
    case Ending::None:
      break;
  }
  return request_jump(run, head);
}

BlockOutcome refuse_search(Run& run, TextSearch::Outcome outcome) {
  switch (outcome) {
    case TextSearch::Outcome::NotYet:
      return BlockOutcome::NeedsText;
    case TextSearch::Outcome::More:
      return BlockOutcome::MoreFollows;
    case TextSearch::Outcome::TooLong:
      run.fail(ErrorCode::BlockTooLong, 0, "in a search");
      break;
    default:
      run.fail(ErrorCode::TextFailed, 0, run.text.failure());
      break;
  }
  return BlockOutcome::Paused;
}

BlockOutcome take_jump(Run& run, TextSearch& search) {
  ModalState& state = run.state;
  Jump& jump = state.jump;
  if (jump.kind == JumpKind::Pattern) return enter_pattern(run, search);
  TextPosition found;
  LoopFrame loop;
  TextSearch::Outcome outcome{};
  BlockOutcome result = BlockOutcome::Paused;
  if (jump.kind == JumpKind::Call && !jump.is_not_in_ram && call_ram(run, result)) return result;
  if (jump.kind == JumpKind::While) {
    outcome = search.find_wend(jump.from, state.at, loop);
  } else if (jump.kind == JumpKind::Call) {
    outcome = search.find_program(jump.number, found);
  } else {
    outcome = search.find_label(state.at, jump.number, found);
  }
  switch (outcome) {
    case TextSearch::Outcome::Missing:
      result = jump.kind == JumpKind::Call ? call_library(run) : refuse_missing(run);
      break;
    case TextSearch::Outcome::Found:
      result = arrive_at(run, found, loop);
      break;
    default:
      return refuse_search(run, outcome);
  }
  if (result != BlockOutcome::NoBlock) return result;
  jump = Jump{};
  return count_pass(run) ? result : BlockOutcome::Paused;
}

bool end_without_code(Run& run) {
  ModalState& state = run.state;
  if (is_reading_pattern(state) && state.calls.size() <= state.pattern.calls) {
    return refuse_end_in_pattern(run);
  }
  if (!state.calls.empty()) return return_from_call(run);
  if (state.blocks == 0) return run.fail(ErrorCode::EmptyProgram, 0);
  end_program(run, state.blocks);
  return check_path(run);
}

}  // namespace dripline::interpreter::centurion
