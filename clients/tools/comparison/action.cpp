#include "clients/tools/comparison/action.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::comparison {
namespace {

using interpreter::Axis;
using interpreter::kAllAxes;
using interpreter::Position;

constexpr double kApart = std::numeric_limits<double>::infinity();
/// Of feeds, speeds and times: what the conversion of inches leaves.
constexpr double kRelative = 1e-9;
/// Two arcs are looked at this often in a revolution; between two looks their distance grows by
/// less than the bound in `arc_distance`.
constexpr double kLooksPerTurn = 64;
constexpr double kQuarter = 1.5707963267948966;
constexpr int kMaxLooks = 4096;

bool is_equal(double a, double b) {
  return a == b || std::abs(a - b) <= kRelative * std::max(std::abs(a), std::abs(b));
}

bool is_equal(const Feed& a, const Feed& b) {
  return a.per() == b.per() && is_equal(a.length().mm(), b.length().mm()) &&
         is_equal(a.moves_per_minute(), b.moves_per_minute());
}

/// Over X, Y and Z together; every other axis by itself.
double distance(const Position& a, const Position& b) {
  double squares = 0, others = 0;
  for (const Axis axis : kAllAxes) {
    const double off = a.raw(axis) - b.raw(axis);
    if (axis <= Axis::Z) {
      squares += off * off;
    } else {
      others = std::max(others, std::abs(off));
    }
  }
  return std::max(std::sqrt(squares), others);
}

struct Vector {
  double first = 0, second = 0;
  double length() const { return std::hypot(first, second); }
};
Vector turned(const Vector& v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.first - s * v.second, s * v.first + c * v.second};
}

Vector start_radius(const Action& arc) {
  const auto axes = interpreter::axes_of(arc.plane);
  return {arc.from.raw(axes.first) - arc.center[0], arc.from.raw(axes.second) - arc.center[1]};
}

/// Without the plane's two axes, which the arc itself decides.
double distance_off_plane(const Action& a, const Action& b) {
  const auto axes = interpreter::axes_of(a.plane);
  const auto without_plane = [&](Position position) {
    position.set_raw(axes.first, 0);
    position.set_raw(axes.second, 0);
    return position;
  };
  return std::max(distance(without_plane(a.from), without_plane(b.from)),
                  distance(without_plane(a.to), without_plane(b.to)));
}

/// Looks at both arcs at the same fractions. The difference of the two points is
/// d(t) = C + R(s t) u - R(r t) v, and between two looks h apart it exceeds the larger of them by
/// at most h*h/8 times the largest second derivative, s*s|u - v| + (|s*s - r*r| + s*s|s - r|) |v|.
double arc_distance(const Action& a, const Action& b) {
  const Vector u = start_radius(a), v = start_radius(b);
  const Vector apart{a.center[0] - b.center[0], a.center[1] - b.center[1]};
  const double sense = a.turn == interpreter::Turn::Counterclockwise ? 1 : -1;
  const double s = a.sweep, r = b.sweep, most = std::max(s, r);
  const double looks =
      std::clamp(std::ceil(most / (4 * kQuarter) * kLooksPerTurn), 4.0, double{kMaxLooks});
  double furthest = 0;
  for (int i = 0; i <= static_cast<int>(looks); ++i) {
    const double t = i / looks;
    const Vector p = turned(u, sense * s * t), q = turned(v, sense * r * t);
    furthest = std::max(
        furthest,
        Vector{apart.first + p.first - q.first, apart.second + p.second - q.second}.length());
  }
  const double bend =
      most * most * Vector{u.first - v.first, u.second - v.second}.length() +
      (std::abs(s * s - r * r) + most * most * std::abs(s - r)) * std::max(u.length(), v.length());
  return furthest + bend / (8 * looks * looks);
}

std::string coordinates(const Action& action) {
  std::string text;
  for (const Axis axis : kAllAxes) {
    if (!action.to.has(axis)) continue;
    text += fmt::format("{}{}{:.4f}", text.empty() ? "" : " ", letter(axis), action.to.raw(axis));
    while (text.back() == '0') text.pop_back();
    if (text.back() == '.') text.pop_back();
  }
  return text;
}

std::string feed_text(const Feed& feed) {
  switch (feed.per()) {
    case Feed::Per::Minute:
      return fmt::format("{:g} mm/min", feed.length().mm());
    case Feed::Per::Revolution:
      return fmt::format("{:g} mm/rev", feed.length().mm());
    case Feed::Per::Move:
      return fmt::format("{:g} moves/min", feed.moves_per_minute());
  }
  return {};
}

std::string spindle_text(const Action& action) {
  constexpr std::string_view kStates[]{"off", "clockwise", "counterclockwise", "oriented"};
  std::string text = fmt::format("spindle {}", kStates[action.code & 3]);
  if (action.numbers[1] != Action::kNoNumber)
    return text + fmt::format(", {:g} m/min", action.numbers[1] / 1000);
  return text + fmt::format(", {:g} rpm", action.numbers[0]);
}

double amount_of(const Feed& feed) {
  return feed.per() == Feed::Per::Move ? feed.moves_per_minute() : feed.length().mm();
}

/// A change of the amount alone leaves the cut what it was; one from or to none does not.
Differences feed_differences(const Action& a, const Action& b) {
  if (a.is_in_step != b.is_in_step) return Difference::Pitch;
  if (a.is_in_step && !(is_equal(a.feed, b.feed) && is_equal(a.speed, b.speed)))
    return Difference::Pitch;
  if (is_equal(a.feed, b.feed)) return {};
  const bool is_amount =
      a.feed.per() == b.feed.per() && amount_of(a.feed) > 0 && amount_of(b.feed) > 0;
  return is_amount ? Difference::Feed : Difference::FeedMode;
}

Differences spindle_differences(const Action& a, const Action& b) {
  const auto is_same = [&](std::size_t i) { return is_equal(a.numbers[i], b.numbers[i]); };
  if (a.code == b.code && is_same(0) && is_same(1) && is_same(2)) return {};
  const bool is_turning = interpreter::is_turning(static_cast<interpreter::SpindleState>(a.code));
  const auto is_by_surface = [](const Action& action) {
    return action.numbers[1] != Action::kNoNumber;
  };
  const std::size_t amount = is_by_surface(a) ? 1 : 0;
  const bool is_amount = is_turning && a.code == b.code && is_by_surface(a) == is_by_surface(b) &&
                         is_same(2) && a.numbers[amount] > 0 && b.numbers[amount] > 0;
  return is_amount ? Difference::Speed : Difference::Spindle;
}

/// Of an axis that moves: one that stays does not take in a length that has come into force.
bool has_other_length(const Action& a, const Action& b, double tolerance) {
  for (std::size_t i = 0; i < a.lengths.size(); ++i) {
    const auto axis = static_cast<Axis>(i);
    const bool moves = a.from.raw(axis) != a.to.raw(axis) || b.from.raw(axis) != b.to.raw(axis);
    if (moves && !(std::abs(a.lengths[i] - b.lengths[i]) <= tolerance)) return true;
  }
  return false;
}

}  // namespace

std::string_view word_of(Difference difference) {
  constexpr std::array<std::string_view, kDifferenceCount> kWords{
      "path",  "pitch",   "feed",     "feed_mode",  "speed", "spindle", "tool",  "offset",
      "dwell", "coolant", "function", "exact_stop", "stop",  "output",  "order", "alarm"};
  return kWords[static_cast<std::size_t>(difference)];
}

double path_distance(const Action& a, const Action& b) {
  if (a.has_arc != b.has_arc) return kApart;
  const double ends = std::max(distance(a.from, b.from), distance(a.to, b.to));
  if (!a.has_arc) return ends;
  if (a.plane != b.plane || a.turn != b.turn || std::abs(a.sweep - b.sweep) > kQuarter)
    return kApart;
  const bool is_same = ends == 0 && a.center == b.center && a.sweep == b.sweep;
  if (is_same) return 0;
  return std::max({ends, distance_off_plane(a, b), arc_distance(a, b)});
}

bool is_alike(const Action& a, const Action& b, const Agreement& agreement) {
  if (a.kind != b.kind) return false;
  Differences allowed = Differences(Difference::Feed) | Difference::FeedMode | Difference::Pitch |
                        Difference::ExactStop;
  if (is_move(a.kind)) allowed |= Difference::Offset;
  return differences(a, b, agreement).is_within(allowed);
}

Differences differences(const Action& a, const Action& b, const Agreement& agreement) {
  Differences found;
  if (is_move(a.kind)) {
    const bool is_lead_same =
        a.kind != ActionKind::Thread ||
        std::ranges::equal(a.numbers, b.numbers, [](double x, double y) { return is_equal(x, y); });
    if (a.code != b.code || !is_lead_same || !(path_distance(a, b) <= agreement.tolerance))
      found |= Difference::Path;
    found |= feed_differences(a, b);
    if (a.rests != b.rests && !agreement.across_controls) found |= Difference::ExactStop;
    if (has_other_length(a, b, agreement.tolerance)) found |= Difference::Offset;
    return found;
  }
  if (a.kind == ActionKind::Spindle) return spindle_differences(a, b);
  const bool is_end = a.kind == ActionKind::End;
  const bool are_numbers_equal =
      std::ranges::equal(a.numbers, b.numbers, [](double x, double y) { return is_equal(x, y); });
  const bool is_code_equal = a.code == b.code || (is_end && agreement.across_controls);
  if (!is_code_equal || !are_numbers_equal || a.text != b.text) found |= difference_of(a.kind);
  const bool is_offset_known = (a.offset && b.offset) || !agreement.across_controls;
  if (a.offset != b.offset && is_offset_known) found |= Difference::Offset;
  return found;
}

Difference difference_of(ActionKind kind) {
  switch (kind) {
    case ActionKind::Dwell:
      return Difference::Dwell;
    case ActionKind::Spindle:
      return Difference::Spindle;
    case ActionKind::Coolant:
      return Difference::Coolant;
    case ActionKind::Tool:
      return Difference::Tool;
    case ActionKind::Function:
    case ActionKind::Pin:
    case ActionKind::Inhibit:
      return Difference::Function;
    case ActionKind::Output:
    case ActionKind::Message:
      return Difference::Output;
    case ActionKind::Stop:
    case ActionKind::End:
      return Difference::Stop;
    case ActionKind::Alarm:
      return Difference::Alarm;
    default:
      return Difference::Path;
  }
}

namespace {

std::string word_text(char letter, double value) {
  return value == Action::kNoNumber ? "" : fmt::format(" {}{:g}", letter, value);
}

}  // namespace

std::string describe(const Action& action) {
  switch (action.kind) {
    case ActionKind::Rapid:
      return fmt::format("rapid to {}", coordinates(action));
    case ActionKind::Line:
      return fmt::format("line to {}, {}", coordinates(action), feed_text(action.feed));
    case ActionKind::Arc:
      return fmt::format("arc to {}, radius {:.4f}, {}", coordinates(action),
                         start_radius(action).length(), feed_text(action.feed));
    case ActionKind::Thread:
      return fmt::format("thread to {}, lead {:g} mm", coordinates(action), action.numbers[0]);
    case ActionKind::Probe:
      return fmt::format("probe{} to {}, {}", action.has_arc ? " on an arc" : "",
                         coordinates(action),
                         action.feed == Feed{} ? "rapid" : feed_text(action.feed));
    case ActionKind::Dwell:
      return action.numbers[1] != Action::kNoNumber
                 ? fmt::format("dwell of {:g} revolutions", action.numbers[1])
                 : fmt::format("dwell of {:g} s", action.numbers[0]);
    case ActionKind::Spindle:
      return spindle_text(action);
    case ActionKind::Coolant:
      return fmt::format("coolant: flood {}, mist {}", (action.code & 1) != 0 ? "on" : "off",
                         (action.code & 2) != 0 ? "on" : "off");
    case ActionKind::Tool:
      return fmt::format("{}tool {}{}{}", action.numbers[0] == 1 ? "preselected " : "", action.code,
                         action.numbers[0] == 2 ? " in the spindle" : "",
                         action.offset ? fmt::format(", offset {}", *action.offset) : "");
    case ActionKind::Function:
      return fmt::format("M{}{}{}", action.code, word_text('P', action.numbers[0]),
                         word_text('Q', action.numbers[1]));
    case ActionKind::Pin:
      return fmt::format("output {} {}", action.code, action.numbers[0] != 0 ? "on" : "off");
    case ActionKind::Inhibit:
      return "override inhibit";
    case ActionKind::Output:
      return fmt::format("output \"{}\"", action.text);
    case ActionKind::Message:
      return fmt::format("message \"{}\"", action.text);
    case ActionKind::Stop:
      return "stop";
    case ActionKind::Alarm:
      return fmt::format("alarm {}", action.text);
    case ActionKind::End:
      return "end of the program";
  }
  return {};
}

}  // namespace dripline::comparison
