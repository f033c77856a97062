#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "storage/sql/database.hpp"

namespace dripline::storage::postgresql {

class Link;

/// An expression of SQL: now by the database's clock, in microseconds since 1970.
inline constexpr const char* kClockMicroseconds =
    "CAST(extract(epoch FROM clock_timestamp()) * 1000000 AS bigint)";

struct ConnectOptions {
  std::string url;  ///< postgresql://... or libpq's "host=... dbname=..."
  std::chrono::seconds connect_timeout{5};
  std::chrono::milliseconds lock_timeout{10000};  ///< for a lock that another has, then Errc::Busy
  /// A server that says nothing for so long and answers no other connection either is given up: Io.
  std::chrono::milliseconds silence{10000};
};

/// One connection to one server. Statements are prepared once, parameters and rows cross the wire
/// in binary form. Errors as sql::Database; the text holds PostgreSQL's code (SQLSTATE).
class Database final : public sql::Database {
 public:
  /// Errors: Io (not reachable), Denied, Unsupported (older than 15, or not UTF-8).
  static Result<Database> connect(const ConnectOptions& options);
  Database(Database&&) noexcept;
  Database& operator=(Database&&) noexcept;
  ~Database() override;

  sql::Engine engine() const override { return sql::Engine::Postgresql; }
  Result<void> execute(const std::string& sql) override;
  Result<sql::Statement> prepare(const std::string& sql) override;
  std::uint64_t changes() const override;

  /// The same picture of the database for several reads, until `end_snapshot`. Both cost no round
  /// trip of their own.
  void begin_snapshot();
  void end_snapshot();
  Result<void> begin();
  /// The next commit may be lost in a power cut of the database's server. Inside a transaction.
  void relax_commit();
  /// On an error nothing was changed, unless the connection is not alive any more: then no one
  /// knows.
  Result<void> commit();
  void roll_back();

  /// False: the connection was lost, and everything but its end is in vain.
  bool is_alive() const;
  /// The transaction was undone because of a conflict with another (40001, 40P01): it may be begun
  /// again.
  bool was_in_the_way() const;
  /// The last error: a lock of another session did not come free in time (55P03).
  bool waited_for_lock() const;

  /// "postgresql://host:5432/name": without user and password.
  const std::string& label() const { return label_; }

 private:
  Database(std::unique_ptr<Link> link, std::string label);
  std::unique_ptr<Link> link_;
  std::string label_;
  bool is_begun_ = false;  ///< a transaction that must be ended
};

}  // namespace dripline::storage::postgresql
