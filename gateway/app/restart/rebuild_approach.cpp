// From where the axes are to the place: what is known of it when the gate opens.
#include <algorithm>
#include <cmath>

#include "gateway/app/restart/rebuild.hpp"

namespace dripline::gateway {
namespace {

constexpr double kSamePosition = 1e-9;  ///< millimeters or degrees
constexpr double kMoved = 0.05;         ///< more than axes move while they come to rest

}  // namespace

/// As the run has left it, after the block executed last.
void Rebuild::note_spindle() {
  const interpreter::ActiveModes modes = parts_.interpreter.modes();
  const std::optional<int> tool = parts_.tracker.delivered().tool;
  if (in_spindle_.tool && in_spindle_.tool != tool) return;  // changed since
  in_spindle_.axis = modes.tool_axis;
  if (!parts_.machine.capabilities().adds_lengths) return;
  if (!in_spindle_.tool) in_spindle_.lengths.of_axes = machine::axis_lengths_of(modes);
  in_spindle_.tool = tool;
  in_spindle_.lengths.of_tool = modes.lengths();
}

/// Another tool is put in after the retraction, and up to there the axes are at the program's
/// position + the length of the one that is in the spindle.
void Rebuild::compare_tools() {
  const std::optional<int> tool = parts_.tracker.delivered().tool;
  changes_tool_ = tool && in_spindle_.tool && tool != in_spindle_.tool;
  if (!changes_tool_) return;
  report_.tool_to_change = tool;
  for (std::size_t i = 0; i < report_.length_change.size(); ++i)
    report_.length_change[i] = lengths_->of_axes[i] - in_spindle_.lengths.of_axes[i];
}

void Rebuild::note_lengths() {
  const interpreter::ActiveModes modes = parts_.interpreter.modes();
  lengths_ = {.of_axes = machine::axis_lengths_of(modes), .of_tool = modes.lengths()};
}

/// From here on positions are those of the program, which leave its lengths out. Where the control
/// has read ahead over another change of them, the approach is refused (AxisLengths).
machine::ToolLengths Rebuild::take_lengths() {
  if (!parts_.machine.capabilities().adds_lengths) {
    lengths_.emplace();
    return {};
  }
  if (parts_.interpreter.origin().block <= target_) note_lengths();
  const machine::ToolLengths present = parts_.machine.status().lengths;
  if (!lengths_) lengths_ = {.of_axes = present, .of_tool = present};
  const machine::ToolLengths lengths = lengths_->of_axes;
  report_.machine = machine::minus(report_.machine, lengths);
  if (report_.stopped_at) report_.stopped_at = machine::minus(*report_.stopped_at, lengths);
  parts_.begin_lengths(report_.machine, lengths);
  return lengths;
}

/// An axis that the program has not moved before the place is where it was when the run began: the
/// first block may name only where it was already.
void Rebuild::expect_unmoved(const machine::ToolLengths& lengths) {
  const interpreter::Position begun = machine::minus(parts_.plan.conditions.begun_at, lengths);
  for (const interpreter::Axis axis : interpreter::kAllAxes) {
    const bool is_there = std::fabs(begun.raw(axis) - report_.machine.raw(axis)) <= kSamePosition;
    if (is_there || parts_.tracker.delivered().position.has(axis)) continue;
    parts_.tracker.expect(axis, begun.raw(axis));
  }
}

/// The highest place along the tool axis where the run has been, also after the place.
interpreter::Position Rebuild::highest(interpreter::Axis up) const {
  interpreter::Position highest;
  const auto add = [&](const ReachedHeights& heights, const machine::ToolLengths& tool) {
    const auto value = heights.highest(up, {.of_axes = lengths_->of_axes, .of_tool = tool});
    if (value && !(highest.has(up) && highest.raw(up) >= *value)) highest.set_raw(up, *value);
  };
  for (const auto* heights :
       {&parts_.tracker.delivered().heights, reached_ ? &*reached_ : nullptr}) {
    if (heights == nullptr) continue;
    add(*heights, lengths_->of_tool);
    if (changes_tool_) add(*heights, in_spindle_.lengths.of_tool);
  }
  return highest;
}

/// Whether the run has shown that its highest place is clear to be led across at.
bool Rebuild::is_clear(const interpreter::Position& highest, interpreter::Axis up) const {
  if (parts_.is_tool_axis_manual) return true;
  const ReachedHeights& heights = reached_ ? *reached_ : parts_.tracker.delivered().heights;
  return highest.has(up) && heights.is_clear(up, highest.raw(up), *lengths_);
}

void Rebuild::on_open(interpreter::EventSink& out) {
  const machine::ToolLengths lengths = take_lengths();
  if (!parts_.tracker.has_ended()) {
    expect_unmoved(lengths);
    compare_tools();
  }
  report_.delivered = parts_.tracker.delivered();
  report_.after = parts_.tracker.delivered().ended;
  report_.has_ended = parts_.tracker.has_ended();
  if (report_.has_ended) {
    report_.delivered.spindle = {};
    report_.delivered.flood = report_.delivered.mist = false;
    return;
  }
  Approach approach;
  approach.is_lathe = parts_.is_lathe;
  passed_.stop_at(report_.stopped_at);
  approach.passed = &passed_;
  approach.stopped_at = report_.stopped_at;
  approach.tool_axis = tool_axis_.value_or(interpreter::Axis::Z);
  approach.from = report_.machine;
  approach.to = report_.delivered.position;
  approach.highest = highest(approach.tool_axis);
  approach.is_clear = is_clear(approach.highest, approach.tool_axis);
  approach.changes_tool = changes_tool_;
  if (changes_tool_ && in_spindle_.axis && in_spindle_.axis != approach.tool_axis) {
    approach.spindle_axis = in_spindle_.axis;
    const interpreter::Axis old_axis = *in_spindle_.axis;
    if (const auto other = highest(old_axis); other.has(old_axis))
      approach.highest.set_raw(old_axis, other.raw(old_axis));
  }
  approach.feed = report_.delivered.feed;
  approach.spindle_turns = report_.delivered.spindle.state != interpreter::SpindleState::Off;
  report_.approach = approach.plan();
  approach_fault_ = place_fault();
  if (approach_fault_.empty()) approach_fault_ = tilt_fault(approach);
  if (approach_fault_.empty()) approach_fault_ = thread_fault();
  if (approach_fault_.empty()) approach_fault_ = chain_fault();
  if (approach_fault_.empty()) approach_fault_ = report_.approach.fault;
  if (!approach_fault_.empty()) return;
  write_approach(report_.approach, report_.delivered, report_.after, out);
  const auto& stopped_at = report_.stopped_at;
  const bool is_end = report_.after.block == parts_.plan.ending.executed.executed;
  parts_.tracker.measure(report_.after.block + 1,
                         is_end && stopped_at ? *stopped_at : report_.machine);
}

bool Rebuild::has_approach() const {
  return !report_.approach.before.empty() || !report_.approach.after.empty() ||
         !report_.approach.fault.empty();
}

/// A device that may have been switched off shows another place then.
std::string Rebuild::place_fault() const {
  if (parts_.plan.doubt.empty()) return {};
  const interpreter::Position& at = report_.delivered.position;
  const bool is_elsewhere = std::ranges::any_of(interpreter::kAllAxes, [&](auto axis) {
    return at.has(axis) && std::fabs(at.raw(axis) - report_.machine.raw(axis)) > kSameAxes;
  });
  return is_elsewhere ? parts_.plan.doubt : std::string();
}

/// A tap, or a tool in a thread, leaves it only along the thread and with the spindle.
std::string Rebuild::thread_fault() const {
  if (!report_.stopped_at || !has_approach()) return {};
  if (!parts_.plan.ending.is_in_thread && !passed_.is_in_thread(*report_.stopped_at)) return {};
  for (const interpreter::Axis axis : interpreter::kAllAxes) {
    const double moved = report_.machine.raw(axis) - report_.stopped_at->raw(axis);
    if (std::fabs(moved) > kMoved) return {};  // it was retracted
  }
  return "the tool stopped in a thread, and the approach would pull it out: retract it at the "
         "machine first, a tap with its spindle reversed";
}

/// The spindle's angle is lost, and the control waits for it only where a thread begins.
std::string Rebuild::chain_fault() const {
  const std::uint64_t block = passed_.thread_begins_in();
  if (block == 0) return {};
  return fmt::format(
      "block {} continues the thread that begins in block {}, and would not meet it again: restart "
      "there, block={}",
      report_.after.block + 1, block, block);
}

/// The approach goes up and down along the tool axis. With a head that tilts the tool that is
/// through the part.
std::string Rebuild::tilt_fault(const Approach& approach) const {
  const bool is_tilted_there = parts_.interpreter.tilts_tool(approach.to);
  if (!has_approach() || (!is_tilted_there && !parts_.interpreter.tilts_tool(approach.from)))
    return {};
  return fmt::format(
      "the tool is tilted {}, and an approach along {} would lead through the part: {}",
      is_tilted_there ? "at the place" : "where the axes are",
      interpreter::letter(approach.tool_axis),
      is_tilted_there ? "restart at a block before the head tilts"
                      : "retract it and bring the head back by MDI first");
}

}  // namespace dripline::gateway
