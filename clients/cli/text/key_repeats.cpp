#include "clients/cli/text/key_repeats.hpp"

#include <poll.h>
#include <termios.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <string_view>

namespace dripline::cli {

struct KeyRepeats::Terminal {
  termios before{};
};

KeyRepeats::KeyRepeats() {
  termios before{};
  if (::tcgetattr(STDIN_FILENO, &before) != 0) return;
  terminal_ = std::make_unique<Terminal>(Terminal{before});
  termios direct = before;
  direct.c_lflag &= ~static_cast<tcflag_t>(ECHO | ICANON | ISIG);
  direct.c_cc[VMIN] = 1;
  direct.c_cc[VTIME] = 0;
  ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &direct);
}

KeyRepeats::~KeyRepeats() {
  // What is left of the repeats is not for the shell.
  if (terminal_) ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &terminal_->before);
}

KeyRepeats::Heard KeyRepeats::wait(std::chrono::milliseconds limit) {
  pollfd input{STDIN_FILENO, POLLIN, 0};
  const int ready = ::poll(&input, 1, static_cast<int>(limit.count()));
  if (ready < 0 && errno != EINTR) return Heard::End;
  if (ready <= 0) return Heard::Nothing;
  std::array<char, 4096> keys{};
  const auto count = ::read(STDIN_FILENO, keys.data(), keys.size());
  if (count <= 0) return Heard::End;
  constexpr std::string_view kEnds = "\x03\x04\x1a";  // Ctrl-C, Ctrl-D, Ctrl-Z
  const std::string_view typed(keys.data(), static_cast<std::size_t>(count));
  return typed.find_first_of(kEnds) == std::string_view::npos ? Heard::Key : Heard::End;
}

}  // namespace dripline::cli
