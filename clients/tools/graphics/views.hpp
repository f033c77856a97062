#pragma once

#include "clients/tools/graphics/height_field.hpp"
#include "clients/tools/graphics/picture.hpp"
#include "protocol/base/units.hpp"

/// The views of the TNC 155's test graphics (its manual's chapter on graphics; what it leaves open
/// is decided here): darker means deeper.
namespace dripline::graphics {

/// Seen along the tool, in `shades` steps of depth: 5 is the control's plan view 1, 17 its view 2.
struct PlanView {
  int shades = 17;
};
Picture draw_plan(const HeightField& part, const PlanView& view = {});

enum class Arrangement : std::uint8_t {
  Din,  ///< first angle: the plan below the front, the view from the left on the right
  Us,   ///< third angle: the plan above the front, the view from the right on the right
};
/// The plan and two sections, with the places of the cuts marked.
struct PlanesView {
  Arrangement arrangement = Arrangement::Din;
  double section_u = 0.5;  ///< where the side section cuts, as a part of the width, 0 to 1
  double section_v = 0.5;  ///< where the front section cuts, as a part of the depth
};
Picture draw_planes(const HeightField& part, const PlanesView& view = {});

/// The part as a solid body, in parallel projection, with a symbol for the axes.
struct SolidView {
  Angle rotation = Angle::degrees(-30);  ///< about the vertical, counterclockwise from above
  Angle tilt = Angle::degrees(35);       ///< 0: from the front, 90: from above; clamped to 5..90
  std::size_t width = 800, height = 600;
};
Picture draw_solid(const HeightField& part, const SolidView& view = {});

}  // namespace dripline::graphics
