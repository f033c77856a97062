#include "server/app/open_store.hpp"

#include <unistd.h>
#include <array>
#include <filesystem>

#include "protocol/process/log.hpp"
#include "storage/migration/files.hpp"
#include "storage/postgresql_store.hpp"
#include "storage/sqlite_store.hpp"

namespace dripline::app {
namespace {

bool is_postgresql(const std::string& url) {
  return url.starts_with("postgresql://") || url.starts_with("postgres://");
}

/// A folder that has had no database does not take one that another folder's server has signed:
/// its audit trail would never verify again.
Result<void> check_trail(const StateFolder& folder, storage::OpenedStore& store) {
  std::error_code ec;
  if (std::filesystem::exists(folder.identity_file(), ec)) return {};
  const auto first = store.audit.chained(0, 1);
  if (!first) return fail(first.error());
  if (first->empty()) return {};
  return fail(Errc::Conflict,
              "the database that --store names has an audit trail, and this state folder has never "
              "had it: {} has not the key that it is signed with. Start with the state folder of "
              "the server that wrote it (or a copy), or name a new database",
              folder.path().string());
}

/// Null: none is wanted, or it cannot be made, which keeps no server from working.
std::unique_ptr<cache::DiskCache> open_cache(const StateFolder& folder, const Settings& settings) {
  if (settings.program_cache_mb == 0) return nullptr;
  constexpr unsigned kMega = 20;
  auto opened =
      cache::DiskCache::open({.folder = folder.cache(),
                              .capacity = std::uint64_t{settings.program_cache_mb} << kMega,
                              .on_fault = [](const std::string& fault) {
                                process::log_warning(
                                    "program text is not kept on this server's disk: {}; machines "
                                    "are fed from the database alone",
                                    fault);
                              }});
  if (opened) return *std::move(opened);
  process::log_warning("program text is not kept on this server's disk: {}", opened.error().what);
  return nullptr;
}

/// A database that was left names the folder, and the folder has its file only after the last step.
Error unfinished(const StateFolder& folder, const Error& error) {
  const auto entered = migration::entered_file(folder.database());
  std::error_code ec;
  if (error.code != Errc::Conflict || !std::filesystem::exists(entered, ec)) return error;
  return {error.code,
          fmt::format("run the migration again (dnc server migrate --from URL --to {}): it was "
                      "ended before its last step, and {} is not in use yet",
                      folder.path().string(), entered.string())};
}

/// A server that stands by has waited already; another one that waits may be quicker.
std::chrono::milliseconds wait_for_holder(const Settings& settings) {
  if (settings.standby) return std::chrono::milliseconds(0);
  return storage::PostgresqlStoreOptions{}.wait_for_holder;
}

Result<KeptStore> open_postgresql(const StateFolder& folder, const Settings& settings,
                                  const Clock& clock, PlaceUse place) {
  if (auto can = check_postgresql(folder, settings); !can) return fail(can.error());
  auto lock = folder.lock();
  if (!lock) return fail(lock.error());
  const auto holder = holder_name(folder);
  if (!holder) return fail(holder.error());
  auto cache = open_cache(folder, settings);
  auto store = storage::PostgresqlStore::open({.url = settings.store,
                                               .holder = *holder,
                                               .described = description(folder),
                                               .lease = std::chrono::seconds(settings.takeover_s),
                                               .wait_for_holder = wait_for_holder(settings),
                                               .ended = std::move(place.ended),
                                               .content_cache = cache.get(),
                                               .on_lost = std::move(place.on_lost)},
                                              clock);
  if (!store) return fail(unfinished(folder, store.error()));
  if (auto own = check_trail(folder, **store); !own) return fail(own.error());
  return KeptStore{*std::move(lock), std::move(cache), *std::move(store), ""};
}

Result<KeptStore> open_sqlite(const StateFolder& folder, const Settings& settings,
                              const Clock& clock) {
  if (auto is_there = folder.expect_database(settings.begin_empty); !is_there)
    return fail(is_there.error());
  auto store = storage::SqliteStore::open({.file = folder.database()}, clock);
  if (!store) return fail(store.error());
  return KeptStore{std::nullopt, nullptr, *std::move(store), ""};
}

}  // namespace

std::string host_name() {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return host.data();
}

std::string description(const StateFolder& folder) {
  return fmt::format("dncd {} on {}, {}", ::getpid(), host_name(), folder.path().string());
}

Result<std::string> holder_name(const StateFolder& folder) {
  auto id = folder.server_id();
  if (!id) return id;
  return fmt::format("{} {} {}", *id, host_name(), folder.path().string());
}

Result<SigningKey> signing_key(const StateFolder& folder) {
  const auto seed = folder.signing_seed();
  if (!seed) return fail(seed.error());
  auto key = SigningKey::of(*seed);
  if (!key) return fail(Errc::Denied, "{}: {}", folder.signing_file().string(), key.error().what);
  return key;
}

Result<void> check_url(const std::string& url) {
  if (!is_postgresql(url)) {
    // Not repeated: it may hold a password.
    return fail(Errc::Unsupported,
                "store: the URL begins with postgresql://, or is empty for a SQLite file in the "
                "state folder");
  }
  const auto has_password = storage::holds_password(url);
  if (!has_password) return fail(has_password.error());
  if (*has_password) {
    process::log_warning(
        "store: the URL has a password in it. Whoever can list processes or read the service's "
        "configuration and the log of its start sees it: put it into ~/.pgpass, or the file that "
        "PGPASSFILE names, and take it out of the URL");
  }
  return {};
}

Result<void> check_postgresql(const StateFolder& folder, const Settings& settings) {
  if (auto known = check_url(settings.store); !known) return known;
  if (!settings.backups.empty()) {
    return fail(Errc::Unsupported,
                "backups: {} is a folder for backups of a SQLite file; a PostgreSQL database is "
                "backed up by its own tools (deploy/docs/operations.md): start without it",
                settings.backups);
  }
  if (settings.begin_empty) {
    return fail(
        Errc::Unsupported,
        "--begin-empty is for a SQLite file: to begin again in PostgreSQL, make a database, "
        "name it with --store, and remove {}",
        folder.identity_file().string());
  }
  // Before the database is touched: a migration goes into an empty one.
  if (std::error_code ec; std::filesystem::exists(folder.database(), ec)) {
    return fail(Errc::Conflict,
                "what this state folder keeps is in {}: move it into the database first (dnc "
                "server migrate --to URL), or start without --store",
                folder.database().string());
  }
  return {};
}

Result<KeptStore> open_store(const StateFolder& folder, const Settings& settings,
                             const Clock& clock, PlaceUse place) {
  auto kept = settings.store.empty() ? open_sqlite(folder, settings, clock)
                                     : open_postgresql(folder, settings, clock, std::move(place));
  if (!kept) return kept;
  auto identity = kept->store->identity();
  if (!identity) return fail(identity.error());
  const std::string name =
      settings.store.empty() ? folder.database().string() : "the one that --store names";
  if (auto known = folder.remember_database(*identity, name); !known) return fail(known.error());
  kept->identity = *std::move(identity);
  return kept;
}

}  // namespace dripline::app
