#pragma once

#include <fmt/core.h>
#include <cstdint>

/// One line in the daemon's log (daemon_log.hpp). Formatting is compiled once, in log.cpp: a file
/// that formats by spdlog itself takes three seconds more to compile. Any thread.
namespace dripline::process {

enum class LogLevel : std::uint8_t { Debug, Info, Warning, Error };

/// A text that cannot be formatted is logged as that, never thrown.
void write_log(LogLevel level, fmt::string_view text, fmt::format_args values);

template <class... T>
void log_debug(fmt::format_string<T...> text, T&&... values) {
  write_log(LogLevel::Debug, text, fmt::make_format_args(values...));
}

template <class... T>
void log_info(fmt::format_string<T...> text, T&&... values) {
  write_log(LogLevel::Info, text, fmt::make_format_args(values...));
}

template <class... T>
void log_warning(fmt::format_string<T...> text, T&&... values) {
  write_log(LogLevel::Warning, text, fmt::make_format_args(values...));
}

template <class... T>
void log_error(fmt::format_string<T...> text, T&&... values) {
  write_log(LogLevel::Error, text, fmt::make_format_args(values...));
}

}  // namespace dripline::process
