#include "tests/support/line/pty.hpp"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace dripline::test_support {
namespace {

void require(bool holds, const char* what) {
  if (holds) return;
  std::perror(what);
  std::abort();
}

bool wait_readable(int descriptor, int milliseconds) {
  pollfd entry{descriptor, POLLIN, 0};
  return ::poll(&entry, 1, milliseconds) > 0;
}

void write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t taken = ::write(descriptor, text.data(), text.size());
    if (taken > 0) {
      text.remove_prefix(static_cast<std::size_t>(taken));
      continue;
    }
    pollfd entry{descriptor, POLLOUT, 0};
    if (::poll(&entry, 1, 2000) <= 0) return;  // no reader: the test will report what is missing
  }
}

}  // namespace

Pty::Pty() : path_((folder_.path() / "port").string()) {
  plug_in();
}

Pty::~Pty() {
  unplug();
}

void Pty::plug_in() {
  char name[128];
  require(::openpty(&master_, &slave_, name, nullptr, nullptr) == 0, "openpty");
  termios modes{};
  ::tcgetattr(slave_, &modes);
  ::cfmakeraw(&modes);  // so that nothing is echoed before the port is opened
  ::tcsetattr(slave_, TCSANOW, &modes);
  ::fcntl(master_, F_SETFL, O_NONBLOCK);
  ::fcntl(master_, F_SETFD, FD_CLOEXEC);
  ::fcntl(slave_, F_SETFD, FD_CLOEXEC);
  device_ = name;
  std::filesystem::create_symlink(device_, path_);
}

void Pty::unplug() {
  if (master_ < 0) return;
  ::close(std::exchange(master_, -1));
  ::close(std::exchange(slave_, -1));
  std::filesystem::remove(path_);
}

void Pty::write(std::string_view text) const {
  write_all(master_, text);
}

std::string Pty::read_available() const {
  std::array<char, 4096> piece;
  std::string text;
  for (;;) {
    const ssize_t got = ::read(master_, piece.data(), piece.size());
    if (got <= 0) return text;
    text.append(piece.data(), static_cast<std::size_t>(got));
  }
}

std::string Pty::read(std::size_t size) const {
  std::string text = read_available();
  while (text.size() < size && wait_readable(master_, 2000)) {
    const std::string more = read_available();
    if (more.empty()) break;
    text += more;
  }
  return text;
}

PtyCable::PtyCable() {
  start();
}

PtyCable::~PtyCable() {
  stop();
}

void PtyCable::start() {
  stops_ = false;
  thread_ = std::thread(&PtyCable::relay, this);
}

void PtyCable::stop() {
  stops_ = true;
  if (thread_.joinable()) thread_.join();
}

void PtyCable::unplug() {
  stop();
  host_.unplug();
}

void PtyCable::unplug_control() {
  stop();
  control_.unplug();
}

void PtyCable::plug_in() {
  host_.plug_in();
  start();
}

void PtyCable::relay() {
  while (!stops_) {
    std::array<pollfd, 2> ends{pollfd{host_.master(), POLLIN, 0},
                               pollfd{control_.master(), POLLIN, 0}};
    if (::poll(ends.data(), ends.size(), 20) <= 0) continue;
    const std::string to_control = host_.read_available();
    write_all(control_.master(), to_control);
    passed_ += to_control.size();
    write_all(host_.master(), control_.read_available());
  }
}

}  // namespace dripline::test_support
