#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "storage/lease_watch.hpp"
#include "storage/opened_store.hpp"
#include "storage/postgresql/database.hpp"

namespace dripline::storage {

/// The place of the one server that uses a database: a lease in a row of it (schema, store_holder).
///
/// What is guaranteed, whatever is killed, frozen or cut off, and whatever any server's clock says:
/// - A term is given once. Each taking of the place has a higher one than all before, in the
///   transaction that takes it, also by the same server and by one with a copied folder.
/// - A transaction that writes locks the row against a taking (FOR KEY SHARE, which FOR UPDATE
/// waits
///   for), and is undone unless the row has the writer's name and the writer's term. So between a
///   taking and the next one only transactions of that taking are committed: a server that was
///   frozen, in the middle of a transaction or before it, and wakes up after another has the place,
///   stores no row.
/// - A renewal changes no key, so it waits for no transaction that writes: the lease of a server
///   that stores much over a slow line is renewed meanwhile, on a connection of its own.
/// - The place is another's only after it was given back, or was not renewed for the lease by the
///   steady clock of the one that takes it (storage/lease_watch.hpp), or its holder (of the same
///   name, which has a folder's lock) begins again. The statement that takes it compares the row
///   with the one that was watched: of two that take it one does, and none after a renewal. A
///   namesake that still renews is another server, with a copy of the folder: refused.
/// What is not: that a server knows at once that it lost the place. Until it writes or renews (a
/// quarter of the lease) it may read, and send what it has to machines; gateways refuse that by its
/// term (protocol/dds).
/// One thread at a time until it is taken; then all of it but `take` from any.
class PostgresqlPlace {
 public:
  struct Owner {
    std::string holder;     ///< what only one process at a time calls itself
    std::string described;  ///< for people
    std::chrono::milliseconds lease{3000};
    std::chrono::milliseconds wait{12000};       ///< that another one's lease ends, then Busy
    std::chrono::milliseconds lock_wait{10000};  ///< for a lock, then Busy
    std::optional<LeaseRow> ended{};  ///< was watched until its lease was over: no wait for it
  };
  explicit PostgresqlPlace(Owner owner) : owner_(std::move(owner)), watch_(owner_.lease) {}

  /// A writer of ours that was frozen with the row locked is disconnected, once its lease is over.
  /// Errors: Busy (another server has it; another session has locked the row), Conflict (a server
  /// that works has the same name), Io.
  Result<void> take(postgresql::Database& database);
  /// After a migration from a schema without terms: what `take` could not do.
  Result<void> raise_term(postgresql::Database& database);
  bool has_term() const { return term_ != 0; }
  std::uint64_t term() const { return term_; }

  /// In a transaction that will write: locks the row, and out other writers of ours: a session that
  /// was lost may not have ended yet. False: it is not ours, or not any more.
  Result<bool> is_ours(sql::Database& database) const;
  /// Also outside a transaction. False: it is not ours, or not any more.
  Result<bool> renew(sql::Database& database) const;
  /// In a transaction of `is_ours`.
  Result<void> publish(sql::Database& database, const ServerFacts& facts) const;
  /// Best effort: otherwise it ends by its time.
  void give_back(sql::Database& database) const;

 private:
  /// What the row was when it was looked at last, while it had our name and its lease.
  struct Namesake {
    std::int64_t until = 0;  ///< of its lease, microseconds
    std::chrono::steady_clock::time_point since;
    int renewals = 0;  ///< that were seen
  };
  /// The row as it was looked at, without a lock.
  struct Seen {
    LeaseWatch::Look look;
    std::string described;
    bool is_own = false;     ///< our name
    bool is_lapsed = false;  ///< by the database's clock
  };
  Result<Seen> look(postgresql::Database& database) const;
  Result<bool> is_free(const Seen& seen, const std::string& label);
  Result<bool> attempt(postgresql::Database& database, Seen& seen, bool& is_due);
  Result<bool> try_take(postgresql::Database& database, const LeaseRow& row);
  Result<bool> is_gone(const Seen& seen, const std::string& label);
  std::chrono::milliseconds longest_wait() const;
  Result<void> take_within(postgresql::Database& database);

  const Owner owner_;
  std::optional<Namesake> namesake_;
  LeaseWatch watch_;
  bool has_terms_ = false;  ///< the schema
  bool may_be_ours_ = false;
  std::uint64_t term_ = 0;
};

}  // namespace dripline::storage
