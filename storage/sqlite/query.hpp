#pragma once

#include "storage/sql/query.hpp"
#include "storage/sqlite/database.hpp"

namespace dripline::storage::sqlite {

using sql::all_rows;
using sql::first_row;
using sql::run;

}  // namespace dripline::storage::sqlite
