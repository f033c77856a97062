#include "gateway/interpreter/dialects/fanuc/turning/passes.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"

namespace dripline::interpreter::fanuc {

Passes::Passes(Run& run)
    : run_(run),
      cycle_(run.state.contour),
      is_facing_(cycle_.code == 172),
      start_(place_of(run.state.position.raw(Axis::X), run.state.position.raw(Axis::Z))) {}

Place Passes::here() const {
  return place_of(run_.state.position.raw(Axis::X), run_.state.position.raw(Axis::Z));
}

Position Passes::on_machine(Place at) const {
  Position to = run_.state.position;
  const double x = is_facing_ ? at.along : at.depth;
  const double z = is_facing_ ? at.depth : at.along;
  if (x != to.raw(Axis::X)) to.set_raw(Axis::X, x);
  if (z != to.raw(Axis::Z)) to.set_raw(Axis::Z, z);
  return to;
}

bool Passes::rapid(Place to) {
  return rapid_to(run_, on_machine(to));
}

bool Passes::feed(Place to) {
  return line_to(run_, on_machine(to), run_.active_feed());
}

bool Passes::approach(Place to) {
  return cycle_.moves.front().is_rapid ? rapid(to) : feed(to);
}

bool Passes::arc(const ContourMove& move, Place to) {
  return arc_to(run_, {.origin = run_.origin,
                       .to = on_machine(to),
                       .center_first = Length::mm(move.center_z),
                       .center_second = Length::mm(move.center_x),
                       .plane = Plane::ZX,
                       .turn = move.is_clockwise ? Turn::Clockwise : Turn::Counterclockwise,
                       .sweep = Angle::degrees(move.sweep),
                       .feed = run_.active_feed()});
}

bool Passes::follow(std::size_t first, double x, double z) {
  for (std::size_t i = first; i < cycle_.moves.size(); ++i) {
    ContourMove move = cycle_.moves[i];
    const Place to = place_of(move.x + x, move.z + z);
    move.center_x += x;
    move.center_z += z;
    const bool is_done = i == 0 && move.is_rapid ? rapid(to)
                         : move.is_arc           ? arc(move, to)
                                                 : feed(to);
    if (!is_done) return false;
  }
  return true;
}

bool Passes::refuse(std::string_view why) {
  return run_.fail(ErrorCode::IllegalContour, 0, why);
}

bool Passes::refuse_beyond(std::size_t move) {
  return refuse(fmt::format("move {} of the contour goes beyond the start point", move + 1));
}

bool Passes::check_allowance() {
  const Place shift = place_of(cycle_.allowance_x, cycle_.allowance_z);
  const Place last = place_of(cycle_.moves.back().x, cycle_.moves.back().z);
  const bool has_length = std::fabs(last.along - start_.along) > kClose;
  if (out_ * shift.depth >= 0 && (forward_ * shift.along <= 0 || !has_length)) return true;
  return refuse("the finish allowance leads into the part");
}

}  // namespace dripline::interpreter::fanuc
