#include "clients/cli/text/terminal.hpp"

#include <unistd.h>
#include <cstdlib>

#include <fmt/core.h>
#include <sys/ioctl.h>

namespace dripline::cli {

namespace {

bool is_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

bool color_is_wanted() {
  const char* no_color = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  return (no_color == nullptr || *no_color == '\0') &&
         (term == nullptr || std::string_view(term) != "dumb");
}

}  // namespace

Terminal terminal_of(int descriptor) {
  Terminal terminal;
  terminal.is_terminal = ::isatty(descriptor) == 1;
  terminal.has_color = terminal.is_terminal && color_is_wanted();
  winsize size{};
  if (terminal.is_terminal && ::ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    terminal.width = size.ws_col;
  }
  return terminal;
}

std::size_t columns(std::string_view text) {
  std::size_t count = 0;
  for (const char c : text) count += is_continuation(c) ? 0 : 1;
  return count;
}

std::string cut(std::string_view text, std::size_t width) {
  if (columns(text) <= width) return std::string(text);
  if (width == 0) return {};
  std::size_t count = 0, end = 0;
  for (; end < text.size(); ++end) {
    if (!is_continuation(text[end]) && ++count == width) break;
  }
  return std::string(text.substr(0, end)) + "\u2026";
}

LiveArea::LiveArea(std::function<Terminal()> terminal, Writer writer)
    : terminal_(std::move(terminal)), writer_(std::move(writer)) {}

LiveArea LiveArea::on_stderr() {
  return LiveArea([] { return terminal_of(STDERR_FILENO); },
                  [](std::string_view text) {
                    std::fflush(stdout);
                    std::fwrite(text.data(), 1, text.size(), stderr);
                    std::fflush(stderr);
                  });
}

std::size_t LiveArea::width() const {
  const int width = terminal_().width;
  // Room for the ^C that a terminal echoes: on a new line it would leave the old one after.
  return width > 3 ? static_cast<std::size_t>(width - 3) : 1;
}

std::string LiveArea::erasure() const {
  if (drawn_ == 0) return {};
  std::string text = "\r";
  if (drawn_ > 1) text += fmt::format("\x1b[{}A", drawn_ - 1);
  return text + "\x1b[J";
}

void LiveArea::show(const std::vector<std::string>& lines) {
  if (!is_live()) return;
  std::string text = erasure();
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i > 0) text += "\n";
    text += cut(printable(lines[i]), width());
  }
  writer_(text);
  drawn_ = lines.size();
}

void LiveArea::clear() {
  if (drawn_ == 0) return;
  writer_(erasure());
  drawn_ = 0;
}

}  // namespace dripline::cli
