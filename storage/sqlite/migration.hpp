#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "storage/sqlite/database.hpp"

namespace dripline::storage::sqlite {

/// One numbered step of a schema. Texts live as long as the program (they are compiled in).
struct Migration {
  std::uint32_t version = 0;  ///< 1, 2, 3 ... without gaps
  std::string_view name;
  std::string_view sql;
};

/// Brings the file to the newest version: each step in one transaction together with its
/// user_version, so a kill leaves the file at a version, never between two.
/// Errors: Unsupported (the file is of a newer version, or holds someone else's tables), and those
/// of Database.
Result<void> migrate(Database& database, std::span<const Migration> migrations);

}  // namespace dripline::storage::sqlite
