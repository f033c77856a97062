#include "clients/cli/text/password_prompt.hpp"

#include <fmt/core.h>
#include <termios.h>
#include <unistd.h>
#include <cstdio>
#include <optional>

#include "clients/cli/text/error_output.hpp"

namespace dripline::cli {
namespace {

constexpr std::size_t kLongest = 4096;

/// The terminal does not show what is typed while this lives.
class HiddenTyping {
 public:
  HiddenTyping() {
    termios hidden{};
    if (::tcgetattr(STDIN_FILENO, &hidden) != 0) return;
    before_ = hidden;
    hidden.c_lflag &= ~static_cast<tcflag_t>(ECHO);
    ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &hidden);
  }
  ~HiddenTyping() {
    if (before_) ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &*before_);
  }
  HiddenTyping(const HiddenTyping&) = delete;
  HiddenTyping& operator=(const HiddenTyping&) = delete;

 private:
  std::optional<termios> before_;
};

Result<std::string> read_line() {
  std::string line;
  for (char c = 0; ::read(STDIN_FILENO, &c, 1) == 1 && c != '\n';) {
    line += c;
    if (line.size() > kLongest)
      return fail(Errc::LimitExceeded, "a password of more than {} bytes", kLongest);
  }
  if (!line.empty() && line.back() == '\r') line.pop_back();
  if (line.empty()) return fail(Errc::Syntax, "no password was given");
  return line;
}

}  // namespace

Result<std::string> ask_password(const std::string& prompt) {
  if (::isatty(STDIN_FILENO) == 0) return read_line();
  print_error("{}: ", prompt);
  std::fflush(stderr);
  const HiddenTyping hidden;
  auto line = read_line();
  print_error("\n");
  return line;
}

Result<std::string> ask_new_password(const std::string& prompt) {
  auto first = ask_password(prompt);
  if (!first || ::isatty(STDIN_FILENO) == 0) return first;
  const auto second = ask_password("the same again");
  if (!second) return second;
  if (*second != *first) return fail(Errc::Syntax, "the two passwords differ");
  return first;
}

}  // namespace dripline::cli
