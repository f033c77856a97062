#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/offsets/offset_rule.hpp"
#include "server/offsets/proposal.hpp"
#include "server/offsets/setup_value.hpp"
#include "server/offsets/value_in_force.hpp"
#include "storage/store.hpp"

namespace dripline::offsets {

struct DeviationQuery {
  const std::string& machine;
  const std::string& unit;  ///< of the setup: what lengths are converted to
  const OffsetRule& rule;
  const SetupTarget& target;  ///< the rule's
  const InForceSince& since;
  /// The control's memory had another number until then (memory_check.hpp).
  const std::optional<UtcTime>& differed_until;
};

struct Measured {
  std::vector<Deviation> deviations;  ///< oldest first, at most the rule's window
  std::string unit;                   ///< of the deviations
  std::vector<std::string> left_out;  ///< how many were, and why, in words
};

/// Of the newest measurements of the rule's characteristic those that it is for, of runs under the
/// value in force: one of each part that has ended and is known not to contradict itself. In doubt
/// one is left out. Errors: those of the store.
Result<Measured> find_deviations(const storage::Store& store, const DeviationQuery& query);

}  // namespace dripline::offsets
