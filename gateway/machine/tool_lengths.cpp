#include "gateway/machine/tool_lengths.hpp"

namespace dripline::machine {

using interpreter::Axis;
using interpreter::Position;

ToolLengths axis_lengths_of(const interpreter::ActiveModes& modes) {
  ToolLengths lengths = modes.lengths();
  for (std::size_t i = 0; i < lengths.size(); ++i)
    if ((modes.bare_axes >> i & 1) != 0) lengths[i] = 0;
  return lengths;
}

Position plus(const Position& position, const ToolLengths& lengths) {
  Position moved = position;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const auto axis = static_cast<Axis>(i);
    if (lengths[i] == 0) continue;
    const bool is_marked = position.has(axis);
    moved.set_raw(axis, position.raw(axis) + lengths[i]);
    if (!is_marked) moved.unmark(axis);
  }
  return moved;
}

Position minus(const Position& position, const ToolLengths& lengths) {
  return plus(position, {-lengths[0], -lengths[1], -lengths[2]});
}

}  // namespace dripline::machine
