#pragma once

#include <cstdint>
#include <span>
#include <string>
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

/// Brings the database to the newest version, all steps in one transaction, and runs `also` in it
/// when something was to be done. Errors: Unsupported (it is of a newer version, or holds someone
/// else's tables), Denied (the user may not make tables), and those of Database.
Result<void> migrate(Database& database, std::span<const Migration> migrations,
                     const std::string& also = "");

/// Whether it has a table of that name.
Result<bool> has_table(sql::Database& database, const std::string& name);
Result<bool> has_column(sql::Database& database, const std::string& table, const std::string& name);

}  // namespace dripline::storage::postgresql
