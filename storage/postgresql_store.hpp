#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "protocol/base/clock.hpp"
#include "storage/content_cache.hpp"
#include "storage/lease_watch.hpp"
#include "storage/opened_store.hpp"

namespace dripline::storage {

struct PostgresqlStoreOptions {
  std::string url;          ///< postgresql://...; the database must exist
  std::string holder{};     ///< what only one process at a time calls itself; empty: a random name
  std::string described{};  ///< which server this is, for anyone who is refused
  /// Another server may have the place when it was not renewed for so long, and a tenth longer, by
  /// that server's steady clock.
  std::chrono::milliseconds lease{3000};
  std::chrono::milliseconds wait_for_holder{12000};  ///< that another one's place ends, then Busy
  /// Of a server that was seen not to renew it (PostgresqlStandby): its place is taken at once,
  /// where the row is the same still.
  std::optional<LeaseRow> ended{};
  std::size_t readers = 4;              ///< connections that read at the same time
  std::uint64_t cache_bytes = 8 << 20;  ///< of program chunks kept checked and decompressed
  /// Program text nearer than the database; null: none. It must outlive the store.
  ContentCache* content_cache = nullptr;
  std::chrono::milliseconds wait{10000};  ///< at most for a connection or a lock, then Errc::Busy
  /// The place is another server's now, for good: called once, from any thread, and returns soon.
  std::function<void(const Error&)> on_lost{};
};

/// Of a URL: whether it has a password in it, which anyone who sees the command line can read.
/// Errors: Syntax.
Result<bool> holds_password(const std::string& url);

/// The second Store: one PostgreSQL database, 15 or newer. What was stored is durable as PostgreSQL
/// promises it (synchronous_commit, and with a synchronous standby there too). One server at a time
/// uses a database: its place is a lease with a term, which every transaction that writes compares
/// (impl/postgresql_place.hpp has what exactly is guaranteed). Who lost the place stores nothing
/// more, reads nothing from when it knows (a quarter of the lease at most), and is notified by
/// `on_lost`. `holder` may be a copied folder's: the term tells the two apart.
/// A lost connection is opened again by the next call; what was not at its commit yet is done
/// again, and so is what conflicted with another transaction. Errors besides those of Store:
/// Timeout (the connection was lost at the commit, and no one knows whether it was stored).
class PostgresqlStore final : public OpenedStore {
 public:
  /// Takes the place, then creates or migrates the tables; on an error the place is free again.
  /// `clock` must outlive the store. Errors: Syntax (the URL), Io, Denied, Busy (another server
  /// uses the database, or another session has locked a table of it), Unsupported (an older
  /// PostgreSQL, another encoding, a newer version's tables or another's, a database of
  /// PostgreSQL's own, or one that is being migrated or was).
  static Result<std::unique_ptr<PostgresqlStore>> open(const PostgresqlStoreOptions& options,
                                                       const Clock& clock);
  ~PostgresqlStore() override;

  using OpenedStore::check;
  /// PostgreSQL finds damage itself (checksums of its pages, pg_amcheck): here it is only asked for
  /// its answer. Errors: Io.
  Result<bool> check(std::chrono::milliseconds limit, const std::stop_token& stop) override;
  Result<void> probe() override;
  Result<std::optional<UtcTime>> time() override;
  /// Unsupported: pg_basebackup and pg_dump are PostgreSQL's own.
  Result<bool> copy_to(const std::filesystem::path& file,
                       const std::function<bool(std::uint64_t, std::uint64_t)>& proceed) override;
  Result<std::string> identity() override;
  std::uint64_t term() const override;
  bool has_place() const override;
  void stop_renewing() override;
  void give_back() override;
  Result<void> publish(const ServerFacts& facts) override;
  Result<std::vector<WaitingServer>> waiting() override;
  Result<OwnHandOvers> own_hand_overs() override;
  Result<void> note_own_hand_overs(const OwnHandOvers& noted) override;

 private:
  struct Parts;
  explicit PostgresqlStore(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace dripline::storage
