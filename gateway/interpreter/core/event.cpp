#include "gateway/interpreter/core/event.hpp"

#include <algorithm>
#include <cmath>

namespace dripline::interpreter {

char letter(Axis axis) {
  return "XYZABCUVW"[static_cast<std::size_t>(axis)];
}

std::optional<Axis> axis_of(char letter) {
  constexpr std::string_view kLetters = "XYZABCUVW";
  const auto at = kLetters.find(letter);
  if (at == std::string_view::npos) return std::nullopt;
  return static_cast<Axis>(at);
}

Arc arc_of(const Thread& thread) {
  const ThreadArc& arc = *thread.arc;
  return {thread.origin, thread.to, arc.center_first, arc.center_second,
          arc.plane,     arc.turn,  arc.sweep,        Feed::per_revolution(thread.lead),
          false};
}

Length mean_lead(const Thread& thread, Length path) {
  if (thread.lead_change == Length{}) return thread.lead;
  // After n revolutions path = lead n + change n^2 / 2, and the lead is the root below.
  const double lead = std::fabs(thread.lead.mm());
  const double square = lead * lead + 2 * thread.lead_change.mm() * path.mm();
  return Length::mm((lead + std::sqrt(std::max(0.0, square))) / 2);
}

}  // namespace dripline::interpreter
