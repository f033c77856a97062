#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "storage/postgresql/database.hpp"

namespace dripline::storage::postgresql {

/// One numbered step of a schema. Texts live as long as the program (they are compiled in).
struct Migration {
  std::uint32_t version = 0;  ///< 1, 2, 3 ... without gaps
  std::string_view name;
  std::string_view sql;
};

/// The files of storage/postgresql/schema, compiled in.
std::span<const Migration> schema();

/// Brings the database to the newest version, all steps in one transaction. Errors: Unsupported (it
/// is of a newer version, or holds someone else's tables), and those of Database.
Result<void> migrate(Database& database, std::span<const Migration> migrations);

}  // namespace dripline::storage::postgresql
