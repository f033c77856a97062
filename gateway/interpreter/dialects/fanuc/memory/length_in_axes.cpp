#include "gateway/interpreter/dialects/fanuc/memory/length_in_axes.hpp"

#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"
#include "gateway/interpreter/dialects/fanuc/memory/tool_offsets.hpp"

namespace dripline::interpreter::fanuc {

namespace {

using Lengths = LengthInAxes::Lengths;

/// Of X, Y and Z, as ActiveModes has them.
Lengths in_force(const Run& run) {
  Lengths lengths{};
  const ModalState& state = run.state;
  if (run.options.is_lathe) {
    const auto offset = static_cast<std::size_t>(state.h_number);
    lengths[0] = run.memory.tools.x_geometry[offset] + run.memory.tools.x_wear[offset];
    lengths[2] = length_of_offset(run, state.h_number);
  } else {
    lengths[static_cast<std::size_t>(state.length_axis)] = state.length_offset;
  }
  return lengths;
}

bool is_named(const Run& run, std::size_t axis) {
  const std::uint8_t one_shot = run.block.parts.one_shot;
  const bool by_cycle = run.state.is_cycle() || run.state.g[kMotionGroup] >= kBoxTurning ||
                        (one_shot >= kTurningCycles && one_shot <= kTurningCycles + 6);
  return by_cycle || run.block.words.has(kWordOfAxis[axis]);
}

constexpr std::uint8_t bit_of(std::size_t axis) {
  return static_cast<std::uint8_t>(1U << axis);
}

/// The block gives its coordinate.
void close_axis(ModalState& state, std::size_t axis) {
  state.open_axes &= static_cast<std::uint8_t>(~bit_of(axis));
}

std::uint8_t axes_with_length(const ActiveModes& modes) {
  std::uint8_t axes = 0;
  if (modes.tool_length_x != Length{}) axes |= bit_of(0);
  if (modes.tool_length_z != Length{}) axes |= bit_of(static_cast<std::size_t>(modes.length_axis));
  return axes;
}

}  // namespace

void note_programmed_axes(Run& run) {
  LengthInAxes& axes = run.state.length_in_axes;
  const Lengths lengths = in_force(run);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (!is_named(run, i)) continue;
    axes.taken[i] = lengths[i];
    axes.bare &= static_cast<std::uint8_t>(~bit_of(i));
  }
  axes.is_even = axes.bare == 0 && axes.taken == lengths;
}

void note_machine_axes(Run& run) {
  LengthInAxes& axes = run.state.length_in_axes;
  axes.is_even = false;
  for (std::size_t i = 0; i < axes.taken.size(); ++i) {
    if (!run.block.words.has(kWordOfAxis[i])) continue;
    close_axis(run.state, i);
    axes.taken[i] = 0;
    axes.bare |= bit_of(i);
    if (run.state.is_compensating())
      axes.doubtful |= bit_of(i);
    else
      axes.doubtful &= static_cast<std::uint8_t>(~bit_of(i));
  }
}

void note_set_axes(Run& run) {
  LengthInAxes& axes = run.state.length_in_axes;
  const Lengths lengths = in_force(run);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    if (!run.block.words.has(kWordOfAxis[i])) continue;
    close_axis(run.state, i);
    if (axes.taken[i] != lengths[i]) axes.doubtful |= bit_of(i);
  }
}

double length_along(const Run& run, Axis axis) {
  const auto i = static_cast<std::size_t>(axis);
  const bool is_bare = i < 3 && (run.state.length_in_axes.bare & bit_of(i)) != 0;
  return i < 3 && !is_bare ? in_force(run)[i] : 0;
}

double length_in_work_position(const Run& run, Axis axis) {
  if (run.tilted.is_on()) return 0;
  if (run.options.is_lathe) {
    const auto offset = static_cast<std::size_t>(run.state.h_number);
    const ToolOffsets& tools = run.memory.tools;
    const double geometry = axis == Axis::X   ? tools.x_geometry[offset]
                            : axis == Axis::Z ? tools.length_geometry[offset]
                                              : 0;
    if (geometry != 0) return kNull;
  }
  return length_along(run, axis);
}

std::uint8_t bare_axes(const ModalState& state, const ActiveModes& modes) {
  return state.length_in_axes.bare & axes_with_length(modes);
}

bool is_length_doubtful(const ModalState& state, const ActiveModes& modes) {
  return (state.length_in_axes.doubtful & axes_with_length(modes)) != 0;
}

}  // namespace dripline::interpreter::fanuc
