#include "clients/tools/statistics/rules.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

namespace dripline::statistics {
namespace {

/// 40.02 is (40.02 - 40) / 0.02 = 1.00000000000007 sigma from 40: binary numbers must not move a
/// point off its line.
constexpr double kOnTheLine = 1e-9;

/// Sees the points in units of sigma from the center and answers for the pattern that ends at one
/// of them.
class Pattern {
 public:
  Pattern(std::span<const double> z, std::size_t last) : z_(z), last_(last) {}

  /// At least `hits` of the last `window` beyond `distance` on the last point's side, the last
  /// point among them.
  bool beyond(double distance, std::size_t hits, std::size_t window) const {
    const double side = z_[last_] > 0 ? 1 : -1;
    if (side * z_[last_] <= distance + kOnTheLine || last_ + 1 < hits) return false;
    const std::size_t begin = last_ + 1 >= window ? last_ + 1 - window : 0;
    const auto in_window = z_.subspan(begin, last_ + 1 - begin);
    const auto found = std::ranges::count_if(
        in_window, [&](double z) { return side * z > distance + kOnTheLine; });
    return static_cast<std::size_t>(found) >= hits;
  }
  bool one_side(std::size_t count) const {
    return all(count, [](double z) { return z > kOnTheLine; }) ||
           all(count, [](double z) { return z < -kOnTheLine; });
  }
  bool trend(std::size_t count) const {
    return steps(count, [](double, double step) { return step > 0; }) ||
           steps(count, [](double, double step) { return step < 0; });
  }
  bool alternates(std::size_t count) const {
    return steps(count, [](double before, double step) { return step != 0 && before * step <= 0; });
  }
  bool within(double distance, std::size_t count) const {
    return all(count, [&](double z) { return std::abs(z) < distance - kOnTheLine; });
  }
  bool outside(double distance, std::size_t count) const {
    return all(count, [&](double z) { return std::abs(z) > distance + kOnTheLine; });
  }

 private:
  template <class Claim>
  bool all(std::size_t count, Claim claim) const {
    return last_ + 1 >= count && std::ranges::all_of(z_.subspan(last_ + 1 - count, count), claim);
  }
  /// The claim about each step between `count` points and the step before it (0 for the first).
  template <class Claim>
  bool steps(std::size_t count, Claim claim) const {
    if (last_ + 1 < count) return false;
    double before = 0;
    for (std::size_t i = last_ + 2 - count; i <= last_; ++i) {
      const double step = z_[i] - z_[i - 1];
      if (!claim(before, step)) return false;
      before = step;
    }
    return true;
  }

  std::span<const double> z_;
  std::size_t last_;
};

struct Rule {
  std::size_t window;
  std::string_view meaning;
  bool (*matches)(const Pattern&);
};

constexpr Rule kBeyondLimits{1, "a point beyond three sigma",
                             [](const Pattern& at) { return at.beyond(3, 1, 1); }};
constexpr Rule kTwoOfThree{3, "two of three points beyond two sigma on one side",
                           [](const Pattern& at) { return at.beyond(2, 2, 3); }};
constexpr Rule kFourOfFive{5, "four of five points beyond one sigma on one side",
                           [](const Pattern& at) { return at.beyond(1, 4, 5); }};

constexpr std::array kLimitsOnly{kBeyondLimits};
constexpr std::array kWesternElectric{kBeyondLimits, kTwoOfThree, kFourOfFive,
                                      Rule{8, "eight points in a row on one side of the center",
                                           [](const Pattern& at) { return at.one_side(8); }}};
constexpr std::array kNelson{kBeyondLimits,
                             Rule{9, "nine points in a row on one side of the center",
                                  [](const Pattern& at) { return at.one_side(9); }},
                             Rule{6, "six points in a row, each above or each below the one before",
                                  [](const Pattern& at) { return at.trend(6); }},
                             Rule{14, "fourteen points in a row that go up and down in turn",
                                  [](const Pattern& at) { return at.alternates(14); }},
                             kTwoOfThree,
                             kFourOfFive,
                             Rule{15, "fifteen points in a row within one sigma",
                                  [](const Pattern& at) { return at.within(1, 15); }},
                             Rule{8, "eight points in a row beyond one sigma on either side",
                                  [](const Pattern& at) { return at.outside(1, 8); }}};

std::span<const Rule> rules_of(RuleSet set) {
  switch (set) {
    case RuleSet::WesternElectric:
      return kWesternElectric;
    case RuleSet::Nelson:
      return kNelson;
    default:
      return kLimitsOnly;
  }
}

}  // namespace

std::string_view to_string(RuleSet set) {
  switch (set) {
    case RuleSet::WesternElectric:
      return "western_electric";
    case RuleSet::Nelson:
      return "nelson";
    default:
      return "limits";
  }
}

Result<RuleSet> parse_rule_set(std::string_view name) {
  for (const RuleSet set : {RuleSet::LimitsOnly, RuleSet::WesternElectric, RuleSet::Nelson}) {
    if (name == to_string(set)) return set;
  }
  return fail(Errc::Syntax, "rules '{}': limits, western_electric or nelson", name);
}

std::string_view meaning(RuleSet set, int rule) {
  const auto rules = rules_of(set);
  if (rule < 1 || static_cast<std::size_t>(rule) > rules.size()) return "no such rule";
  return rules[static_cast<std::size_t>(rule) - 1].meaning;
}

std::string describe(const Violation& violation) {
  const auto what = meaning(violation.set, violation.rule);
  switch (violation.set) {
    case RuleSet::WesternElectric:
      return fmt::format("Western Electric {}: {}", violation.rule, what);
    case RuleSet::Nelson:
      return fmt::format("Nelson {}: {}", violation.rule, what);
    default:
      return std::string(what);
  }
}

std::vector<Violation> find_violations(std::span<const double> points, double center, double sigma,
                                       RuleSet set) {
  std::vector<Violation> found;
  if (!(sigma > 0)) return found;
  std::vector<double> z(points.size());
  std::ranges::transform(points, z.begin(), [&](double x) { return (x - center) / sigma; });
  const auto rules = rules_of(set);
  for (std::size_t i = 0; i < z.size(); ++i) {
    const Pattern at(z, i);
    for (std::size_t r = 0; r < rules.size(); ++r) {
      if (!rules[r].matches(at)) continue;
      const std::size_t first = i + 1 >= rules[r].window ? i + 1 - rules[r].window : 0;
      found.push_back({set, static_cast<int>(r) + 1, first, i});
    }
  }
  return found;
}

}  // namespace dripline::statistics
