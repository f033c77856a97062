// A cable between two serial ports that are not there: what goes into one link comes out of the
// other. For trying a serial machine on one computer; the quickstart does.
//
//   null_modem [--rate BAUD] [--faults N] HOST CONTROL
//
// makes both links; SIGTERM or SIGINT takes them away. With a rate characters pass as on a line of
// it, 10 bits each; without one as fast as they are read. With --faults about one character in N is
// lost, doubled or has a bit turned, the same ones each time.
#include <unistd.h>
#include <algorithm>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <random>
#include <vector>

#include "tests/support/line/pty.hpp"

namespace {

using dripline::test_support::Pty;
using dripline::test_support::PtyCable;
using Clock = std::chrono::steady_clock;

struct Options {
  unsigned rate = 0;    ///< baud; 0: no limit
  unsigned faults = 0;  ///< one character in so many; 0: none
  std::vector<std::string> links;
};

std::optional<Options> read_options(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string_view word = argv[i];
    unsigned* const number = word == "--rate"     ? &options.rate
                             : word == "--faults" ? &options.faults
                                                  : nullptr;
    if (number == nullptr) {
      if (word.starts_with('-')) return std::nullopt;
      options.links.emplace_back(word);
      continue;
    }
    if (++i == argc) return std::nullopt;
    const std::string_view digits = argv[i];
    const char* const end = digits.data() + digits.size();
    const auto read = std::from_chars(digits.data(), end, *number);
    if (read.ec != std::errc{} || read.ptr != end || *number == 0) return std::nullopt;
  }
  if (options.links.size() != 2) return std::nullopt;
  return options;
}

/// One direction. Characters that may not pass yet stay in the port they were written to.
class Wire {
 public:
  Wire(const Pty& from, const Pty& to, const Options& options)
      : from_(from), to_(to), options_(options) {}

  void pass(Clock::duration elapsed) {
    constexpr double kBitsPerCharacter = 10, kMaxAtOnce = 4096, kLongestPause = 0.05;  // seconds
    const double speed = options_.rate / kBitsPerCharacter;
    const double seconds = std::chrono::duration<double>(elapsed).count();
    allowed_ = options_.rate == 0
                   ? kMaxAtOnce
                   : std::min({allowed_ + seconds * speed, speed * kLongestPause + 1, kMaxAtOnce});
    std::string text(static_cast<std::size_t>(allowed_), '\0');
    if (text.empty()) return;
    const ssize_t got = ::read(from_.master(), text.data(), text.size());
    if (got <= 0) return;
    allowed_ -= static_cast<double>(got);
    text.resize(static_cast<std::size_t>(got));
    to_.write(options_.faults == 0 ? text : damaged(text));
  }

 private:
  std::string damaged(const std::string& text) {
    std::string out;
    for (const char c : text) {
      if (random_() % options_.faults != 0) {
        out += c;
        continue;
      }
      const auto kind = random_() % 3;
      if (kind == 1) out.append(2, c);
      if (kind == 2) out += static_cast<char>(c ^ (1 << random_() % 7));
    }
    return out;
  }

  const Pty& from_;
  const Pty& to_;
  const Options& options_;
  double allowed_ = 0;   ///< characters
  std::mt19937 random_;  ///< with its fixed seed
};

/// False: they cannot be made.
bool make_links(const Options& options, const std::string& host, const std::string& control) {
  namespace fs = std::filesystem;
  std::error_code error;
  for (const bool is_host : {true, false}) {
    const std::string& link = options.links[is_host ? 0 : 1];
    fs::remove(link, error);  // of a cable that was killed
    fs::create_symlink(is_host ? host : control, link, error);
    if (!error) continue;
    std::fprintf(stderr, "null_modem: %s: %s\n", link.c_str(), error.message().c_str());
    return false;
  }
  return true;
}

bool serve(const Options& options, const sigset_t& ends) {
  if (options.rate == 0 && options.faults == 0) {
    const PtyCable cable;
    if (!make_links(options, cable.host(), cable.control())) return false;
    int signal = 0;
    sigwait(&ends, &signal);
    return true;
  }
  const Pty host, control;
  if (!make_links(options, host.path(), control.path())) return false;
  Wire to_control(host, control, options), to_host(control, host, options);
  constexpr timespec kTick{0, 2'000'000};
  auto last = Clock::now();
  while (sigtimedwait(&ends, nullptr, &kTick) < 0) {
    const auto now = Clock::now();
    to_control.pass(now - last);
    to_host.pass(now - last);
    last = now;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const auto options = read_options(argc, argv);
  if (!options) {
    std::fprintf(stderr, "usage: null_modem [--rate BAUD] [--faults N] HOST CONTROL\n");
    return 2;
  }
  sigset_t ends;
  sigemptyset(&ends);
  sigaddset(&ends, SIGTERM);
  sigaddset(&ends, SIGINT);
  pthread_sigmask(SIG_BLOCK, &ends, nullptr);  // the cable's thread too
  if (!serve(*options, ends)) return 1;
  std::error_code error;
  for (const auto& link : options->links) std::filesystem::remove(link, error);
  return 0;
}
