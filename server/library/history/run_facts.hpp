#pragma once

#include <string>
#include <vector>

#include "protocol/audit/attestation.hpp"
#include "storage/store.hpp"

namespace dripline::library {

/// What is attested of a run that has ended: program and what it called, the setups of server and
/// gateway, machine, why it was allowed and by which decision, how far it came, what was executed,
/// and where its end is in the audit trail of `database`. Errors: NotFound, Conflict (it has not
/// ended), Corrupt (it was changed since).
Result<std::vector<audit::Fact>> facts_of_run(const storage::Store& store, const std::string& run,
                                              const std::string& database);

}  // namespace dripline::library
