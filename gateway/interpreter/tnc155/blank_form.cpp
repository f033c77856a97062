#include <fmt/core.h>

#include "gateway/interpreter/tnc155/cycles.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

/// The longest side of a blank, millimetres.
constexpr double kLongestSide = 14'000;

bool take_minimum(Run& run, const Block& block) {
  BlankState& blank = run.state.blank;
  blank = {};
  blank.has_minimum = true;
  if (block.axis) blank.axis = *block.axis;
  for (std::size_t i = 0; i < block.coordinate_count; ++i) {
    const Coordinate& corner = block.coordinates[i];
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

}  // namespace

bool define_blank(Run& run, const Block& block) {
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
  for (std::size_t i = 0; i < block.coordinate_count; ++i) {
    const Coordinate& corner = block.coordinates[i];
    if (corner.axis > Axis::Z) {
      return run.fail(ErrorCode::BlankFormIncorrect, "the MAX corner is X, Y and Z");
    }
    const double base = corner.is_incremental ? event.min.raw(corner.axis) : 0;
    event.max.set_raw(corner.axis, base + run.length(corner.value));
  }
  for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
    if (!check_side(run, axis, event.max.raw(axis) - event.min.raw(axis))) return false;
  }
  run.events().on_blank(event);
  return true;
}

}  // namespace dripline::interpreter::tnc155
