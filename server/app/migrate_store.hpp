#pragma once

#include "protocol/base/result.hpp"
#include "server/app/settings.hpp"

namespace dripline::app {

/// `dncd --migrate-to`: moves everything that the state folder's server keeps into the database
/// that `settings.migrate_to` names, or from PostgreSQL (`settings.store`) into a SQLite file of
/// the folder; prints how far it is on standard error, and what was moved on standard output.
/// Errors: those of migration::migrate; Unsupported (no such target), Corrupt (the source is not
/// the database that this folder has had).
Result<void> migrate_store(const Settings& settings);

}  // namespace dripline::app
