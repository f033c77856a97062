#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "protocol/base/result.hpp"
#include "protocol/wire/discipline.hpp"

/// The ends of real lines: local ttys, TCP streams, RFC 2217 device servers.

namespace dripline::serial {

struct TtyAddress {
  std::string path;
  friend bool operator==(const TtyAddress&, const TtyAddress&) = default;
};
struct TcpAddress {
  std::string host;  ///< name or number; an IPv6 address without brackets
  std::uint16_t port = 0;
  bool speaks_rfc2217 = false;
  friend bool operator==(const TcpAddress&, const TcpAddress&) = default;
};
using Address = std::variant<TtyAddress, TcpAddress>;

/// "/dev/ttyUSB0", "tcp://moxa-3:4001", "rfc2217://[fd00::3]:4001". Pure.
/// Errors: Syntax (naming the expected form), LimitExceeded (port not 1 to 65535).
Result<Address> parse_address(std::string_view text);

/// The result of reading: characters, or the fault of one.
struct Received {
  std::size_t bytes = 0;  ///< number of bytes in the caller's span
  /// The fault comes after these bytes; its character is not among them.
  std::optional<wire::LineFault> fault;
};

/// An open line. No function waits; the owner polls `descriptor()`. Owned by one thread.
/// Closing restores a tty's settings and releases its lock.
class Channel {
 public:
  virtual ~Channel() = default;
  /// Must be repeated until it returns neither bytes nor a fault: polling does not show bytes that
  /// were already read from the device. Errors: Io (the cable, the adapter or the server is gone:
  /// the channel must be reopened).
  virtual Result<Received> read(std::span<std::byte> room) = 0;
  /// Returns the number of accepted bytes; 0: the driver is full. Errors: Io.
  virtual Result<std::size_t> write(std::span<const std::byte> bytes) = 0;
  /// Characters in the driver that have not left, if it reports them.
  virtual std::optional<std::size_t> unsent() const = 0;
  /// Errors: Io. nullopt: this channel has no modem lines.
  virtual Result<std::optional<wire::InputLines>> input_lines() = 0;
  virtual Result<void> set_output_lines(wire::OutputLines lines) = 0;
  /// Errors: Unsupported (a TCP stream), Io.
  virtual Result<void> apply(const wire::LineSettings& settings) = 0;
  /// The descriptor to poll for reading.
  virtual int descriptor() const = 0;
  virtual std::string name() const = 0;  ///< the address as configured
};

/// `address`: a path ("/dev/ttyUSB0"), "tcp://host:port", or "rfc2217://host:port". Waits at most
/// `limit` for a connection. Errors: Syntax, NotFound (no such device), Busy (in use; names the
/// owner), Timeout, Io, Denied.
Result<std::unique_ptr<Channel>> open_channel(const std::string& address,
                                              const wire::LineSettings& settings,
                                              std::chrono::milliseconds limit);

}  // namespace dripline::serial
