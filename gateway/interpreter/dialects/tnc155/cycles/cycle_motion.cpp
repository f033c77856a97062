#include "gateway/interpreter/dialects/tnc155/cycles/cycle_motion.hpp"

#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"
#include "gateway/interpreter/dialects/tnc155/execution/target.hpp"

namespace dripline::interpreter::tnc155 {
namespace {

/// F of an inch program is tenths of an inch, of a rotary axis that moves alone degrees.
Pace feeding(const Run& run, double feed) {
  constexpr double kTenthsPerInch = 10;
  const bool is_inch = run.state.units == Units::Inch;
  return {false, feed, is_inch ? feed * kTenthsPerInch / Length::kMillimetersPerInch : feed};
}

/// The moves of a hole do not lie in the plane, unless the rotation of another plane tilts them.
bool leaves_contour(const Run& run, CycleMotion::Direction direction) {
  const State& state = run.state;
  return state.uses_stages && (direction == CycleMotion::Direction::InThePlane ||
                               !state.transformation.keeps_circles(state.plane));
}

/// Where a contour has led the tool the cycle begins, not where its block pointed to; so it does
/// after R+ and R-.
void stand_where_the_tool_is(Run& run) {
  State& state = run.state;
  interrupt_contour(run);
  state.machine = run.compensator.sent();
  state.stand_at(state.transformation.to_program(values_of(state.machine)));
}

}  // namespace

CycleMotion::CycleMotion(Run& run, Direction direction)
    : run_(run),
      leaves_contour_(leaves_contour(run, direction)),
      axes_(axes_of(run.state.plane)),
      machine_(run.state.machine),
      nominal_(run.state.nominal),
      beside_(run.state.beside),
      is_beside_(run.state.is_beside) {
  run.state.stand_at(run.state.tool_position());
  if (leaves_contour_) stand_where_the_tool_is(run);
  start_ = nominal_in_plane(run.state);
  start_height_ = run.state.nominal_of(run.state.tool.axis);
  tool_radius_ = run.state.tool.data.radius / run.state.transformation.factor(run.state.plane);
}

void CycleMotion::end() {
  run_.state.nominal = nominal_;
  run_.state.beside = beside_;
  run_.state.is_beside = is_beside_;
  if (leaves_contour_) {
    run_.state.machine = machine_;
    continue_contour(run_, machine_);
  }
  run_.state.last = LastMove{};
}

Turn CycleMotion::turn_for(Turn programmed) const {
  if (!run_.state.transformation.turns_over(run_.state.plane)) return programmed;
  return programmed == Turn::Clockwise ? Turn::Counterclockwise : Turn::Clockwise;
}

int CycleMotion::place_of(Axis axis) const {
  if (axis == axes_.first) return 0;
  return axis == axes_.second ? 1 : -1;
}

void CycleMotion::move(Axis axis, double value, Pace pace) {
  Target target = here(run_.state);
  target.set(axis, value);
  line_to(run_, target, pace);
}
void CycleMotion::move(PlaneVector to, Pace pace) {
  Target target = here(run_.state);
  target.set(axes_.first, to.first);
  target.set(axes_.second, to.second);
  line_to(run_, target, pace);
}

void CycleMotion::feed_to_height(double height, double feed) {
  move(run_.state.tool.axis, height, feeding(run_, feed));
}
void CycleMotion::rapid_to_height(double height) {
  move(run_.state.tool.axis, height, kRapid);
}
void CycleMotion::feed_to(PlaneVector to, double feed) {
  move(to, feeding(run_, feed));
}
void CycleMotion::rapid_to(PlaneVector to) {
  move(to, kRapid);
}

void CycleMotion::arc_to(PlaneVector to, PlaneVector center, Turn turn, double feed) {
  ArcTarget target;
  target.to = here(run_.state);
  target.to.set(axes_.first, to.first);
  target.to.set(axes_.second, to.second);
  target.center = center;
  target.turn = turn;
  constexpr double kHalf = 180;
  const bool is_full = to == nominal_in_plane(run_.state);
  target.sweep = is_full ? 2 * kHalf : kHalf;
  tnc155::arc_to(run_, target, feeding(run_, feed));
}

void CycleMotion::circle(PlaneVector center, Turn turn, double feed) {
  arc_to(nominal_in_plane(run_.state), center, turn, feed);
}

void CycleMotion::dwell(double seconds) {
  if (seconds > 0) run_.events().on_dwell({run_.origin, seconds, {}});
}

}  // namespace dripline::interpreter::tnc155
