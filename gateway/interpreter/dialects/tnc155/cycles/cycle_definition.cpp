#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "gateway/interpreter/core/shown_length.hpp"
#include "gateway/interpreter/dialects/tnc155/cycles/cycles.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"
#include "gateway/interpreter/dialects/tnc155/itnc/itnc_execution.hpp"
#include "gateway/interpreter/dialects/tnc155/reading/cycle_names.hpp"

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
                  fmt::format("side {} is {} long; more than 0 and at most {}", letter(axis),
                              shown_length(Length::mm(side), run.state.units),
                              shown_length(Length::mm(kLongestSide), run.state.units)));
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

namespace {

constexpr double kLongestDwell = 19'999.999;
constexpr double kMaxRotation = 360;

bool refuse_incomplete(Run& run, const Block& block) {
  const CycleState& cycle = run.state.cycle;
  if (block.cycle == cycle.defining && block.part == cycle.next_part) {
    return run.fail(ErrorCode::CycleIncomplete,
                    fmt::format("CYCL DEF {0}.{1} does not follow {0}.{2}", block.cycle, block.part,
                                block.part - 1));
  }
  return run.fail(ErrorCode::CycleIncomplete,
                  fmt::format("CYCL DEF {}.{} where {}.{} was due", block.cycle, block.part,
                              cycle.defining, cycle.next_part));
}

/// Sub-blocks come in their order, one after the other; of the datum shift only the first has to.
bool take_place(Run& run, const Block& block) {
  CycleState& cycle = run.state.cycle;
  if (block.part == 0) {
    if (!cycle.is_complete) return refuse_incomplete(run, block);
    cycle.defining = block.cycle;
    cycle.draft = MachiningCycle{};
    cycle.draft.number = block.cycle;
  } else if (block.cycle != cycle.defining || block.part != cycle.next_part ||
             run.state.blocks > cycle.block + 1) {
    return refuse_incomplete(run, block);
  }
  cycle.block = run.state.blocks;
  cycle.next_part = static_cast<std::uint8_t>(block.part + 1);
  const bool is_last = cycle.next_part >= cycle_parts(block.cycle).size();
  cycle.is_complete = is_last || (block.cycle == kDatumShift && block.part > 0);
  return true;
}

/// A contour ends as by M98 before what it is made of changes (manual: coordinate transformations).
/// Whether the next block begins another one with the same side, or none, is not stated.
bool transform(Run& run, const Transformation& changed) {
  run.state.needs_side |= run.state.is_compensating();
  end_contour(run, true);
  change_transformation(run, changed);
  return true;
}

bool shift_datum(Run& run, const Block& block) {
  run.ledger.take_all();
  Transformation changed = run.state.transformation;
  for (const Coordinate& word : block.words()) {
    double& shift = changed.shift[static_cast<std::size_t>(word.axis)];
    shift = run.coordinate(word.axis, word.value) + (word.is_incremental ? shift : 0);
  }
  return transform(run, changed);
}

bool mirror(Run& run, const Block& block) {
  run.ledger.take_all();
  // The same axis is reported in whatever order the axes were programmed.
  const ActiveTool& tool = run.state.tool;
  if (tool.is_called && block.names(tool.axis)) {
    return run.fail(ErrorCode::MirrorOnToolAxis, std::string(1, letter(tool.axis)));
  }
  Transformation changed = run.state.transformation;
  changed.mirrored = {};
  for (const Axis axis : kAllAxes) {
    if (!block.names(axis)) continue;
    if (axis > Axis::Z) {
      return run.fail(ErrorCode::WrongAxis, fmt::format("{} is not mirrored", letter(axis)));
    }
    changed.mirrored[static_cast<std::size_t>(axis)] = true;
  }
  return transform(run, changed);
}

bool rotate(Run& run, const Block& block) {
  Transformation changed = run.state.transformation;
  double angle = run.number(block.angle);
  if (block.is_angle_incremental) angle += changed.rotation;
  if (!(std::fabs(angle) <= kMaxRotation)) {
    if (!block.is_angle_incremental) {
      return run.fail(ErrorCode::EntryOutOfRange, fmt::format("ROT {} is not -360 to 360", angle));
    }
    angle = std::fmod(angle, kMaxRotation);
  }
  const Plane plane = block.axis ? plane_across(*block.axis) : run.state.plane;
  if (changed.rotation != 0 && angle != 0 && plane != changed.rotation_plane) {
    const PlaneAxes axes = axes_of(changed.rotation_plane);
    run.warn("TNC-ROTATION-PLANE",
             fmt::format("the rotation by {:.3f} degrees of {} and {} ends: one of another plane "
                         "takes its place",
                         changed.rotation, letter(axes.first), letter(axes.second)));
  }
  changed.rotation = angle;
  changed.rotation_plane = plane;
  return transform(run, changed);
}

bool scale(Run& run, const Block& block) {
  constexpr double kMillionths = 1e-6;
  if (block.factor <= 0) return run.fail(ErrorCode::EntryOutOfRange, "SCL 0");
  Transformation changed = run.state.transformation;
  changed.scale = block.factor * kMillionths;
  changed.scaled = {};
  const PlaneAxes axes = axes_of(run.state.plane);
  for (const Axis axis : {axes.first, axes.second, axes.normal}) {
    const bool is_scaled = run.options.scales_three_axes || axis != axes.normal;
    changed.scaled[static_cast<std::size_t>(axis)] = is_scaled;
  }
  return transform(run, changed);
}

bool dwell(Run& run, const Block& block) {
  const double seconds = run.number(block.first);
  if (!(seconds >= 0 && seconds <= kLongestDwell)) {
    return run.fail(ErrorCode::EntryOutOfRange,
                    fmt::format("DWELL {} s is not 0 to {}", seconds, kLongestDwell));
  }
  if (seconds > 0) {
    run.loops.note_progress();
    run.events().on_dwell({run.origin, seconds, {}});
  }
  return true;
}

/// A later control takes the sign of DEPTH as the direction, and set-up clearance and infeed
/// without one (TNC 426, User's Manual: pecking). Those of an older program have that of the depth.
void take_direction(MachiningCycle& cycle) {
  if (!(cycle.depth < 0)) return;
  if (cycle.clearance > 0) cycle.clearance = -cycle.clearance;
  if (cycle.peck > 0) cycle.peck = -cycle.peck;
}

/// The value of a sub-block of lengths goes by its word: set-up, depth or pecking.
void take_length(MachiningCycle& draft, std::string_view word, double value) {
  if (word.starts_with("SET-UP")) {
    draft.clearance = value;
  } else if (word.starts_with("DEPTH")) {
    draft.depth = value;
  } else {
    draft.peck = value;
  }
}

void take_side(Run& run, const Block& block, MachiningCycle& draft) {
  const Coordinate& side = block.coordinates[0];
  run.ledger.take(1);
  const double value = run.coordinate(side.axis, side.value);
  const bool is_first = block.part == 4;
  (is_first ? draft.first_axis : draft.second_axis) = side.axis;
  (is_first ? draft.first_side : draft.second_side) = value;
}

bool take_machining(Run& run, const Block& block, const CyclePart& part) {
  MachiningCycle& draft = run.state.cycle.draft;
  double feed = 0;
  if (block.feed.is_programmed() && !read_cycle_feed(run, block.feed, feed)) return false;
  switch (part.field) {
    case CycleField::Length:
      take_length(draft, part.word, run.length(block.first));
      break;
    case CycleField::Dwell:
      draft.dwell = run.number(block.first);
      break;
    case CycleField::Peck:
      draft.peck = run.length(block.first);
      draft.plunge_feed = feed;
      break;
    case CycleField::Side:
      take_side(run, block, draft);
      break;
    case CycleField::FeedTurn:
      draft.turn = block.turn.value_or(Turn::Counterclockwise);
      draft.feed = feed;
      break;
    case CycleField::Feed:
      draft.feed = feed;
      break;
    case CycleField::Radius:
      draft.radius = std::fabs(run.length(block.radius));
      break;
    case CycleField::Program:
      draft.program = block.target;
      break;
    default:
      break;
  }
  return true;
}

}  // namespace

bool define_cycle(Run& run, const Block& block) {
  if (!take_place(run, block)) return false;
  if (block.part == 0) return true;
  if (run.options.is_itnc && !itnc::check_order(run, block)) return false;
  switch (block.cycle) {
    case kDatumShift:
      return shift_datum(run, block);
    case kMirror:
      return mirror(run, block);
    case kDwell:
      return dwell(run, block);
    case kRotation:
      return rotate(run, block);
    case kScaling:
      return scale(run, block);
    default:
      break;
  }
  CycleState& cycle = run.state.cycle;
  if (!take_machining(run, block, cycle_parts(block.cycle)[block.part])) return false;
  if (cycle.is_complete && run.options.is_itnc) take_direction(cycle.draft);
  if (cycle.is_complete) cycle.machining = cycle.draft;
  if (cycle.is_complete && run.options.is_itnc) cycle.is_modal_call = false;
  return true;
}

bool is_defining(const Run& run) {
  return !run.state.cycle.is_complete;
}

void end_cycles(Run& run) {
  run.state.cycle = CycleState{};
  if (!run.options.cancels_transformations) return;
  run.state.transformation.cancel_cycles();
  ++run.frame_changes;
}

}  // namespace dripline::interpreter::tnc155
