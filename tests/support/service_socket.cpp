#include "tests/support/service_socket.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <array>
#include <stdexcept>

namespace dripline::test_support {

ServiceSocket::ServiceSocket() : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path().copy(static_cast<char*>(address.sun_path), sizeof address.sun_path - 1);
  if (::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    throw std::runtime_error("cannot bind " + path());
}

std::optional<std::string> ServiceSocket::receive(std::chrono::milliseconds limit) {
  pollfd entry{socket_.get(), POLLIN, 0};
  if (::poll(&entry, 1, static_cast<int>(limit.count())) <= 0) return std::nullopt;
  std::array<char, 4096> text{};
  const ssize_t size = ::recv(socket_.get(), text.data(), text.size(), 0);
  if (size < 0) return std::nullopt;
  return std::string(text.data(), static_cast<std::size_t>(size));
}

}  // namespace dripline::test_support
