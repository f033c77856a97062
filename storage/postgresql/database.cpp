#include "storage/postgresql/database.hpp"

#include <libpq-fe.h>
#include <array>

#include "storage/postgresql/cursor.hpp"
#include "storage/postgresql/errors.hpp"
#include "storage/postgresql/link.hpp"
#include "storage/postgresql/url.hpp"

namespace dripline::storage::postgresql {
namespace {

constexpr int kOldestVersion = 150000;

std::string text_of(const char* text) {
  return text == nullptr ? "" : text;
}

std::string label_of(PGconn* connection) {
  const std::string host = text_of(PQhost(connection)), port = text_of(PQport(connection));
  const std::string name = text_of(PQdb(connection));
  if (host.starts_with('/'))  // a socket of this computer
    return fmt::format("postgresql:///{}?host={}&port={}", name, host, port);
  return fmt::format("postgresql://{}:{}/{}", host.empty() ? "localhost" : host, port, name);
}

/// For PQconnectdbParams and its like. What is before the URL may be set in it.
class Parts {
 public:
  explicit Parts(const ConnectOptions& options)
      : url_(options.url), timeout_(std::to_string(options.connect_timeout.count())) {}
  const char* const* keys() const { return kKeys.data(); }
  std::array<const char*, 7> values() const {
    return {timeout_.c_str(), "dncd", "UTF8", "10000", "read-write", url_.c_str(), nullptr};
  }

 private:
  static constexpr std::array<const char*, 7> kKeys{"connect_timeout",
                                                    "application_name",
                                                    "client_encoding",
                                                    "tcp_user_timeout",
                                                    "target_session_attrs",
                                                    "dbname",
                                                    nullptr};
  std::string url_, timeout_;
};

/// Of the server that a connection has, where its URL names several.
struct Place {
  std::string host, address, port;
};

Place place_of(PGconn* connection) {
  return {text_of(PQhost(connection)), text_of(PQhostaddr(connection)),
          text_of(PQport(connection))};
}

/// Whether the server there answers a new connection. What comes after the URL replaces what is in
/// it: another host of the URL must not answer for this one.
bool is_answering(const ConnectOptions& options, const Place& place) {
  const std::string timeout = std::to_string(options.connect_timeout.count());
  constexpr std::array<const char*, 6> kKeys{"connect_timeout", "dbname", "host",
                                             "hostaddr",        "port",   nullptr};
  const std::array<const char*, 6> values{timeout.c_str(),    options.url.c_str(),
                                          place.host.c_str(), place.address.c_str(),
                                          place.port.c_str(), nullptr};
  return PQpingParams(kKeys.data(), values.data(), 1) == PQPING_OK;
}

/// libpq's words may have the whole URL in them only when it cannot be read, and then it is not
/// repeated: it may hold a password.
Error refused(PGconn* connection) {
  std::string words = text_of(PQerrorMessage(connection));
  std::erase(words, '\n');
  return {Errc::Io, fmt::format("database {}: {}", label_of(connection), words)};
}

}  // namespace

Result<Database> Database::connect(const ConnectOptions& options) {
  if (const auto facts = read_url(options.url); !facts) return fail(facts.error());
  const Parts parts(options);
  PGconn* connection = PQconnectdbParams(parts.keys(), parts.values().data(), 1);
  if (connection == nullptr) return fail(Errc::Io, "no memory for a connection");
  auto link = std::make_unique<Link>(
      connection, Link::Patience{.silence = options.silence,
                                 .is_answering = [options, place = place_of(connection)] {
                                   return is_answering(options, place);
                                 }});
  if (PQstatus(connection) != CONNECTION_OK) return fail(refused(connection));
  PQsetNoticeProcessor(
      connection, [](void*, const char*) {}, nullptr);
  Database database(std::move(link), label_of(connection));
  if (PQserverVersion(connection) < kOldestVersion) {
    return fail(Errc::Unsupported, "database {}: PostgreSQL {}, but 15 is the oldest that is known",
                database.label_, PQserverVersion(connection) / 10000);
  }
  const std::string encoding = text_of(PQparameterStatus(connection, "server_encoding"));
  if (encoding != "UTF8") {
    return fail(Errc::Unsupported, "database {}: its encoding is {}, and must be UTF8",
                database.label_, encoding);
  }
  // Plans of short statements gain nothing from JIT. A server that was frozen with a transaction
  // open must not keep the others waiting for ever.
  auto set = database.execute(
      fmt::format("SET jit = off; SET lock_timeout = {}; "
                  "SET idle_in_transaction_session_timeout = 60000; SET TimeZone = 'UTC'",
                  options.lock_timeout.count()));
  if (!set) return fail(set.error());
  return database;
}

Database::Database(std::unique_ptr<Link> link, std::string label)
    : link_(std::move(link)), label_(std::move(label)) {}
Database::Database(Database&&) noexcept = default;
Database& Database::operator=(Database&&) noexcept = default;
Database::~Database() = default;

Result<void> Database::execute(const std::string& sql) {
  if (auto done = link_->execute(sql); !done) return fail(done.error());
  return {};
}

Result<sql::Statement> Database::prepare(const std::string& sql) {
  return sql::Statement(std::make_unique<LinkCursor>(*link_, sql));
}

std::uint64_t Database::changes() const {
  return link_->changes();
}

void Database::begin_snapshot() {
  link_->clear_state();
  link_->send("BEGIN ISOLATION LEVEL REPEATABLE READ, READ ONLY");
}

void Database::end_snapshot() {
  link_->send("COMMIT");
  link_->leave();
}

Result<void> Database::begin() {
  link_->clear_state();
  link_->send("BEGIN ISOLATION LEVEL READ COMMITTED");
  is_begun_ = true;
  return {};
}

void Database::relax_commit() {
  link_->send("SET LOCAL synchronous_commit = off");
}

Result<void> Database::commit() {
  link_->send("COMMIT");
  const auto done = link_->answer();
  if (!done) return fail(done.error());
  is_begun_ = false;
  // PostgreSQL answers so to the COMMIT of a transaction that had failed before.
  if (std::string_view(PQcmdStatus(done->get())) == "COMMIT") return {};
  return fail(Errc::Io, "database {}: the transaction had failed and was undone", label_);
}

void Database::roll_back() {
  if (!is_begun_) return;
  is_begun_ = false;
  if (!link_->is_alive()) return;
  // What was posted and is not answered yet is answered first; of an error there is nothing to do.
  if (!link_->execute("ROLLBACK") && link_->is_alive())
    static_cast<void>(link_->execute("ROLLBACK"));
}

bool Database::is_alive() const {
  return link_->is_alive();
}

bool Database::was_in_the_way() const {
  return asks_to_repeat(link_->last_state());
}

bool Database::waited_for_lock() const {
  return link_->last_state() == "55P03";
}

}  // namespace dripline::storage::postgresql
