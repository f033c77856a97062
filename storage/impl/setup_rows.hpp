#pragma once

#include "storage/setup_store.hpp"
#include "storage/sql/database.hpp"

namespace dripline::storage {

/// Inside the caller's transaction: what SetupStore::save promises. Digest, size, number and
/// `created` are set here.
Result<SetupRevision> save_setup(sql::Database& database, const SetupRevision& setup,
                                 std::optional<std::uint64_t> base, UtcTime now);

}  // namespace dripline::storage
