#pragma once

#include <span>

#include "storage/sqlite/migration.hpp"

namespace dripline::storage {

/// The files of storage/schema, compiled in.
std::span<const sqlite::Migration> schema();

}  // namespace dripline::storage
