#include <malloc.h>
#include <pthread.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <csignal>
#include <ctime>

#include "protocol/base/one_line.hpp"
#include "server/app/server.hpp"
#include "server/app/settings.hpp"

namespace dripline::app {
namespace {

constexpr int kFailed = 1;
constexpr int kUnsafe = 2;

/// The message, on one line whatever is in it.
class OneLineMessage final : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& entry, const std::tm&,
              spdlog::memory_buf_t& to) override {
    const std::string line = one_line({entry.payload.data(), entry.payload.size()});
    to.append(line.data(), line.data() + line.size());
  }
  std::unique_ptr<custom_flag_formatter> clone() const override {
    return std::make_unique<OneLineMessage>();
  }
};

std::unique_ptr<spdlog::formatter> log_formatter() {
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<OneLineMessage>('*').set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %l %*");
  return formatter;
}

Result<void> open_log(const Settings& settings) {
  const auto level = spdlog::level::from_str(settings.log_level);
  if (level == spdlog::level::off && settings.log_level != "off") {
    return fail(Errc::Denied, "log-level '{}' is not debug, info, warn, error or off",
                settings.log_level);
  }
  try {
    auto logger = settings.log.empty() ? spdlog::stderr_logger_mt("dncd")
                                       : spdlog::basic_logger_mt("dncd", settings.log);
    logger->set_level(level);
    logger->flush_on(spdlog::level::info);
    logger->set_formatter(log_formatter());
    spdlog::set_default_logger(std::move(logger));
  } catch (const spdlog::spdlog_ex& e) {
    return fail(Errc::Io, "log file: {}", e.what());
  }
  return {};
}

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
  ::mallopt(M_MMAP_THRESHOLD, kMapFrom);
  ::mallopt(M_ARENA_MAX, kArenas);
}

/// Blocked in every thread and waited for in this one: no handler code, no races.
sigset_t block_end_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
  return signals;
}

void serve_until(const sigset_t& signals, Server& server) {
  constexpr timespec kTidyInterval{.tv_sec = 3600, .tv_nsec = 0};
  while (sigtimedwait(&signals, nullptr, &kTidyInterval) < 0) {
    if (errno == EAGAIN) server.tidy();
  }
}

int run(const Settings& settings) {
  keep_memory_small();
  const sigset_t signals = block_end_signals();
  if (auto opened = open_log(settings); !opened) return complain(opened.error());
  ::umask(S_IRWXG | S_IRWXO);  // programs, reports and the token are the owner's alone
  const SystemClock clock;
  auto server = Server::start(settings, clock);
  if (!server) {
    spdlog::error("not started: {}", server.error().what);
    // Without a log file the line above is on standard error already.
    if (settings.log.empty()) return server.error().code == Errc::Denied ? kUnsafe : kFailed;
    return complain(server.error());
  }
  spdlog::info("dncd {} listening at {}", DRIPLINE_VERSION, (*server)->url());
  fmt::print("dncd listening at {}\n", (*server)->url());
  std::fflush(stdout);
  serve_until(signals, **server);
  spdlog::info("stopping");
  server->reset();
  spdlog::info("stopped");
  spdlog::shutdown();
  return 0;
}

}  // namespace
}  // namespace dripline::app

int main(int argc, char** argv) {
  const auto line = dripline::app::read_command_line(argc, argv);
  if (!line.print.empty()) {
    fmt::print(line.exit_code == 0 ? stdout : stderr, "{}", line.print);
    return line.exit_code;
  }
  return dripline::app::run(line.settings);
}
