#include "gateway/interpreter/dialects/rs274ngc/execution/motion.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"
#include "gateway/interpreter/dialects/rs274ngc/compensation/compensation.hpp"

namespace dripline::interpreter::rs274ngc {
namespace {

/// The allowed deviations of arcs.
struct Tolerance {
  double radius;        ///< of the radii at both ends, absolute
  double spread;        ///< of the radii, as a part of the larger (the later program)
  double most;          ///< of the radii, whatever their size
  double least_radius;  ///< a smaller one is none
  double chord;         ///< that half a chord may exceed the radius
};
Tolerance tolerance(const Run& run) {
  const bool is_inch = run.state.units == Units::Inch;
  if (!run.is_linuxcnc())
    return {is_inch ? 0.0002 * Length::kMillimetersPerInch : 0.002, 0, 0, 0, 0};
  return {is_inch ? 0.00283 * Length::kMillimetersPerInch : 0.0283, 0.001,
          is_inch ? 0.283 * Length::kMillimetersPerInch : 2.83,
          is_inch ? 0.00004 * Length::kMillimetersPerInch : 0.001,
          is_inch ? 0.00005 * Length::kMillimetersPerInch : 0.00127};
}

/// Of squares, so that nearly all arcs need no root: |a - b| is at most |a^2 - b^2| over the
/// larger.
bool surely_agree(const Tolerance& limits, double at_start, double at_end) {
  const double off = at_start - at_end;
  return std::min(at_start, at_end) > limits.least_radius * limits.least_radius &&
         off * off <= limits.radius * limits.radius * std::max(at_start, at_end);
}

bool check_radii(Run& run, PlaneVector center, PlaneVector start, PlaneVector end) {
  const Tolerance limits = tolerance(run);
  const auto square = [&](PlaneVector point) { return dot(point - center, point - center); };
  if (surely_agree(limits, square(start), square(end))) [[likely]]
    return true;
  const double at_start = std::sqrt(square(start));
  const double at_end = std::sqrt(square(end));
  if (at_start <= limits.least_radius || at_end <= limits.least_radius) {
    return run.fail(ErrorCode::ArcZero, 0);
  }
  const double off = std::fabs(at_start - at_end);
  bool differs = off > limits.radius;
  if (run.is_linuxcnc()) {
    differs = (differs && off > limits.spread * std::fmax(at_start, at_end)) || off > limits.most;
  }
  if (!differs) return true;
  const double unit = run.state.mm_per_unit();
  return run.fail(ErrorCode::ArcRadiusDiffers, 0,
                  fmt::format("{} at the start, {} at the end", at_start / unit, at_end / unit));
}

double word_in_mm(const Run& run, char word) {
  return run.mm(run.block.words.value_or(word, 0));
}

bool center_of_offsets(Run& run, const PlaneAxes& axes, PlaneVector start, PlaneVector end,
                       PlaneVector& center) {
  const Words& words = run.block.words;
  const char first = offset_word(axes.first), second = offset_word(axes.second);
  center = {word_in_mm(run, first), word_in_mm(run, second)};
  if (!run.state.modes.is_arc_absolute) {
    center = center + start;
  } else if (!words.has(first) || !words.has(second)) {
    return run.fail(ErrorCode::ArcNone, 0, "G90.1 needs both offsets");
  }
  const Compensation& compensation = run.state.compensation;
  if (compensation.side != Side::Off && compensation.is_first && !run.is_linuxcnc()) return true;
  return check_radii(run, center, start, end);
}

bool center_of_radius(Run& run, PlaneVector start, PlaneVector end, Turn turn,
                      PlaneVector& center) {
  const double radius = word_in_mm(run, 'R');
  const PlaneVector chord = end - start;
  const double half = length(chord) / 2;
  if (half == 0) return run.fail_word(ErrorCode::ArcSamePoint, 'R');
  const double size = std::fabs(radius);
  if (half > size * (1 + 1e-12) + tolerance(run).chord) {
    return run.fail_word(ErrorCode::ArcRadiusTooSmall, 'R',
                         fmt::format("half the chord is {}", half / run.state.mm_per_unit()));
  }
  const double height = half < size ? std::sqrt(size * size - half * half) : 0;
  // The center lies left of the chord for short arcs ccw and long ones cw.
  const bool is_left = (turn == Turn::Counterclockwise) == (radius > 0);
  const double along = (is_left ? height : -height) / (2 * half);
  center = {(start.first + end.first) / 2 - along * chord.second,
            (start.second + end.second) / 2 + along * chord.first};
  return true;
}

bool check_words(Run& run, const PlaneAxes& axes, bool names_plane) {
  const Words& words = run.block.words;
  const bool has_radius = words.has('R');
  const bool has_offset = words.has_any(set_of("IJK"));
  if (has_radius && has_offset) return run.fail_word(ErrorCode::ArcMixed, 'R');
  if (!has_radius && !has_offset) return run.fail(ErrorCode::ArcNone, 0);
  const char other = offset_word(axes.normal);
  if (words.has(other)) return run.fail_word(ErrorCode::ArcOffsetPlane, other);
  if (names_plane || (run.is_linuxcnc() && has_offset)) return true;
  if (run.is_linuxcnc()) return run.fail_word(ErrorCode::ArcSamePoint, 'R');
  return run.fail(ErrorCode::ArcNoAxis, 0);
}

/// A code of the block, not the arc's, that takes P as well.
bool has_other_user_of_p(const Run& run) {
  const Profile profile = run.options.profile;
  const Block& block = run.block;
  for (const GGroup group : {GGroup::OneShot, GGroup::Path}) {
    const GRow* row = g_row(block.g(group), profile);
    if (row != nullptr && (words_of(*row, profile) & set_of("P")) != 0) return true;
  }
  for (std::size_t group = 0; group < kMGroups; ++group) {
    const MRow* row = m_row(block.m(static_cast<MGroup>(group)), profile);
    if (row != nullptr && (row->words & set_of("P")) != 0) return true;
  }
  return false;
}

/// P of an arc. One that is a dwell, a tolerance or an input's number at the same time would turn
/// the arc that often, without a word of it.
bool read_full_circles(Run& run, double& full_circles) {
  full_circles = 1;
  const Words& words = run.block.words;
  if (!words.has('P')) return true;
  if (has_other_user_of_p(run)) {
    if (!run.is_linuxcnc()) return true;
    return run.fail_word(ErrorCode::ArcTurns, 'P',
                         fmt::format("P{} is of another code of the block as well", words['P']));
  }
  full_circles = std::round(words['P']);
  constexpr double kMaxFullCircles = 1e6;
  if (std::fabs(words['P'] - full_circles) <= 0.0001 && full_circles >= 1 &&
      full_circles <= kMaxFullCircles)
    return true;
  return run.fail_word(ErrorCode::ArcTurns, 'P', fmt::format("P{}", words['P']));
}

}  // namespace

double sweep_of(PlaneVector center, PlaneVector start, PlaneVector end, Turn turn) {
  constexpr double kFull = 2 * Angle::kPi;
  constexpr double kSame = 1e-6;  // radians; an angle this small is a full turn
  const PlaneVector from = start - center, to = end - center;
  const double side = turn == Turn::Counterclockwise ? 1 : -1;
  double sweep = std::atan2(side * cross(from, to), dot(from, to));
  if (sweep < 0) sweep += kFull;
  if (sweep <= kSame || sweep >= kFull) sweep = kFull;
  return sweep * (180 / Angle::kPi);
}

bool arc_center(Run& run, PlaneVector start, PlaneVector end, Turn turn, PlaneVector& center) {
  const PlaneAxes axes = axes_of(run.state.modes.plane);
  if (!check_words(run, axes, !(start == end))) return false;
  return run.block.words.has('R') ? center_of_radius(run, start, end, turn, center)
                                  : center_of_offsets(run, axes, start, end, center);
}

bool arc_move(Run& run, bool is_clockwise) {
  Target target;
  Feed feed;
  State& state = run.state;
  if (state.modes.has_tilted_plane) return run.fail(ErrorCode::ArcTilted, 0);
  if (!read_feed(run, true, feed) || !read_target(run, target)) return false;
  const PlaneAxes axes = axes_of(state.modes.plane);
  const bool names_plane = (target.named & (bit_of(axes.first) | bit_of(axes.second))) != 0;
  if (!check_words(run, axes, names_plane)) return false;
  double full_circles = 1;
  if (!read_full_circles(run, full_circles)) return false;
  PlaneVector start{state[axes.first], state[axes.second]};
  const Compensation& compensation = state.compensation;
  const bool is_compensated = shifts_moves(run);
  if (is_compensated && !compensation.is_first) start = {compensation.x, compensation.y};
  const PlaneVector end{target.to[index_of(axes.first)], target.to[index_of(axes.second)]};
  const Turn turn = is_clockwise ? Turn::Clockwise : Turn::Counterclockwise;
  PlaneVector center;
  if (run.block.words.has('R')) {
    if (!is_compensated || !compensation.is_first || run.is_linuxcnc()) {
      if (!center_of_radius(run, start, end, turn, center)) return false;
    }
  } else if (!center_of_offsets(run, axes, start, end, center)) {
    return false;
  }
  run.state.passes = 0;
  if (is_compensated && state.modes.feed != FeedMode::InverseTime)
    return compensated_arc(run, target, center, turn, full_circles, feed);
  const auto normal = index_of(axes.normal);
  const double turned = sweep_of(center, start, end, turn) + 360 * (full_circles - 1);
  if (state.modes.feed == FeedMode::InverseTime) [[unlikely]]
    note_speed(run, std::hypot(distance(center, start) * turned * (Angle::kPi / 180),
                               target.to[normal] - state.position[normal]));
  if (is_compensated) return compensated_arc(run, target, center, turn, full_circles, feed);
  if (compensation.was_on) return run.fail(ErrorCode::CompExit, 0);
  target.named = static_cast<AxisBits>(target.named | bit_of(axes.first) | bit_of(axes.second));
  return arc_to(run, target, {center.first, center.second, turn, turned}, feed);
}

}  // namespace dripline::interpreter::rs274ngc
