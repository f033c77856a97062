#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"
#include "storage/lease_watch.hpp"

namespace dripline::storage {

/// The view of a server that waits for a database's place (impl/postgresql_place.hpp). It takes
/// nothing, and writes one row: that it waits. One thread.
class PostgresqlStandby {
 public:
  struct Options {
    std::string url;                        ///< postgresql://...
    std::string holder;                     ///< as of PostgresqlStoreOptions
    std::string described;                  ///< likewise
    std::chrono::milliseconds lease{3000};  ///< likewise
  };
  explicit PostgresqlStandby(Options options);
  PostgresqlStandby(const PostgresqlStandby&) = delete;
  PostgresqlStandby& operator=(const PostgresqlStandby&) = delete;
  /// Waits no more.
  ~PostgresqlStandby();

  struct View {
    bool is_free = false;     ///< given back, this server's own of before, or its lease is over
    bool has_tables = true;   ///< false: no server has used the database yet
    bool is_lapsed = false;   ///< its holder has not given it back, and its lease is over
    bool is_own = false;      ///< of this server itself, which was killed
    std::string described;    ///< of the holder
    std::string url;          ///< of the holder; empty: not known
    std::string signing_key;  ///< of the last holder; empty: not known
    std::string settings;     ///< likewise (ServerFacts); empty: an older version
    std::uint64_t term = 0;   ///< of the last holder
    bool has_others = false;  ///< other servers wait too
    /// It was given back by a server that heard no gateway: for one that does.
    bool is_for_hearers = false;
    LeaseRow lease;        ///< for PostgresqlStoreOptions::ended, where it is lapsed
    std::string obstacle;  ///< of a lapsed place: who has locked it, for a lease or more
    std::string identity;  ///< of the database; empty: it has none
    UtcTime time{};        ///< by the database's clock; only where it has tables
  };
  /// Connects when it is not connected. A lease is over by the own steady clock (LeaseWatch), so
  /// only when it was looked at again and again for its whole time, and after `kSettle` of a
  /// connection: after an outage of the database its holder comes first. Nor is the place free
  /// while a transaction that writes has its row locked: its server may be alive, on a line that is
  /// slow. One that was frozen in it is disconnected (postgresql/lock_holders.hpp). Errors: Io,
  /// Denied, Unsupported (a newer version's tables).
  Result<View> look();
  /// Whether it could take over: one that cannot is not among the servers that wait, so that
  /// nothing is handed over to it. From the next look on.
  void set_able(bool is_able) { is_able_ = is_able; }

  /// For people who look at the active server: what this one would lack. From the next look on.
  void set_note(std::string note) { note_ = std::move(note); }

  /// Whether a token of this user and name is kept in the database, and is not this secret. Errors:
  /// Io.
  Result<bool> has_other_token(const std::string& user, const std::string& name,
                               const std::string& secret);

  static constexpr std::chrono::milliseconds kSettle{3000};
  /// The gateways that this server hears; nullopt: it does not listen. From the next look on.
  void set_gateways(std::optional<std::int64_t> gateways) { gateways_ = gateways; }

 private:
  struct Connection;
  Result<void> connect();
  Result<void> read_schema();
  Result<View> read();
  Result<void> note();
  Result<void> look_at_lock(View& view);

  const Options options_;
  bool is_able_ = true;
  std::string note_;
  std::optional<std::int64_t> gateways_;
  LeaseWatch watch_;
  std::unique_ptr<Connection> connection_;  ///< null: not connected
};

}  // namespace dripline::storage
