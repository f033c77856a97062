#pragma once

#include <string>
#include <vector>

#include "storage/opened_store.hpp"
#include "storage/sql/database.hpp"

/// The rows of servers that wait for a database's place (schema, store_standby).
namespace dripline::storage {

/// Those that were seen in the last seconds, but `except`. A database's clock that was set back
/// leaves none that is gone.
Result<std::vector<WaitingServer>> waiting_servers(sql::Database& database,
                                                   const std::string& except);
Result<void> note_waiting(sql::Database& database, const std::string& holder,
                          const std::string& described);
Result<void> drop_waiting(sql::Database& database, const std::string& holder);

}  // namespace dripline::storage
