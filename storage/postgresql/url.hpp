#pragma once

#include <string>

#include "protocol/base/result.hpp"

namespace dripline::storage::postgresql {

/// What a URL says of itself, before anything is connected.
struct UrlFacts {
  std::string database;  ///< as libpq takes it when the URL names none, too
  bool has_password = false;
};

/// Errors: Syntax (libpq cannot read it; it is not repeated, for it may hold a password).
Result<UrlFacts> read_url(const std::string& url);

/// Errors: Unsupported (a database that PostgreSQL keeps for itself: postgres, template0,
/// template1).
Result<void> check_name(const std::string& database);

}  // namespace dripline::storage::postgresql
