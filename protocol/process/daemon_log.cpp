#include "protocol/process/daemon_log.hpp"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/dist_sink.h>
#include <spdlog/sinks/rotating_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>

#include "protocol/base/clock.hpp"
#include "protocol/base/utf8.hpp"

namespace dripline::process {
namespace {

/// The message on one line, whatever it contains.
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

using FileSwitch = spdlog::sinks::dist_sink_mt;  ///< exchanges its files under a lock

std::shared_ptr<spdlog::sinks::sink> open_file(const LogOptions& options) {
  constexpr std::size_t kMega = 1024 * 1024;
  auto file = std::make_shared<spdlog::sinks::rotating_file_sink_mt>(
      options.file, options.max_mb * kMega, options.kept);
  file->set_formatter(log_formatter());
  return file;
}

/// The log is spdlog's default logger, one for the process; so is its file.
struct OpenLog {
  std::mutex mutex;
  LogOptions options;
  std::shared_ptr<FileSwitch> file;
};
OpenLog& open_log() {
  static OpenLog log;
  return log;
}

}  // namespace

Result<void> start_log(const std::string& program, const LogOptions& options) {
  const auto parsed = spdlog::level::from_str(options.level);
  if (parsed == spdlog::level::off && options.level != "off") {
    return fail(Errc::Denied, "log-level '{}' is not debug, info, warn, error or off",
                options.level);
  }
  try {
    std::shared_ptr<spdlog::sinks::sink> sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
    OpenLog& log = open_log();
    const std::lock_guard lock(log.mutex);
    log.options = options;
    log.file.reset();
    if (!options.file.empty()) {
      log.file = std::make_shared<FileSwitch>();
      log.file->add_sink(open_file(options));
      sink = log.file;
    }
    auto logger = std::make_shared<spdlog::logger>(program, std::move(sink));
    logger->set_formatter(log_formatter());
    logger->set_level(parsed);
    logger->flush_on(spdlog::level::info);
    spdlog::set_default_logger(std::move(logger));
  } catch (const spdlog::spdlog_ex& e) {
    return fail(Errc::Io, "log file: {}", e.what());
  }
  return {};
}

bool reopen_log() {
  OpenLog& log = open_log();
  const std::lock_guard lock(log.mutex);
  if (!log.file) return false;
  try {
    log.file->set_sinks({open_file(log.options)});
    spdlog::info("log file reopened");
  } catch (const spdlog::spdlog_ex& e) {
    spdlog::error("log file not reopened, the old one stays in use: {}", e.what());
  }
  return true;
}

void log_foreign(bool is_error, std::string_view text) {
  constexpr std::uint64_t kLines = 10;
  static std::mutex mutex;
  static RateLimit limit(kLines, std::chrono::seconds(10));
  std::optional<std::uint64_t> left_out;
  {
    const std::lock_guard lock(mutex);
    left_out = limit.pass(std::chrono::steady_clock::now());
  }
  if (!left_out) return;
  const auto level = is_error ? spdlog::level::err : spdlog::level::warn;
  if (*left_out > 0) spdlog::log(level, "{} such lines were left out", *left_out);
  spdlog::log(level, "{}", text);
}

}  // namespace dripline::process
