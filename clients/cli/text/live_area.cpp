#include "clients/cli/text/live_area.hpp"

#include <fmt/core.h>
#include <unistd.h>

namespace dripline::cli {

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
