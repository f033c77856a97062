#include "protocol/process/daemon_log.hpp"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <memory>

#include "protocol/base/one_line.hpp"

namespace dripline::process {
namespace {

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

}  // namespace

Result<void> start_log(const std::string& program, const std::string& file,
                       const std::string& level) {
  const auto parsed = spdlog::level::from_str(level);
  if (parsed == spdlog::level::off && level != "off") {
    return fail(Errc::Denied, "log-level '{}' is not debug, info, warn, error or off", level);
  }
  try {
    auto logger =
        file.empty() ? spdlog::stderr_logger_mt(program) : spdlog::basic_logger_mt(program, file);
    logger->set_formatter(log_formatter());
    logger->set_level(parsed);
    logger->flush_on(spdlog::level::info);
    spdlog::set_default_logger(std::move(logger));
  } catch (const spdlog::spdlog_ex& e) {
    return fail(Errc::Io, "log file: {}", e.what());
  }
  return {};
}

}  // namespace dripline::process
