#include <fmt/format.h>
#include <cmath>
#include <utility>

#include "gateway/app/run/run_loop.hpp"

/// What the control has in force between two runs.
namespace dripline::gateway {

namespace {

bool is_there(const interpreter::Position& a, const interpreter::Position& b) {
  constexpr double kSamePlace = 1e-6;
  for (const interpreter::Axis axis : interpreter::kAllAxes)
    if (std::fabs(a.raw(axis) - b.raw(axis)) > kSamePlace) return false;
  return true;
}

}  // namespace

/// Modes that do not fit the machine any more would move it to a place that no one meant.
const interpreter::Snapshot* RunLoop::modes_for(const StartOrigin& origin) {
  if ((!origin.from.is_mdi && !origin.from.part) || !modes_) return nullptr;
  const machine::MachineStatus now = parts_.machine.status();
  std::string changed;
  if (!is_there(modes_->at, now.position)) changed = "the axes were moved since";
  if (modes_->spindle != now.spindle.state) changed = "the spindle was switched since";
  if (modes_->setup != sha256(origin.setup).hex()) changed = "the setup was changed since";
  if (modes_->memory != parts_.memory.digest()) changed = "the control's memory was changed since";
  if (changed.empty()) return &modes_->snapshot;
  why_no_modes_ = std::move(changed);
  return nullptr;
}

/// Of a run that is on disk: the next one has those that it leaves.
void RunLoop::begin_modes(const StartOrigin& origin, bool has_modes) {
  is_keyed_in_ = origin.from.is_mdi && (!has_modes || modes_->is_keyed_in);
  modes_of_part_.reset();
  if (origin.from.part && has_modes) modes_of_part_.swap(modes_);
  modes_.reset();
  why_no_modes_ = "the last run was cut off";
}

/// Before the session is gone.
void RunLoop::take_modes() {
  if (parts_.run.last_execution != dds::Execution::ProgramCompleted) return keep_modes_of_part();
  const bool keeps_zero = parts_.run.session->keeps_zero_when_moved();
  auto snapshot = parts_.run.session->take_modes();
  if (!snapshot) {
    why_no_modes_ = snapshot.error().what;
    return;
  }
  const machine::MachineStatus now = parts_.machine.status();
  modes_ = Modes{.snapshot = *std::move(snapshot),
                 .at = now.position,
                 .spindle = now.spindle.state,
                 .setup = setup_given_,
                 .memory = parts_.memory.digest(),
                 .keeps_zero = keeps_zero,
                 .is_keyed_in = is_keyed_in_};
}

/// A program of a tape that an operator or an alarm of its own has cut off is begun again as it was
/// begun. Where the machine has failed, its axes may be elsewhere.
void RunLoop::keep_modes_of_part() {
  const auto& alarm = parts_.recorder.alarm();
  const bool is_by_program =
      ended_as_ == dds::RunOutcome::Alarmed && alarm && !alarm->id.starts_with("MCH");
  const bool is_orderly = ended_as_ == dds::RunOutcome::Aborted || is_by_program;
  if (!modes_of_part_ || !modes_of_part_->keeps_zero || !is_orderly ||
      parts_.run.was_emergency_stopped)
    return;
  modes_.swap(modes_of_part_);
  modes_of_part_.reset();
  modes_->at = parts_.machine.status().position;
  modes_->is_of_part = true;
}

void RunLoop::begin_jog() {
  resolve_at_rest();
  is_jogging_ =
      modes_ && modes_->keeps_zero && is_there(modes_->at, parts_.machine.status().position);
}

void RunLoop::end_jog(bool is_certain) {
  if (is_jogging_ && is_certain && modes_) modes_->at = parts_.machine.status().position;
  is_jogging_ = false;
}

/// What an operator may not expect: they are not those that a program has left.
std::string RunLoop::notice_of_modes(const StartOrigin& origin, bool has_modes) const {
  if (!origin.from.part && (!origin.from.is_mdi || !has_modes)) return {};
  const std::string text =
      origin.from.part ? fmt::format("program {} of the tape", *origin.from.part) : "MDI";
  if (!has_modes)
    return fmt::format("{} begins with the modes of power on: {}", text, why_no_modes_);
  if (modes_->is_of_part) {
    return fmt::format(
        "{} begins with the zero (G94), the feed and the registers that the program of the tape "
        "began with, which was cut off",
        text);
  }
  if (!modes_->is_keyed_in || !origin.from.part) return {};
  return fmt::format("{} begins with the modes of power on, and what MDI has set since", text);
}

}  // namespace dripline::gateway
