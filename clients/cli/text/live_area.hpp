#pragma once

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "clients/cli/text/terminal.hpp"

namespace dripline::cli {

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
