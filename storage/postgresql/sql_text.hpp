#pragma once

#include <string>
#include <string_view>

namespace dripline::storage::postgresql {

/// PostgreSQL's spelling of what the repositories write: ?1 becomes $1, and what only tells
/// SQLite's planner how to go (INDEXED BY name, CROSS JOIN ... ON) is left out. Texts in quotation
/// marks stay as they are.
std::string spelled(std::string_view sql);

}  // namespace dripline::storage::postgresql
