#include "gateway/interpreter/dialects/centurion/codes/reference_points.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/motion/transform_stage.hpp"

namespace dripline::interpreter::centurion {
namespace {

constexpr AxesNamed kXOnly{true, false};
constexpr AxesNamed kZOnly{false, true};
constexpr int kClearances = 139;  ///< P139 X as a diameter, P140 Z

Point here(const Run& run) {
  return machine_of(run, run.state.position);
}

/// `point` in the axes named, where the machine is in the others.
Point in_axes(const Run& run, const Point& point, AxesNamed named) {
  Point to = here(run);
  if (named.x) to.x = point.x;
  if (named.z) to.z = point.z;
  return to;
}

/// A first leg of no length, as in G28 W0, leads nowhere in any coordinates.
bool has_increments_of_zero(const Run& run) {
  const Words& words = run.block.words;
  const auto is_zero = [&](Address address) { return !words.has(address) || words[address] == 0; };
  const bool is_absolute = !run.state.modes.is_incremental;
  if (is_absolute && words.has_any(set_of(Address::X, Address::Z))) return false;
  return is_zero(Address::X) && is_zero(Address::Z) && is_zero(Address::U) && is_zero(Address::W);
}

/// The point that the words of G28, G29 and G30 name, in machine coordinates.
bool read_via(Run& run, Target& target) {
  return read_end_words(run, {here(run), run.state.origin, run.state.modes.is_incremental}, target);
}

bool read_reference(Run& run, Point& point) {
  int number = 1;
  const Words& words = run.block.words;
  if (run.axis_code() == 30) {
    const double given = words.has(Address::P) ? words[Address::P] : 2;
    if (given != 2 && given != 3 && given != 4) {
      return run.fail(ErrorCode::IllegalReference, words.column(Address::P),
                      fmt::format("P{} is not 2, 3 or 4", given));
    }
    number = static_cast<int>(given);
  }
  point = run.parameters.point(kReferencePoints + 2 * (number - 1));
  return true;
}

bool retract_for(Run& run, int code) {
  const AxesNamed axis = code == 45 || code == 47 ? kZOnly : kXOnly;
  const Point& zero = run.state.origin;
  const Point clearance{zero.x + run.parameters[kClearances] / 2,
                        zero.z + run.parameters[kClearances + 1]};
  const Point change = in_axes(run, run.parameters.point(kToolChangePoint), axis);
  Point to = run.state.position;
  if (axis.x) to.x = clearance.x;
  if (axis.z) to.z = clearance.z;
  const bool is_clearance = code == 45 || code == 46;
  if (!check_target(run, is_clearance ? to : change)) return false;
  cancel_compensation(run);
  if (is_clearance) {
    rapid_to(run, to, axis);
  } else {
    machine_rapid_to(run, change, axis);
  }
  resume_compensation(run);
  return true;
}

}  // namespace

bool check_untransformed(Run& run, std::string_view what) {
  const Transformation& how = run.state.transformation;
  if (!how.mirrors() && !how.rotates) return true;
  return run.fail(ErrorCode::IllegalStatement, motion_column(run),
                  fmt::format("{} with axis words while {} is on: end it before ({})", what,
                              how.mirrors() ? "mirror (G511)" : "rotation (G568)",
                              how.mirrors() ? "G501" : "G569"));
}

bool move_in_machine(Run& run) {
  if (!run.block.words.has_any(kEndWords)) return true;
  const MotionMode mode = run.state.modes.motion;
  if (mode >= MotionMode::Clockwise) {
    return run.fail(ErrorCode::IllegalStatement, motion_column(run), "G53 moves on straight lines");
  }
  Target target;
  if (!read_end_words(run, {here(run), {}, false}, target)) return false;
  if (mode == MotionMode::Line && !check_feed(run)) return false;
  cancel_compensation(run);
  if (mode == MotionMode::Rapid) {
    machine_rapid_to(run, target.to, target.named);
  } else {
    machine_feed_to(run, target.to, target.named);
  }
  resume_compensation(run);
  return true;
}

namespace {

bool check_first_leg(Run& run) {
  return has_increments_of_zero(run) ||
         check_untransformed(run, fmt::format("G{}", run.axis_code()));
}

}  // namespace

bool go_to_reference(Run& run) {
  Target via;
  Point reference;
  if (!check_first_leg(run)) return false;
  if (!read_reference(run, reference) || !read_via(run, via)) return false;
  if (!via.named.x && !via.named.z) return true;
  const Point last = in_axes(run, reference, via.named);
  if (!check_target(run, last)) return false;
  cancel_compensation(run);
  run.state.reference_via = {via.to, via.named.x, via.named.z};
  rapid_untransformed(run, via.to, via.named);
  machine_rapid_to(run, in_axes(run, last, via.named), via.named);
  resume_compensation(run);
  return true;
}

/// Before any G28 the machine is where it would go first.
bool return_from_reference(Run& run) {
  const ReferenceVia& via = run.state.reference_via;
  const AxesNamed axes{via.x, via.z};
  Target target;
  if (!check_first_leg(run)) return false;
  cancel_compensation(run);
  rapid_untransformed(run, in_axes(run, via.at, axes), axes);
  const bool is_read = read_via(run, target);
  if (is_read) rapid_untransformed(run, target.to, target.named);
  resume_compensation(run);
  return is_read;
}

bool retract(Run& run, const GRow& row) {
  return retract_for(run, row.code);
}

bool go_to_tool_change(Run& run) {
  return retract_for(run, 48);
}

}  // namespace dripline::interpreter::centurion
