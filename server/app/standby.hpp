#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/base/clock.hpp"
#include "protocol/base/descriptor.hpp"
#include "server/api/http_server.hpp"
#include "server/app/settings.hpp"
#include "server/app/standby_faults.hpp"
#include "server/app/state_folder.hpp"
#include "storage/postgresql_standby.hpp"

namespace dripline::app {

/// A server that waits for another one's database: everything that needs no place is checked as at
/// a start, health and readiness are answered, and whether the place is free is looked at some
/// times a second. No serial port, hot folder, webhook or broker is touched, and gateways are only
/// listened to: how many it hears is what the active server sees of it. One thread, but for the
/// answers.
class Standby {
 public:
  struct Options {
    /// The term of the place that this process has handed over; another server is to have it next.
    /// 0: it has not.
    std::uint64_t handed_over = 0;
    /// How often this process has tried to take over in vain, one time soon after the other, and
    /// why. The next try has a pause before it.
    int late = 0;
    std::string late_because = {};
  };
  /// Errors: those of Server::start that its settings, folder, certificates and the connection can
  /// give; Conflict (this folder has not the key or the token of the server that has the database),
  /// Unsupported (there is no database that servers share).
  static Result<std::unique_ptr<Standby>> open(const Settings& settings, const Clock& clock,
                                               const Options& options);
  /// Answers until it is gone: one line for each try, and the folder's dncd.json names it.
  ~Standby();
  Standby(const Standby&) = delete;
  Standby& operator=(const Standby&) = delete;

  /// True: the place is free, try to take it. A database that cannot be reached is logged once, and
  /// waited for, and so is a UDP port in use: the place is never taken without gateways. Without
  /// its MTConnect agent it is. Errors: Unsupported (a newer version's tables), Corrupt (another
  /// database).
  Result<bool> look();
  /// At the start of the process: a port that another server on this computer has stays its own, so
  /// this one could take over only when that one has ended, and not when it hangs. Errors: Busy.
  Result<void> check_ports() const;
  /// Listens at the address of the settings. Errors: Io, Denied.
  Result<void> listen();
  /// HOST:PORT where it listens, which the server takes over.
  const std::string& address() const { return address_; }
  const std::string& url() const { return url_; }
  /// One line, for people: who has the database.
  std::string status() const;
  /// After `look` was true: the place of a server whose lease is over; nullopt: it was given back.
  std::optional<storage::LeaseRow> ended() const;
  /// For people, likewise: from whom it is taken over, and why.
  std::string takeover() const;

  static constexpr std::chrono::milliseconds kLookEvery{150};

 private:
  struct Parts;
  explicit Standby(std::unique_ptr<Parts> parts);
  Result<void> check(const storage::PostgresqlStandby::View& view) const;
  Result<void> check_token(const std::string& token) const;
  bool is_for_others(const storage::PostgresqlStandby::View& view) const;
  bool is_for_hearers(const storage::PostgresqlStandby::View& view);
  bool is_pausing() const;
  void look_at_place(const storage::PostgresqlStandby::View& view);
  bool has_ports(bool is_due);
  void look_at_agent();
  void look_at_settings(const storage::PostgresqlStandby::View& view);
  void look_at_clock(UtcTime before, const storage::PostgresqlStandby::View& view);
  void look_at_disk();
  void set_fault(std::string StandbyFaults::*which, std::string now, const char* cleared);
  api::Response answer(const api::Request& request) const;

  std::unique_ptr<Parts> parts_;
  std::string address_, url_;
  mutable std::mutex mutex_;
  storage::PostgresqlStandby::View view_;  ///< the last
  StandbyFaults faults_;
  SteadyTime ports_seen_{};
  std::optional<SteadyTime> hearers_since_;  ///< the place is free for a server that hears gateways
  std::unique_ptr<api::HttpServer> http_;    // last: its threads use the others
};

}  // namespace dripline::app
