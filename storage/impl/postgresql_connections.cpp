#include "storage/impl/postgresql_connections.hpp"

#include <condition_variable>
#include <mutex>

#include "protocol/base/random.hpp"
#include "storage/postgresql/migration.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

using SteadyClock = std::chrono::steady_clock;

/// Of the holder's place without being renewed; the database's clock counts it.
constexpr std::chrono::seconds kPlace{10};
constexpr std::chrono::seconds kRenew{3};
/// A database that is not there keeps no caller longer; one that was just lost may be back at once.
constexpr std::chrono::milliseconds kReconnect{2000}, kPause{100};

}  // namespace

PostgresqlConnections::PostgresqlConnections(const PostgresqlStoreOptions& options)
    : options_(options),
      holder_(options.holder.empty() ? random_hex(16) : options.holder),
      writer_(options.wait),
      readers_(options.wait) {}

Result<std::unique_ptr<PostgresqlConnections>> PostgresqlConnections::open(
    const PostgresqlStoreOptions& options) {
  std::unique_ptr<PostgresqlConnections> connections(new PostgresqlConnections(options));
  auto writer = Database::connect({.url = options.url, .lock_timeout = options.wait});
  if (!writer) return fail(writer.error());
  connections->label_ = writer->label();
  if (auto done = postgresql::migrate(*writer, postgresql::schema()); !done)
    return fail(done.error());
  if (auto taken = connections->take_place(*writer); !taken) return fail(taken.error());
  connections->writer_.add(*std::move(writer));
  for (std::size_t i = 0; i < std::max<std::size_t>(1, options.readers); ++i)
    connections->readers_.add(std::nullopt);
  connections->keeper_ = std::jthread(
      [raw = connections.get()](const std::stop_token& stop) { raw->keep_place(stop); });
  return connections;
}

PostgresqlConnections::~PostgresqlConnections() {
  if (!keeper_.joinable()) return;  // it was never opened
  keeper_.request_stop();
  keeper_.join();
  // When this fails the place ends by its time.
  static_cast<void>(write([this](sql::Database& database) {
    return sql::run(
        database, "UPDATE store_holder SET holder = '', until = now() WHERE holder = ?1", holder_);
  }));
}

/// True: it is ours now. False: `other` has it.
Result<bool> PostgresqlConnections::try_place(Database& database, std::string& other) {
  if (auto begun = database.begin(); !begun) return fail(begun.error());
  const auto free = sql::first_row(
      database,
      "SELECT holder = '' OR holder = ?1 OR until <= now(), described FROM store_holder "
      "WHERE id = 1 FOR UPDATE",
      [&](const sql::Statement& row) {
        other = row.text(1);
        return row.integer(0) != 0;
      },
      holder_);
  if (!free) return fail(free.error());
  if (!free->value_or(false)) {
    database.roll_back();
    return false;
  }
  const auto taken = sql::run(
      database,
      "UPDATE store_holder SET holder = ?1, described = ?2, until = now() + ?3 * interval '1 "
      "second' WHERE id = 1",
      holder_, options_.described, kPlace.count());
  if (!taken) return fail(taken.error());
  if (auto done = database.commit(); !done) return fail(done.error());
  return true;
}

Result<void> PostgresqlConnections::take_place(Database& database) {
  const auto deadline = SteadyClock::now() + options_.wait_for_holder;
  std::string other;
  for (;;) {
    const auto taken = try_place(database, other);
    if (!taken) {
      database.roll_back();
      return fail(taken.error());
    }
    if (*taken) return {};
    if (SteadyClock::now() >= deadline) {
      return fail(Errc::Busy,
                  "database {} is used by another server ({}): end that one; a server that was "
                  "killed loses its place after {} s",
                  label_, other.empty() ? "not named" : other, kPlace.count());
    }
    std::this_thread::sleep_for(kPause);
  }
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
  const auto holder =
      sql::first_row(database, "SELECT holder FROM store_holder WHERE id = 1 FOR UPDATE",
                     [](const sql::Statement& row) { return row.text(0); });
  if (!holder) return fail(holder.error());
  if (!*holder || **holder != holder_) is_lost_ = true;
  return check_place();
}

Result<void> PostgresqlConnections::check_place() const {
  if (!is_lost_) return {};
  return fail(Errc::Io,
              "database {} was taken over by another server: nothing is stored or read by this one "
              "any more; end it",
              label_);
}

Result<void> PostgresqlConnections::write_with(const Work& work, Durability durability) {
  if (auto ours = check_place(); !ours) return ours;
  return writer_.with([&](Slot& slot) -> Result<void> {
    const auto deadline = SteadyClock::now() + options_.wait;
    for (;;) {
      if (auto there = connect(slot); !there) return there;
      auto done = begin_write(*slot, durability);
      if (done) done = work(*slot);
      const bool is_at_commit = done.has_value();
      if (done) done = slot->commit();
      if (done) return done;
      const bool is_over = SteadyClock::now() >= deadline;
      if (!slot->is_alive()) {
        if (is_at_commit) {
          return fail(Errc::Timeout, "whether it was stored is not known: {}", done.error().what);
        }
        if (is_over) return done;
        continue;  // nothing of it was stored
      }
      const bool is_in_the_way = slot->was_in_the_way();
      slot->roll_back();
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

Result<void> PostgresqlConnections::renew() {
  return write([this](sql::Database& database) {
    return sql::run(database,
                    "UPDATE store_holder SET until = now() + ?2 * interval '1 second' "
                    "WHERE holder = ?1",
                    holder_, kPlace.count());
  });
}

void PostgresqlConnections::keep_place(const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any stopped;
  std::unique_lock lock(mutex);
  while (!stop.stop_requested()) {
    stopped.wait_for(lock, stop, kRenew, [] { return false; });
    // A failure shows in whatever is stored next.
    if (!stop.stop_requested()) static_cast<void>(renew());
  }
}

}  // namespace dripline::storage
