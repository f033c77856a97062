#include <malloc.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>
#include <csignal>
#include <ctime>
#include <mutex>
#include <optional>

#include "protocol/dds/configuration.hpp"
#include "protocol/process/daemon_log.hpp"
#include "protocol/process/log.hpp"
#include "protocol/process/service_manager.hpp"
#include "protocol/process/stop_signals.hpp"
#include "server/app/migrate_store.hpp"
#include "server/app/restore.hpp"
#include "server/app/server.hpp"
#include "server/app/settings.hpp"

namespace dripline::app {
namespace {

constexpr int kFailed = 1;
constexpr int kUnsafe = 2;
constexpr unsigned kLongestEnd = 30;  ///< seconds

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

/// Ends the process when the database is another server's: a service manager starts it again, and
/// what it would do until then is that server's.
class LostStore {
 public:
  void note(const Error& error) {
    {
      const std::lock_guard lock(mutex_);
      why_ = error.what;
    }
    ::kill(::getpid(), SIGTERM);  // that the main thread waits for
  }
  std::optional<std::string> why() const {
    const std::lock_guard lock(mutex_);
    return why_;
  }

 private:
  mutable std::mutex mutex_;
  std::optional<std::string> why_;
};

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
    // Without a log file a hang-up is the end, as of any program whose terminal is gone; a service
    // has none.
    if (signal == SIGHUP && (process::reopen_log() || process::has_service_manager())) continue;
    if (signal >= 0) return;
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
  LostStore lost;
  const auto files = process::require_open_files(process::kServerFiles);
  auto server =
      files ? Server::start(settings, clock, [&lost](const Error& error) { lost.note(error); })
            : fail(files.error());
  if (!server) {
    process::log_error("not started: {}", server.error().what);
    // Without a log file the line above is on standard error already.
    if (settings.log.empty()) return server.error().code == Errc::Denied ? kUnsafe : kFailed;
    return complain(server.error());
  }
  process::log_info("dncd {} listening at {}", DRIPLINE_VERSION, (*server)->url());
  fmt::print("dncd listening at {}\n", (*server)->url());
  if (const auto& agent = (*server)->mtconnect_url(); !agent.empty()) {
    process::log_info("MTConnect agent at {}", agent);
    fmt::print("MTConnect agent at {}\n", agent);
  }
  std::fflush(stdout);
  process::notify_ready((*server)->status());
  serve_until(signals, **server, clock);
  if (const auto why = lost.why()) {
    process::log_error("{}: the server ends", *why);
    if (!settings.log.empty()) fmt::print(stderr, "dncd: {}: the server ends\n", *why);
    ::alarm(kLongestEnd);  // an end that hangs is an end all the same
  }
  process::log_info("stopping");
  process::notify_stopping();
  server->reset();
  process::log_info("stopped");
  spdlog::shutdown();
  return lost.why() ? kFailed : 0;
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
