#include "gateway/interpreter/dialects/tnc155/itnc/pocket_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"

namespace dripline::interpreter::tnc155::itnc {
namespace {

/// Lines whose corners are further apart than the tool is wide leave a tip between them.
constexpr double kMaxOverlap = 1.4;

/// The middle of the figure, from the corner of a rectangle or the place in a slot that Q367 names.
PlaneVector rectangle_center(const Table& table, PlaneVector at) {
  const int corner = whole_word(table, 367);  // from the lower left counterclockwise
  if (corner == 0) return at;
  const PlaneVector along = unit_vector(table.of(224));
  const double first = corner == 1 || corner == 4 ? 1 : -1;
  const double second = corner <= 2 ? 1 : -1;
  return at + (first * table.mm(218) / 2) * along + (second * table.mm(219) / 2) * left_of(along);
}

PlaneVector slot_center(const Table& table, PlaneVector at) {
  const double half = table.mm(218) / 2, core = half - table.mm(219) / 2;
  const std::array by{0.0, half, core, -core, -half};
  return at + by[static_cast<std::size_t>(whole_word(table, 367))] * unit_vector(table.of(374));
}

}  // namespace

PocketShape shape_of(const Table& table, int cycle, PlaneVector at, double tool, int repeat) {
  PocketShape shape;
  switch (cycle) {
    case kRectangularPocket: {
      const double first = table.mm(218), second = table.mm(219);
      shape.core = PocketShape::Core::Line;
      shape.is_rectangle = true;
      shape.center = rectangle_center(table, at);
      shape.angle = table.of(224) + (first >= second ? 0 : 90);
      shape.half_length = std::fabs(first - second) / 2;
      shape.room = std::min(first, second) / 2 - tool;
      shape.corner = std::max(0.0, table.mm(220) - tool);
      break;
    }
    case kCircularPocket:
      shape.center = at;
      shape.room = table.mm(223) / 2 - tool;
      break;
    case kSlot:
      shape.core = PocketShape::Core::Line;
      shape.center = slot_center(table, at);
      shape.angle = table.of(374);
      shape.half_length = (table.mm(218) - table.mm(219)) / 2;
      shape.room = table.mm(219) / 2 - tool;
      break;
    default:
      shape.core = PocketShape::Core::Arc;
      shape.center = {table.mm(216), table.mm(217)};
      shape.angle = table.of(376) + repeat * table.of(378);
      shape.span = table.of(248);
      shape.radius = table.mm(375) / 2;
      shape.room = table.mm(219) / 2 - tool;
      break;
  }
  if (std::fabs(shape.room) < kSameLength) shape.room = 0;
  return shape;
}

double stepover(const Table& table, int cycle, double tool) {
  if (is_slot(cycle)) return tool;
  const double most = cycle == kRectangularPocket ? kMaxOverlap : 2;
  return tool * std::min(table.of(370), most);
}

int lines_to(double room, double step) {
  constexpr double kMaxLines = 1e6;  // more than a call may have
  if (room <= kSameLength) return 0;
  return static_cast<int>(std::ceil(std::min(room / step, kMaxLines) - kSliverOfStep));
}

double helix_radius(double room, double tool) {
  return room >= kLeastHelix * tool ? std::min(room, tool) : 0;
}

double ramp_length(const PocketShape& shape, double room, double tool) {
  if (shape.is_rectangle) return 2 * std::min(2 * tool, shape.half_length + room);
  return shape.core_length();
}

bool has_allowance(const Table& table) {
  return table.mm(368) > 0 || table.mm(369) > 0;
}

}  // namespace dripline::interpreter::tnc155::itnc
