#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "server/library/audit_trail.hpp"
#include "server/library/health.hpp"
#include "storage/backup/backup_folder.hpp"

namespace dripline::library {

/// Backups of the server's state folder while it works: at an interval and on request, one
/// at a time, on a thread of its own. Old ones are removed, and the newest is read again now and
/// then. What is wrong with them is a finding of the server's health. Any thread.
class Backups {
 public:
  struct Options {
    std::chrono::hours every{24};  ///< 0: only on request
    backup::Retention retention = {};
    std::chrono::hours verify_every{24 * 7};
    std::chrono::milliseconds look_every{10'000};  ///< whether something is due
  };
  struct Parts {
    backup::BackupFolder folder;
    backup::Source source;
    AuditTrail& audit;
    Health& health;
    const Clock& clock;
  };

  enum class Kind { Make, Verify };
  struct Work {
    Kind kind = Kind::Make;
    std::string id;  ///< of what is verified
    backup::Phase phase = backup::Phase::Copying;
    std::uint64_t done = 0, total = 0;  ///< bytes of this phase
  };
  struct Outcome {
    Kind kind = Kind::Make;
    std::string id;  ///< empty: no backup was made
    UtcTime at;
    std::string error;  ///< empty: good
  };
  struct State {
    std::string folder;
    std::chrono::hours every{0};
    backup::BackupFolder::List list;
    std::optional<Work> work;     ///< in progress
    std::optional<Outcome> last;  ///< since the server was started
    bool is_overdue = false;      ///< the newest is older than it should be
  };

  Backups(Parts parts, const Options& options);
  /// Ends what is in progress; a backup that is not complete does not count.
  ~Backups();
  Backups(const Backups&) = delete;
  Backups& operator=(const Backups&) = delete;

  State state() const;

  /// These return at once; state() reports the progress. Errors: Busy (another is in progress),
  /// NotFound.
  Result<void> begin_make(const storage::Actor& who);
  Result<void> begin_verify(const storage::Actor& who, const std::string& id);
  /// Errors: Busy, NotFound, Conflict (it is the only one), Io.
  Result<void> remove(const storage::Actor& who, const std::string& id);

 private:
  struct Order {
    Kind kind = Kind::Make;
    std::string id;
  };
  void run(const std::stop_token& stop);
  std::optional<Order> due() const;
  void carry_out(const Order& order, const std::stop_token& stop);
  void make(const backup::Watch& watch, Outcome& outcome);
  void refresh();
  void report();
  bool knows(const std::string& id) const;
  bool is_overdue() const;
  Result<void> begin(const storage::Actor& who, Order order);

  const Options options_;
  Parts parts_;  ///< the folder: on the thread alone, or with `work_` empty and the mutex taken
  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::optional<Order> asked_;
  std::optional<Work> work_;
  std::optional<Outcome> last_, last_made_;
  backup::BackupFolder::List list_;
  std::optional<UtcTime> failed_;  ///< a failed one is tried again after an hour
  const UtcTime started_;
  std::jthread thread_;  // last: it uses the others
};

/// make, verify
std::string_view to_string(Backups::Kind kind);

}  // namespace dripline::library
