#pragma once

#include <sys/socket.h>
#include <chrono>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>

#include "protocol/base/descriptor.hpp"
#include "protocol/base/result.hpp"

namespace dripline::mqtt {

/// A TCP connection that never waits, but for the name server. Tries each address of the host.
class BrokerSocket {
 public:
  /// Errors: Io (no such host, no address answers at all).
  Result<void> open(const std::string& host, std::uint16_t port);
  /// What of it the network takes now. Errors: Io.
  Result<std::size_t> send(std::string_view bytes);
  /// Appends what has come, at most kPiece. False: nothing. Errors: Io (also when it is ended).
  Result<bool> receive(std::string& bytes);
  /// Of a connection that is being made: whether it is there. Errors: Io.
  Result<bool> connect();

  int descriptor() const { return socket_.get(); }
  bool is_connected() const { return is_connected_; }

  static constexpr std::size_t kPiece = 16 * 1024;
  /// With an address that is silent, while there are others.
  static constexpr std::chrono::seconds kPatience{3};

 private:
  struct Address {
    sockaddr_storage bytes{};
    socklen_t size = 0;
  };
  Result<void> try_next(int error);
  int begin(const Address& address);

  std::deque<Address> untried_;
  std::chrono::steady_clock::time_point begun_{};  ///< of the address that is tried
  Descriptor socket_;
  bool is_connected_ = false;
};

}  // namespace dripline::mqtt
