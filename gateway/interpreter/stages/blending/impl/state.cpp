#include "gateway/interpreter/stages/look_ahead/state_bytes.hpp"

#include "gateway/interpreter/stages/blending/corner_blender.hpp"

namespace dripline::interpreter::language {
template <>
inline constexpr auto kLast<blending::Back> = blending::Back::Farthest;
template <>
inline constexpr auto kLast<blending::impl::CornerShape::Kind> =
    blending::impl::CornerShape::Kind::ChamferFace;
}  // namespace dripline::interpreter::language

namespace dripline::interpreter::blending::impl {

template <class Archive>
void visit_state(Archive& archive, State& state) {
  archive(state.has_element, state.plane, state.programmed, state.sent, state.next);
  if (state.has_element) archive(state.waiting());
  archive(state.has_end);
  if (state.has_end) archive(state.end);
}

}  // namespace dripline::interpreter::blending::impl

namespace dripline::interpreter::look_ahead {
template class LookAheadStage<blending::CornerBlender, blending::impl::State, blending::FaultKind>;
}
