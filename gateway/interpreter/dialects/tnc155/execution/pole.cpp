#include <fmt/core.h>

#include "gateway/interpreter/dialects/tnc155/execution/execution.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/start_search.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"

namespace dripline::interpreter::tnc155 {

namespace {

/// Both coordinates, by themselves.
bool names_pole(const Block& block, const PlaneAxes& axes) {
  AxisMask named = 0;
  for (const Coordinate& word : block.words())
    if (!word.is_incremental) named |= bit(word.axis);
  const AxisMask both = static_cast<AxisMask>(bit(axes.first) | bit(axes.second));
  return (named & both) == both;
}

}  // namespace

bool set_pole(Run& run, const Block& block) {
  State& state = run.state;
  const PlaneAxes axes = axes_of(state.plane);
  for (std::size_t i = 0; i < block.coordinate_count; ++i) {
    const Axis axis = block.coordinates[i].axis;
    if (axis == axes.first || axis == axes.second) continue;
    return run.fail(ErrorCode::PlaneWronglyDefined,
                    fmt::format("the pole is in the working plane {}{}, which has no {}",
                                letter(axes.first), letter(axes.second), letter(axis)));
  }
  if (!names_pole(block, axes) && !refuse_before_positioning(run, "CC by the present position"))
    return false;
  Target pole = here(state);
  read_coordinates(run, block, pole);
  for (const Axis axis : {axes.first, axes.second}) {
    state.pole[static_cast<std::size_t>(axis)] = pole.at[static_cast<std::size_t>(axis)];
  }
  state.has_pole = true;
  state.polar.is_current = false;
  ++run.frame_changes;
  return true;
}

}  // namespace dripline::interpreter::tnc155
