#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>

#include "storage/postgresql/database.hpp"

namespace dripline::storage::postgresql {

/// That a table's lock did not come free within `waited`: which session has locked which tables,
/// since when, in words for people. Outside a transaction; what waited has been rolled back.
Error locked_by_others(Database& database, std::chrono::milliseconds waited);

/// Disconnects sessions of ours that have the place's row locked (schema, store_holder) and have
/// sent nothing for `lease`: a server that was frozen, or cut off, in the middle of a transaction.
/// What it had not committed is undone. By the database's clock, or by the own steady clock from
/// the first call on: the database's may have been set back. One thread.
class FrozenWriters {
 public:
  explicit FrozenWriters(std::chrono::milliseconds lease) : lease_(lease) {}
  /// Again and again, while the lease of the place is over.
  Result<void> end(Database& database);

 private:
  struct Seen {
    std::string state;  ///< since when it waits for its client, by the database's clock
    std::chrono::steady_clock::time_point since;
  };
  const std::chrono::milliseconds lease_;
  std::map<std::int64_t, Seen> seen_;  ///< by process number
};

}  // namespace dripline::storage::postgresql
