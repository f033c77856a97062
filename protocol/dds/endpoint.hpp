#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.hpp"
#include "protocol/dds/message.hpp"

/// The two ends of the star: one server, many gateways, a partition for each machine. These
/// interfaces hide the rest of DDS.

namespace dripline::dds {

/// File names of DDS Security (PEM; governance and permissions signed). Loopback runs without.
struct SecurityFiles {
  std::string identity_ca, certificate, private_key, permissions_ca, governance, permissions;
  std::optional<std::string> revocation_list;
};

/// A server consists of cells, each with two ports and a participant; every machine belongs to one.
/// In DDS each gateway learns of all endpoints of its peer that it could match, so one peer for n
/// machines announces n * n endpoints; c cells reduce that to a c-th.
inline constexpr std::uint32_t kFewestCells = 8, kMostCells = 64;

struct NetworkOptions {
  std::uint32_t domain =
      0;  ///< 0..230; at most 100 for a server: above that are the system's ephemeral ports
  std::string interface = "lo";  ///< network interface name or address
  /// For gateways: the addresses of the server and of those that may take over from it, each host
  /// or host:port, with commas between. A server uses two ports for each cell from there.
  std::string server = "127.0.0.1";
  /// For servers: the first of those ports; 0: 7410 + 250 * domain.
  std::uint16_t port = 0;
  /// For servers: of its taking of a library that others may take over
  /// (storage::OpenedStore::term). It is in every message, and in what a gateway learns of the
  /// server beforehand. 0: none.
  std::uint64_t term = 0;
  std::string tag;  ///< systems with different tags ignore each other
  std::uint32_t discovery_interval_ms = 250;
  std::uint32_t lease_ms = 2000;  ///< a peer that is silent for longer is lost
  /// 8, 16, 32 or 64. A server takes gateways that have as many cells as it has, or fewer; one that
  /// has more does not find it. What is gained comes when both have many.
  std::uint32_t cells = kFewestCells;
  std::optional<SecurityFiles> security;
  bool is_open_network_allowed =
      false;  ///< permits other networks than loopback without `security`
};

/// Whether it is safe to open an endpoint with these options. Errors: Denied (an interface that
/// other hosts reach, without security: any host there could command every machine).
Result<void> check_exposure(const NetworkOptions& options);

/// Messages that were dropped because they failed a check; they are never delivered.
struct Rejected {
  std::uint64_t messages = 0;
  std::string last_reason;
};

/// Unacknowledged samples in flight before the newest replaces the oldest (qos.cpp has the reason):
/// records of one gateway, and block pieces of kMaxBlockBytes for one machine. Below these numbers
/// a live peer loses nothing; lost samples are sent or requested again.
inline constexpr std::size_t kRecordWindow = 256;
inline constexpr std::size_t kBlockWindow = 64;
/// Machines that one server attaches; further announcements are rejected.
inline constexpr std::size_t kMaxMachines = 4096;

/// A message that is written while a connection breaks or recovers can be lost without an error: a
/// caller that needs an answer repeats the message (records, requests, commands with their id, and
/// the answers to repeated ones) until it has one.

/// Every callback runs on a thread of the endpoint: it must return at once (post to your own
/// executor) and must not call back into the endpoint or destroy it. Callbacks of different kinds
/// may run at the same time. After the endpoint's destructor returns, no callback runs any more.
struct GatewayHandlers {
  std::function<void(Command)> on_command;
  std::function<void(RecordAck)> on_ack;
  std::function<void(BlockData)> on_block;
  /// true: a server and this gateway are connected; repeated when another server takes over or the
  /// same one is back. Another one takes over when the present one is lost, or has a lower term
  /// than the other; until then its messages are rejected. false: no server is left.
  std::function<void(bool is_connected)> on_server;
  /// A server is there whose term is lower than `seen`: nothing of it is delivered, whether or not
  /// there is another one. Once for each such server.
  std::function<void(std::uint64_t term, std::uint64_t seen)> on_stale_server = {};
  /// Where the machine is a control at the end of a line; empty: it has no such topics.
  std::function<void(LineRequest)> on_line_request = {};
};

/// A gateway's end, for one machine. Of several servers it has one: that with the highest term.
/// Once it had a server of a term, none with a lower one or without one is ever its server again,
/// and a message with a lower one is rejected, stops included. Nothing is delivered before the
/// gateway wrote its Announce; the endpoint repeats it to every new server. The write functions
/// never wait longer than a few milliseconds: Errc::Timeout means "not accepted, try later"; any
/// thread. Messages written while no server is connected are lost, except the last Announce. A
/// Status is not acknowledged either: it is to be repeated until another one follows, at least once
/// a second. Errors of writing: Syntax, LimitExceeded (an impossible member), Timeout, Io.
class GatewayEndpoint {
 public:
  /// Errors: Syntax, LimitExceeded (options, machine name), NotFound (a security file), Io.
  static Result<std::unique_ptr<GatewayEndpoint>> open(const NetworkOptions& options,
                                                       const std::string& machine,
                                                       GatewayHandlers handlers);
  virtual ~GatewayEndpoint() = default;
  virtual Result<void> write(const Announce& message) = 0;
  virtual Result<void> write(const Status& message) = 0;
  virtual Result<void> write(const Record& message) = 0;
  virtual Result<void> write(const CommandResult& message) = 0;
  virtual Result<void> write(const BlockRequest& message) = 0;
  /// Errors: also Unsupported (without GatewayHandlers::on_line_request).
  virtual Result<void> write(const LineData& message) = 0;
  virtual bool is_connected() const = 0;
  virtual Rejected rejected() const = 0;
};

struct ServerHandlers {
  /// The machine can be written to from now on. Called again when it is back or announces something
  /// else; a restarted gateway can appear (with another session) without on_lost before. Its status
  /// and records may arrive a little earlier; those of any other participant never arrive.
  std::function<void(Announce)> on_announce;
  std::function<void(std::string machine)> on_lost;  ///< its lease ended, or it disconnected
  /// Another participant announces the same machine while the present one is alive: its messages
  /// are rejected until that one is lost. false: no longer.
  std::function<void(std::string machine, bool is_there)> on_rival;
  /// Whether a gateway may become that of a machine, which has none at the time. False: it waits,
  /// as a rival does, until it is asked for again. Empty: any may.
  std::function<bool(const Announce&)> may_serve = {};
  std::function<void(Status)> on_status;
  std::function<void(Record)> on_record;
  std::function<void(CommandResult)> on_command_result;
  std::function<void(BlockRequest)> on_request;
  std::function<void(LineData)> on_line_data = {};
};

/// The server's end. Machines are attached as they announce themselves; each gets writers and
/// bounded readers of its own, so a hung gateway delays no other. Writes as above; several
/// threads may write, one at a time per machine.
class ServerEndpoint {
 public:
  /// Errors: Busy (another server of this domain runs here), and those of GatewayEndpoint::open.
  static Result<std::unique_ptr<ServerEndpoint>> open(const NetworkOptions& options,
                                                      ServerHandlers handlers);
  virtual ~ServerEndpoint() = default;
  /// Errors: NotFound (not connected), Syntax, LimitExceeded, Timeout (not accepted: try later),
  /// Io.
  virtual Result<void> write(const RecordAck& message) = 0;
  virtual Result<void> write(const Command& message) = 0;
  virtual Result<void> write(const BlockData& message) = 0;
  /// Errors: also Unsupported (the machine's gateway has announced no line). Can be lost until the
  /// gateway is matched; the caller repeats it.
  virtual Result<void> write(const LineRequest& message) = 0;
  /// No status of this machine arrives though its gateway is connected: takes them through another
  /// reader from now on. Returns at once; the latest one may come again.
  virtual void renew_status(const std::string& /*machine*/) {}
  /// ServerHandlers::may_serve has another answer for this machine. Returns at once.
  virtual void look_again(const std::string& /*machine*/) {}
  /// The gateways that this server hears, whether or not it is connected with them. Any thread.
  virtual std::size_t heard_gateways() const { return 0; }
  virtual Rejected rejected() const = 0;
};

// The commands that stop or slow down a machine: one rule for both ends. They never expire, and no
// session, clock or protocol version withholds them.

/// Hold, abort, or a pressed emergency stop.
inline bool is_stop(CommandAction action, std::string_view argument, double value) {
  if (action == CommandAction::Switch) return argument == "emergency_stop" && value == 1;
  return action == CommandAction::Hold || action == CommandAction::Abort;
}

inline bool is_override(CommandAction action) {
  return action == CommandAction::FeedOverride || action == CommandAction::RapidOverride ||
         action == CommandAction::SpindleOverride;
}

/// The member of `now` (a `Status`, a machine's panel) that an override command sets. `action` is
/// that of an override.
template <class Overrides>
auto& override_of(CommandAction action, Overrides& now) {
  return action == CommandAction::FeedOverride    ? now.feed_override
         : action == CommandAction::RapidOverride ? now.rapid_override
                                                  : now.spindle_override;
}

/// Whether `value` is less than the override in force; false for a NaN.
template <class Overrides>
bool lowers_override(CommandAction action, double value, const Overrides& now) {
  return is_override(action) && value < override_of(action, now);
}

}  // namespace dripline::dds
