#include <array>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/rs274ngc/compensation/compensation_paths.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

/// From the center of the nose to the tip, in the plane ZX.
PlanePoint tip_of(const Compensation& compensation) {
  constexpr std::array<double, 9> kAlongZ{0, 1, -1, -1, 1, 1, 0, -1, 0};
  constexpr std::array<double, 9> kAlongX{0, -1, -1, 1, 1, 0, -1, 0, 1};
  const std::size_t quadrant = compensation.orientation;
  return {compensation.radius * kAlongZ[quadrant], compensation.radius * kAlongX[quadrant]};
}

void shift(Position& to, PlanePoint by) {
  to.set_raw(Axis::Z, to.raw(Axis::Z) + by.first);
  to.set_raw(Axis::X, to.raw(Axis::X) + by.second);
}

}  // namespace

void shift_held_to_tip(Run& run) {
  const PlanePoint tip = tip_of(run.state.compensation);
  for (auto& event : run.held.events()) {
    if (auto* line = std::get_if<Line>(&event)) shift(line->to, tip);
    if (auto* rapid = std::get_if<Rapid>(&event)) shift(rapid->to, tip);
    auto* arc = std::get_if<Arc>(&event);
    if (arc == nullptr) continue;
    shift(arc->to, tip);
    arc->center_first += Length::mm(tip.first);
    arc->center_second += Length::mm(tip.second);
  }
}

}  // namespace dripline::interpreter::rs274ngc
