#include "gateway/interpreter/dialects/tnc155/execution/flow.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <tuple>
#include <utility>

#include "gateway/interpreter/dialects/tnc155/cycles/cycles.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/ahead_search.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"
#include "gateway/interpreter/dialects/tnc155/memory/changer.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

bool refuse_in_transfer(Run& run, std::string_view what) {
  if (!run.options.blockwise_restrictions) return true;
  return run.fail(ErrorCode::NotInBlockwiseTransfer, what);
}

bool refuse_depth(Run& run, std::size_t max, std::string_view what) {
  return run.fail(ErrorCode::ExcessiveSubprogramming, fmt::format("more than {} {}", max, what));
}

std::size_t label_base(const State& state) {
  return state.programs.empty() ? 0 : state.programs.back().label_base;
}

bool check_label(Run& run, std::int32_t label) {
  if (label == 0) return run.fail(ErrorCode::JumpToLabelZero);
  if (label >= 1 && (label <= kLastLabel || run.options.is_itnc)) return true;
  return run.fail(ErrorCode::EntryOutOfRange,
                  fmt::format("label {} is not 1 to {}", label, kLastLabel));
}

void request(Run& run, JumpKind kind, std::int32_t number, std::int32_t repeats = 0) {
  Jump& jump = run.state.jump;
  jump.kind = kind;
  jump.number = static_cast<std::uint32_t>(number);
  jump.repeats = static_cast<std::uint32_t>(repeats);
  jump.call = run.reader.block_place();
  jump.name = run.options.is_itnc ? run.parts.itnc.name : std::string();
}

/// The repeat that this block controls, if it is active.
LabelFrame* open_repeat(State& state, const TextPlace& call) {
  for (std::size_t i = state.labels.size(); i > label_base(state); --i) {
    LabelFrame& frame = state.labels[i - 1];
    if (frame.is_repeat && frame.call == call) return &frame;
    if (!frame.is_repeat) break;
  }
  return nullptr;
}

void drop_labels_of(State& state, ProgramIndex program) {
  std::erase_if(state.known_labels,
                [&](const LabelPlace& label) { return label.program == program; });
}

bool comes_before(const LabelPlace& a, const LabelPlace& b) {
  return std::tie(a.program, a.label, a.name) < std::tie(b.program, b.label, b.name);
}

/// Both blocks that set the label are named; the second one is shown.
bool fail_doubled(Run& run, const TextSearch& search, ProgramIndex program) {
  const LabelSet& second = search.second();
  run.origin.program = program;
  run.origin.offset = second.at.offset;
  run.origin.line = second.at.line;
  run.origin.sequence = second.block;
  return run.fail(ErrorCode::NumberAllocated, search.doubled());
}

void go_to(Run& run, const TextPlace& place) {
  run.state.at = place;
  run.state.number_due = Block::kNone;
  run.reader.seek(place);
}

/// LBL 0 returns to the block after the call. It is ignored within a repeat and without a call.
void return_from_label(Run& run) {
  State& state = run.state;
  const std::uint64_t here = run.reader.block_place().offset;
  std::size_t level = state.labels.size();
  if (level > label_base(state) && state.labels.back().is_repeat) {
    const LabelFrame& repeat = state.labels.back();
    if (here >= repeat.from && here < repeat.call.offset) return;
  }
  while (level > label_base(state) && state.labels[level - 1].is_repeat) --level;
  if (level == label_base(state)) return;
  go_to(run, state.labels[level - 1].back);
  state.labels.resize(level - 1);
}

BlockOutcome arrive_at_label(Run& run, const TextPlace& found) {
  State& state = run.state;
  const Jump& jump = state.jump;
  if (jump.kind != JumpKind::Label) {
    if (state.labels.size() >= kMaxLabelLevels) {
      refuse_depth(run, kMaxLabelLevels, "levels of labels");
      return BlockOutcome::Paused;
    }
    LabelFrame frame;
    frame.is_repeat = jump.kind == JumpKind::Repeat;
    frame.label = jump.number;
    frame.left = frame.is_repeat ? jump.repeats - 1 : 0;
    frame.call = jump.call;
    frame.back = state.at;
    frame.from = found.offset;
    state.labels.push_back(frame);
  }
  go_to(run, found);
  return BlockOutcome::NoBlock;
}

BlockOutcome find_label(Run& run, TextSearch& search) {
  State& state = run.state;
  const std::uint32_t label = state.jump.number;
  const ProgramIndex program = state.jump.call.program;
  TextPlace found;
  switch (search.find_label(program, label, state.jump.name, found)) {
    case TextSearch::Outcome::Found:
      return arrive_at_label(run, found);
    case TextSearch::Outcome::NotYet:
      return BlockOutcome::NeedsText;
    case TextSearch::Outcome::More:
      return BlockOutcome::MoreFollows;
    case TextSearch::Outcome::Failed:
      run.fail(ErrorCode::TextFailed, search.reason());
      break;
    case TextSearch::Outcome::Doubled:
      fail_doubled(run, search, program);
      break;
    case TextSearch::Outcome::Missing:
      run.fail(ErrorCode::LabelNotFound, state.jump.name.empty()
                                             ? fmt::format("LBL {}", label)
                                             : fmt::format("LBL \"{}\"", state.jump.name));
      break;
  }
  return BlockOutcome::Paused;
}

/// The called program, once its text has arrived. Finished: `Run::called` is it.
BlockOutcome look_up_program(Run& run) {
  const Jump& jump = run.state.jump;
  if (run.called) return BlockOutcome::Finished;
  const ProgramLookup lookup =
      run.reader.find(jump.name.empty() ? fmt::format("{}", jump.number) : jump.name);
  if (lookup.state == ProgramLookup::State::NotYet) return BlockOutcome::NeedsText;
  if (lookup.state == ProgramLookup::State::Found) {
    run.called = lookup.program;
    return BlockOutcome::Finished;
  }
  if (jump.name.empty()) {
    fail_unavailable(run, jump.number);
  } else {
    run.fail_as(ErrorCode::ProgramUnavailable, fmt::format("PGM {} UNAVAILABLE", jump.name));
  }
  return BlockOutcome::Paused;
}

/// The QL parameters of a later control, which are the program's own: those of `next`, none: all 0.
std::vector<double> exchange_locals(Run& run, const std::vector<double>& next) {
  if (!run.options.is_itnc) return {};
  const auto first = run.state.q.begin() + kFirstLocal;
  std::vector<double> before(first, first + kLocalParameters);
  std::fill(first, first + kLocalParameters, 0.0);
  std::copy_n(next.begin(), std::min<std::size_t>(next.size(), kLocalParameters), first);
  ++run.q_changes;
  return before;
}

BlockOutcome find_program(Run& run, TextSearch& search) {
  State& state = run.state;
  if (state.programs.size() >= kMaxProgramLevels) {
    refuse_depth(run, kMaxProgramLevels, "levels of programs");
    return BlockOutcome::Paused;
  }
  BlockOutcome outcome = look_up_program(run);
  if (outcome == BlockOutcome::Finished) outcome = check_first_labels(run, search, *run.called);
  if (outcome != BlockOutcome::Finished) return outcome;
  const ProgramIndex called = *std::exchange(run.called, std::nullopt);
  const bool is_cycle = state.jump.kind == JumpKind::CycleProgram;
  state.programs.push_back({state.at, state.reading, static_cast<std::uint8_t>(state.labels.size()),
                            is_cycle && state.cycle.is_modal_call, exchange_locals(run, {})});
  if (is_cycle) state.cycle.is_modal_call = false;
  if (run.options.modes_go_over_calls) {
    state.reading.program = ProgramForm{};
  } else {
    state.reading = ReadingState{};
  }
  TextPlace entry;
  entry.program = called;
  go_to(run, entry);
  return BlockOutcome::NoBlock;
}

}  // namespace

BlockOutcome check_first_labels(Run& run, TextSearch& search, ProgramIndex program) {
  const bool is_wanted = run.options.is_itnc || run.options.checks_calls;
  if (!is_wanted || run.options.blockwise_restrictions || run.options.is_mdi) {
    return BlockOutcome::Finished;
  }
  switch (search.check_labels(program, AheadSearch::kMaxBlocks)) {
    case TextSearch::Outcome::NotYet:
      return BlockOutcome::NeedsText;
    case TextSearch::Outcome::More:
      return BlockOutcome::MoreFollows;
    case TextSearch::Outcome::Doubled:
      fail_doubled(run, search, program);
      return BlockOutcome::Paused;
    default:  // text that fails, fails when the run comes to it
      return BlockOutcome::Finished;
  }
}

bool meet_label(Run& run, const Block& block) {
  State& state = run.state;
  if (block.target == 0) {
    return_from_label(run);
    return true;
  }
  LabelPlace label{run.reader.block_place().program,
                   static_cast<std::uint32_t>(block.target),
                   run.reader.block_place(),
                   block.number,
                   {}};
  if (block.target == kNameLabel) label.name = run.parts.itnc.name;
  const auto known = std::ranges::lower_bound(state.known_labels, label, comes_before);
  if (known == state.known_labels.end() || comes_before(label, *known)) {
    if (state.known_labels.size() == kMaxLabels) {
      return run.fail(ErrorCode::MemoryExceeded, fmt::format("more than {} labels", kMaxLabels));
    }
    state.known_labels.insert(known, std::move(label));
    return true;
  }
  if (known->at.offset == label.at.offset) return true;
  const LabelSet first{known->at, known->block}, second{label.at, label.block};
  return run.fail(ErrorCode::NumberAllocated,
                  fmt::format("LBL {} is set in {} and in {}",
                              label.name.empty() ? fmt::format("{}", label.label)
                                                 : fmt::format("\"{}\"", label.name),
                              first.text(), second.text()));
}

bool call_label(Run& run, const Block& block) {
  State& state = run.state;
  if (!refuse_in_transfer(run, "CALL LBL") || !check_label(run, block.target)) return false;
  if (block.repeats == Block::kNone) {
    request(run, JumpKind::Subprogram, block.target);
    return true;
  }
  if (LabelFrame* repeat = open_repeat(state, run.reader.block_place())) {
    const auto level = static_cast<std::size_t>(repeat - state.labels.data());
    state.labels.resize(level + 1);  // repeats inside it start again
    if (repeat->left == 0) {
      state.labels.pop_back();
      return true;
    }
    --repeat->left;
    request(run, JumpKind::Label, block.target);
    return true;
  }
  if (block.repeats > 0) request(run, JumpKind::Repeat, block.target, block.repeats);
  return true;
}

bool jump_to_label(Run& run, std::int32_t label) {
  if (!refuse_in_transfer(run, "a jump to a label") || !check_label(run, label)) return false;
  request(run, JumpKind::Label, label);
  return true;
}

namespace {

/// A later control cancels the compensation at the call (iTNC 530, User's Manual, tool
/// compensation): where the tool would leave the contour is not known here.
bool refuse_in_contour(Run& run) {
  if (!run.options.is_itnc || !run.state.is_compensating()) return true;
  return run.fail(ErrorCode::PathOffsetWronglyStarted,
                  "CALL PGM with RL or RR in force: R0 comes before it");
}

}  // namespace

bool call_program(Run& run, std::int32_t number) {
  if (!refuse_in_transfer(run, "CALL PGM") || !refuse_in_contour(run)) return false;
  request(run, JumpKind::Program, number);
  return true;
}

bool call_cycle_program(Run& run, std::int32_t number) {
  if (!refuse_in_transfer(run, "CALL PGM") || !refuse_in_contour(run)) return false;
  request(run, JumpKind::CycleProgram, number);
  return true;
}

bool fail_unavailable(Run& run, std::int64_t number) {
  return run.fail_as(ErrorCode::ProgramUnavailable, fmt::format("PGM {} UNAVAILABLE", number));
}

void end_program(Run& run, bool rewinds) {
  State& state = run.state;
  if (state.programs.empty() && run.tilted.is_on())
    run.warn("TNC-TILT-ENDS",
             "the program ends without PLANE RESET or M129: here that ends with it");
  if (!state.programs.empty()) {
    const ProgramFrame& frame = state.programs.back();
    drop_labels_of(state, state.at.program);
    state.labels.resize(frame.label_base);
    if (run.options.modes_go_over_calls) {
      state.reading.program = frame.reading.program;
    } else {
      state.reading = frame.reading;
    }
    if (state.units != state.reading.program.units) {
      state.units = state.reading.program.units;
      run.events().on_units({run.origin, state.units});
    }
    go_to(run, frame.back);
    state.cycle.is_modal_call |= frame.resumes_modal_call;
    exchange_locals(run, frame.locals);
    state.programs.pop_back();
    return;
  }
  if (rewinds) switch_off(run);
  const bool is_keyed_in = run.options.is_mdi && !rewinds;  // the next text begins here
  if (!is_keyed_in) end_cycles(run);
  report_pockets(run);
  state.phase = RunPhase::Ended;
  run.events().on_end({run.origin, state.blocks + (run.is_in_block ? 1 : 0), rewinds});
}

BlockOutcome take_jump(Run& run, TextSearch& search) {
  BlockOutcome outcome = BlockOutcome::NoBlock;
  switch (run.state.jump.kind) {
    case JumpKind::None:
      break;
    case JumpKind::Program:
    case JumpKind::CycleProgram:
      outcome = find_program(run, search);
      break;
    default:
      outcome = find_label(run, search);
      break;
  }
  if (outcome != BlockOutcome::NoBlock) return outcome;
  run.state.jump = Jump{};
  if (run.loops.count_pass()) return outcome;
  run.fail(ErrorCode::LoopLimit, fmt::format("more than {} jumps and repeats without a move or a "
                                             "wait",
                                             language::LoopGuard::kMaxIdlePasses));
  return BlockOutcome::Paused;
}

}  // namespace dripline::interpreter::tnc155
