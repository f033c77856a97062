#pragma once

#include <string>
#include <string_view>

namespace dripline::cli {

/// What the destination of text can show.
struct Terminal {
  bool is_terminal = false;
  bool has_color = false;  ///< a terminal, NO_COLOR unset and TERM not "dumb"
  int width = 80;          ///< columns
};

/// The terminal of a file descriptor, now (a window can be resized).
Terminal terminal_of(int descriptor);

enum class Style { Plain, Heading, Good, Bad, Busy, Faint };

/// `text` with the escape sequences of `style`, or as it is when there is no color.
std::string styled(std::string_view text, Style style, bool has_color);

/// Columns that UTF-8 text takes, one for each character.
std::size_t columns(std::string_view text);
/// The text cut to `width` columns, with an ellipsis when something was cut.
std::string cut(std::string_view text, std::size_t width);
/// Control characters as blanks: what comes from a program or machine must not steer the terminal.
std::string printable(std::string_view text);

}  // namespace dripline::cli
