#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <string>
#include <string_view>
#include <utility>

namespace dripline::serial {

/// A TCP server of one connection, in the test's hands.
class TcpPeer {
 public:
  explicit TcpPeer(std::uint16_t port = 0)
      : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const int yes = 1;
    ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof place;
    is_listening_ = ::bind(listener_, reinterpret_cast<sockaddr*>(&place), size) == 0 &&
                    ::listen(listener_, 4) == 0;
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&place), &size);
    port_ = ntohs(place.sin_port);
  }
  ~TcpPeer() {
    hang_up();
    ::close(listener_);
  }
  TcpPeer(const TcpPeer&) = delete;
  TcpPeer& operator=(const TcpPeer&) = delete;

  bool is_listening() const { return is_listening_; }
  std::uint16_t port() const { return port_; }
  std::string address() const { return "tcp://127.0.0.1:" + std::to_string(port_); }
  bool accept(int milliseconds = 5000) {
    pollfd entry{listener_, POLLIN, 0};
    if (::poll(&entry, 1, milliseconds) <= 0) return false;
    hang_up();
    socket_ = ::accept(listener_, nullptr, nullptr);
    return socket_ >= 0;
  }
  void hang_up() {
    if (socket_ >= 0) ::close(std::exchange(socket_, -1));
  }
  void write(std::string_view text) const {
    (void)!::send(socket_, text.data(), text.size(), MSG_NOSIGNAL);
  }
  /// What came until `size` characters are there, or none did for two seconds.
  std::string read(std::size_t size) const {
    std::string text;
    char piece[256];
    pollfd entry{socket_, POLLIN, 0};
    while (text.size() < size && ::poll(&entry, 1, 2000) > 0) {
      const ssize_t got = ::recv(socket_, piece, sizeof piece, 0);
      if (got <= 0) break;
      text.append(piece, static_cast<std::size_t>(got));
    }
    return text;
  }

 private:
  int listener_, socket_ = -1;
  std::uint16_t port_ = 0;
  bool is_listening_ = false;
};

}  // namespace dripline::serial
