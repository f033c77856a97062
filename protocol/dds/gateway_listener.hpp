#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <memory>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/descriptor.hpp"
#include "protocol/base/result.hpp"
#include "protocol/dds/discovery_packet.hpp"
#include "protocol/dds/endpoint.hpp"

namespace dripline::dds {

/// The gateways that announce themselves steadily. Pure; one thread.
class HeardGateways {
 public:
  /// A gateway counts that was heard for `lease` at least without a gap of that length, so that one
  /// that starts is met by every server first, and not longer than `lease` ago.
  explicit HeardGateways(std::chrono::milliseconds lease) : lease_(lease) {}
  /// At most kMaxMachines are known at a time; others are not counted.
  void note(const ParticipantAnnouncement::Prefix& gateway, SteadyTime now);
  std::size_t count(SteadyTime now) const;
  void drop_silent(SteadyTime now);

 private:
  struct Heard {
    SteadyTime since, last;
  };
  const std::chrono::milliseconds lease_;
  std::map<ParticipantAnnouncement::Prefix, Heard> gateways_;
};

/// Of a server that waits for another one's place: which gateways reach it. Gateways announce
/// themselves to every server that they name, several times a second, whether or not it answers. It
/// listens at the first port of each cell, sends nothing, and no gateway learns of it; the ports
/// are its own meanwhile, so it must be gone before a ServerEndpoint is opened.
///
/// What it hears is not authenticated, also with DDS Security: anybody who reaches the ports can
/// be counted as a gateway. One thread.
class GatewayListener {
 public:
  /// Errors: Busy (a port is in use), Io.
  static Result<std::unique_ptr<GatewayListener>> open(const NetworkOptions& options);
  /// Takes what has arrived; to be called some times in a lease. After a gap as long as a lease
  /// what has arrived is dropped: it may be old.
  void receive(SteadyTime now);
  /// Gateways of this domain and tag that are heard steadily.
  std::size_t count(SteadyTime now) const { return heard_.count(now); }

 private:
  explicit GatewayListener(const NetworkOptions& options)
      : options_(options), heard_(std::chrono::milliseconds(options.lease_ms)) {}
  void receive_at(const Descriptor& socket, SteadyTime now, bool is_old);

  const NetworkOptions options_;
  HeardGateways heard_;
  std::vector<Descriptor> sockets_;
  std::vector<std::byte> buffer_;
  SteadyTime received_{};
};

}  // namespace dripline::dds
