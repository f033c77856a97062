#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/dialects/tnc155/execution/machine_functions.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/path.hpp"

namespace dripline::interpreter::tnc155 {

namespace {

/// Positions are the same within the control's resolution.
constexpr double kResolution = 0.001;

std::string block_text(std::int32_t number) {
  return number < 0 ? "a block without number" : fmt::format("block {}", number);
}

/// Why the state at this block cannot be rebuilt, one text a reason.
std::vector<std::string> refusals(const Run& run, std::int32_t returning) {
  const State& state = run.state;
  std::vector<std::string> reasons;
  for (const LabelFrame& frame : state.labels) {
    if (state.start.pass != 0) break;
    reasons.push_back(fmt::format("repeats and return address of LBL {}, which line {} calls",
                                  frame.label, frame.call.line));
  }
  if (returning >= 0) {
    reasons.push_back(fmt::format("how often block {} leads back over it", returning));
  }
  if (is_contour_open(state)) {
    reasons.push_back(
        fmt::format("the contour with radius compensation or the corner from {} on: "
                    "start there",
                    block_text(state.start.contour_block)));
  }
  if (!state.cycle.is_complete) {
    reasons.push_back(fmt::format("CYCL DEF {}, which it is a part of: start at its first block",
                                  state.cycle.defining));
  }
  if (run.options.random_changer && state.start.has_changed_tool) {
    reasons.push_back("which pockets the tools are in: the random changer has changed tools");
  }
  return reasons;
}

std::string join(const std::vector<std::string>& reasons) {
  std::string text;
  for (const std::string& reason : reasons) {
    if (!text.empty()) text += "; ";
    text += reason;
  }
  return text;
}

void add_axes(std::string& text, const AxisValues& values) {
  for (const Axis axis : kAllAxes) {
    const double value = values[static_cast<std::size_t>(axis)];
    if (value != 0) text += fmt::format(" {}{:+.3f}", letter(axis), value);
  }
}

/// What is kept of repeats and subprograms, as by the arrow keys; a start without a pass has none.
void add_labels(std::string& text, const State& state) {
  for (const LabelFrame& frame : state.labels) {
    if (frame.is_repeat) {
      text += fmt::format(", LBL {} {} more times", frame.label, frame.left);
    } else {
      text += fmt::format(", LBL {} returns to line {}", frame.label, frame.back.line);
    }
  }
}

void add_transformation(std::string& text, const Transformation& now) {
  std::string shift;
  add_axes(shift, now.shift);
  if (!shift.empty()) text += ", datum shift" + shift;
  for (std::size_t i = 0; i < now.mirrored.size(); ++i) {
    if (now.mirrored[i]) text += fmt::format(", mirror {}", letter(kAllAxes[i]));
  }
  if (now.rotation != 0) text += fmt::format(", rotation {:+.3f}", now.rotation);
  if (now.scale != 1) text += fmt::format(", scale {:.6f}", now.scale);
}

/// What is in force, for the operator to compare with the machine.
std::string description(const Run& run, std::int32_t number, const Position& expected) {
  const State& state = run.state;
  std::string text = fmt::format("start at block {}", number);
  if (state.start.pass != 0) text += fmt::format(", pass {}", state.start.pass);
  text += ": ";
  if (state.tool.number != 0) {
    text += fmt::format("tool {} L{:+.3f} R{:+.3f}", state.tool.number, state.tool.data.length,
                        state.tool.data.radius);
  } else {
    text += "no tool";
  }
  constexpr std::string_view kSpindle[] = {"M05", "M03", "M04", "oriented"};
  text += fmt::format(", S {:.0f} {}", state.spindle.speed,
                      kSpindle[static_cast<std::size_t>(state.spindle.state)]);
  if (state.coolant.flood) text += ", coolant on";
  add_transformation(text, state.transformation);
  if (state.cycle.machining.number != 0) {
    text += fmt::format(", cycle {}", state.cycle.machining.number);
  }
  add_labels(text, state);
  for (std::size_t code = 0; code < state.start.codes.size(); ++code) {
    if (state.start.codes.test(code)) text += fmt::format(", M{:02} not given out", code);
  }
  std::string program, machine;
  add_axes(program, values_of(expected));
  add_axes(machine, values_of(state.start.actual));
  return text + fmt::format("; the program is at{}, the machine at{} (machine coordinates, mm)",
                            program.empty() ? " 0" : program, machine.empty() ? " 0" : machine);
}

/// The machine is where it was stopped; what joins a move to the one before it is lost.
void stand_at_start(Run& run) {
  State& state = run.state;
  state.machine = state.start.actual;
  state.machine.unmark_all();
  state.nominal = state.transformation.to_program(values_of(state.machine));
  state.last = LastMove{};
  state.polar = PolarData{};
  state.blend = Blend{};
  state.has_positioned = false;
  state.is_restart = true;
  ++run.frame_changes;
  run.reset_stages();
}

void announce(Run& run, const std::string& text) {
  const State& state = run.state;
  run.events().on_message({run.origin, text});
  if (state.tool.number != 0) {
    const ToolShape shape{Length::mm(state.tool.data.length), Length::mm(state.tool.data.radius)};
    run.events().on_tool({run.origin, state.tool.number, false, {}, shape});
  }
  stop(run, StopKind::Operator);
  if (state.spindle.state != SpindleState::Off) turn_spindle(run, state.spindle.state);
  if (state.coolant.flood) run.events().on_coolant({run.origin, true, false});
}

}  // namespace

bool is_contour_open(const State& state) {
  return state.compensation > Compensation::Off || state.is_parallel || state.joins ||
         state.blend.kind != BlendKind::None;
}

void StartGate::on_tool(const ToolChange& event) {
  if (is_open()) return out().on_tool(event);
  start_->has_changed_tool |= !event.is_preselection;
}

void StartGate::on_miscellaneous(const Miscellaneous& event) {
  if (is_open()) return out().on_miscellaneous(event);
  const auto code = static_cast<std::size_t>(event.code);
  if (code < start_->codes.size()) start_->codes.set(code);
}

bool begin_at_block(Run& run, std::int32_t number, std::int32_t returning) {
  State& state = run.state;
  if (const auto reasons = refusals(run, returning); !reasons.empty()) {
    return run.fail(ErrorCode::ProgramStartUndefined,
                    fmt::format("a start at block {} would lose {}", number, join(reasons)));
  }
  state.start.expected = state.uses_stages ? run.compensator.sent() : state.machine;
  const std::string text = description(run, number, state.start.expected);
  stand_at_start(run);
  state.start.is_searching = false;
  announce(run, text);
  return true;
}

void note_contour_start(Run& run, std::int32_t number) {
  StartState& start = run.state.start;
  const bool is_open = is_contour_open(run.state);
  if (is_open && !start.is_in_contour) start.contour_block = number;
  start.is_in_contour = is_open;
}

bool note_computation(Run& run, const Block& block) {
  StartState& start = run.state.start;
  for (const Value* operand : {&block.first, &block.second}) {
    if (!operand->is_q()) continue;
    const auto q = static_cast<std::size_t>(operand->number);
    if (!start.assigned.test(q)) start.carried.set(q);
  }
  const auto q = static_cast<std::size_t>(block.target);
  if (start.carried.test(q)) {
    return run.fail(ErrorCode::ProgramStartUndefined,
                    fmt::format("a start after {} would lose Q{}, whose value continues that of "
                                "the run before",
                                block_text(block.number), q));
  }
  start.assigned.set(q);
  return true;
}

bool check_positions(Run& run, std::uint16_t named) {
  const StartState& start = run.state.start;
  std::string wrong;
  for (const Axis axis : kAllAxes) {
    const double expected = start.expected.raw(axis);
    const double actual = start.actual.raw(axis);
    if ((named & bit(axis)) != 0 || std::fabs(expected - actual) <= kResolution) continue;
    wrong += fmt::format("{}{} is at {:.3f} and the program has it at {:.3f} here",
                         wrong.empty() ? "" : ", ", letter(axis), actual, expected);
  }
  if (wrong.empty()) return true;
  return run.fail(ErrorCode::ProgramStartUndefined,
                  wrong + " (machine coordinates): start at a block that positions it");
}

bool refuse_before_positioning(Run& run, std::string_view what) {
  if (!run.state.is_restart) return true;
  return run.fail(ErrorCode::ProgramStartUndefined,
                  fmt::format("{} after GOTO, before the first positioning block", what));
}

AheadSearch::AheadSearch(ProgramSource& source, ReaderOptions options) : reader_(source, options) {}

void AheadSearch::begin() {
  at_ = TextPlace{};
  state_ = ReadingState{};
  blocks_ = 0;
}

/// Of an ISO program only the words are read: the run resolves them.
AheadSearch::Step AheadSearch::next() {
  reader_.seek(at_);
  const bool knew_form = state_.program.form != Form::Unknown;
  ReadState read = is_iso() ? reader_.next_words(state_) : reader_.next(state_, parts_);
  if (read == ReadState::Wrong && is_iso() && !knew_form) {
    reader_.seek(at_);
    read = reader_.next_words(state_);
  }
  switch (read) {
    case ReadState::Ready:
      at_ = reader_.place();
      ++blocks_;
      return Step::Read;
    case ReadState::NotYet:
      return Step::NotYet;
    case ReadState::Wrong:
      if (state_.program.form == Form::Unknown || !reader_.skip_wrong()) return Step::End;
      at_ = reader_.place();
      ++blocks_;
      return Step::Skipped;
    default:
      return Step::End;
  }
}

/// The last block of a program.
bool AheadSearch::is_over() const {
  if (!is_iso()) return parts_.blocks[0].kind == BlockKind::End;
  const IsoBlock& block = reader_.iso_block();
  return blocks_ > 1 && block.program != IsoBlock::kNone &&
         (block.has(IsoGroup::Unit) || block.program == state_.program.number);
}

bool AheadSearch::is_definition(std::int32_t number) {
  if (!is_iso()) {
    definition_ = parts_.blocks[0];
  } else {
    const IsoBlock& block = reader_.iso_block();
    if (!block.has_code(IsoGroup::Tool, 99)) return false;
    definition_.clear(BlockKind::ToolDefinition);
    definition_.target = block.tool;
    definition_.length = block.length;
    if (block.has(IsoSlot::R)) definition_.radius = block.value(IsoSlot::R);
  }
  return definition_.kind == BlockKind::ToolDefinition && definition_.target == number &&
         (definition_.length.is_programmed() || definition_.radius.is_programmed());
}

AheadSearch::Outcome AheadSearch::find_tool(std::int32_t number, std::uint64_t max_blocks) {
  const auto tool = static_cast<std::size_t>(number);
  if (undefined_.test(tool)) return Outcome::Missing;
  if (tool_ != number) begin();
  tool_ = number;
  reader_.drop_window();
  for (unsigned count = 0; count < kBlocksPerCall; ++count) {
    const Step step = next();
    if (step == Step::NotYet) return Outcome::NotYet;
    const bool is_found = step == Step::Read && is_definition(number);
    if (is_found || step == Step::End || blocks_ >= max_blocks ||
        (step == Step::Read && is_over())) {
      tool_ = Block::kNone;  // the next search starts from the beginning
      undefined_.set(tool, !is_found);
      return is_found ? Outcome::Found : Outcome::Missing;
    }
  }
  return Outcome::More;
}

std::int32_t AheadSearch::block_number() const {
  return is_iso() ? reader_.iso_block().number : parts_.blocks[0].number;
}

/// The program that the block read last calls; kNone: none.
std::int32_t AheadSearch::called_program() const {
  if (!is_iso()) {
    const Block& block = parts_.blocks[0];
    const bool calls = block.kind == BlockKind::ProgramCall ||
                       (block.kind == BlockKind::CycleDefinition && block.cycle == 12);
    return calls ? block.target : Block::kNone;
  }
  const IsoBlock& block = reader_.iso_block();
  if (blocks_ == 1) return Block::kNone;  // the program's own number
  if (block.has_code(IsoGroup::Cycle, 39)) return block.called_program;
  return block.has(IsoGroup::Unit) ? Block::kNone : block.program;
}

/// The use of labels in the block read last.
AheadSearch::LabelUse AheadSearch::label_use() const {
  LabelUse use;
  if (!is_iso()) {
    const Block& block = parts_.blocks[0];
    if (block.kind == BlockKind::Label) use.set = block.target;
    const bool jumps = block.kind == BlockKind::Function && block.function >= 9;
    const bool compares = block.kind == BlockKind::Comparison;
    if (block.kind == BlockKind::LabelCall || jumps || compares) use.used = block.target;
    use.returns = block.kind == BlockKind::LabelCall && block.repeats == Block::kNone;
    const std::int32_t label = std::max(use.set, use.used);
    const std::hash<std::string_view> hash;
    if (label > 255) use.later = hash(parts_.later.name) + static_cast<std::size_t>(label);
    return use;
  }
  const IsoBlock& block = reader_.iso_block();
  if (block.has(IsoGroup::Label)) {
    use.set = block.label;
  } else {
    use.used = block.label;
    use.returns = block.function == IsoBlock::kNone && block.repeats == IsoBlock::kNone;
  }
  return use;
}

/// With more labels than are kept it may lead back.
bool AheadSearch::comes_back_later(bool is_before, const LabelUse& use) {
  constexpr std::size_t kMost = 20'000;
  if (is_before) {
    if (use.set > 0 && later_before_.size() <= kMost) later_before_[use.later] = true;
    return false;
  }
  const auto at = later_before_.find(use.later);
  if (at == later_before_.end()) return use.used > 0 && later_before_.size() > kMost;
  return use.used > 0 && (!use.returns || at->second);
}

/// Notes the labels before the place; after it: the block leads back over it.
bool AheadSearch::comes_back(bool is_before) {
  const LabelUse use = label_use();
  if (use.later != 0) return comes_back_later(is_before, use);
  const auto is_label = [](std::int32_t label) { return label >= 0 && label < 256; };
  if (is_before) {
    if (use.set == 0) {
      is_sub_open_.reset();
      for (auto& [label, is_open] : later_before_) is_open = false;
    }
    if (use.set > 0 && is_label(use.set)) {
      before_.set(static_cast<std::size_t>(use.set));
      is_sub_open_.set(static_cast<std::size_t>(use.set));
    }
    return false;
  }
  if (!is_label(use.used)) return false;
  return (use.returns ? is_sub_open_ : before_).test(static_cast<std::size_t>(use.used));
}

AheadSearch::Outcome AheadSearch::find_return(const TextPlace& place) {
  reader_.drop_window();
  for (unsigned count = 0; count < kBlocksPerCall; ++count) {
    const Step step = next();
    if (step == Step::NotYet) return Outcome::NotYet;
    if (step == Step::End) return Outcome::Missing;
    if (step == Step::Skipped) continue;
    if (comes_back(reader_.block_place().offset < place.offset)) return Outcome::Found;
    if (is_over()) return Outcome::Missing;
  }
  return Outcome::More;
}

AheadSearch::Outcome AheadSearch::look_up() {
  const ProgramLookup lookup = reader_.find(fmt::format("{}", *wanted_));
  if (lookup.state == ProgramLookup::State::NotYet) return Outcome::NotYet;
  called_.push_back(*wanted_);
  wanted_.reset();
  return lookup.state == ProgramLookup::State::NotFound ? Outcome::Found : Outcome::Missing;
}

AheadSearch::Outcome AheadSearch::find_missing_program() {
  reader_.drop_window();
  while (blocks_ < kMaxBlocks && called_.size() < kMaxPrograms) {
    if (wanted_) {
      if (const Outcome outcome = look_up(); outcome != Outcome::Missing) return outcome;
    }
    const Step step = next();
    if (step == Step::NotYet) return Outcome::NotYet;
    if (step == Step::Skipped) continue;
    if (step == Step::End || is_over()) return Outcome::Missing;
    const std::int32_t number = called_program();
    const bool is_new = number != Block::kNone && number != state_.program.number &&
                        std::ranges::find(called_, number) == called_.end();
    if (is_new) wanted_ = number;
  }
  return Outcome::Missing;
}

}  // namespace dripline::interpreter::tnc155
