#include "gateway/interpreter/stages/look_ahead/state_bytes.hpp"

#include "gateway/interpreter/stages/blending/corner_blender.hpp"

namespace dripline::interpreter::compensation {

using look_ahead::up_to;

/// In the namespace of their types, where the look-up by argument finds them.
template <class Archive>
void visit(Archive& archive, StartUp& start_up) {
  up_to(archive, start_up, StartUp::Tangent);
}
template <class Archive>
void visit(Archive& archive, Command& command) {
  up_to(archive, command.kind, Command::Kind::ResumeOutput);
  up_to(archive, command.cutter.plane, Plane::YZ);
  up_to(archive, command.cutter.side, Side::Right);
  visit(archive, command.cutter.radius);
  visit(archive, command.cutter.tip_first);
  visit(archive, command.cutter.tip_second);
  look_ahead::visit_optional(archive, command.start_up);
}

}  // namespace dripline::interpreter::compensation

namespace dripline::interpreter::blending::impl {

using look_ahead::up_to;
using look_ahead::visit;
using look_ahead::visit_all;
using look_ahead::visit_numbers;
using look_ahead::visit_optional;

template <class Archive>
void visit(Archive& archive, UncountedEnd& end) {
  visit(archive, end.origin);
}
template <class Archive>
void visit(Archive& archive, CornerPlace& place) {
  visit(archive, place.origin);
}

template <class Archive>
void visit(Archive& archive, CornerShape& shape) {
  up_to(archive, shape.kind, CornerShape::Kind::ChamferFace);
  visit(archive, shape.size);
  archive(shape.has_own_block);
  visit_optional(archive, shape.feed);
}
template <class Archive>
void visit(Archive& archive, Estimate& estimate) {
  visit_numbers(archive, estimate.tolerance, estimate.radius);
}
template <class Archive>
void visit(Archive& archive, LeadBack& back) {
  visit(archive, back.direction);
  up_to(archive, back.which, Back::Farthest);
}
template <class Archive>
void visit(Archive& archive, Announced& announced) {
  visit_optional(archive, announced.corner);
  visit_optional(archive, announced.estimate);
  visit_optional(archive, announced.back);
}
template <class Archive>
void visit(Archive& archive, Element& element) {
  visit_all(archive, element.is_rapid, element.is_arc, element.is_moved);
  visit(archive, element.line);
  for (PlaneVector* vector : {&element.from, &element.end, &element.center}) {
    visit(archive, *vector);
  }
  visit_numbers(archive, element.side, element.sweep);
  visit(archive, element.given_sweep);
  visit(archive, element.announced);
}

template <class Archive>
void visit_state(Archive& archive, State& state) {
  archive(state.has_element);
  up_to(archive, state.plane, Plane::YZ);
  visit(archive, state.programmed);
  visit(archive, state.sent);
  visit(archive, state.next);
  if (state.has_element) visit(archive, state.waiting());
  archive(state.has_end);
  if (state.has_end) visit(archive, state.end);
}

}  // namespace dripline::interpreter::blending::impl

namespace dripline::interpreter::look_ahead {
template class LookAheadStage<blending::CornerBlender, blending::impl::State, blending::FaultKind>;
}
