#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "protocol/base/clock.hpp"
#include "protocol/base/descriptor.hpp"
#include "protocol/base/signature.hpp"
#include "server/app/settings.hpp"
#include "server/app/state_folder.hpp"
#include "storage/cache/disk_cache.hpp"
#include "storage/lease_watch.hpp"
#include "storage/opened_store.hpp"

namespace dripline::app {

struct KeptStore {
  std::optional<FileLock> folder_lock;      ///< of a database elsewhere; let go after the store
  std::unique_ptr<cache::DiskCache> cache;  ///< of such a one; null: none. Used by the store
  std::unique_ptr<storage::OpenedStore> store;
  std::string identity;
};

/// The store is another server's now, for good: called once, from any thread, and returns soon.
using OnLost = std::function<void(const Error&)>;

/// Of a store that servers share.
struct PlaceUse {
  std::optional<storage::LeaseRow> ended{};  ///< as of PostgresqlStoreOptions
  OnLost on_lost{};
};

/// Opens what `settings.store` names, the folder's SQLite file by default, and remembers in the
/// folder which database it is. `clock` must outlive the store. Errors: those of the store;
/// Unsupported (another URL than postgresql://, or a folder of backups with PostgreSQL), Corrupt
/// (not the database that this folder has had), Busy (another server uses it).
Result<KeptStore> open_store(const StateFolder& folder, const Settings& settings,
                             const Clock& clock, PlaceUse place = {});

/// "dncd 812 on srv-1, /var/lib/dripline": who uses a database, for anyone who is refused.
std::string description(const StateFolder& folder);
/// The computer's name; empty: it has none.
std::string host_name();
/// What the server of this folder calls itself in a database: only one process at a time is it,
/// also where the folder was copied. Errors: those of the folder.
Result<std::string> holder_name(const StateFolder& folder);
/// The key that another server of the same database has to have. Errors: those of the folder.
Result<SigningKey> signing_key(const StateFolder& folder);

/// Warns of a password in the URL. Errors: Unsupported (none of postgresql://), Syntax.
Result<void> check_url(const std::string& url);
/// What keeps a server of this folder from a PostgreSQL database, whatever is in that. Errors:
/// those of check_url, Unsupported (settings of a SQLite file), Conflict (the folder has such a
/// file).
Result<void> check_postgresql(const StateFolder& folder, const Settings& settings);

}  // namespace dripline::app
