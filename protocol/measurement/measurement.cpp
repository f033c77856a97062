#include "protocol/measurement/measurement.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dripline::measurement {
namespace {

constexpr std::array<std::string_view, 4> kVerdicts{"good", "unknown", "rework", "scrap"};

}  // namespace

std::string_view to_string(Verdict verdict) {
  return kVerdicts.at(static_cast<std::size_t>(verdict));
}

Result<Verdict> parse_verdict(std::string_view text) {
  const auto found = std::ranges::find(kVerdicts, text);
  if (found == kVerdicts.end())
    return fail(Errc::Syntax, "'{}' is no verdict: good, unknown, rework, scrap", text);
  return static_cast<Verdict>(found - kVerdicts.begin());
}

Verdict judge(const Characteristic& characteristic, double actual, ReworkSide rework) {
  if (!std::isfinite(actual)) return Verdict::Unknown;
  // Limits come as decimal texts and sums of them: 40 + 0.02 must not exclude 40.02. A millionth of
  // the last digit that the report has is no difference.
  const double slack = 1e-6 * std::pow(10.0, -characteristic.decimals);
  const auto& lower = characteristic.lower;
  const auto& upper = characteristic.upper;
  const auto outside = [&](ReworkSide side) {
    return rework == side || rework == ReworkSide::Both ? Verdict::Rework : Verdict::Scrap;
  };
  if (lower && actual < *lower - slack) return outside(ReworkSide::Below);
  if (upper && actual > *upper + slack) return outside(ReworkSide::Above);
  return lower || upper ? Verdict::Good : Verdict::Unknown;
}

}  // namespace dripline::measurement
