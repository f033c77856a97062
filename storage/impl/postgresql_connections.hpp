#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "storage/impl/connection_pool.hpp"
#include "storage/impl/connections.hpp"
#include "storage/impl/postgresql_place.hpp"
#include "storage/postgresql/database.hpp"
#include "storage/postgresql_store.hpp"

namespace dripline::storage {

/// What a database is opened for. A migration (storage/migration) leaves one for a file or enters
/// one from it; no server uses a database that is being entered or was left.
struct DatabaseUse {
  enum class Kind : std::uint8_t { Serve, Leave, Enter };
  Kind kind = Kind::Serve;
  std::string begin{};       ///< of Enter: SQL in the transaction that makes the tables
  std::string source{};      ///< of Enter: the identity of the database that is moved
  bool makes_tables = true;  ///< false: a database without ours stays as it is
};

/// One connection that writes, some that read and one that keeps the place; a lost one is opened
/// again by anyone who needs it. The database has one holder, by a lease with a term
/// (postgresql_place.hpp): a server that lost its place stores nothing any more, and once it knows
/// that it reads nothing either: what it would do is another one's now. Thread-safe.
class PostgresqlConnections final : public Connections {
 public:
  /// Takes the holder's place, and creates or migrates the schema. Errors: see
  /// PostgresqlStore::open; NotFound (it has no tables of ours, and none are to be made).
  static Result<std::unique_ptr<PostgresqlConnections>> open(const PostgresqlStoreOptions& options,
                                                             const DatabaseUse& use = {});
  /// Gives the place back.
  ~PostgresqlConnections() override;

  const std::string& label() const { return label_; }
  Result<void> check_place() const override;
  /// Extends the place, in a transaction that is on disk when it returns.
  Result<void> renew();
  std::uint64_t term() const { return place_.term(); }
  /// Whether no other server can have the place now: by this computer's clock, which runs on while
  /// the process is frozen, but not while a virtual machine is.
  bool has_place() const;
  /// OpenedStore's. From then on `on_lost` is not called: the server ends.
  void stop_renewing();
  void give_back();
  /// Of this server, for those that wait.
  Result<void> publish(const ServerFacts& facts);

 private:
  using Database = postgresql::Database;
  using Slot = std::optional<Database>;  ///< nullopt: to be opened

  explicit PostgresqlConnections(const PostgresqlStoreOptions& options);
  Result<void> write_with(const Work& work, Durability durability) override;
  Result<void> read_with(const Work& work) override;
  Result<void> prepare(Database& database, const DatabaseUse& use);
  Result<void> check_use(Database& database, const DatabaseUse& use) const;
  void lose_place();
  void note_renewed(std::chrono::steady_clock::time_point when);
  Result<void> renew_when_late(Database& database,
                               std::optional<std::chrono::steady_clock::time_point>& renewed);
  void keep(Slot& slot);
  Result<void> begin_write(Database& database, Durability durability);
  /// Opens it when it is not. Errors: Io, after trying for a moment.
  Result<void> connect(Slot& slot);
  void keep_place(const std::stop_token& stop);
  Error lost_error() const;

  const PostgresqlStoreOptions options_;
  std::string label_;
  PostgresqlPlace place_;
  std::atomic<bool> is_lost_ = false;                                 ///< the place; for good
  std::atomic<std::chrono::steady_clock::time_point> renewed_{};      ///< was begun to be, and was
  std::atomic<bool> is_ending_ = false;                               ///< of the server
  std::atomic<std::chrono::steady_clock::time_point> place_until_{};  ///< at least
  ConnectionPool<Slot> writer_;
  ConnectionPool<Slot> readers_;
  std::jthread keeper_;  // last: it uses the others
};

}  // namespace dripline::storage
