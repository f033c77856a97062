#include "protocol/measurement/measurement.hpp"

#include <fmt/format.h>

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

namespace {

bool is_same(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return std::abs(*a - *b) <= kSameLimit * std::max(std::abs(*a), std::abs(*b));
}

}  // namespace

std::string limits_text(const Characteristic& of) {
  const auto number = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.10g}", *value) : std::string("none");
  };
  return fmt::format("nominal {}, limits {} to {} {}", number(of.nominal), number(of.lower),
                     number(of.upper), of.unit);
}

Result<void> check_one_tolerance(std::span<const Measurement> all, Limits which) {
  if (all.empty()) return {};
  const bool with_lower = which == Limits::All || which == Limits::Lower;
  const bool with_upper = which == Limits::All || which == Limits::Upper;
  const Characteristic& newest = all.back().characteristic;
  for (auto one = all.rbegin(); one != all.rend(); ++one) {
    const Characteristic& of = one->characteristic;
    if (is_same(of.nominal, newest.nominal) && (!with_lower || is_same(of.lower, newest.lower)) &&
        (!with_upper || is_same(of.upper, newest.upper))) {
      continue;
    }
    return fail(Errc::Conflict,
                "{}: {} at {}, but {} of the newest: choose those of one nominal value and one "
                "tolerance by since, until or run",
                newest.name, limits_text(of), to_iso8601(one->time), limits_text(newest));
  }
  return {};
}

}  // namespace dripline::measurement
