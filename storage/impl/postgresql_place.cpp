#include "storage/impl/postgresql_place.hpp"

#include <algorithm>
#include <optional>
#include <thread>

#include "storage/postgresql/lock_holders.hpp"
#include "storage/postgresql/migration.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kTakePause{100}, kLockTry{500};

/// Above all before, also where the database is one that was restored from a backup.
constexpr const char* kNextTerm =
    "GREATEST(term + 1, CAST(floor(extract(epoch FROM now())) AS bigint))";

double seconds(std::chrono::milliseconds time) {
  return std::chrono::duration<double>(time).count();
}

Result<std::uint64_t> number_of(Result<std::optional<std::int64_t>> row) {
  if (!row) return fail(row.error());
  return static_cast<std::uint64_t>(row->value_or(0));
}

std::int64_t first_number(const sql::Statement& row) {
  return row.integer(0);
}

}  // namespace

/// True: it is ours now. False: `other` has it.
Result<bool> PostgresqlPlace::try_take(postgresql::Database& database, std::string& other) {
  const auto has_terms = postgresql::has_column(database, "store_holder", "term");
  if (!has_terms) return fail(has_terms.error());
  if (auto begun = database.begin(); !begun) return fail(begun.error());
  const auto free = sql::first_row(
      database,
      "SELECT holder = '' OR until <= now(), holder = ?1, described, "
      "CAST(extract(epoch FROM until) * 1000000 AS bigint) FROM store_holder WHERE id = 1 FOR "
      "UPDATE",
      [&](const sql::Statement& row) -> Result<bool> {
        other = row.text(2);
        if (row.integer(0) != 0) return true;
        if (row.integer(1) != 0) return is_gone(row.integer(3), database.label(), other);
        namesake_.reset();
        return false;
      },
      owner_.holder);
  if (!free) return fail(free.error());
  if (const auto is_free = free->value_or(false); !is_free || !*is_free) {
    database.roll_back();
    return is_free;
  }
  const auto taken =
      sql::run(database,
               "UPDATE store_holder SET holder = ?1, described = ?2, until = clock_timestamp() + "
               "?3 * interval '1 millisecond' WHERE id = 1",
               owner_.holder, owner_.described, owner_.lease.count());
  if (!taken) return fail(taken.error());
  std::uint64_t term = 0;
  if (*has_terms) {
    const auto given =
        number_of(sql::first_row(database,
                                 fmt::format("UPDATE store_holder SET term = {}, url = '' WHERE "
                                             "id = 1 RETURNING term",
                                             kNextTerm),
                                 first_number));
    if (!given) return fail(given.error());
    term = *given;
  }
  may_be_ours_ = true;
  if (auto done = database.commit(); !done) return fail(done.error());
  term_ = term;
  return true;
}

/// Whether the server that has the place by our name was one of before, which was killed. One
/// renewal may still have been on its way. Errors: Conflict (it renews).
Result<bool> PostgresqlPlace::is_gone(std::int64_t until, const std::string& label,
                                      const std::string& described) {
  constexpr int kOnItsWay = 1;
  const auto now = SteadyClock::now();
  const bool is_renewed = namesake_ && namesake_->until != until;
  const int renewals = is_renewed ? namesake_->renewals + 1 : namesake_ ? namesake_->renewals : 0;
  if (renewals > kOnItsWay) {
    return fail(Errc::Conflict,
                "database {} is used by a server of the same server.id that works ({}): this "
                "one's state folder is a copy. Delete server.id in the copy, and start it again",
                label, described);
  }
  if (!namesake_ || is_renewed) namesake_ = Namesake{until, now, renewals};
  return now - namesake_->since >= owner_.lease / 2;
}

Result<void> PostgresqlPlace::take_within(postgresql::Database& database) {
  const auto begun = SteadyClock::now();
  std::optional<SteadyClock::time_point> locked_since;
  std::string other;
  for (;;) {
    const auto taken = try_take(database, other);
    if (taken && *taken) return {};
    if (!taken) {
      const bool was_locked = database.waited_for_lock() || database.was_in_the_way();
      database.roll_back();
      if (!was_locked) return fail(taken.error());
      if (!locked_since) locked_since = SteadyClock::now();
      if (SteadyClock::now() - *locked_since + kLockTry >= owner_.lock_wait)
        return fail(postgresql::locked_by_others(database, owner_.lock_wait));
      if (auto ended = postgresql::end_frozen_writers(database, owner_.lease); !ended) return ended;
      continue;
    }
    locked_since.reset();
    // Its own place of before is free at the latest when the lease is over.
    const auto wait = namesake_ ? std::max(owner_.wait, owner_.lease) : owner_.wait;
    if (SteadyClock::now() - begun >= wait) {
      return fail(
          Errc::Busy,
          "database {} is used by another server ({}), and still was after {} s of waiting: "
          "end that one; a server that was killed loses its place after {} s",
          database.label(), other.empty() ? "not named" : other, seconds(owner_.wait),
          seconds(owner_.lease));
    }
    std::this_thread::sleep_for(kTakePause);
  }
}

Result<void> PostgresqlPlace::take(postgresql::Database& database) {
  const auto set_wait = [&](std::chrono::milliseconds wait) {
    return database.execute(fmt::format("SET lock_timeout = {}", wait.count()));
  };
  if (auto set = set_wait(std::min(owner_.lock_wait, kLockTry)); !set) return set;
  if (auto taken = take_within(database); !taken) return taken;
  return set_wait(owner_.lock_wait);
}

Result<void> PostgresqlPlace::raise_term(postgresql::Database& database) {
  const auto given = number_of(sql::first_row(
      database,
      fmt::format("UPDATE store_holder SET term = {} WHERE id = 1 AND holder = ?1 RETURNING term",
                  kNextTerm),
      first_number, owner_.holder));
  if (!given) return fail(given.error());
  if (*given == 0)
    return fail(Errc::Busy, "database {} was taken over by another server", database.label());
  term_ = *given;
  return {};
}

Result<bool> PostgresqlPlace::is_ours(sql::Database& database) const {
  const auto ours = sql::first_row(database,
                                   "SELECT place.holder, place.term FROM store_holder AS place, "
                                   "schema_version AS writer "
                                   "WHERE place.id = 1 FOR KEY SHARE OF place FOR UPDATE OF writer",
                                   [this](const sql::Statement& row) {
                                     return row.text(0) == owner_.holder &&
                                            static_cast<std::uint64_t>(row.integer(1)) == term_;
                                   });
  if (!ours) return fail(ours.error());
  return ours->value_or(false);
}

Result<bool> PostgresqlPlace::renew(sql::Database& database) const {
  const auto renewed =
      sql::run(database,
               "UPDATE store_holder SET until = clock_timestamp() + ?1 * interval '1 millisecond' "
               "WHERE id = 1 AND holder = ?2 AND term = ?3",
               owner_.lease.count(), owner_.holder, term_);
  if (!renewed) return fail(renewed.error());
  return database.changes() == 1;
}

Result<void> PostgresqlPlace::publish(sql::Database& database, const ServerFacts& facts) const {
  return sql::run(database,
                  "UPDATE store_holder SET url = ?1, signing_key = ?2, settings = ?3 WHERE id = 1",
                  facts.url, facts.signing_key, facts.settings);
}

void PostgresqlPlace::give_back(sql::Database& database) const {
  if (!may_be_ours_) return;
  if (!has_term()) {  // of a schema without terms that could not be migrated
    static_cast<void>(
        sql::run(database, "UPDATE store_holder SET holder = '', until = now() WHERE holder = ?1",
                 owner_.holder));
    return;
  }
  static_cast<void>(sql::run(database,
                             "UPDATE store_holder SET holder = '', url = '', until = now() "
                             "WHERE holder = ?1 AND term = ?2",
                             owner_.holder, term_));
}

}  // namespace dripline::storage
