#pragma once

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/fanuc/execution/coordinates.hpp"

namespace dripline::interpreter::fanuc {

/// G16: of the plane's two words the first is a radius, the second an angle. A radius of G90 is
/// about the program's zero, and stays; one of G91 is about the present place, for its block. An
/// angle of G91 counts from the last one. What the manual leaves open is an alarm (false).
bool place_by_angle(Run& run, Point3& point);

/// Whether G16 reads the word as a radius or an angle.
inline bool is_polar_word(const ModalState& state, std::size_t axis) {
  return state.is_polar() && static_cast<Axis>(axis) != axes_of(state.plane()).normal;
}

}  // namespace dripline::interpreter::fanuc
