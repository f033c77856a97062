#include "gateway/interpreter/stages/compensation/fault.hpp"

#include <fmt/core.h>

#include "gateway/interpreter/stages/look_ahead/held_events.hpp"

namespace dripline::interpreter::compensation {

namespace {

/// Rounds to a tenth of a micrometer, below the resolution of any control.
std::string rounded(Length length) {
  std::string text = fmt::format("{:.4f}", length.mm());
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

}  // namespace

std::string describe(const Fault& fault) {
  const std::string value = rounded(fault.value);
  const std::string limit = rounded(fault.limit);
  switch (fault.kind) {
    case FaultKind::NoIntersection:
      return fmt::format("the compensated path of line {} does not meet that of line {}",
                         fault.origin.line, fault.next.line);
    case FaultKind::ArcTooSmall:
      return fmt::format("arc radius {} mm is smaller than the cutter radius {} mm", value, limit);
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
      return fmt::format("start-up move of {} mm is not longer than the cutter radius {} mm", value,
                         limit);
    case FaultKind::OtherPlane:
      return "arc in another plane than the compensated one";
    case FaultKind::ArcTooLarge:
      return "the other end of the move lies within the circle of its arc";
    case FaultKind::TooMuchBetween:
      return fmt::format("more than {} events or {} characters between two compensated moves",
                         look_ahead::kMaxHeldEvents, look_ahead::kMaxHeldText);
  }
  return {};
}

}  // namespace dripline::interpreter::compensation
