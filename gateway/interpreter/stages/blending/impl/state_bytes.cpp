#include "gateway/interpreter/stages/blending/impl/state_bytes.hpp"

#include "gateway/interpreter/stages/look_ahead/event_archive.hpp"

namespace dripline::interpreter::blending::impl {

using look_ahead::StateReader;
using look_ahead::StateWriter;
using look_ahead::up_to;
using look_ahead::visit;
using look_ahead::visit_all;
using look_ahead::visit_numbers;
using look_ahead::visit_optional;

template <class Archive>
void visit(Archive& archive, CompensationCall& call) {
  up_to(archive, call.kind, CompensationCall::Kind::Go);
  up_to(archive, call.cutter.plane, Plane::YZ);
  up_to(archive, call.cutter.side, compensation::Side::Right);
  visit(archive, call.cutter.radius);
  visit(archive, call.cutter.tip_first);
  visit(archive, call.cutter.tip_second);
  up_to(archive, call.start_up, compensation::StartUp::Tangent);
}
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

namespace {

template <class Archive>
void visit_state(Archive& archive, State& state) {
  archive(state.has_element);
  up_to(archive, state.plane, Plane::YZ);
  visit(archive, state.programmed);
  visit(archive, state.given);
  visit(archive, state.next);
  if (state.has_element) visit(archive, state.waiting());
  archive(state.has_end);
  if (state.has_end) visit(archive, state.end);
}

}  // namespace

std::vector<std::byte> to_bytes(const State& state) {
  StateWriter archive;
  State copy = state;
  visit_state(archive, copy);
  look_ahead::write_held(archive, state.held);
  return archive.take();
}

Result<void> from_bytes(State& state, const std::vector<std::byte>& bytes) {
  StateReader archive(bytes);
  State read;
  visit_state(archive, read);
  look_ahead::read_held(archive, read.held);
  if (!archive.is_complete()) {
    return dripline::fail(Errc::Corrupt, "blending state of {} bytes does not read back",
                          bytes.size());
  }
  state = read;
  return {};
}

}  // namespace dripline::interpreter::blending::impl
