#pragma once

#include <string>
#include <vector>

#include "storage/sql/database.hpp"

namespace dripline::migration {

namespace sql = storage::sql;

struct Column {
  std::string name;
  sql::Kind kind = sql::Kind::Unknown;
};

/// One table of the schema, which both engines have under the same names.
struct Table {
  std::string name;
  std::vector<Column> columns;
  std::vector<Column> order;       ///< the primary key; of a table without one, all columns
  std::string number;              ///< the column that numbers its rows by itself; empty: none
  bool never_reuses = false;       ///< a number, also after its row is gone (SQLite: AUTOINCREMENT)
  std::vector<std::string> needs;  ///< tables that its rows refer to
};

/// What the newest schema consists of.
struct Layout {
  std::vector<Table> tables;          ///< each after those it needs, `identity` first
  std::vector<std::string> triggers;  ///< SQLite's statements that make them
  std::vector<std::string> names;     ///< of all tables, also of the search index
};

/// Read from the schema itself, in an empty database in memory. Without the search index, which is
/// no data: the server makes it from what is stored. Errors: those of the database.
Result<Layout> read_layout();

/// "name" in quotation marks, as both engines take it.
std::string quoted(const std::string& name);

}  // namespace dripline::migration
