#include <cmath>

#include "gateway/interpreter/stages/compensation/compensator.hpp"

/// A corner that a block of its own rounds.
namespace dripline::interpreter::compensation {

using namespace impl;

/// The direction of the last compensated move at its end.
std::optional<PlaneVector> Compensator::last_direction() const {
  if (state_.has_element) return state_.waiting().direction_out;
  if (state_.phase != Phase::On) return std::nullopt;
  // ended on its own normal
  const PlaneVector out = nose() - in_plane(state_.programmed, axes_of(state_.plane));
  if (std::fabs(length(out) - std::fabs(state_.offset)) > kNoLength) return std::nullopt;
  return (-1 / state_.offset) * left_of(out);
}

bool Compensator::round_outside_corner(const Origin& origin, Feed feed,
                                       std::optional<PlaneVector> along) {
  if (fault_ || state_.offset == 0) return true;
  const auto direction = last_direction();
  if (!direction || state_.phase != Phase::On) return false;
  Element& element = state_.spare();
  element.is_rapid = element.rests = false;
  element.origin = origin;
  element.to = state_.programmed;
  element.feed = feed;
  element.offset = state_.offset;
  complete_corner(element, in_plane(state_.programmed, axes_of(state_.plane)), *direction);
  if (along && !turn_corner(element, *along)) {
    refuse({FaultKind::ConcaveCorner, origin, origin});
    return true;
  }
  take(element);
  if (along) flush();
  return true;
}

/// The waiting element rounds a corner, and the next element is known now.
bool Compensator::end_corner(const Element& next) {
  if (turn_corner(state_.waiting(), next.direction_in)) return true;
  return refuse({FaultKind::ConcaveCorner, state_.waiting().origin, next.origin});
}

}  // namespace dripline::interpreter::compensation
