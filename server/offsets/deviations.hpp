#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/offsets/offset_rule.hpp"
#include "server/offsets/proposal.hpp"
#include "storage/store.hpp"

namespace dripline::offsets {

struct DeviationQuery {
  const std::string& machine;
  const std::string& unit;  ///< of the setup: what the deviations are in
  const OffsetRule& rule;
  std::uint64_t since = 0;  ///< the first setup with the value in force
};

struct Measured {
  std::vector<Deviation> deviations;  ///< oldest first, at most the rule's window
  /// Under the value in force too, and left out: the rule is for another program, tool or template.
  std::uint64_t of_others = 0;
  bool is_cut = false;  ///< older ones were not looked at
};

/// Of the newest measurements of the rule's characteristic those that it is for, of runs under the
/// value in force. Errors: those of the store.
Result<Measured> find_deviations(const storage::Store& store, const DeviationQuery& query);

}  // namespace dripline::offsets
