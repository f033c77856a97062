#include <fmt/core.h>
#include <algorithm>
#include <utility>

#include "gateway/interpreter/dialects/tnc155/cycles/cycles.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

/// The longest side of a blank, millimeters.
constexpr double kLongestSide = 14'000;

bool take_minimum(Run& run, const Block& block) {
  BlankState& blank = run.state.blank;
  blank = {};
  blank.has_minimum = true;
  if (block.axis) blank.axis = *block.axis;
  for (const Coordinate& corner : block.words()) {
    if (corner.axis > Axis::Z || corner.is_incremental) {
      return run.fail(ErrorCode::BlankFormIncorrect, "the MIN corner is X, Y and Z, absolute");
    }
    blank.minimum[static_cast<std::size_t>(corner.axis)] = run.length(corner.value);
  }
  return true;
}

bool check_side(Run& run, Axis axis, double side) {
  if (side > 0 && side <= kLongestSide) return true;
  return run.fail(ErrorCode::BlankFormIncorrect,
                  fmt::format("side {} is {} mm long; more than 0 and at most {}", letter(axis),
                              side, kLongestSide));
}

/// The place of the workpiece on the machine. Its corners are coordinates relative to the datum, so
/// the datum and a shift in force apply. Mirroring, rotation and scaling apply to the path only,
/// and the sides stay parallel to the axes; a basic rotation rotates the workpiece itself, so the
/// blank becomes the smallest one that contains it (manual: path functions, common rules; BLK
/// FORM).
void put_on_machine(const Transformation& transformation, Blank& blank) {
  Transformation place;
  place.datum = transformation.datum;
  place.shift = transformation.shift;
  place.basic_rotation = transformation.basic_rotation;
  place.basic_plane = transformation.basic_plane;
  constexpr unsigned kCorners = 8;
  const Position minimum = blank.min, maximum = blank.max;
  for (unsigned corner = 0; corner < kCorners; ++corner) {
    Transformation::Values point{};
    for (unsigned i = 0; i < 3; ++i) {
      point[i] = ((corner >> i & 1u) != 0 ? maximum : minimum).raw(static_cast<Axis>(i));
    }
    point = place.to_machine(point);
    for (unsigned i = 0; i < 3; ++i) {
      const Axis axis = static_cast<Axis>(i);
      const bool is_first = corner == 0;
      blank.min.set_raw(axis, is_first ? point[i] : std::min(blank.min.raw(axis), point[i]));
      blank.max.set_raw(axis, is_first ? point[i] : std::max(blank.max.raw(axis), point[i]));
    }
  }
}

}  // namespace

bool define_blank(Run& run, const Block& block) {
  run.ledger.take_all();
  const ControlVersion& version = run.options.version;
  if (!block.is_maximum && !version.has(Feature::Graphics)) {
    run.warn("TNC-NO-GRAPHICS", "BLK FORM is for graphics: " + version.lacks(Feature::Graphics));
  }
  if (!block.is_maximum) return take_minimum(run, block);
  BlankState& blank = run.state.blank;
  if (!blank.has_minimum) {
    return run.fail(ErrorCode::BlankFormIncorrect, "the MAX corner before the MIN corner");
  }
  Blank event;
  event.origin = run.origin;
  event.spindle_axis = blank.axis;
  for (std::size_t i = 0; i < 3; ++i) {
    event.min.set_raw(static_cast<Axis>(i), blank.minimum[i]);
    event.max.set_raw(static_cast<Axis>(i), blank.minimum[i]);
  }
  for (const Coordinate& corner : block.words()) {
    if (corner.axis > Axis::Z) {
      return run.fail(ErrorCode::BlankFormIncorrect, "the MAX corner is X, Y and Z");
    }
    const double base = corner.is_incremental ? event.min.raw(corner.axis) : 0;
    event.max.set_raw(corner.axis, base + run.length(corner.value));
  }
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    if (!check_side(run, axis, event.max.raw(axis) - event.min.raw(axis))) return false;
  }
  put_on_machine(run.state.transformation, event);
  run.events().on_blank(event);
  if (run.state.tool.number != 0) warn_of_graphics(run);
  return true;
}

void warn_of_graphics(Run& run) {
  BlankState& blank = run.state.blank;
  const ActiveTool& tool = run.state.tool;
  const bool is_across = blank.has_minimum && !(tool.is_called && tool.axis == blank.axis);
  const bool was_across = std::exchange(blank.is_tool_across, is_across);
  if (!is_across) {
    if (was_across) run.warn("TNC-GRAPHICS-AGAIN", "graphics: the tool is along the blank's axis");
    return;
  }
  run.warn("TNC-GRAPHICS",
           fmt::format("graphics: PGM-SECTION CANNOT BE SHOWN: {}, BLK FORM has {}",
                       tool.is_called ? fmt::format("the tool's axis is {}", letter(tool.axis))
                                      : "no TOOL CALL has named an axis",
                       letter(blank.axis)));
}

}  // namespace dripline::interpreter::tnc155
