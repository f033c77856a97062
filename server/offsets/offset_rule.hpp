#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"

namespace dripline::offsets {

/// How the deviations of a characteristic become a correction of one value of the setup.
struct OffsetRule {
  std::string name;            ///< unique among the machine's
  std::string characteristic;  ///< whose deviations
  /// Only those of this program, tool and report template; empty: of any.
  std::string program, tool, template_name;
  std::string target;  ///< T3.wear.X, T3.length, G54.Z, #500 (setup_value.hpp)
  double scale = 1;    ///< change of the value that changes the characteristic by 1: 0.5 for a
                       ///< diameter by a radius, below 0 where they go against each other
  double gain = 0.5;   ///< part of the mean deviation that is corrected at once; above 0, at most 1
  double dead_band = 0;       ///< a mean deviation below it is left alone; in the setup's unit
  double max_step = 0;        ///< largest change at once, in the setup's unit; required
  std::size_t min_count = 3;  ///< measurements under the value in force that are needed
  std::size_t window = 10;    ///< the newest ones that are looked at
  double outlier = 3.5;  ///< robust deviations (1.4826 MAD) from the median beyond which one is
                         ///< left out; 0: none is
  std::optional<double> lowest, highest;  ///< the value stays between them
  double automatic = 0;  ///< steps up to this one are applied without a person; 0: none is
  int decimals = 4;      ///< of the value, as it is written
};

/// "of program O0900 by tool T3"; empty: it is for all.
std::string scope_text(const OffsetRule& rule);
bool has_same_scope(const OffsetRule& a, const OffsetRule& b);
/// Tools are named as reports name them: T3, T03 and 3 are the same one.
std::string bare_tool(std::string_view tool);

inline constexpr std::size_t kMaxRules = 256;
inline constexpr std::size_t kMaxRuleText = 64 * 1024;

/// A machine's rules: `[[rule]]` tables with these keys. Errors: Syntax (no TOML, an unknown key, a
/// value of another kind; with its line), LimitExceeded (a value outside its bounds, over
/// kMaxRules), Conflict (two rules with one name or one target).
Result<std::vector<OffsetRule>> parse_offset_rules(std::string_view toml);

}  // namespace dripline::offsets
