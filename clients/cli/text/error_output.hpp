#pragma once

#include <fmt/core.h>

#include <concepts>
#include <string>
#include <string_view>

#include "clients/cli/text/terminal_text.hpp"

namespace dripline::cli {

/// Writes to standard error, after what standard output was given before.
void write_error(std::string_view text);

/// A text as one printable line, anything else as it is.
template <class T>
auto one_line_of(const T& value) {
  if constexpr (std::convertible_to<const T&, std::string_view>) {
    return printable(value);
  } else {
    return value;
  }
}

/// Formats a message onto standard error. Each text in it becomes one printable line, in a file
/// too: messages of servers, names of machines and blocks of programs are in them.
template <class... Args>
void print_error(fmt::format_string<const Args&...> form, const Args&... args) {
  write_error(fmt::vformat(form, fmt::make_format_args(one_line_of(args)...)));
}

}  // namespace dripline::cli
