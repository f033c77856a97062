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

constexpr const char* kUntil = "CAST(extract(epoch FROM until) * 1000000 AS bigint)";
constexpr const char* kLeft =
    "CAST(extract(epoch FROM until - clock_timestamp()) * 1000 AS bigint)";

const char* term_column(bool has_terms) {
  return has_terms ? "term" : "CAST(0 AS bigint)";
}

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

Result<PostgresqlPlace::Seen> PostgresqlPlace::look(postgresql::Database& database) const {
  Seen seen;
  seen.look.asked = SteadyClock::now();
  const auto row = sql::first_row(
      database,
      fmt::format("SELECT holder, {}, {}, {}, described, holder = ?1, until <= clock_timestamp() "
                  "FROM store_holder WHERE id = 1",
                  term_column(has_terms_), kUntil, kLeft),
      [&](const sql::Statement& found) {
        seen.look.row = {found.text(0), static_cast<std::uint64_t>(found.integer(1)),
                         found.integer(2)};
        seen.look.left = std::chrono::milliseconds(found.integer(3));
        seen.described = found.text(4);
        seen.is_own = found.integer(5) != 0;
        seen.is_lapsed = found.integer(6) != 0;
        return true;
      },
      owner_.holder);
  if (!row) return fail(row.error());
  seen.look.answered = SteadyClock::now();
  if (row->has_value()) return seen;
  return fail(Errc::Corrupt,
              "database {} has lost the row of its place (table store_holder): no server can have "
              "it until there is one again (deploy/docs/operations.md)",
              database.label());
}

Result<bool> PostgresqlPlace::is_free(const Seen& seen, const std::string& label) {
  const bool is_over = watch_.is_over(seen.look);
  if (is_over || seen.look.row == owner_.ended) return true;
  if (!seen.is_own) {
    namesake_.reset();
    return false;
  }
  return seen.is_lapsed ? Result<bool>(true) : is_gone(seen, label);
}

/// True: it is ours now. False: the row is not this one any more. It is locked first, because what
/// follows changes no key, and would not wait for a transaction that writes.
Result<bool> PostgresqlPlace::try_take(postgresql::Database& database, const LeaseRow& row) {
  if (auto begun = database.begin(); !begun) return fail(begun.error());
  const auto locked =
      sql::first_row(database, "SELECT id FROM store_holder WHERE id = 1 FOR UPDATE", first_number);
  if (!locked) return fail(locked.error());
  const std::string with_term =
      has_terms_ ? fmt::format(", term = {}, url = ''", kNextTerm) : std::string();
  const auto given = sql::first_row(
      database,
      fmt::format(
          "UPDATE store_holder SET holder = ?1, described = ?2, until = clock_timestamp() + "
          "?3 * interval '1 millisecond'{} WHERE id = 1 AND holder = ?4 AND {} = ?5 AND {} "
          "= ?6 RETURNING {}",
          with_term, term_column(has_terms_), kUntil, term_column(has_terms_)),
      first_number, owner_.holder, owner_.described, owner_.lease.count(), row.holder, row.term,
      row.until);
  if (!given) return fail(given.error());
  if (!*given) {
    database.roll_back();
    return false;
  }
  may_be_ours_ = true;
  if (auto done = database.commit(); !done) return fail(done.error());
  term_ = static_cast<std::uint64_t>(**given);
  return true;
}

/// Whether the server that has the place by our name was one of before, which was killed. One
/// renewal may still have been on its way. Errors: Conflict (it renews).
Result<bool> PostgresqlPlace::is_gone(const Seen& seen, const std::string& label) {
  constexpr int kOnItsWay = 1;
  const std::int64_t until = seen.look.row.until;
  const bool is_renewed = namesake_ && namesake_->until != until;
  const int renewals = is_renewed ? namesake_->renewals + 1 : namesake_ ? namesake_->renewals : 0;
  if (renewals > kOnItsWay) {
    return fail(Errc::Conflict,
                "database {} is used by a server of the same server.id that works ({}): this "
                "one's state folder is a copy. Delete server.id in the copy, and start it again",
                label, seen.described);
  }
  if (!namesake_ || is_renewed) namesake_ = Namesake{until, seen.look.answered, renewals};
  return seen.look.asked - namesake_->since >= owner_.lease / 2;
}

/// Its own place of before is free at the latest when the lease is over; one whose lease is over
/// for long is watched for a lease all the same.
std::chrono::milliseconds PostgresqlPlace::longest_wait() const {
  constexpr std::chrono::milliseconds kLooks{1000};
  if (owner_.wait.count() == 0) return namesake_ ? owner_.lease : owner_.wait;
  return std::max(owner_.wait, watch_.period() + kLooks);
}

/// True: it is ours now. False: another server has it.
Result<bool> PostgresqlPlace::attempt(postgresql::Database& database, Seen& seen, bool& is_due) {
  is_due = false;
  auto now = look(database);
  if (!now) return fail(now.error());
  seen = *std::move(now);
  const auto is_free = this->is_free(seen, database.label());
  if (!is_free || !*is_free) return is_free;
  is_due = true;
  return try_take(database, seen.look.row);
}

Result<void> PostgresqlPlace::take_within(postgresql::Database& database) {
  const auto begun = SteadyClock::now();
  std::optional<SteadyClock::time_point> locked_since;
  postgresql::FrozenWriters frozen(owner_.lease);
  Seen seen;
  for (bool is_due = false;;) {
    const auto taken = attempt(database, seen, is_due);
    if (taken && *taken) return {};
    if (!taken) {
      const bool was_locked = database.waited_for_lock() || database.was_in_the_way();
      database.roll_back();
      if (!was_locked) return fail(taken.error());
      if (!locked_since) locked_since = SteadyClock::now();
      if (SteadyClock::now() - *locked_since + kLockTry >= owner_.lock_wait)
        return fail(postgresql::locked_by_others(database, owner_.lock_wait));
      if (!is_due) continue;
      if (auto ended = frozen.end(database); !ended) return ended;
      continue;
    }
    locked_since.reset();
    const auto wait = longest_wait();
    if (SteadyClock::now() - begun >= wait) {
      return fail(
          Errc::Busy,
          "database {} is used by another server ({}), and still was after {} s of waiting: "
          "end that one; a server that was killed loses its place after {} s",
          database.label(), seen.described.empty() ? "not named" : seen.described, seconds(wait),
          seconds(owner_.lease));
    }
    std::this_thread::sleep_for(kTakePause);
  }
}

Result<void> PostgresqlPlace::take(postgresql::Database& database) {
  const auto has_terms = postgresql::has_column(database, "store_holder", "term");
  if (!has_terms) return fail(has_terms.error());
  has_terms_ = *has_terms;
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
