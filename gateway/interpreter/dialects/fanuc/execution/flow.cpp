#include "gateway/interpreter/dialects/fanuc/execution/flow.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/fanuc/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/fanuc/turning/turning.hpp"

namespace dripline::interpreter::fanuc {
namespace {

/// As the control writes it: O0012, or its name.
std::string program_of(const Jump& jump) {
  return jump.name.empty() ? fmt::format("O{:04}", jump.number) : jump.name;
}

std::size_t loop_base(const ModalState& state) {
  return state.calls.empty() ? 0 : state.calls.back().loop_base;
}

/// Something that could go on for ever has happened once more.
bool count_jump_back(Run& run) {
  if (++run.state.limits.jumps_back <= run.options.max_loops) return true;
  return run.fail(
      ErrorCode::LoopLimit, 0,
      fmt::format("more than {} jumps back without a move or a wait", run.options.max_loops));
}

void end_program(Run& run, std::uint64_t blocks, bool rewind) {
  all_off(run);
  if (run.state.uses_compensator && run.state.is_compensating()) run.compensator.cancel();
  run.events().on_end({run.origin, blocks, rewind});
  run.state.phase = RunPhase::Ended;
}

void drop_frame(ModalState& state) {
  const CallFrame& frame = state.calls.back();
  state.loops.resize(std::min<std::size_t>(state.loops.size(), frame.loop_base));
  if (frame.kind != CallKind::Subprogram) {  // a subprogram shares what is modal with its caller
    state.modals.resize(std::min<std::size_t>(state.modals.size(), frame.modal_count));
    state.modal_active = frame.modal_active;
    state.locals.pop_back();
  }
  state.calls.pop_back();
}

void begin_pass(ModalState& state) {
  CallFrame& frame = state.calls.back();
  state.loops.resize(std::min<std::size_t>(state.loops.size(), frame.loop_base));
  if (frame.kind != CallKind::Subprogram) state.locals.back() = frame.arguments;
  state.at = frame.entry;
}

void open_goto(Run& run, std::uint32_t number) {
  Jump& jump = run.state.jump;
  jump = Jump{};
  jump.kind = JumpKind::Goto;
  jump.is_return = true;
  jump.number = number;
  jump.from = run.state.at;
}

/// M99 of the main program: from its head again, or to a block.
bool restart_main_program(Run& run, std::uint32_t number) {
  ModalState& state = run.state;
  if (run.options.is_dnc) {
    if (number != 0) return run.fail(ErrorCode::MacroInDnc, 0, "M99 P");
    run.warn(WarningCode::EndOfTapeByReturn, 0);
    end_program(run, state.blocks + 1, false);
    return true;
  }
  if (!count_jump_back(run)) return false;
  if (number != 0) {
    open_goto(run, number);
    return true;
  }
  state.loops.clear();
  state.at = state.at.segment_head();
  return true;
}

bool return_from_call(Run& run, std::uint32_t number) {
  ModalState& state = run.state;
  if (state.calls.empty()) return restart_main_program(run, number);
  CallFrame& frame = state.calls.back();
  const std::uint32_t set = run.block.parts.passes_left;
  if (set != Block::kKeepPasses) frame.passes_left = set;
  if (frame.passes_left > 0) {
    if (number != 0) {
      return run.fail(ErrorCode::ImproperCommand, 0,
                      fmt::format("M99 P{} with {} passes left: whether they are made differs "
                                  "between controls; L0 beside P ends them",
                                  number, frame.passes_left));
    }
    --frame.passes_left;
    if (!count_jump_back(run)) return false;
    begin_pass(state);
    return true;
  }
  state.at = frame.back;
  drop_frame(state);
  run.update_special();
  if (number == 0) return true;
  if (run.options.is_dnc && state.at.program == kMainProgram) {
    return run.fail(ErrorCode::MacroInDnc, 0, "M99 P into the program from the line");
  }
  open_goto(run, number);
  return true;
}

bool return_to_loop(Run& run, std::uint64_t block_offset) {
  ModalState& state = run.state;
  if (state.loops.size() <= loop_base(state) || state.loops.back().end_offset != block_offset ||
      state.loops.back().number != run.block.parts.loop_number) {
    return run.fail(ErrorCode::MissingEnd, run.block.parts.statement_column, "END without its DO");
  }
  if (!count_jump_back(run)) return false;
  state.at = state.loops.back().head;
  state.loops.pop_back();
  return true;
}

bool check_depth(Run& run) {
  const ModalState& state = run.state;
  const bool is_subprogram = state.jump.call == CallKind::Subprogram;
  const auto same = std::count_if(state.calls.begin(), state.calls.end(),
                                  [is_subprogram](const CallFrame& frame) {
                                    return (frame.kind == CallKind::Subprogram) == is_subprogram;
                                  });
  const std::size_t most = is_subprogram ? run.options.max_call_depth : kMaxMacroLevels - 1;
  if (static_cast<std::size_t>(same) < most && state.calls.size() < run.options.max_nesting) {
    return true;
  }
  return run.fail(ErrorCode::Nesting, 0,
                  fmt::format("{} is called too deep", program_of(state.jump)));
}

BlockOutcome enter_call(Run& run, const TextPosition& entry) {
  ModalState& state = run.state;
  if (!check_depth(run)) return BlockOutcome::Paused;
  const Jump& jump = state.jump;
  CallFrame frame;
  frame.kind = jump.call;
  frame.back = state.at;
  frame.entry = entry;
  frame.arguments = jump.arguments;
  frame.passes_left = jump.passes - 1;
  frame.loop_base = static_cast<std::uint8_t>(state.loops.size());
  if (frame.kind != CallKind::Subprogram) frame.modal_active = state.modal_active;
  frame.modal_count = static_cast<std::uint8_t>(state.modals.size());
  if (jump.call == CallKind::Modal && jump.modal >= 0) {
    state.modal_active = state.modals[static_cast<std::size_t>(jump.modal)].outer;
  }
  if (frame.kind != CallKind::Subprogram) state.locals.push_back(frame.arguments);
  state.calls.push_back(frame);
  state.at = entry;
  run.update_special();
  return BlockOutcome::NoBlock;
}

BlockOutcome call_library(Run& run) {
  const std::string name = program_of(run.state.jump);
  const ProgramLookup lookup = run.source.find(name);
  run.text.invalidate();
  if (lookup.state == ProgramLookup::State::NotYet) return BlockOutcome::NeedsText;
  if (lookup.state == ProgramLookup::State::NotFound) {
    run.fail(ErrorCode::NumberNotFound, 0, name);
    return BlockOutcome::Paused;
  }
  TextPosition entry;
  entry.program = lookup.program;
  return enter_call(run, entry);
}

BlockOutcome enter_loop(Run& run, const LoopFrame& loop) {
  ModalState& state = run.state;
  if (!state.jump.condition) {
    state.at = loop.next;
    return BlockOutcome::NoBlock;
  }
  if (state.loops.size() - loop_base(state) >= OpenLoops::kMax) {
    run.fail(ErrorCode::LoopNumber, 0, "more than 3 loops within one another");
    return BlockOutcome::Paused;
  }
  state.loops.push_back(loop);
  return BlockOutcome::NoBlock;
}

/// The loops around the target must be those that are running; the others are left.
BlockOutcome go_to(Run& run, const TextPosition& found, const OpenLoops& open) {
  ModalState& state = run.state;
  const std::size_t base = loop_base(state);
  for (std::size_t i = 0; i < open.count; ++i) {
    if (base + i < state.loops.size() && state.loops[base + i].head.offset == open.loop[i].offset) {
      continue;
    }
    run.fail(ErrorCode::MissingEnd, 0, fmt::format("GOTO {} leads into a loop", state.jump.number));
    return BlockOutcome::Paused;
  }
  if (found.offset <= state.jump.from.offset && !count_jump_back(run)) return BlockOutcome::Paused;
  state.loops.resize(base + open.count);
  state.at = found;
  return BlockOutcome::NoBlock;
}

BlockOutcome refuse_missing(Run& run) {
  const Jump& jump = run.state.jump;
  if (jump.kind == JumpKind::Loop) {
    run.fail(ErrorCode::MissingEnd, 0, fmt::format("DO{}", jump.loop_number));
  } else {
    run.fail(jump.is_return ? ErrorCode::SequenceNotFound : ErrorCode::MacroSequence, 0,
             fmt::format("N{}", jump.number));
  }
  return BlockOutcome::Paused;
}

OpenLoops running_loops(const ModalState& state) {
  OpenLoops open;
  for (std::size_t i = loop_base(state); i < state.loops.size() && open.count < OpenLoops::kMax;
       ++i) {
    open.loop[open.count++] = {state.loops[i].number, state.loops[i].head.offset};
  }
  return open;
}

}  // namespace

bool leave_block(Run& run) {
  const Block::Parts& parts = run.block.parts;
  ModalState& state = run.state;
  if (parts.has_code) state.at.code_seen = state.at.head_seen = true;
  const std::uint64_t offset = run.text.offset();
  run.text.advance(state.at, run.text.begin() + parts.end);
  if (state.contour.code != 0) [[unlikely]] {
    if (!follow_contour(run)) return false;
    if (state.contour.code == 0) return true;
  }
  if (parts.ending != Ending::None) [[unlikely]] {
    if (parts.ending == Ending::Return) return return_from_call(run, parts.ending_number);
    end_program(run, state.blocks + 1, parts.rewinds);
    return true;
  }
  if (parts.statement == StatementKind::EndLoop) [[unlikely]]
    return return_to_loop(run, offset);
  return true;
}

BlockOutcome take_jump(Run& run, TextSearch& search) {
  ModalState& state = run.state;
  Jump& jump = state.jump;
  TextPosition found;
  LoopFrame loop;
  OpenLoops open = running_loops(state);
  TextSearch::Outcome outcome{};
  if (jump.kind == JumpKind::Loop) {
    outcome = search.find_end(jump.from, state.at, jump.loop_number, loop);
  } else if (jump.kind == JumpKind::Call) {
    // A program from the line cannot be searched: what it calls is in memory.
    outcome = run.options.is_dnc ? TextSearch::Outcome::Missing : search.find_program(jump, found);
  } else {
    const bool begins_contour = state.contour.code != 0 && jump.is_return;
    std::string why;
    if (begins_contour) {
      outcome = search.check_contour(state.at,
                                     {.first = jump.number,
                                      .last = state.contour.last,
                                      .is_left_at_its_end = state.contour.code != kTurningCycles},
                                     why);
      if (outcome == TextSearch::Outcome::Missing) {
        run.fail(ErrorCode::IllegalContour, 0, why);
        return BlockOutcome::Paused;
      }
    }
    if (!begins_contour || outcome == TextSearch::Outcome::Found)
      outcome = search.find_label(state.at, jump.number, open, found);
  }
  BlockOutcome result = BlockOutcome::Paused;
  switch (outcome) {
    case TextSearch::Outcome::NotYet:
      return BlockOutcome::NeedsText;
    case TextSearch::Outcome::More:
      return BlockOutcome::MoreFollows;
    case TextSearch::Outcome::TooLong:
      run.fail(ErrorCode::LineTooLong, 0, "met in a search");
      break;
    case TextSearch::Outcome::Failed:
      run.fail(ErrorCode::TextFailed, 0, run.text.failure());
      break;
    case TextSearch::Outcome::Crossed:
      run.fail(ErrorCode::MissingEnd, 0, "DO and END do not belong together");
      break;
    case TextSearch::Outcome::Missing:
      result = jump.kind == JumpKind::Call ? call_library(run) : refuse_missing(run);
      break;
    case TextSearch::Outcome::Found:
      result = jump.kind == JumpKind::Call   ? enter_call(run, found)
               : jump.kind == JumpKind::Loop ? enter_loop(run, loop)
                                             : go_to(run, found, open);
      break;
  }
  if (result == BlockOutcome::NoBlock) jump = Jump{};
  return result;
}

bool fail_at_end_of_record(Run& run) {
  return run.fail(ErrorCode::EndOfRecord, 0);
}

}  // namespace dripline::interpreter::fanuc
