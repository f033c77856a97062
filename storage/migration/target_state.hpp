#pragma once

#include <optional>
#include <string>

#include "storage/impl/connections.hpp"
#include "storage/migration/table.hpp"
#include "storage/migration/verified_table.hpp"

/// What a target knows of its own migration, in two tables that are there only meanwhile. They
/// change in the transactions that write the rows, so a kill leaves them true.
namespace dripline::migration {

using storage::Connections;

/// SQL that makes the two tables, takes out what the schema itself has put in, and switches the
/// triggers off. `source`: the identity of the database that is moved.
std::string begin_sql(sql::Engine engine, const Layout& layout, const std::string& source);
/// The opposite, when everything is there: the search index is due, triggers work again.
std::string end_sql(sql::Engine engine, const Layout& layout);
/// Empties every table: it is copied again from the beginning.
std::string restart_sql(sql::Engine engine, const Layout& layout);

struct TargetState {
  std::string source;        ///< its identity
  bool is_verified = false;  ///< everything was read back and is as it is in the source
};
/// Errors: those of the database.
Result<TargetState> read_state(Connections& target);

struct TableState {
  std::uint64_t rows = 0;  ///< that are there: the first ones in the order of the key
  bool is_whole = false;
};
Result<TableState> table_state(Connections& target, const Table& table);
/// In the transaction that wrote the rows.
Result<void> save_table_state(sql::Database& target, const Table& table, const TableState& state);

/// In one transaction: all tables were read back.
Result<void> save_verified(Connections& target, const std::vector<VerifiedTable>& tables);
Result<std::vector<VerifiedTable>> read_verified(Connections& target);

}  // namespace dripline::migration
