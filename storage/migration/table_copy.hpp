#pragma once

#include <functional>

#include "storage/impl/connections.hpp"
#include "storage/migration/table.hpp"
#include "storage/migration/verified_table.hpp"

namespace dripline::migration {

using storage::Connections;

/// Told how many rows were done; false: end it.
using Tick = std::function<bool(std::uint64_t rows)>;

/// Writes the rows of a table that are missing in the target, some MiB a transaction. Errors:
/// Timeout (`tick` ended it), and those of the databases.
Result<void> copy_table(Connections& source, Connections& target, const Table& table,
                        const Tick& tick);

/// Of all rows of a table in the order of its key; equal in both engines for equal rows.
Result<TableDigest> digest_of(Connections& connections, const Table& table, const Tick& tick);

Error stopped();

}  // namespace dripline::migration
