#include <fmt/core.h>

#include "gateway/interpreter/dialects/tnc155/execution/execution.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"

namespace dripline::interpreter::tnc155 {

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
