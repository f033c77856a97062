#include "storage/impl/postgresql_connections.hpp"

#include <condition_variable>
#include <mutex>

#include "protocol/base/random.hpp"
#include "storage/postgresql/lock_holders.hpp"
#include "storage/postgresql/migration.hpp"
#include "storage/postgresql/url.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// A database that is not there keeps no caller longer; one that was just lost may be back at once.
constexpr std::chrono::milliseconds kReconnect{2000}, kPause{100};
/// Of the lease: so often the place is renewed, and after so long without it with what is written.
constexpr int kRenewals = 4, kLateRenewals = 2;

}  // namespace

PostgresqlConnections::PostgresqlConnections(const PostgresqlStoreOptions& options)
    : options_(options),
      place_({.holder = options.holder.empty() ? random_hex(16) : options.holder,
              .described = options.described,
              .lease = options.lease,
              .wait = options.wait_for_holder,
              .lock_wait = options.wait,
              .ended = options.ended}),
      writer_(options.wait),
      readers_(options.wait) {}

Result<std::unique_ptr<PostgresqlConnections>> PostgresqlConnections::open(
    const PostgresqlStoreOptions& options, const DatabaseUse& use) {
  const auto facts = postgresql::read_url(options.url);
  if (!facts) return fail(facts.error());
  if (auto ours = postgresql::check_name(facts->database); !ours) return fail(ours.error());
  std::unique_ptr<PostgresqlConnections> connections(new PostgresqlConnections(options));
  auto writer = Database::connect({.url = options.url, .lock_timeout = options.wait});
  if (!writer) return fail(writer.error());
  connections->label_ = writer->label();
  if (auto done = connections->prepare(*writer, use); !done) {
    const bool was_locked = writer->waited_for_lock();
    writer->roll_back();
    if (writer->is_alive()) connections->place_.give_back(*writer);
    return fail(was_locked ? postgresql::locked_by_others(*writer, options.wait) : done.error());
  }
  connections->writer_.add(*std::move(writer));
  for (std::size_t i = 0; i < std::max<std::size_t>(1, options.readers); ++i)
    connections->readers_.add(std::nullopt);
  connections->keeper_ = std::jthread(
      [raw = connections.get()](const std::stop_token& stop) { raw->keep_place(stop); });
  return connections;
}

PostgresqlConnections::~PostgresqlConnections() {
  if (!keeper_.joinable()) return;  // it was never opened
  stop_renewing();
  keeper_.join();
  give_back();
}

void PostgresqlConnections::stop_renewing() {
  is_ending_ = true;
  keeper_.request_stop();
}

void PostgresqlConnections::give_back() {
  stop_renewing();
  if (is_lost_) return;
  // When this fails the place ends by its time.
  static_cast<void>(write([this](sql::Database& database) -> Result<void> {
    place_.give_back(database);
    return {};
  }));
  is_lost_ = true;
}

/// The place comes first: another server's tables are not migrated while it works. An empty
/// database has no place yet, so its tables are made before.
Result<void> PostgresqlConnections::prepare(Database& database, const DatabaseUse& use) {
  auto has_place = postgresql::has_table(database, "store_holder");
  if (has_place && !*has_place) {
    if (!use.makes_tables)
      return fail(Errc::NotFound, "database {} holds no store of Dripline", label_);
    auto made = postgresql::migrate(database, postgresql::schema(), use.begin);
    if (!made) {
      // Another server may have made them at the same moment.
      has_place = postgresql::has_table(database, "store_holder");
      if (!has_place || !*has_place) return made;
    }
  }
  if (!has_place) return fail(has_place.error());
  if (auto taken = place_.take(database); !taken) return taken;
  if (auto fits = check_use(database, use); !fits) return fits;
  if (auto done = postgresql::migrate(database, postgresql::schema()); !done) return done;
  return place_.has_term() ? Result<void>() : place_.raise_term(database);
}

Result<void> PostgresqlConnections::check_use(Database& database, const DatabaseUse& use) const {
  const auto kind = use.kind;
  const auto is_begun = postgresql::has_table(database, "store_migration");
  if (!is_begun) return fail(is_begun.error());
  const auto is_left = postgresql::has_table(database, "store_migrated");
  if (!is_left) return fail(is_left.error());
  if (kind == DatabaseUse::Kind::Enter && !*is_begun) {
    const auto identity = database.text("SELECT id FROM identity");
    if (identity && *identity == use.source && !*is_left) return {};  // it was entered before
    return fail(Errc::Conflict,
                "database {} has tables already: a migration goes into an empty one (createdb "
                "--encoding=UTF8 --template=template0 NAME)",
                label_);
  }
  if (kind != DatabaseUse::Kind::Enter && *is_begun) {
    return fail(Errc::Busy,
                "database {} is the target of a migration that is not complete: run it again (dnc "
                "server migrate); or drop the database, the old one is as it was",
                label_);
  }
  if (kind == DatabaseUse::Kind::Serve && *is_left) {
    const auto to = database.text("SELECT target FROM store_migrated");
    return fail(Errc::Conflict,
                "database {} was migrated to {}: what is stored here now would be missing there. "
                "To use it again all the same: DROP TABLE store_migrated",
                label_, to.value_or("another one"));
  }
  return {};
}

Result<void> PostgresqlConnections::connect(Slot& slot) {
  if (slot && slot->is_alive()) return {};
  const auto deadline = SteadyClock::now() + kReconnect;
  for (;;) {
    auto opened = Database::connect({.url = options_.url, .lock_timeout = options_.wait});
    if (opened) {
      slot = *std::move(opened);
      return {};
    }
    if (SteadyClock::now() >= deadline) return fail(opened.error());
    std::this_thread::sleep_for(kPause);
  }
}

Result<void> PostgresqlConnections::begin_write(Database& database, Durability durability) {
  if (auto begun = database.begin(); !begun) return begun;
  if (durability == Durability::Normal) database.relax_commit();
  const auto ours = place_.is_ours(database);
  if (!ours) return fail(ours.error());
  if (!*ours) lose_place();
  return check_place();
}

Error PostgresqlConnections::lost_error() const {
  return {Errc::Io,
          fmt::format("database {} was taken over by another server: nothing is stored or "
                      "read by this one any more",
                      label_)};
}

/// For good, also when the other one has given it back: what this one has in memory is not what is
/// stored any more.
void PostgresqlConnections::lose_place() {
  if (is_lost_.exchange(true)) return;
  if (options_.on_lost && !is_ending_) options_.on_lost(lost_error());
}

Result<void> PostgresqlConnections::check_place() const {
  if (is_lost_) return fail(lost_error());
  return {};
}

bool PostgresqlConnections::has_place() const {
  return !is_lost_ && SteadyClock::now() < place_until_.load();
}

Result<void> PostgresqlConnections::write_with(const Work& work, Durability durability) {
  if (auto ours = check_place(); !ours) return ours;
  return writer_.with([&](Slot& slot) -> Result<void> {
    const auto deadline = SteadyClock::now() + options_.wait;
    for (;;) {
      if (auto there = connect(slot); !there) return there;
      auto done = begin_write(*slot, durability);
      if (done) done = work(*slot);
      std::optional<SteadyClock::time_point> renewed;
      if (done) done = renew_when_late(*slot, renewed);
      const bool is_at_commit = done.has_value();
      if (done) done = slot->commit();
      if (done && renewed) note_renewed(*renewed);
      if (done) return done;
      const bool is_over = SteadyClock::now() >= deadline;
      if (!slot->is_alive()) {
        if (is_at_commit) {
          return fail(Errc::Timeout, "whether it was stored is not known: {}", done.error().what);
        }
        if (is_over) return done;
        continue;  // nothing of it was stored
      }
      const bool is_in_the_way = slot->was_in_the_way(), was_locked = slot->waited_for_lock();
      slot->roll_back();
      if (was_locked) return fail(postgresql::locked_by_others(*slot, options_.wait));
      if (!is_in_the_way || is_over) return done;
    }
  });
}

Result<void> PostgresqlConnections::read_with(const Work& work) {
  if (auto ours = check_place(); !ours) return ours;
  return readers_.with([&](Slot& slot) -> Result<void> {
    const auto deadline = SteadyClock::now() + options_.wait;
    for (;;) {
      if (auto there = connect(slot); !there) return there;
      slot->begin_snapshot();
      auto done = work(*slot);
      if (slot->is_alive()) slot->end_snapshot();
      const bool is_repeated = !done && (!slot->is_alive() || slot->was_in_the_way());
      if (!is_repeated || SteadyClock::now() >= deadline) return done;
    }
  });
}

void PostgresqlConnections::note_renewed(SteadyClock::time_point when) {
  renewed_ = when;
  place_until_ = when + options_.lease;
}

/// With whatever is written, where the keeper's connection is lost or slow.
Result<void> PostgresqlConnections::renew_when_late(
    Database& database, std::optional<SteadyClock::time_point>& renewed) {
  const auto now = SteadyClock::now();
  if (now - renewed_.load() < options_.lease / kLateRenewals) return {};
  const auto ours = place_.renew(database);
  if (!ours) return fail(ours.error());
  renewed = now;
  return {};
}

Result<void> PostgresqlConnections::renew() {
  SteadyClock::time_point begun;
  auto done = write([&](sql::Database& database) -> Result<void> {
    begun = SteadyClock::now();
    const auto ours = place_.renew(database);
    return ours ? Result<void>() : fail(ours.error());
  });
  if (done) note_renewed(begun);
  return done;
}

Result<void> PostgresqlConnections::publish(const ServerFacts& facts) {
  return write([&](sql::Database& database) { return place_.publish(database, facts); });
}

/// Waits for no writer, and shares no connection with what is stored: neither a transaction that
/// takes long, nor a queue of writers, nor text on a slow line costs the place.
void PostgresqlConnections::keep(Slot& slot) {
  if (!check_place() || !connect(slot)) return;
  const auto begun = SteadyClock::now();
  const auto ours = place_.renew(*slot);
  if (!ours) return;  // shows in whatever is stored next
  if (*ours) {
    note_renewed(begun);
  } else {
    lose_place();
  }
}

void PostgresqlConnections::keep_place(const std::stop_token& stop) {
  Slot own;
  std::mutex mutex;
  std::condition_variable_any stopped;
  std::unique_lock lock(mutex);
  while (!stop.stop_requested()) {
    stopped.wait_for(lock, stop, options_.lease / kRenewals, [] { return false; });
    if (!stop.stop_requested()) keep(own);
  }
}

}  // namespace dripline::storage
