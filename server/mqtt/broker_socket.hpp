#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/descriptor.hpp"
#include "protocol/base/name_lookup.hpp"
#include "protocol/base/result.hpp"

namespace dripline::mqtt {

/// A TCP connection that never waits, neither for the name server. Tries each address of the host.
class BrokerSocket {
 public:
  /// Begins to look up the host, or to connect where that takes no time. Errors: LimitExceeded
  /// (lookups), those of `connect`.
  Result<void> open(const std::string& host, std::uint16_t port, const NameLookup& lookup);
  /// What of it the network takes now. Errors: Io.
  Result<std::size_t> send(std::string_view bytes);
  /// Appends what has come, at most kPiece. False: nothing. Errors: Io (also when it is ended).
  Result<bool> receive(std::string& bytes);
  /// Of a connection that is being made: whether it is there. Errors: Io (no such host, no address
  /// answers at all).
  Result<bool> connect();

  /// Readable when the host is looked up, until then; later the socket.
  int descriptor() const { return lookup_ ? lookup_->descriptor() : socket_.get(); }
  bool is_looking_up() const { return lookup_.has_value(); }
  bool is_connected() const { return is_connected_; }

  static constexpr std::size_t kPiece = 16 * 1024;
  /// With an address that is silent, while there are others.
  static constexpr std::chrono::seconds kPatience{3};

 private:
  /// If they are there.
  Result<void> take_addresses();
  Result<void> try_next(int error);
  int begin(const SocketAddress& address);

  std::optional<PendingLookup> lookup_;
  std::uint16_t port_ = 0;
  std::deque<std::string> untried_;
  std::chrono::steady_clock::time_point begun_{};  ///< of the address that is tried
  Descriptor socket_;
  bool is_connected_ = false;
};

}  // namespace dripline::mqtt
