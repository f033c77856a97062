#include "gateway/interpreter/stages/blending/policy.hpp"

#include <fmt/core.h>

#include "gateway/interpreter/stages/look_ahead/held_events.hpp"

namespace dripline::interpreter::blending {

std::string describe(const Fault& fault, Units units) {
  const bool is_inch = units == Units::Inch;
  const double value = is_inch ? fault.value.inch() : fault.value.mm();
  const double limit = is_inch ? fault.limit.inch() : fault.limit.mm();
  const auto line = fault.origin.line;
  const auto next = fault.next.line;
  switch (fault.kind) {
    case FaultKind::NoIntersection:
      return fmt::format("the move of line {} does not meet that of line {}", line, next);
    case FaultKind::ArcsApart:
      return fmt::format("the arc of line {} does not meet that of line {}", line, next);
    case FaultKind::OffArc:
      return fmt::format("point is {:.6f} off the radius {:.6f}", value, limit);
    case FaultKind::Straight:
      return fmt::format("no corner to round between lines {} and {}", line, next);
    case FaultKind::DoesNotFit:
      if (limit < 0)
        return fmt::format("no arc of radius {:.6f} touches the moves of lines {} and {}", value,
                           line, next);
      return fmt::format("the corner takes {:.6f} of a move that is {:.6f} long", value, limit);
    case FaultKind::ChamferAtArc:
      return fmt::format("a chamfer between lines {} and {}, of which one is an arc", line, next);
    case FaultKind::OtherPlane:
      return "a corner with an arc of another plane";
    case FaultKind::NoElement:
      return "no move before this one";
    case FaultKind::OpenCorner:
      return fmt::format("no move makes a corner with that of line {}", line);
    case FaultKind::TooMuchBetween:
      return fmt::format("more than {} events or {} characters at a corner",
                         look_ahead::kMaxHeldEvents, look_ahead::kMaxHeldText);
  }
  return {};
}

}  // namespace dripline::interpreter::blending
