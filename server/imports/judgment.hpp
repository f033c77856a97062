#pragma once

#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "server/library/release_policy.hpp"
#include "storage/programs/program_store.hpp"

namespace dripline::imports {

/// What is known when a revision from a machine is judged.
struct Evidence {
  const storage::Revision& revision;
  const storage::Revision& base;     ///< it was compared with
  std::uint64_t newest = 0;          ///< the newest revision in force
  const nlohmann::json& comparison;  ///< by motion, base first
  bool has_setup = false;            ///< the comparison used a setup of the machine
};

/// Why a person has to look at it; nullopt: the policy accepts it at once. In doubt it waits: when
/// its class is not among those of the policy; it came over a disturbed line; what was compared is
/// withdrawn, or not the newest; the comparison met an alarm or could not be completed; or the
/// class depends on offsets and tools, and the machine has no setup. Pure.
std::optional<std::string> reason_to_wait(const library::ReleasePolicy& policy,
                                          const Evidence& evidence);

}  // namespace dripline::imports
