#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "storage/migration/verified_table.hpp"
#include "storage/postgresql_store.hpp"

namespace dripline::migration {

enum class Step : std::uint8_t { Copy, Verify, Leave, Activate };

struct Progress {
  Step step{};
  std::string table{};
  std::uint64_t done = 0, total = 0;  ///< rows, of all tables
};

struct Request {
  enum class Direction : std::uint8_t { ToPostgresql, ToSqlite };
  Direction direction{};
  std::filesystem::path file;                  ///< of the server's SQLite database
  storage::PostgresqlStoreOptions postgresql;  ///< url, holder and described
  /// Whether the source's identity, under a name for people, is the one to move; its error ends it.
  std::function<Result<void>(const std::string&, const std::string&)> is_expected{};
  /// Asked before each step, and every few thousand rows: false ends it as a kill would.
  std::function<bool(const Progress&)> proceed{};
};

struct Report {
  std::string from, to;          ///< without a password
  std::string identity;          ///< of the database, before and after
  std::uint64_t term = 0;        ///< above that of every server of the source; 0: they had none
  bool was_resumed = false;      ///< an earlier call had been ended
  bool was_begun_again = false;  ///< and the source had been used since
  bool was_complete = false;     ///< nothing was left to do: `tables` is empty
  std::vector<VerifiedTable> tables;
};

/// Moves everything that a server keeps from one engine into the other, reads both back and
/// compares them, and then makes the target the only one that a server may use. Ended at any
/// moment, by a kill too, it continues with the next call; until its last step the source is as it
/// was. No server uses either of them meanwhile. Errors: NotFound, Busy, Conflict (the target holds
/// something else), Corrupt (what was read back is not what was written), Timeout (`proceed` ended
/// it), and those of the stores.
Result<Report> migrate(const Request& request);

}  // namespace dripline::migration
