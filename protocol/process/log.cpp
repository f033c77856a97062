#include "protocol/process/log.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <exception>

namespace dripline::process {
namespace {

spdlog::level::level_enum level_of(LogLevel level) {
  switch (level) {
    case LogLevel::Debug:
      return spdlog::level::debug;
    case LogLevel::Info:
      return spdlog::level::info;
    case LogLevel::Warning:
      return spdlog::level::warn;
    case LogLevel::Error:
      break;
  }
  return spdlog::level::err;
}

}  // namespace

void write_log(LogLevel level, fmt::string_view text, fmt::format_args values) {
  auto* const logger = spdlog::default_logger_raw();
  const auto severity = level_of(level);
  if (!logger->should_log(severity)) return;
  try {
    logger->log(severity, spdlog::string_view_t(fmt::vformat(text, values)));
  } catch (const std::exception& e) {
    logger->log(spdlog::level::err, spdlog::string_view_t(e.what()));
  }
}

}  // namespace dripline::process
