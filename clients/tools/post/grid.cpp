#include "clients/tools/post/grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace dripline::post {
namespace {

using interpreter::Axis;

constexpr double kMaxCounts = 1e15;  ///< far outside of every control's range

constexpr double power_of_ten(int exponent) {
  double power = 1;
  for (int i = 0; i < exponent; ++i) power *= 10;
  return power;
}

}  // namespace

Grid::Grid(const Target& target, interpreter::Units units, const Values& shift)
    : target_(&target), units_(units), shift_(shift) {
  const double power = power_of_ten(decimals());
  center_step_ = mm_per_unit(units) / power;
  for (const Axis axis : interpreter::kAllAxes) {
    double step = interpreter::is_rotary(axis) ? 1 / power : center_step_;
    if (target.is_lathe && axis == Axis::X) step /= 2;
    step_[static_cast<std::size_t>(axis)] = step;
  }
}

std::int64_t Grid::counts(Axis axis, double machine) const {
  const auto i = static_cast<std::size_t>(axis);
  const double counts = (machine + shift_[i]) / step_[i];
  if (!std::isfinite(counts)) return static_cast<std::int64_t>(kMaxCounts);
  return std::llround(std::clamp(counts, -kMaxCounts, kMaxCounts));
}

double Grid::machine(Axis axis, std::int64_t counts) const {
  const auto i = static_cast<std::size_t>(axis);
  return static_cast<double>(counts) * step_[i] - shift_[i];
}

bool Grid::is_in_range(std::int64_t counts) const {
  const double value = value_of(std::abs(counts), decimals());
  return value <= range_of(target_->coordinate, units_).max;
}

namespace {

/// The path of a thread over its longer axis, where that axis has the lead.
double path_over_axis(const Grid& grid, const interpreter::Position& from,
                      const interpreter::Position& to) {
  if (!grid.target().has_lead_along_axis) return 1;
  const auto travel = [&](Axis axis) {
    return std::fabs(grid.machine(axis, grid.counts(axis, to.raw(axis))) -
                     grid.machine(axis, grid.counts(axis, from.raw(axis))));
  };
  const double x = travel(Axis::X), z = travel(Axis::Z), longer = std::max(x, z);
  return longer > 0 ? std::hypot(x, z) / longer : 1;
}

}  // namespace

Length lead_word(const Grid& grid, const interpreter::Position& from,
                 const interpreter::Position& to, Length lead_of_path) {
  return lead_of_path / path_over_axis(grid, from, to);
}

Length lead_of_path(const Grid& grid, const interpreter::Position& from,
                    const interpreter::Position& to, Length lead_word) {
  return lead_word * path_over_axis(grid, from, to);
}

void append_number(std::string& out, std::int64_t counts, int decimals, NumberLook look) {
  if (counts < 0) {
    out += '-';
    counts = -counts;
  } else if (look.has_plus) {
    out += '+';
  }
  std::string digits = std::to_string(counts);
  const auto places = static_cast<std::size_t>(decimals);
  if (digits.size() <= places) digits.insert(0, places + 1 - digits.size(), '0');
  const std::string_view all(digits);
  std::string_view fraction = all.substr(all.size() - places);
  while (fraction.ends_with('0')) fraction.remove_suffix(1);
  out += all.substr(0, all.size() - places);
  if (!fraction.empty() || look.has_point) out += look.point;
  out += fraction;
}

std::int64_t counts_of(double value, int decimals) {
  return std::llround(std::clamp(value * power_of_ten(decimals), -kMaxCounts, kMaxCounts));
}

double value_of(std::int64_t counts, int decimals) {
  return static_cast<double>(counts) / power_of_ten(decimals);
}

}  // namespace dripline::post
