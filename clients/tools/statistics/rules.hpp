#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"

namespace dripline::statistics {

enum class RuleSet : std::uint8_t {
  LimitsOnly,       ///< a point beyond three sigma
  WesternElectric,  ///< Statistical Quality Control Handbook (1956): 1 to 4
  Nelson,           ///< L. S. Nelson, Journal of Quality Technology 16 (1984): 1 to 8
};
std::string_view to_string(RuleSet set);
/// limits, western_electric, nelson. Errors: Syntax.
Result<RuleSet> parse_rule_set(std::string_view name);

/// One pattern that a process in control shows very rarely.
struct Violation {
  RuleSet set = RuleSet::Nelson;
  int rule = 0;           ///< number in its set
  std::size_t first = 0;  ///< first point of the pattern
  std::size_t point = 0;  ///< last point, the one that completes it
};

/// What the rule looks for, for people.
std::string_view meaning(RuleSet set, int rule);
/// "Nelson 2: nine points in a row on one side of the center".
std::string describe(const Violation& violation);

/// Ordered by point, then rule. `sigma` is that of the plotted points. A point exactly on a limit
/// is not beyond it; one on the center line is on neither side.
std::vector<Violation> find_violations(std::span<const double> points, double center, double sigma,
                                       RuleSet set);

}  // namespace dripline::statistics
