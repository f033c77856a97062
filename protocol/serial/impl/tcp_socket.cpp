#include "protocol/serial/impl/tcp_socket.hpp"

#include <poll.h>
#include <algorithm>
#include <cerrno>
#include <memory>
#include <system_error>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include "protocol/serial/impl/channels.hpp"

namespace dripline::serial {

namespace {

using Deadline = std::chrono::steady_clock::time_point;

void set_option(int socket, int level, int option, int value) {
  ::setsockopt(socket, level, option, &value, sizeof value);  // optional: a failure is ignored
}

void watch_peer(int socket) {
  set_option(socket, IPPROTO_TCP, TCP_NODELAY, 1);
  set_option(socket, SOL_SOCKET, SO_KEEPALIVE, 1);
  set_option(socket, IPPROTO_TCP, TCP_KEEPIDLE, 3);  // seconds
  set_option(socket, IPPROTO_TCP, TCP_KEEPINTVL, 2);
  set_option(socket, IPPROTO_TCP, TCP_KEEPCNT, 3);
  set_option(socket, IPPROTO_TCP, TCP_USER_TIMEOUT, 10'000);  // ms
}

/// 0, or the error.
int connect_one(const SocketAddress& place, Deadline end, Descriptor& to) {
  Descriptor socket(::socket(place.family(), SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket) return errno;
  watch_peer(socket.get());
  if (::connect(socket.get(), place.get(), place.size) != 0) {
    if (errno != EINPROGRESS) return errno;
    if (!wait_for(socket.get(), POLLOUT, end)) return ETIMEDOUT;
    int error = 0;
    socklen_t size = sizeof error;
    ::getsockopt(socket.get(), SOL_SOCKET, SO_ERROR, &error, &size);
    if (error != 0) return error;
  }
  to = std::move(socket);
  return 0;
}

}  // namespace

bool wait_for(int descriptor, short events, Deadline end) {
  for (;;) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    pollfd entry{descriptor, events, 0};
    const int ready =
        ::poll(&entry, 1, static_cast<int>(std::clamp<long long>(left.count(), 0, 3'600'000)));
    if (ready > 0) return true;
    if (ready == 0 || errno != EINTR) return false;
  }
}

Result<Descriptor> connect_tcp(const TcpAddress& address, std::chrono::milliseconds limit,
                               const NameLookup& lookup) {
  const Deadline end = std::chrono::steady_clock::now() + limit;
  const auto places = addresses_of(address.host, lookup, end, {});
  if (!places) return fail(places.error().code, "host {}: {}", address.host, places.error().what);
  int error = EHOSTUNREACH;
  for (const std::string& place : *places) {
    const auto to = socket_address(place, address.port);
    if (!to) continue;
    Descriptor socket;
    error = connect_one(*to, end, socket);
    if (error == 0) return socket;
    if (error == ETIMEDOUT) break;
  }
  if (error == ETIMEDOUT)
    return fail(Errc::Timeout, "{} port {}: no connection in {} ms", address.host, address.port,
                limit.count());
  return fail(Errc::Io, "{} port {}: {}", address.host, address.port,
              std::generic_category().message(error));
}

namespace {

class TcpChannel final : public Channel {
 public:
  TcpChannel(std::string name, Descriptor socket)
      : name_(std::move(name)), socket_(std::move(socket)) {}

  Result<Received> read(std::span<std::byte> room) override {
    const ssize_t got = ::recv(socket_.get(), room.data(), room.size(), 0);
    if (got > 0) return Received{static_cast<std::size_t>(got), std::nullopt};
    if (got == 0) return fail(Errc::Io, "{}: the other end closed the connection", name_);
    if (errno == EAGAIN || errno == EINTR) return Received{};
    return fail(Errc::Io, "{}: {}", name_, std::generic_category().message(errno));
  }
  Result<std::size_t> write(std::span<const std::byte> bytes) override {
    const ssize_t taken = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (taken >= 0) return static_cast<std::size_t>(taken);
    if (errno == EAGAIN || errno == EINTR) return std::size_t{0};
    return fail(Errc::Io, "{}: {}", name_, std::generic_category().message(errno));
  }
  /// Bytes without the network's acknowledgment do not show the state of the line.
  std::optional<std::size_t> unsent() const override { return std::nullopt; }
  Result<std::optional<wire::InputLines>> input_lines() override {
    return std::optional<wire::InputLines>();
  }
  Result<void> set_output_lines(wire::OutputLines) override { return {}; }
  Result<void> apply(const wire::LineSettings&) override {
    return fail(Errc::Unsupported, "{}: a TCP stream has no line settings; set the device server",
                name_);
  }
  int descriptor() const override { return socket_.get(); }
  std::string name() const override { return name_; }

 private:
  std::string name_;
  Descriptor socket_;
};

}  // namespace

Result<std::unique_ptr<Channel>> open_tcp(const std::string& name, const TcpAddress& address,
                                          std::chrono::milliseconds limit) {
  auto socket = connect_tcp(address, limit, look_up);
  if (!socket) return fail(socket.error());
  return std::unique_ptr<Channel>(std::make_unique<TcpChannel>(name, std::move(*socket)));
}

}  // namespace dripline::serial
