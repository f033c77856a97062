#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "storage/opened_store.hpp"
#include "storage/sql/database.hpp"

/// The rows of servers that wait for a database's place (schema, store_standby).
namespace dripline::storage {

/// Those that were seen in the last seconds. A database's clock that was set back leaves none that
/// is gone.
Result<std::vector<WaitingServer>> waiting_servers(sql::Database& database);
/// Whether there are any but this one.
Result<bool> has_other_waiting(sql::Database& database, const std::string& holder);
struct WaitingNote {
  std::string holder, described;
  std::optional<std::int64_t> gateways;  ///< that it hears; nullopt: not known
  bool has_gateways = true;              ///< the schema, from version 13 on
};
Result<void> note_waiting(sql::Database& database, const WaitingNote& note);
Result<void> drop_waiting(sql::Database& database, const std::string& holder);

}  // namespace dripline::storage
