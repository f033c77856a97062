#include "storage/postgresql_standby.hpp"

#include <optional>
#include <span>
#include <utility>

#include "protocol/base/digest.hpp"
#include "storage/impl/waiting_rows.hpp"
#include "storage/postgresql/database.hpp"
#include "storage/postgresql/lock_holders.hpp"
#include "storage/postgresql/migration.hpp"
#include "storage/postgresql/url.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kNoteEvery{1000};

}  // namespace

struct PostgresqlStandby::Connection {
  postgresql::Database database;
  SteadyClock::time_point since;
  std::optional<SteadyClock::time_point> noted{};
  std::optional<SteadyClock::time_point> locked_since{};  ///< the place, which is lapsed
  std::optional<SteadyClock::time_point> named{};         ///< who has locked it
  std::string obstacle{};
  postgresql::FrozenWriters frozen;
  bool has_tables = false;
  bool has_place = false;     ///< its schema has terms, and servers that wait
  bool has_settings = false;  ///< its schema has settings of the holder
  bool has_gateways = false;  ///< its schema has the gateways that servers hear
  std::optional<std::int64_t> noted_gateways{};
};

PostgresqlStandby::PostgresqlStandby(Options options)
    : options_(std::move(options)), watch_(options_.lease) {}

PostgresqlStandby::~PostgresqlStandby() {
  if (connection_ && connection_->has_place && connection_->database.is_alive())
    static_cast<void>(drop_waiting(connection_->database, options_.holder));
}

Result<void> PostgresqlStandby::connect() {
  if (connection_ && connection_->database.is_alive()) return {};
  connection_.reset();
  const auto facts = postgresql::read_url(options_.url);
  if (!facts) return fail(facts.error());
  if (auto ours = postgresql::check_name(facts->database); !ours) return ours;
  auto database = postgresql::Database::connect({.url = options_.url});
  if (!database) return fail(database.error());
  connection_.reset(new Connection{.database = *std::move(database),
                                   .since = SteadyClock::now(),
                                   .frozen = postgresql::FrozenWriters(options_.lease)});
  watch_.restart();
  return {};
}

/// Until its schema is of a server that knows what this one does: it may be migrated meanwhile.
Result<void> PostgresqlStandby::read_schema() {
  auto& database = connection_->database;
  if (connection_->has_gateways) return {};
  const auto has_tables = postgresql::has_table(database, "store_holder");
  if (!has_tables) return fail(has_tables.error());
  connection_->has_tables = *has_tables;
  if (!*has_tables) return {};
  const auto version = database.integer("SELECT version FROM schema_version");
  if (!version) return fail(version.error());
  const auto newest = static_cast<std::int64_t>(postgresql::schema().size());
  if (*version > newest) {
    return fail(Errc::Unsupported,
                "database {} has schema version {}, this program knows versions up to {}: use a "
                "newer program",
                database.label(), *version, newest);
  }
  const auto has_terms = postgresql::has_column(database, "store_holder", "signing_key");
  if (!has_terms) return fail(has_terms.error());
  const auto has_settings = postgresql::has_column(database, "store_holder", "settings");
  if (!has_settings) return fail(has_settings.error());
  const auto has_gateways = postgresql::has_column(database, "store_standby", "gateways");
  if (!has_gateways) return fail(has_gateways.error());
  connection_->has_place = *has_terms;
  connection_->has_gateways = *has_gateways;
  connection_->has_settings = *has_settings;
  return {};
}

Result<PostgresqlStandby::View> PostgresqlStandby::read() {
  auto& database = connection_->database;
  if (auto read = read_schema(); !read) return fail(read.error());
  View view;
  if (!connection_->has_tables) {
    view.is_free = true;
    view.has_tables = false;
    return view;
  }
  LeaseWatch::Look look;
  const std::string facts =
      connection_->has_place ? "url, signing_key, term" : "'', '', CAST(0 AS bigint)";
  const std::string settings = connection_->has_settings ? "settings" : "''";
  const std::string helped = connection_->has_gateways ? "has_helped" : "1";
  look.asked = SteadyClock::now();
  const auto row = sql::first_row(
      database,
      fmt::format("SELECT holder, CAST(extract(epoch FROM until) * 1000000 AS bigint), described, "
                  "{}, {}, {}, {} FROM store_holder WHERE id = 1",
                  facts, settings, postgresql::kClockMicroseconds, helped),
      [&](const sql::Statement& found) {
        view.described = found.text(2);
        view.url = found.text(3);
        view.signing_key = found.text(4);
        view.term = static_cast<std::uint64_t>(found.integer(5));
        view.settings = found.text(6);
        view.time = UtcTime(std::chrono::microseconds(found.integer(7)));
        view.is_for_hearers = found.integer(8) == 0 && found.text(0).empty();
        view.lease = {found.text(0), view.term, found.integer(1)};
        return true;
      });
  look.answered = SteadyClock::now();
  if (!row) return fail(row.error());
  if (!*row) {
    return fail(Errc::Corrupt,
                "database {} has lost the row of its place (table store_holder): no server can "
                "have it until there is one again (deploy/docs/operations.md)",
                database.label());
  }
  look.row = view.lease;
  look.left = std::chrono::duration_cast<std::chrono::milliseconds>(
      std::chrono::microseconds(view.lease.until) - view.time.time_since_epoch());
  const bool is_over = watch_.is_over(look);
  const bool is_settled = look.asked - connection_->since >= kSettle;
  view.is_own = view.lease.holder == options_.holder;
  view.is_lapsed = is_over && !view.is_own && !view.lease.holder.empty();
  view.is_free = view.is_own || view.lease.holder.empty() || (view.is_lapsed && is_settled);
  if (auto looked = look_at_lock(view); !looked) return fail(looked.error());
  auto identity = database.text("SELECT id FROM identity");
  if (!identity) return fail(identity.error());
  view.identity = *std::move(identity);
  if (!connection_->has_place) return view;
  const auto others = has_other_waiting(database, options_.holder);
  if (!others) return fail(others.error());
  view.has_others = *others;
  if (auto noted = note(); !noted) return fail(noted.error());
  return view;
}

/// A taking would wait for the row too, and be late where the other server has renewed its lease.
Result<void> PostgresqlStandby::look_at_lock(View& view) {
  auto& database = connection_->database;
  auto& locked_since = connection_->locked_since;
  auto& named = connection_->named;
  const auto is_unlocked = [&]() -> Result<bool> {
    if (!view.is_free || !view.is_lapsed) return true;
    const auto row =
        sql::first_row(database, "SELECT id FROM store_holder WHERE id = 1 FOR UPDATE SKIP LOCKED",
                       [](const sql::Statement&) { return true; });
    if (!row) return fail(row.error());
    return row->has_value();
  }();
  if (!is_unlocked) return fail(is_unlocked.error());
  if (*is_unlocked) {
    locked_since.reset();
    named.reset();
    return {};
  }
  view.is_free = false;
  const auto now = SteadyClock::now();
  if (!locked_since) locked_since = now;
  const auto locked = std::chrono::floor<std::chrono::seconds>(now - *locked_since);
  if (locked >= options_.lease && (!named || now - *named >= kNoteEvery)) {
    connection_->obstacle = postgresql::locked_by_others(database, locked).what;
    named = now;
  }
  if (named) view.obstacle = connection_->obstacle;
  return connection_->frozen.end(database);
}

/// That this server waits, each second; or that it does not, once.
Result<void> PostgresqlStandby::note() {
  auto& noted = connection_->noted;
  if (!is_able_) {
    if (!noted) return {};
    noted.reset();
    return drop_waiting(connection_->database, options_.holder);
  }
  const auto now = SteadyClock::now();
  const auto gateways = connection_->has_gateways ? gateways_ : std::nullopt;
  const bool is_news = gateways != connection_->noted_gateways;
  if (noted && now - *noted < kNoteEvery && !is_news) return {};
  auto done =
      note_waiting(connection_->database,
                   {.holder = options_.holder,
                    .described = note_.empty() ? options_.described
                                               : fmt::format("{} ({})", options_.described, note_),
                    .gateways = gateways,
                    .has_gateways = connection_->has_gateways});
  if (!done) return done;
  noted = now;
  connection_->noted_gateways = gateways;
  return {};
}

Result<bool> PostgresqlStandby::has_other_token(const std::string& user, const std::string& name,
                                                const std::string& secret) {
  if (auto there = connect(); !there) return fail(there.error());
  const Digest digest = sha256(secret);
  const auto other = sql::first_row(
      connection_->database,
      "SELECT count(*) FROM credential WHERE \"user\" = ?1 AND name = ?2 AND sha256 <> ?3",
      [](const sql::Statement& row) { return row.integer(0) > 0; }, user, name,
      std::span<const std::byte>(digest.bytes));
  if (!other) return fail(other.error());
  return other->value_or(false);
}

Result<PostgresqlStandby::View> PostgresqlStandby::look() {
  if (auto there = connect(); !there) return fail(there.error());
  auto view = read();
  if (!view) connection_.reset();
  return view;
}

}  // namespace dripline::storage
