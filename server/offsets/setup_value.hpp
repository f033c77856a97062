#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"

/// Single values in the text of a setup (deploy/docs/setup-format.md), as numbers of its unit.
namespace dripline::offsets {

/// What a value is called: T3.wear.X, T3.wear.radius, T3.X, T3.Z, T3.length, T3.radius; G54.X and
/// the other axes of an offset by its name; a variable by its name, without a point: #500, P12.
struct SetupTarget {
  enum class Kind : std::uint8_t { Tool, Wear, Offset, Variable } kind = Kind::Variable;
  int tool = 0;
  std::string name;  ///< of the offset, of the variable
  std::string key;   ///< X, radius, length ...; empty for a variable
};
/// Errors: Syntax.
Result<SetupTarget> parse_setup_target(std::string_view text);

/// 0 where the setup says nothing of it. Errors: Syntax (no TOML, with the line).
Result<double> value_in_setup(std::string_view toml, const SetupTarget& target);

/// Whether the setup has the tool, the offset or the variable itself. Errors: Syntax.
Result<bool> is_in_setup(std::string_view toml, const SetupTarget& target);
/// "tool 3", "offset G54", "variable #500"
std::string owner_of(const SetupTarget& target);

/// The same text with another value: comments, order and layout stay; a tool, an offset or a key
/// that is not there is added. Errors: Syntax (no TOML), Unsupported (a layout that it cannot be
/// written into).
Result<std::string> with_value(std::string_view toml, const SetupTarget& target, double value,
                               int decimals);

/// Every value of a tool or an offset that a setup states, for histories.
struct NamedValue {
  std::string target;
  double value = 0;
};
/// In the order of the text. Errors: Syntax.
Result<std::vector<NamedValue>> values_in_setup(std::string_view toml);

/// What a value along X or a radius is in the setup: "radius" or "diameter", where there is a
/// difference; empty for any other. Errors: Syntax.
Result<std::string> kind_of_x(std::string_view toml, std::string_view control,
                              const SetupTarget& target);

/// "mm" or "in" as the setup states it; empty: it is the control's. Errors: Syntax.
Result<std::string> unit_of_setup(std::string_view toml);
/// The same, or the control's own. Errors: those of find_dialect too.
Result<std::string> unit_in_force(std::string_view toml, std::string_view control);

}  // namespace dripline::offsets
