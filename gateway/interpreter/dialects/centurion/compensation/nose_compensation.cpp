#include "gateway/interpreter/dialects/centurion/compensation/nose_compensation.hpp"

#include <fmt/core.h>
#include <cmath>
#include <limits>

#include "gateway/interpreter/core/shown_length.hpp"
#include "gateway/interpreter/dialects/centurion/motion/corner_words.hpp"
#include "gateway/interpreter/dialects/centurion/motion/motion.hpp"
#include "gateway/interpreter/dialects/centurion/run.hpp"

namespace dripline::interpreter::centurion {
namespace {

using compensation::Fault;
using NoseFault = compensation::FaultKind;
using compensation::Side;

/// From the center of the nose to the point that is programmed, in nose radii (manual: tool types).
struct TipDirection {
  int z, x;
};
constexpr std::array<TipDirection, 10> kTips{
    {{0, 0}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}, {0, 0}}};

constexpr std::uint8_t kCompensationOff = 4;  ///< of the special flags

NoseUse wanted_use(const Run& run) {
  NoseUse use;
  const bool is_disabled =
      (run.parameters.byte(kSpecialFlags) & kCompensationOff) != 0 || run.options.draws_part_path;
  use.code = is_disabled ? std::uint8_t{0} : run.state.modes.compensation;
  if (use.code == 0) return use;
  const Transformation& how = run.state.transformation;
  use.is_mirrored = how.mirrors_x != how.mirrors_z;
  use.radius_mm = run.length(run.parameters.tool(run.state.tool.offset, ToolField::Radius)).mm();
  use.tip = run.parameters.tool(run.state.tool.offset, ToolField::Type);
  return use;
}

ErrorCode code_of(const Fault& fault) {
  switch (fault.kind) {
    case NoseFault::NoIntersection:
      return fault.first_is_arc && fault.next_is_arc ? ErrorCode::CompensatedArcsApart
                                                     : ErrorCode::CompensatedLineArcApart;
    case NoseFault::ArcTooSmall:
      return fault.first_is_arc ? ErrorCode::SecondArcTooSmall : ErrorCode::ArcTooSmall;
    case NoseFault::TooMuchBetween:
      return ErrorCode::TooMuchBetween;
    case NoseFault::Reversed:
      return ErrorCode::ContourTooNarrow;
    default:
      return ErrorCode::CompensationNotStraight;
  }
}

/// All events pass through the stage from the first G41, G42 or G65 on.
void begin_use(Run& run) {
  if (run.state.uses_compensator) return;
  run.events();  // the header first
  run.compensator.reset(run.blender.sent());
  // the stage takes its plane from a cutter
  compensation::Cutter none;
  none.plane = Plane::ZX;
  run.compensator.turn_on(none);
  run.compensator.turn_off();
  run.state.uses_compensator = true;
  run.connect_stages();
}

}  // namespace

compensation::Policy compensation_policy() {
  compensation::Policy policy;
  policy.outside = compensation::OutsideCorner::IntersectCurves;
  policy.blocks_without_motion = std::numeric_limits<int>::max();
  return policy;
}

compensation::Cutter nose_of(const Run& run, bool is_left) {
  const int offset = run.state.tool.offset;
  const Length radius = run.length(run.parameters.tool(offset, ToolField::Radius));
  const double type = run.parameters.tool(offset, ToolField::Type);
  const TipDirection tip = kTips[type >= 0 && type <= 9 ? static_cast<std::size_t>(type) : 0];
  const double size = std::fabs(radius.mm());
  compensation::Cutter cutter;
  cutter.plane = Plane::ZX;
  // on a mirrored path the tool is on the other side
  cutter.side = is_left != run.state.nose.is_mirrored ? Side::Left : Side::Right;
  cutter.radius = radius;
  cutter.tip_first = Length::mm(tip.z * size);
  cutter.tip_second = Length::mm(tip.x * size);
  return cutter;
}

bool update_compensation(Run& run) {
  run.state.nose_is_stale = false;
  const NoseUse use = wanted_use(run);
  const Transformation& how = run.state.transformation;
  if (use.code != 0 && how.scales && (how.factor.x < 0 || how.factor.z < 0)) {
    return run.fail(ErrorCode::IllegalStatement, 0,
                    "nose compensation with a scale factor below 0");
  }
  constexpr double kMaxRadius = 1e6;
  if (!(std::fabs(use.radius_mm) <= kMaxRadius)) {
    return run.fail(
        ErrorCode::ParameterOutOfRange, 0,
        fmt::format("nose radius {}", shown_length(Length::mm(use.radius_mm), run.state.units)));
  }
  NoseUse& now = run.state.nose;
  if (now == use) return true;
  now = use;
  if (use.code != 0) {
    begin_use(run);
    run.blender.turn_on(nose_of(run, use.code == 1));
  } else if (run.state.uses_compensator) {
    run.blender.turn_off();
  }
  return true;
}

void cancel_compensation(Run& run) {
  if (run.state.nose.code == 0) return;
  run.blender.cancel();
}

void resume_compensation(Run& run) {
  if (run.state.nose.code == 0) return;
  run.blender.turn_on(nose_of(run, run.state.nose.code == 1));
}

bool check_uncompensated(Run& run, std::string_view what) {
  const NoseUse& nose = run.state.nose;
  if (nose.code == 0 || nose.radius_mm == 0) return true;
  return run.fail(
      ErrorCode::IllegalStatement, motion_column(run),
      fmt::format("{} within G{}: compensation has to be off (G40)", what, 40 + nose.code));
}

bool is_at_program(const Run& run) {
  constexpr double kRounding = 1e-6;  // millimeters
  const Point at = machine_of(run, run.state.position);
  const Position& sent = run.sent();
  return std::fabs((sent.linear(Axis::X) - run.length(at.x)).mm()) <= kRounding &&
         std::fabs((sent.linear(Axis::Z) - run.length(at.z)).mm()) <= kRounding;
}

void suppress_output(Run& run, bool is_suppressed) {
  begin_use(run);
  run.blender.suppress_output(is_suppressed);
}

bool refuse_misfit(Run& run) {
  return run.fail(ErrorCode::RadiusTooSmall, 0, "the scaled radius does not span the points");
}

bool check_path(Run& run) {
  if (const auto& misfit = run.transform.misfit()) {
    run.origin.line = misfit->line;
    return refuse_misfit(run);
  }
  if (const auto& stopped = run.guard.fault()) {
    run.origin.line = stopped->origin.line;
    return run.fail(stopped->code, 0, stopped->detail);
  }
  if (const auto& fault = run.blender.fault(); fault) {
    run.origin.line = fault->origin.line;
    return run.fail(code_of(*fault), 0, blending::describe(*fault, run.state.units));
  }
  const auto& fault = run.compensator.fault();
  if (!fault) return true;
  run.origin.line = fault->origin.line;
  return run.fail(code_of(*fault), 0, compensation::describe(*fault, run.state.units));
}

}  // namespace dripline::interpreter::centurion
