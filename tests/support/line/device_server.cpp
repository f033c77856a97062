#include "tests/support/line/device_server.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace dripline::test_support {

DeviceServer::DeviceServer() {
  switch_on();
}

DeviceServer::~DeviceServer() {
  switch_off();
}

void DeviceServer::switch_on() {
  listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int yes = 1;
  ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(port_);
  place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof place;
  if (::bind(listener_, reinterpret_cast<sockaddr*>(&place), size) != 0 ||
      ::listen(listener_, 1) != 0) {
    std::perror("device server");
    std::abort();
  }
  ::getsockname(listener_, reinterpret_cast<sockaddr*>(&place), &size);
  port_ = ntohs(place.sin_port);
  stops_ = false;
  thread_ = std::thread(&DeviceServer::serve, this);
}

void DeviceServer::switch_off() {
  stops_ = true;
  if (thread_.joinable()) thread_.join();
  if (listener_ >= 0) ::close(std::exchange(listener_, -1));
}

void DeviceServer::serve() {
  int client = -1;
  while (!stops_) {
    std::array<pollfd, 2> ends{pollfd{client < 0 ? listener_ : client, POLLIN, 0},
                               pollfd{pty_.master(), POLLIN, 0}};
    if (::poll(ends.data(), ends.size(), 20) <= 0) continue;
    if (client < 0 && ends[0].revents != 0) {
      client = ::accept(listener_, nullptr, nullptr);
      const int yes = 1;
      ::setsockopt(client, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
      continue;
    }
    if (ends[0].revents != 0) {
      std::array<char, 256> piece;
      const ssize_t got = ::recv(client, piece.data(), piece.size(), 0);
      if (got <= 0) {
        ::close(std::exchange(client, -1));
        continue;
      }
      pty_.write({piece.data(), static_cast<std::size_t>(got)});
    }
    const std::string back = pty_.read_available();
    if (client >= 0 && !back.empty()) (void)!::send(client, back.data(), back.size(), MSG_NOSIGNAL);
  }
  if (client >= 0) ::close(client);
}

}  // namespace dripline::test_support
