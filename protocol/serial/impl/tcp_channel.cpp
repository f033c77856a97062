#include "protocol/serial/impl/channels.hpp"

#include <sys/socket.h>
#include <cerrno>
#include <system_error>

#include "protocol/serial/impl/tcp_socket.hpp"

namespace dripline::serial {
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
  auto socket = connect_tcp(address, limit);
  if (!socket) return fail(socket.error());
  return std::unique_ptr<Channel>(std::make_unique<TcpChannel>(name, std::move(*socket)));
}

}  // namespace dripline::serial
