#include "gateway/interpreter/dialects/tnc155/execution/contour.hpp"

namespace dripline::interpreter::tnc155 {

bool check_stages(Run& run) {
  if (const auto& fault = run.blender.fault()) {
    run.origin = fault->origin;
    return run.fail(fault->kind == blending::FaultKind::OtherPlane ||
                            fault->kind == blending::FaultKind::NoElement
                        ? ErrorCode::PlaneWronglyDefined
                        : ErrorCode::RoundingRadiusTooLarge,
                    blending::describe(*fault, run.state.units));
  }
  const auto& fault = run.compensator.fault();
  if (!fault) [[likely]]
    return true;
  run.origin = fault->origin;
  switch (fault->kind) {
    case compensation::FaultKind::StartUpNotStraight:
    case compensation::FaultKind::CancelNotStraight:
      return run.fail(ErrorCode::PathOffsetWronglyStarted,
                      compensation::describe(*fault, run.state.units));
    case compensation::FaultKind::ArcTooLarge:
      return run.fail(ErrorCode::RoundingRadiusTooLarge,
                      compensation::describe(*fault, run.state.units));
    case compensation::FaultKind::OtherPlane:
      return run.fail(ErrorCode::PlaneWronglyDefined,
                      compensation::describe(*fault, run.state.units));
    default:
      return run.fail(ErrorCode::ToolRadiusTooLarge,
                      compensation::describe(*fault, run.state.units));
  }
}

}  // namespace dripline::interpreter::tnc155
