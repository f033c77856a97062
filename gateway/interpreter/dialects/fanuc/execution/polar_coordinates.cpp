#include "gateway/interpreter/dialects/fanuc/execution/polar_coordinates.hpp"

#include <fmt/core.h>
#include <cmath>

#include "gateway/interpreter/dialects/fanuc/execution/motion.hpp"

namespace dripline::interpreter::fanuc {

bool place_by_angle(Run& run, Point3& point) {
  ModalState& state = run.state;
  const Words& words = run.block.words;
  const PlaneAxes axes = axes_of(state.plane());
  const auto first = static_cast<std::size_t>(axes.first);
  const auto second = static_cast<std::size_t>(axes.second);
  const Address radius_word = kWordOfAxis[first];
  const Address angle_word = kWordOfAxis[second];
  if (!words.has(radius_word) && !words.has(angle_word)) return true;
  const bool is_incremental = state.is_incremental();
  if (!state.polar_radius && !words.has(radius_word)) {
    return run.fail(ErrorCode::ImproperCommand, words.column(angle_word),
                    fmt::format("an angle of G16 without a radius: {} in G90 comes before",
                                letter(radius_word)));
  }
  if (!state.polar_radius && !is_incremental && !words.has(angle_word)) {
    return run.fail(
        ErrorCode::ImproperCommand, words.column(radius_word),
        fmt::format("the first radius of G16 in G90 without an angle: {}", letter(angle_word)));
  }
  const Point3 center = is_incremental && words.has(radius_word) ? point : Point3{};
  const double radius =
      words.has(radius_word) ? run.length(words[radius_word]) : *state.polar_radius;
  state.polar_radius =
      is_incremental && words.has(radius_word) ? std::nullopt : std::optional(radius);
  double angle = state.polar_angle;
  if (words.has(angle_word)) angle = run.angle(words[angle_word]) + (is_incremental ? angle : 0);
  state.polar_angle = angle;
  const double turn = angle * (Angle::kPi / 180);
  point[first] = center[first] + radius * std::cos(turn);
  point[second] = center[second] + radius * std::sin(turn);
  return true;
}

}  // namespace dripline::interpreter::fanuc
