#include "gateway/interpreter/core/event.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

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
  const PathArc& arc = *thread.arc;
  return {thread.origin, thread.to, arc.center_first, arc.center_second,
          arc.plane,     arc.turn,  arc.sweep,        Feed::per_revolution(thread.lead),
          false};
}

Arc arc_of(const Probe& probe) {
  const PathArc& arc = *probe.arc;
  Arc passed{probe.origin,      probe.to,   arc.center_first,
             arc.center_second, arc.plane,  arc.turn,
             arc.sweep,         probe.feed, true};
  if (!probe.result || !probe.result->tripped) return passed;
  passed.to = probe.result->at;
  const PlaneAxes axes = axes_of(arc.plane);
  const PlaneVector center{arc.center_first.mm(), arc.center_second.mm()};
  const PlaneVector start = in_plane(probe.from, axes) - center;
  const PlaneVector end = in_plane(passed.to, axes) - center;
  const double sense = arc.turn == Turn::Counterclockwise ? 1 : -1;
  double radians = sense * turn_between(start, end);
  if (radians < 0) radians += 2 * Angle::kPi;
  // What rounding has put before the start or after the end has not moved, or passed all.
  const double sweep = arc.sweep.radians();
  const double beyond = radians - sweep, before = 2 * Angle::kPi - radians;
  if (beyond > 0) radians = before < beyond ? 0 : sweep;
  passed.sweep = Angle::radians(radians);
  return passed;
}

Length mean_lead(const Thread& thread, Length path) {
  if (thread.lead_change == Length{}) return thread.lead;
  // After n revolutions path = lead n + change n^2 / 2, and the lead is the root below.
  const double lead = std::fabs(thread.lead.mm());
  const double square = lead * lead + 2 * thread.lead_change.mm() * path.mm();
  return Length::mm((lead + std::sqrt(std::max(0.0, square))) / 2);
}

namespace {

/// `words` are in the order of the enumerators.
template <class Enum>
std::string_view word_among(std::initializer_list<std::string_view> words, Enum value) {
  return words.begin()[static_cast<std::size_t>(value)];
}

}  // namespace

std::string_view word_of(Units units) {
  return word_among({"in", "mm"}, units);
}
std::string_view word_of(Turn turn) {
  return word_among({"cw", "ccw"}, turn);
}
std::string_view word_of(ProbeUntil until) {
  return word_among({"contact", "release"}, until);
}
std::string_view word_of(SpindleState state) {
  return word_among({"off", "cw", "ccw", "oriented"}, state);
}
std::string_view word_of(StopKind kind) {
  return word_among({"program", "optional", "tool_change", "operator"}, kind);
}
std::string_view word_of(OutputDevice device) {
  return word_among({"file", "port1", "port2", "screen", "printer"}, device);
}
std::string_view word_of(Feed::Per per) {
  return word_among({"min", "rev", "move"}, per);
}
std::string_view word_of(Plane plane) {
  return word_among({"XY", "ZX", "YZ"}, plane);
}

}  // namespace dripline::interpreter
