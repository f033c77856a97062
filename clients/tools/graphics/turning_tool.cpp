#include "clients/tools/graphics/turning_tool.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/base/units.hpp"

namespace dripline::graphics {
namespace {

/// Edge length of the insert that is drawn: of the usual sizes.
constexpr double kUsualEdge = 15;
/// Free space between the edge and a wall that the tip follows, degrees.
constexpr double kClearance = 3;
constexpr double kThreadDegrees = 60;
constexpr double kDrillPointDegrees = 118;

SectionPoint toward(double degrees, double length) {
  const double angle = Angle::degrees(degrees).radians();
  return {length * std::cos(angle), length * std::sin(angle)};
}

/// From the nose's center to the imaginary tip, in radii.
SectionPoint tip_of(int type) {
  constexpr SectionPoint kTips[] = {{0, 0}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1},
                                    {1, 0}, {0, 1}, {-1, 0}, {0, -1},  {0, 0}};
  return kTips[std::clamp(type, 0, 9)];
}

ConvexOutline circle(const SectionPoint& center, double radius) {
  constexpr int kCorners = 16;
  ConvexOutline outline;
  for (int i = 0; i < kCorners; ++i) {
    const SectionPoint corner = toward(i * 360.0 / kCorners, radius);
    outline.push_back({center.z + corner.z, center.x + corner.x});
  }
  return outline;
}

/// The area of `outline` and of everything from it in direction `degrees`.
ConvexOutline drawn_out(const ConvexOutline& outline, double degrees, double length) {
  return swept(outline, {}, toward(degrees, length));
}

/// The insert of a corner tool: from its wall side (3 degrees off the X direction) back by its
/// angle.
ConvexOutline insert_of(const SectionPoint& center, const SectionPoint& tip, double nose,
                        double degrees) {
  const double up = tip.x < 0 ? 1 : -1, right = tip.z < 0 ? 1 : -1;
  ConvexOutline outline = circle(center, nose);
  for (const double edge : {90 - kClearance, 90 - kClearance - degrees}) {
    const SectionPoint end = toward(edge, kUsualEdge);
    outline.push_back({center.z + right * end.z, center.x + up * end.x});
  }
  return swept(outline, {}, {});
}

ConvexOutline pointed(const SectionPoint& center, double nose, double outwards) {
  ConvexOutline outline = circle(center, nose);
  for (const double side : {-1.0, 1.0}) {
    const SectionPoint end = toward(outwards + side * kThreadDegrees / 2, kUsualEdge);
    outline.push_back({center.z + end.z, center.x + end.x});
  }
  return swept(outline, {}, {});
}

ConvexOutline drill(double diameter, double reach) {
  const double radius = diameter / 2;
  const double point = radius / std::tan(Angle::degrees(kDrillPointDegrees / 2).radians());
  return {{0, 0}, {point, -radius}, {reach, -radius}, {reach, radius}, {point, radius}};
}

/// From the tip to the rest of the tool.
double shank_direction(int type) {
  switch (type) {
    case 1:
    case 2:
    case 6:
      return -90;  // within a bore
    case 5:
      return 180;
    case 7:
      return 0;
    default:
      return 90;
  }
}

}  // namespace

std::vector<ConvexOutline> cutting_pieces(const TurningTool& tool, const ToolUse& use) {
  if (tool.type == 7 && use.is_on_axis && tool.width) return {drill(*tool.width, use.reach)};
  const SectionPoint tip = tip_of(tool.type);
  const double nose = std::max(tool.radius, use.least_radius);
  const SectionPoint center{-tip.z * nose, -tip.x * nose};
  const double shank = shank_direction(tool.type);
  if (use.is_thread) {
    ConvexOutline point = pointed(center, nose, shank == -90 ? -90 : 90);
    return {std::move(point), drawn_out(circle(center, nose), shank, use.reach)};
  }
  ConvexOutline cutting = circle(center, nose);
  const bool is_corner = tool.type >= 1 && tool.type <= 4;
  if (tool.width && !is_corner) {
    const bool is_across = shank == 90 || shank == -90;
    const double rest = std::max(0.0, *tool.width - 2 * nose);
    cutting = swept(cutting, {}, is_across ? SectionPoint{rest, 0} : SectionPoint{0, rest});
  }
  std::vector<ConvexOutline> pieces{drawn_out(cutting, shank, use.reach)};
  if (is_corner) pieces.push_back(insert_of(center, tip, nose, use.insert_degrees));
  return pieces;
}

}  // namespace dripline::graphics
