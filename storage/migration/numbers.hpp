#pragma once

#include "storage/impl/connections.hpp"
#include "storage/migration/table.hpp"

namespace dripline::migration {

/// The numbers that rows get by themselves continue where the source has been, also where its last
/// rows are gone. Both engines. Errors: those of the databases.
Result<void> carry_numbers(storage::Connections& source, storage::Connections& target,
                           const Layout& layout);

}  // namespace dripline::migration
