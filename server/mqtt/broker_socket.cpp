#include "server/mqtt/broker_socket.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <array>
#include <cerrno>
#include <system_error>

namespace dripline::mqtt {
namespace {

tl::unexpected<Error> system_fault(int error) {
  return fail(Errc::Io, "{}", std::generic_category().message(error));
}
bool is_for_later(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

}  // namespace

Result<void> BrokerSocket::open(const std::string& host, std::uint16_t port,
                                const NameLookup& lookup) {
  *this = BrokerSocket();
  port_ = port;
  auto begun = PendingLookup::begin(host, lookup);
  if (!begun) return fail(begun.error());
  lookup_ = std::move(*begun);
  return take_addresses();
}

Result<void> BrokerSocket::take_addresses() {
  const auto found = lookup_->result();
  if (!found) return {};
  lookup_.reset();
  if (!*found) return fail(Errc::Io, "{}", found->error().what);
  untried_.assign((*found)->begin(), (*found)->end());
  return try_next(EADDRNOTAVAIL);
}

Result<void> BrokerSocket::try_next(int error) {
  while (!untried_.empty()) {
    const auto address = socket_address(untried_.front(), port_);
    untried_.pop_front();
    error = address ? begin(*address) : EADDRNOTAVAIL;
    if (error == 0) return {};
  }
  socket_ = Descriptor();
  return system_fault(error);
}

/// 0: it is being connected.
int BrokerSocket::begin(const SocketAddress& address) {
  socket_ = Descriptor();
  socket_ = Descriptor(::socket(address.family(), SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!socket_) return errno;
  begun_ = std::chrono::steady_clock::now();
  const int on = 1;
  (void)::setsockopt(socket_.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  if (::connect(socket_.get(), address.get(), address.size) == 0) return 0;
  return errno == EINPROGRESS || errno == EINTR ? 0 : errno;
}

Result<bool> BrokerSocket::connect() {
  if (is_connected_) return true;
  if (lookup_) {
    if (auto taken = take_addresses(); !taken) return fail(taken.error());
    if (lookup_) return false;
  }
  pollfd file{.fd = socket_.get(), .events = POLLOUT, .revents = 0};
  int error = ETIMEDOUT;
  if (::poll(&file, 1, 0) > 0) {
    socklen_t size = sizeof error;
    if (::getsockopt(socket_.get(), SOL_SOCKET, SO_ERROR, &error, &size) != 0) error = errno;
    if (error == 0) return is_connected_ = true;
  } else if (untried_.empty() || std::chrono::steady_clock::now() - begun_ < kPatience) {
    return false;
  }
  if (auto next = try_next(error); !next) return fail(next.error());
  return false;
}

Result<std::size_t> BrokerSocket::send(std::string_view bytes) {
  const auto sent = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  if (sent >= 0) return static_cast<std::size_t>(sent);
  if (is_for_later(errno)) return std::size_t{0};
  return system_fault(errno);
}

Result<bool> BrokerSocket::receive(std::string& bytes) {
  std::array<char, kPiece> piece{};
  const auto got = ::recv(socket_.get(), piece.data(), piece.size(), 0);
  if (got > 0) {
    bytes.append(piece.data(), static_cast<std::size_t>(got));
    return true;
  }
  if (got == 0) return fail(Errc::Io, "ended the connection");
  if (is_for_later(errno)) return false;
  return system_fault(errno);
}

}  // namespace dripline::mqtt
