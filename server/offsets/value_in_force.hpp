#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "server/offsets/setup_value.hpp"
#include "storage/store.hpp"

/// Since when a value is in force: a deviation is one under the value only if nothing else that
/// moves what was measured has changed either.
namespace dripline::offsets {

/// Whether a change of one of both values moves the tool's edge along an axis along which the other
/// one moves it too: geometry and wear of one tool, and the work offsets of the axis. A variable
/// may be any of them. Symmetric; in doubt they do.
bool moves_the_same(const SetupTarget& a, const SetupTarget& b, std::string_view control);

struct SetupInForce {
  const std::string& machine;
  const std::string& control;
  const std::string& text;
  std::uint64_t number = 0;  ///< 0: there is none
};

struct InForceSince {
  std::uint64_t setup = 0;  ///< the first one; 0: there is none
  std::string change;       ///< what was another one before: "T3.Z was 0 mm"; empty: nothing
};

/// Back from the newest setup as long as the target, whatever moves the same, and the options of
/// [control] are the same; lengths in mm. `tool`: of the rule; empty: any (an offset is that of all
/// tools). Errors: those of the store; Syntax (the newest setup).
Result<InForceSince> in_force_since(storage::SetupStore& setups, const SetupInForce& now,
                                    const SetupTarget& target, std::string_view tool);

/// Of a rotary axis: in degrees.
bool is_angle(const SetupTarget& target);
/// A number of a setup in mm, where it is a length.
double canonical(const SetupTarget& target, double value, std::string_view unit);
/// Equal but for the rounding of binary numbers.
bool is_same_number(double a, double b);

}  // namespace dripline::offsets
