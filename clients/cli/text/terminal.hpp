#pragma once

#include <cstdio>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/cli/text/terminal_text.hpp"

namespace dripline::cli {

/// What the destination of text can show.
struct Terminal {
  bool is_terminal = false;
  bool has_color = false;  ///< a terminal, NO_COLOR unset and TERM not "dumb"
  int width = 80;          ///< columns
};

/// The terminal of a file descriptor, now (a window can be resized).
Terminal terminal_of(int descriptor);

/// Columns that UTF-8 text takes, one for each character.
std::size_t columns(std::string_view text);
/// The text cut to `width` columns, with an ellipsis when something was cut.
std::string cut(std::string_view text, std::size_t width);

/// A few lines at the bottom of a terminal that are drawn over and over. On anything else it draws
/// nothing. Clears itself when destroyed.
class LiveArea {
 public:
  using Writer = std::function<void(std::string_view)>;
  /// `terminal` reports whether there is one and its width; it is asked at each drawing.
  LiveArea(std::function<Terminal()> terminal, Writer writer);
  /// On standard error, so that standard output stays clean.
  static LiveArea on_stderr();
  ~LiveArea() { clear(); }
  LiveArea(LiveArea&&) = default;

  bool is_live() const { return terminal_().is_terminal; }
  /// One less than the terminal has: a full last column would wrap on some.
  std::size_t width() const;
  /// Replaces what is drawn; lines are cut to the width.
  void show(const std::vector<std::string>& lines);
  void clear();

 private:
  std::string erasure() const;
  std::function<Terminal()> terminal_;
  Writer writer_;
  std::size_t drawn_ = 0;  ///< lines; the cursor is at the end of the last
};

}  // namespace dripline::cli
