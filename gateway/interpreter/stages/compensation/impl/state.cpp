#include "gateway/interpreter/stages/look_ahead/state_bytes.hpp"

#include "gateway/interpreter/stages/compensation/compensator.hpp"

namespace dripline::interpreter::language {
template <>
inline constexpr auto kLast<compensation::OutsideCorner> =
    compensation::OutsideCorner::IntersectCurves;
template <>
inline constexpr auto kLast<compensation::impl::Role> = compensation::impl::Role::Parallel;
template <>
inline constexpr auto kLast<compensation::impl::Phase> = compensation::impl::Phase::Parallel;
}  // namespace dripline::interpreter::language

namespace dripline::interpreter::compensation::impl {

template <class Archive>
void visit(Archive& archive, LeadIn& lead_in) {
  archive(lead_in.count);
  if (lead_in.count > lead_in.pieces.size()) lead_in.count = 0, archive.damage();
  for (std::uint8_t i = 0; i < lead_in.count; ++i) archive(lead_in.pieces[i]);
}
template <class Archive>
void visit(Archive& archive, Element& element) {
  archive(element.is_rapid, element.is_arc, element.rests, element.is_silent, element.rounds_corner,
          element.offset, element.role, element.start_up, element.outside, element.origin,
          element.to, element.feed, element.from, element.end, element.direction_in,
          element.direction_out, element.arch, element.begin, element.lead_in, element.by_arc);
}

template <class Archive>
void visit_state(Archive& archive, State& state) {
  archive(state.phase, state.has_element, state.is_displaced, state.is_output_suppressed,
          state.idle_blocks, state.offset, state.plane, state.tip, state.start_up,
          state.next_corner, state.next_arc, state.begins_contour, state.programmed, state.sent);
  if (state.has_element) archive(state.waiting());
}

}  // namespace dripline::interpreter::compensation::impl

namespace dripline::interpreter::look_ahead {
template class LookAheadStage<compensation::Compensator, compensation::impl::State,
                              compensation::FaultKind>;
}
