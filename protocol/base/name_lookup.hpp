#pragma once

#include <sys/socket.h>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

namespace dripline {

/// Of a host, as numeric texts, in the order in which they are tried.
using HostAddresses = std::vector<std::string>;

/// It may take long, and nothing can end it. Errors: NotFound (none is known).
using NameLookup = std::function<Result<HostAddresses>(const std::string& host)>;

/// The system's (getaddrinfo).
Result<HostAddresses> look_up(const std::string& host);

/// One lookup in a thread of its own, which uses nothing but what it owns: one that is not waited
/// for any more ends by itself. Bounded: kMax at a time in a process, those with them that are not
/// waited for. An address as `host` needs neither lookup nor thread. Any thread.
class PendingLookup {
 public:
  static constexpr int kMax = 64;

  /// Errors: LimitExceeded.
  static Result<PendingLookup> begin(const std::string& host, const NameLookup& lookup);
  /// Nothing: it is in progress.
  std::optional<Result<HostAddresses>> result() const;
  /// Waits for it. Errors: those of the lookup, Timeout (`end`, or `stop`).
  Result<HostAddresses> wait(SteadyTime end, const std::stop_token& stop) const;
  /// Readable when there is a result.
  int descriptor() const;

 private:
  struct State;
  explicit PendingLookup(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::shared_ptr<State> state_;
};

/// Waits for a lookup until `end` or `stop`. Errors: those of `lookup`, Timeout, LimitExceeded.
Result<HostAddresses> addresses_of(const std::string& host, const NameLookup& lookup,
                                   SteadyTime end, const std::stop_token& stop);

struct SocketAddress {
  sockaddr_storage bytes{};
  socklen_t size = 0;
  int family() const { return bytes.ss_family; }
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&bytes); }
};

/// Of one of those addresses. Errors: Syntax.
Result<SocketAddress> socket_address(const std::string& address, std::uint16_t port);

}  // namespace dripline
