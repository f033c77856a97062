#pragma once

#include <string>
#include <string_view>

/// Text that a terminal may get, whatever a server, a machine or a program put into it. What can
/// steer a terminal: control characters (U+0000 to U+001F, U+007F to U+009F), the marks that
/// reorder what is read (Bidi_Control of Unicode), and single bytes 0x80 to 0x9f, which are no
/// UTF-8: a terminal of another character set takes them for control characters.

namespace dripline::cli {

enum class Style { Plain, Heading, Good, Bad, Busy, Faint };

/// `text` in `style`, or as it is when there is no color. A style is a mark here, with a number
/// that this process drew at its first; VisibleText makes an escape sequence of it. So no text from
/// outside can hold a style, and none of its own escape sequences comes through.
std::string styled(std::string_view text, Style style, bool has_color);

/// One line: what can steer a terminal, line ends and tabs too, as blanks.
std::string printable(std::string_view text);

/// Text for a terminal: styles as escape sequences, and what can steer it written as `\x1b` or
/// `\u202e`; lines and tabs stay. JSON stays JSON of the same value, for it holds nothing below
/// U+0020. Takes a text in pieces; half a character at the very end is left out.
class VisibleText {
 public:
  /// The visible form; stays until the next call.
  std::string_view take(std::string_view piece);

 private:
  std::string text_;
  std::string begun_;  ///< of a character that the last piece did not end
};

/// The visible form of a whole text.
std::string visible(std::string_view text);

}  // namespace dripline::cli
