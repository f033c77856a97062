#include "clients/tools/comparison/action_reader.hpp"

#include <fmt/format.h>
#include <iterator>
#include <variant>

#include "clients/tools/comparison/outside_inputs.hpp"

namespace dripline::comparison {
namespace {

constexpr std::uint64_t kStepBlocks = 256;
/// States of spindle and coolant that wait to be put in order, across controls.
constexpr std::size_t kMaxStates = 64;

bool is_state(const Action& action) {
  return action.kind == ActionKind::Spindle || action.kind == ActionKind::Coolant;
}

}  // namespace

ActionReader::ActionReader(const MotionSide& side, bool across_controls, double shift,
                           unsigned shifted_axes)
    : side_(side),
      across_controls_(across_controls),
      setup_(started_beside(side.setup, shift, shifted_axes)),
      recorder_(queue_, setup_.start, across_controls) {
  setup_.switches.optional_stop = true;  // an optional stop is compared, whatever the switch is
}

Result<void> ActionReader::begin(const MotionOptions& options) {
  if (side_.stage) stage_ = side_.stage(recorder_, setup_.start);
  interpreter::EventSink& sink = stage_ ? *stage_ : static_cast<interpreter::EventSink&>(recorder_);
  auto run = interpreter::OfflineRun::begin(
      side_.dialect, setup_, side_.source, sink,
      {.max_blocks = options.max_blocks, .max_repeated_blocks = options.max_repeated_blocks});
  if (!run) return fail(run.error());
  run_.emplace(*std::move(run));
  recorder_.watch(run_->interpreter());
  return {};
}

/// Across controls a coolant state may still be followed by one of the spindle, which goes first.
std::size_t ActionReader::ready() const {
  std::size_t count = queue_.size();
  if (!across_controls_ || is_over_) return count;
  for (std::size_t i = 0; i < kMaxStates && count > 0 && is_state(queue_[count - 1]); ++i) --count;
  return count;
}

void ActionReader::step() {
  const auto is_over = run_->step(kStepBlocks);
  is_over_ = !is_over || *is_over;
  if (is_over) return;
  const Place place = queue_.empty() ? last_place_ : queue_.back().place;
  Action& action = queue_.push();
  action.kind = ActionKind::Alarm;
  action.place = place;
  action.text = is_over.error().what;
  fault_ = Condition{Condition::Kind::Fault, false, place, is_over.error().what};
}

std::size_t ActionReader::fill(std::size_t count) {
  while (!is_over_ && ready() < count) step();
  return ready();
}

void ActionReader::drop(std::size_t count) {
  if (count == 0) return;
  last_place_ = queue_[count - 1].place;
  queue_.drop(count);
  dropped_ += count;
}

ActionReader::Kept ActionReader::kept() {
  Kept kept;
  auto* memory = dynamic_cast<interpreter::RetainedMemory*>(&run_->interpreter());
  if (memory == nullptr) return kept;
  kept.cells = memory->memory_cells();
  memory->read_memory(kept.values);
  return kept;
}

void ActionReader::add_conditions(bool is_second, std::vector<Condition>& conditions) const {
  using enum Condition::Kind;
  // Of the alternatives of Question; a signal is an input of the machine as well.
  static constexpr Condition::Kind kKinds[]{Probe, Prompt, Input, Clock, Input};
  static_assert(std::size(kKinds) == std::variant_size_v<interpreter::Question>);
  const auto outcome = run_->outcome();
  for (const auto& asked : outcome.asked) {
    const auto& origin = asked.origin;
    conditions.push_back(
        {kKinds[asked.kind], is_second, {origin.line, origin.offset, origin.program}, {}});
  }
  for (const OutsideInput& input :
       find_outside_inputs(side_.dialect, side_.source, recorder_.programs())) {
    const auto kind = input.kind == OutsideInput::Kind::Variable ? Variable : BlockSkip;
    conditions.push_back({kind, is_second, input.place, input.name});
  }
  if (outcome.alarm) {
    const auto& alarm = *outcome.alarm;
    conditions.push_back({Alarm,
                          is_second,
                          {alarm.line, recorder_.alarm_offset(), outcome.alarm_program},
                          fmt::format("{}: {}", alarm.id, alarm.text)});
  }
  if (fault_) {
    conditions.push_back(*fault_);
    conditions.back().is_second = is_second;
  }
}

}  // namespace dripline::comparison
