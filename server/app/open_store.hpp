#pragma once

#include <memory>
#include <optional>
#include <string>

#include "protocol/base/clock.hpp"
#include "protocol/base/descriptor.hpp"
#include "server/app/settings.hpp"
#include "server/app/state_folder.hpp"
#include "storage/opened_store.hpp"

namespace dripline::app {

struct KeptStore {
  std::optional<FileLock> folder_lock;  ///< of a database elsewhere; let go after the store
  std::unique_ptr<storage::OpenedStore> store;
  std::string identity;
};

/// Opens what `settings.store` names, the folder's SQLite file by default, and remembers in the
/// folder which database it is. `clock` must outlive the store. Errors: those of the store;
/// Unsupported (another URL than postgresql://, or a folder of backups with PostgreSQL), Corrupt
/// (not the database that this folder has had), Busy (another server uses it).
Result<KeptStore> open_store(const StateFolder& folder, const Settings& settings,
                             const Clock& clock);

}  // namespace dripline::app
