#include "gateway/interpreter/stages/compensation/fault.hpp"

#include <fmt/core.h>

#include "gateway/interpreter/core/shown_length.hpp"
#include "gateway/interpreter/stages/look_ahead/held_events.hpp"

namespace dripline::interpreter::compensation {

std::string describe(const Fault& fault, Units units) {
  const std::string value = shown_length(fault.value, units);
  const std::string limit = shown_length(fault.limit, units);
  switch (fault.kind) {
    case FaultKind::NoIntersection:
      return fmt::format("the compensated path of line {} does not meet that of line {}",
                         fault.origin.line, fault.next.line);
    case FaultKind::ArcTooSmall:
      return fmt::format("arc radius {} is smaller than the cutter radius {}", value, limit);
    case FaultKind::Reversed:
      return fmt::format("the compensated move of line {} runs backwards", fault.origin.line);
    case FaultKind::ConcaveCorner:
      return fmt::format("inside corner between lines {} and {}", fault.origin.line,
                         fault.next.line);
    case FaultKind::StartUpNotStraight:
      return "the first compensated move is an arc";
    case FaultKind::CancelNotStraight:
      return "the move that ends compensation is an arc";
    case FaultKind::StartUpTooClose:
      return fmt::format("start-up move of {} is not longer than the cutter radius {}", value,
                         limit);
    case FaultKind::OtherPlane:
      return "arc in another plane than the compensated one";
    case FaultKind::ArcTooLarge:
      return "the other end of the move lies within the circle of its arc";
    case FaultKind::RadiusAtArc:
      return fmt::format("the cutter radius changes at the arc of line {}", fault.next.line);
    case FaultKind::FlatSideChange:
      return fmt::format("the side changes between lines {} and {}, which meet at a flat angle",
                         fault.origin.line, fault.next.line);
    case FaultKind::TooMuchBetween:
      return fmt::format("more than {} events or {} characters between two compensated moves",
                         look_ahead::kMaxHeldEvents, look_ahead::kMaxHeldText);
  }
  return {};
}

}  // namespace dripline::interpreter::compensation
