#include "gateway/app/run/tool_in_position.hpp"

#include <fmt/format.h>
#include <cmath>
#include <limits>

namespace dripline::gateway {

using interpreter::Axis;

namespace {

constexpr std::array kLengthAxes{Axis::X, Axis::Y, Axis::Z};

bool is_none(double length) {
  constexpr double kSmallest = 1e-9;  // mm
  return std::fabs(length) <= kSmallest;
}

/// A block may be noted in parts, with the number of the one before: so many blocks after the one
/// that is noted the first move may still be executed.
constexpr std::uint64_t kUncertain = 1;
constexpr std::uint64_t kLastBlock = std::numeric_limits<std::uint64_t>::max();

}  // namespace

std::string to_text(const ToolLengths& lengths, bool is_lathe) {
  std::string text;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (is_none(lengths[i])) continue;
    const bool is_diameter = is_lathe && i == 0;
    text += fmt::format("{}{} {:.4g}", text.empty() ? "" : ", ",
                        interpreter::letter(kLengthAxes[i]), lengths[i] * (is_diameter ? 2 : 1));
  }
  return text.empty() ? text : text + " mm";
}

std::string ToolInPosition::length_fault(Axis axis) const {
  const auto i = static_cast<std::size_t>(axis);
  if (i >= unknown.size() || !unknown[i]) return {};
  return fmt::format(
      "a program was cut off while the tool's length along {} changed, or ended with a tilted "
      "tool or in machine coordinates (G28, G53): which length is in the position is not certain. "
      "Run a program from its beginning "
      "first",
      interpreter::letter(axis));
}

std::string ToolInPosition::datum_fault(Axis axis, bool is_lathe) const {
  const auto i = static_cast<std::size_t>(axis);
  if (i >= in_force.size()) return {};
  if (unknown[i]) return length_fault(axis);
  if (!is_none(in_force[i] - left_out[i])) {
    return fmt::format(
        "another tool's length along {} has come into force since the last move: move the axes "
        "first",
        interpreter::letter(axis));
  }
  if (is_none(dropped[i])) return {};
  ToolLengths lost{};
  lost[i] = dropped[i];
  return fmt::format(
      "MDI has begun without the tool whose length ({}) was in force: call the tool by MDI first, "
      "so that it is certain whose position becomes the datum",
      to_text(lost, is_lathe));
}

void ToolInPosition::drop_tool(interpreter::Position& position) {
  for (std::size_t i = 0; i < in_force.size(); ++i) {
    if (!is_none(in_force[i])) dropped[i] = in_force[i];
    if (is_none(left_out[i])) continue;
    const Axis axis = kLengthAxes[i];
    position.set_raw(axis, position.raw(axis) + left_out[i]);
  }
  in_force = left_out = {};
}

void ToolHistory::begin(const std::optional<ToolInPosition>& before,
                        const interpreter::ActiveModes& modes) {
  const ToolLengths in_force = modes.lengths();
  begun_ = before.value_or(ToolInPosition{});
  entries_.clear();
  tool_called_.reset();
  entries_.push_back({.in_force = in_force,
                      .left_out_before = before ? before->left_out : in_force,
                      .is_plain = modes.is_length_plain,
                      .is_at_beginning = true});
}

/// Of the position after `block`.
ToolLengths ToolHistory::left_out(const Entry& entry, std::uint64_t block) const {
  ToolLengths lengths = entry.in_force;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const bool has_moved = entry.moved[i].last != 0 && entry.moved[i].last <= block;
    if ((shifts_ || entry.is_at_beginning) && !has_moved) lengths[i] = entry.left_out_before[i];
  }
  return lengths;
}

void ToolHistory::note(std::uint64_t block, const interpreter::ActiveModes& modes,
                       const EventTracker::Moves& moves) {
  const Entry& last = entries_.back();
  const ToolLengths lengths = modes.lengths();
  if (lengths != last.in_force || modes.is_length_plain != last.is_plain)
    entries_.push_back({.block = block, .in_force = lengths, .is_plain = modes.is_length_plain});
  for (std::size_t i = 0; i < moves.axes.size(); ++i)
    if (moves.axes[i].last != 0) attribute(i, moves.axes[i]);
  if (moves.has_tool && !tool_called_) tool_called_ = block;
}

/// To the entries under which the blocks run: a move may be given after the length has changed.
void ToolHistory::attribute(std::size_t axis, EventTracker::Moves::Blocks blocks) {
  for (std::size_t k = entries_.size(); k-- > 0;) {
    Entry& entry = entries_[k];
    const std::uint64_t begin = k == 0 ? 0 : entry.block;
    if (blocks.last < begin) continue;
    if (entry.moved[axis].last == 0)
      entry.moved[axis] = {std::max(blocks.first, begin), blocks.last};
    if (blocks.first >= begin) return;
    blocks.last = begin - 1;
  }
}

void ToolHistory::drop(std::uint64_t executing) {
  while (entries_.size() > 1 && entries_[1].block + kUncertain < executing) {
    entries_[1].left_out_before = left_out(entries_[0], kLastBlock);
    entries_.pop_front();
  }
}

ToolInPosition ToolHistory::at_end(const std::optional<std::uint64_t>& cut_off) const {
  const std::uint64_t block = cut_off.value_or(kLastBlock);
  std::size_t last = entries_.size() - 1;
  while (last > 0 && entries_[last].block > block) --last;
  Entry entry = entries_[0];
  for (std::size_t k = 1; k <= last; ++k) {
    const ToolLengths before = left_out(entry, kLastBlock);
    entry = entries_[k];
    entry.left_out_before = before;
  }
  ToolInPosition end = begun_;
  end.in_force = entry.in_force;
  end.left_out = left_out(entry, block);
  for (std::size_t i = 0; i < end.in_force.size(); ++i) {
    // Within the first move under another length the position is somewhere between the two.
    const bool has_changed = !is_none(entry.in_force[i] - entry.left_out_before[i]);
    const auto& moved = entry.moved[i];
    const bool is_between = cut_off && has_changed && moved.last != 0 && moved.first <= block &&
                            block <= moved.last + kUncertain;
    if (!entry.is_plain || is_between) end.unknown.set(i);
  }
  const bool has_changed = last > 0 || entry.in_force != entry.left_out_before;
  if (has_changed || (tool_called_ && *tool_called_ <= block)) end.dropped = {};
  return end;
}

}  // namespace dripline::gateway
