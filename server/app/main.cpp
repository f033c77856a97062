#include <malloc.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>
#include <atomic>
#include <chrono>
#include <csignal>
#include <ctime>
#include <mutex>
#include <optional>
#include <utility>

#include "protocol/dds/configuration.hpp"
#include "protocol/process/daemon_log.hpp"
#include "protocol/process/log.hpp"
#include "protocol/process/service_manager.hpp"
#include "protocol/process/stop_signals.hpp"
#include "server/app/migrate_store.hpp"
#include "server/app/restore.hpp"
#include "server/app/server.hpp"
#include "server/app/settings.hpp"
#include "server/app/standby.hpp"

namespace dripline::app {
namespace {

constexpr int kFailed = 1;
constexpr int kUnsafe = 2;
constexpr unsigned kLongestEnd = 60;   ///< seconds; below TimeoutStopSec= of the unit
constexpr unsigned kLongestLost = 30;  ///< likewise, of a server whose library is another one's

int complain(const Error& error) {
  fmt::print(stderr, "dncd: {}\n", error.what);
  return error.code == Errc::Denied ? kUnsafe : kFailed;
}

/// Uploads pass through in pieces of some MiB, on several threads. Left alone, glibc raises its
/// threshold and keeps such pieces in an arena per thread: 100 MiB resident after the first GiB. So
/// large blocks go back to the system at once.
void keep_memory_small() {
  constexpr int kMapFrom = 256 * 1024;
  constexpr int kArenas = 2;
  ::mallopt(M_MMAP_THRESHOLD, kMapFrom);  // NOLINT(concurrency-mt-unsafe): no threads yet
  ::mallopt(M_ARENA_MAX, kArenas);        // NOLINT(concurrency-mt-unsafe): no threads yet
}

/// Ends the server when the database is another one's, or is to become that. The process ends too:
/// a service manager starts it again, and what it would do until then is the other server's.
class EndReason {
 public:
  void note_lost(const Error& error) {
    {
      const std::lock_guard lock(mutex_);
      why_ = error.what;
    }
    ::kill(::getpid(), SIGTERM);  // that the main thread waits for
  }
  void note_handed_over() {
    if (is_handed_over_.exchange(true)) return;
    ::kill(::getpid(), SIGTERM);
  }
  /// nullopt: it was not lost.
  std::optional<std::string> lost() const {
    const std::lock_guard lock(mutex_);
    return why_;
  }
  bool is_handed_over() const { return is_handed_over_; }

 private:
  mutable std::mutex mutex_;
  std::optional<std::string> why_;
  std::atomic<bool> is_handed_over_ = false;
};

/// Without a log file a hang-up is the end, as of any program whose terminal is gone; a service
/// has none.
bool is_end(int signal) {
  if (signal < 0) return false;
  if (signal != SIGHUP) return true;
  const bool is_reopened = process::reopen_log();
  return !is_reopened && !process::has_service_manager();
}

void serve_until(const sigset_t& signals, Server& server, const Clock& clock) {
  constexpr std::chrono::hours kTidyInterval{1};
  const auto interval = process::alive_interval().value_or(kTidyInterval);
  const auto seconds = std::chrono::floor<std::chrono::seconds>(interval);
  const timespec wait{.tv_sec = seconds.count(),
                      .tv_nsec = std::chrono::nanoseconds(interval - seconds).count()};
  SteadyTime tidied = clock.steady_now();
  for (;;) {
    const int signal = sigtimedwait(&signals, nullptr, &wait);
    if (signal < 0 && errno == EAGAIN) process::notify_alive(server.status());
    if (clock.steady_now() - tidied >= kTidyInterval) {
      server.tidy();
      tidied = clock.steady_now();
    }
    if (is_end(signal)) return;
  }
}

int restore(const Settings& settings) {
  ::umask(S_IRWXG | S_IRWXO);
  const auto restored = restore_backup(settings);
  if (!restored) return complain(restored.error());
  fmt::print("backup {} is in {}: start dncd with it\n", *restored, settings.state);
  return 0;
}

int migrate(const Settings& settings) {
  ::umask(S_IRWXG | S_IRWXO);
  // On standard error: the daemon's log file is the daemon's.
  if (auto opened = process::start_log("dncd", {}); !opened) return complain(opened.error());
  const auto migrated = migrate_store(settings);
  return migrated ? 0 : complain(migrated.error());
}

int not_started(const Settings& settings, const Error& error) {
  process::log_error("not started: {}", error.what);
  // Without a log file the line above is on standard error already.
  if (settings.log.empty()) return error.code == Errc::Denied ? kUnsafe : kFailed;
  return complain(error);
}

/// What this process is from one end of a server to the next.
struct Turn {
  Settings settings;
  std::uint64_t handed_over = 0;  ///< the term of the place that it handed over last; 0: none
  int late = 0;                   ///< how often another server was quicker, in a row
  std::string late_because = {};  ///< of the last time
  SteadyTime late_since{};        ///< that time
  std::optional<storage::LeaseRow> ended = {};  ///< of the server that is taken over from
  bool is_first = true;                         ///< the process has just been started
  bool is_over = false;                         ///< the process ends
};

/// Until the place is free, which is true at once where no server has it. False: a signal ended it.
Result<bool> stand_by(Turn& turn, const sigset_t& signals, const Clock& clock) {
  constexpr std::chrono::minutes kLateEnds{10};
  if (clock.steady_now() - turn.late_since > kLateEnds) turn.late = 0;
  auto opened = Standby::open(
      turn.settings, clock,
      {.handed_over = turn.handed_over, .late = turn.late, .late_because = turn.late_because});
  if (!opened) return fail(opened.error());
  Standby& standby = **opened;
  if (std::exchange(turn.is_first, false)) {
    if (auto free = standby.check_ports(); !free) return fail(free.error());
  }
  auto is_due = standby.look();
  turn.ended = standby.ended();
  if (is_due && *is_due) process::log_info("{}", standby.takeover());
  if (!is_due || *is_due) return is_due;
  if (auto listens = standby.listen(); !listens) return fail(listens.error());
  turn.settings.http = standby.address();  // port 0 would be another one after the wait
  process::log_info("dncd {} standing by at {}: {}", DRIPLINE_VERSION, standby.url(),
                    standby.status());
  fmt::print("dncd standing by at {}\n", standby.url());
  std::fflush(stdout);
  process::notify_ready(standby.status());
  constexpr std::chrono::nanoseconds kWait = Standby::kLookEvery;
  const timespec wait{.tv_sec = 0, .tv_nsec = kWait.count()};
  for (;;) {
    if (is_end(sigtimedwait(&signals, nullptr, &wait))) return false;
    process::notify_alive(standby.status());
    is_due = standby.look();
    if (!is_due) return is_due;
    if (!*is_due) continue;
    turn.ended = standby.ended();
    process::log_info("{}", standby.takeover());
    return true;
  }
}

/// The only place where the process ends in the middle: a thread is in the file system and cannot
/// be ended, and uses what would be taken down. What was taken is stored or will be found again.
[[noreturn]] void end_without(const Error& error) {
  process::log_error("{}: the process ends without it", error.what);
  spdlog::shutdown();
  ::_exit(kFailed);
}

/// One server, from its start (or the wait for it) to its end.
int take_turn(Turn& turn, const sigset_t& signals, const Clock& clock) {
  turn.is_over = true;
  if (turn.settings.standby) {
    const auto is_due = stand_by(turn, signals, clock);
    if (!is_due) return not_started(turn.settings, is_due.error());
    if (!*is_due) return 0;
  }
  EndReason end;
  auto server = Server::start(turn.settings, clock,
                              {.ended = std::exchange(turn.ended, std::nullopt),
                               .on_lost = [&end](const Error& error) { end.note_lost(error); }},
                              [&end] { end.note_handed_over(); });
  if (!server) {
    // Of several that wait one is the first; or the present one was busy, and is there again. It
    // waits on, however often that is: without it there is no standby.
    if (turn.settings.standby && server.error().code == Errc::Busy) {
      ++turn.late;
      turn.late_because = server.error().what;
      turn.late_since = clock.steady_now();
      process::log_warning("not taken over: {}", server.error().what);
      turn.is_over = false;
      return 0;
    }
    return not_started(turn.settings, server.error());
  }
  turn.late = 0;
  process::log_info("dncd {} listening at {}", DRIPLINE_VERSION, (*server)->url());
  fmt::print("dncd listening at {}\n", (*server)->url());
  if (const auto& agent = (*server)->mtconnect_url(); !agent.empty()) {
    process::log_info("MTConnect agent at {}", agent);
    fmt::print("MTConnect agent at {}\n", agent);
  }
  std::fflush(stdout);
  process::notify_ready((*server)->status());
  serve_until(signals, **server, clock);
  const auto lost = end.lost();
  if (lost) {
    process::log_error("{}: the server ends", *lost);
    if (!turn.settings.log.empty()) fmt::print(stderr, "dncd: {}: the server ends\n", *lost);
  }
  ::alarm(lost ? kLongestLost : kLongestEnd);  // an end that hangs is an end all the same
  process::log_info("{}", end.is_handed_over() ? "handing over" : "stopping");
  turn.is_over = lost || !end.is_handed_over() || !turn.settings.standby;
  if (turn.is_over) process::notify_stopping();
  turn.handed_over = (*server)->term();
  if (const auto ended = (*server)->end(); !ended) end_without(ended.error());
  server->reset();
  ::alarm(0);
  process::log_info("stopped");
  return lost ? kFailed : 0;
}

int run(const Settings& settings) {
  keep_memory_small();
  if (!settings.restore.empty()) return restore(settings);
  if (!settings.migrate_to.empty()) return migrate(settings);
  const sigset_t signals = process::block_stop_signals();
  ::umask(S_IRWXG | S_IRWXO);  // programs, reports, the log and the token are the owner's alone
  const process::LogOptions log{.file = settings.log,
                                .level = settings.log_level,
                                .max_mb = settings.log_mb,
                                .kept = settings.log_files};
  if (auto opened = process::start_log("dncd", log); !opened) return complain(opened.error());
  dds::send_log_to(process::log_foreign);
  const SystemClock clock;
  const auto files = process::require_open_files(process::kServerFiles);
  int status = files ? 0 : not_started(settings, files.error());
  Turn turn{.settings = settings};
  while (files && !turn.is_over) status = take_turn(turn, signals, clock);
  spdlog::shutdown();
  return status;
}

}  // namespace
}  // namespace dripline::app

int main(int argc, char** argv) {
  try {
    const auto line = dripline::app::read_command_line(argc, argv);
    if (!line.print.empty()) {
      fmt::print(line.exit_code == 0 ? stdout : stderr, "{}", line.print);
      return line.exit_code;
    }
    return dripline::app::run(line.settings);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "dncd: %s\n", failure.what());
    return dripline::app::kFailed;
  }
}
