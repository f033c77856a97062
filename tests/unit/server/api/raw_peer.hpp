#pragma once

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <chrono>
#include <string>
#include <string_view>
#include <utility>

namespace dripline::server_test {

/// A TCP connection to this machine that does nothing on its own: for what no HTTP client would do.
class RawPeer {
 public:
  explicit RawPeer(std::uint16_t port, int receive_buffer = 0)
      : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (receive_buffer > 0) {
      ::setsockopt(fd_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    }
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    is_connected_ =
        fd_ >= 0 && ::connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  }
  RawPeer(RawPeer&& other) noexcept
      : fd_(std::exchange(other.fd_, -1)), is_connected_(other.is_connected_) {}
  RawPeer& operator=(RawPeer&&) = delete;
  ~RawPeer() {
    if (fd_ >= 0) ::close(fd_);
  }

  bool is_connected() const { return is_connected_; }
  bool send(std::string_view text) {
    while (!text.empty()) {
      const auto size = ::send(fd_, text.data(), text.size(), MSG_NOSIGNAL);
      if (size <= 0) return false;
      text.remove_prefix(static_cast<std::size_t>(size));
    }
    return true;
  }
  /// Ends the connection as a port scanner does: with a reset.
  void reset() {
    const linger now{.l_onoff = 1, .l_linger = 0};
    ::setsockopt(fd_, SOL_SOCKET, SO_LINGER, &now, sizeof now);
    ::close(std::exchange(fd_, -1));
  }
  /// What arrives until `end` is in it, the other side ends, or the limit passes.
  std::string read_until(std::string_view end,
                         std::chrono::milliseconds limit = std::chrono::seconds(30)) {
    std::string text;
    const auto last = std::chrono::steady_clock::now() + limit;
    char piece[4096];
    while (text.find(end) == std::string::npos) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
          last - std::chrono::steady_clock::now());
      pollfd wait{.fd = fd_, .events = POLLIN, .revents = 0};
      if (left.count() <= 0 || ::poll(&wait, 1, static_cast<int>(left.count())) <= 0) return text;
      const auto size = ::recv(fd_, piece, sizeof piece, 0);
      if (size <= 0) {
        is_ended_ = true;
        return text;
      }
      text.append(piece, static_cast<std::size_t>(size));
    }
    return text;
  }
  /// Reads until the other side ends; false: it did not within the limit.
  bool wait_for_end(std::chrono::milliseconds limit = std::chrono::seconds(30)) {
    read_until(std::string_view("\0never\0", 7), limit);
    return is_ended_;
  }

 private:
  int fd_;
  bool is_connected_ = false;
  bool is_ended_ = false;
};

}  // namespace dripline::server_test
