#include "gateway/interpreter/stages/look_ahead/state_bytes.hpp"

#include "gateway/interpreter/stages/compensation/compensator.hpp"

namespace dripline::interpreter::compensation {

/// In the namespace of its type, where the look-up by argument finds it.
template <class Archive>
void visit(Archive& archive, OutsideCorner& corner) {
  look_ahead::up_to(archive, corner, OutsideCorner::IntersectCurves);
}

}  // namespace dripline::interpreter::compensation

namespace dripline::interpreter::compensation::impl {

template <class Archive>
void visit(Archive& archive, ByArc& by_arc) {
  look_ahead::visit(archive, by_arc.radius);
  look_ahead::visit(archive, by_arc.origin);
}

using look_ahead::up_to;
using look_ahead::visit;
using look_ahead::visit_all;
using look_ahead::visit_numbers;
using look_ahead::visit_optional;

template <class Archive>
void visit(Archive& archive, LeadIn& lead_in) {
  visit_all(archive, lead_in.count);
  if (lead_in.count > lead_in.pieces.size()) lead_in.count = 0, archive.damage();
  for (std::uint8_t i = 0; i < lead_in.count; ++i) {
    Piece& piece = lead_in.pieces[i];
    archive(piece.is_arc);
    visit(archive, piece.sweep);
    visit(archive, piece.to);
    visit(archive, piece.center);
    visit_optional(archive, piece.origin);
  }
}
template <class Archive>
void visit(Archive& archive, Element& element) {
  visit_all(archive, element.is_rapid, element.is_arc, element.rests, element.is_silent,
            element.rounds_corner);
  visit(archive, element.offset);
  up_to(archive, element.role, Role::Parallel);
  up_to(archive, element.start_up, StartUp::Tangent);
  up_to(archive, element.outside, OutsideCorner::IntersectCurves);
  visit(archive, element.origin);
  visit(archive, element.to);
  visit(archive, element.feed);
  for (PlaneVector* vector : {&element.from, &element.end, &element.direction_in,
                              &element.direction_out, &element.arch.center, &element.begin}) {
    visit(archive, *vector);
  }
  Arch& arch = element.arch;
  visit_numbers(archive, arch.radius_in, arch.radius_out, arch.side, arch.sweep);
  visit(archive, element.lead_in);
  visit_optional(archive, element.by_arc);
}

template <class Archive>
void visit_state(Archive& archive, State& state) {
  up_to(archive, state.phase, Phase::Parallel);
  visit_all(archive, state.has_element, state.is_displaced, state.is_output_suppressed,
            state.idle_blocks);
  visit(archive, state.offset);
  up_to(archive, state.plane, Plane::YZ);
  visit(archive, state.tip);
  up_to(archive, state.start_up, StartUp::Tangent);
  visit_optional(archive, state.next_corner);
  visit_optional(archive, state.next_arc);
  archive(state.begins_contour);
  visit(archive, state.programmed);
  visit(archive, state.sent);
  if (state.has_element) visit(archive, state.waiting());
}

}  // namespace dripline::interpreter::compensation::impl

namespace dripline::interpreter::look_ahead {
template class LookAheadStage<compensation::Compensator, compensation::impl::State,
                              compensation::FaultKind>;
}
