#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/result.hpp"
#include "protocol/dds/message.hpp"

/// The two ends of the star: one server, many gateways, a partition per machine. Everything else of
/// DDS stays after these.
namespace dripline::dds {

/// File names of DDS Security (PEM; governance and permissions signed). Loopback runs without.
struct SecurityFiles {
  std::string identity_ca, certificate, private_key, permissions_ca, governance, permissions;
  std::optional<std::string> revocation_list;
};

struct NetworkOptions {
  std::uint32_t domain = 0;  ///< 0..230; to 100 for a server, above are ports the system hands out
  std::string interface = "lo";  ///< network interface name or address
  /// Gateways: where the server listens, host or host:port. It uses 16 ports from there.
  std::string server = "127.0.0.1";
  std::string tag;  ///< systems with different tags do not see each other
  std::uint32_t discovery_interval_ms = 250;
  std::uint32_t lease_ms = 2000;  ///< a silent peer is given up after this
  std::optional<SecurityFiles> security;
  bool is_open_network_allowed = false;  ///< beyond loopback without `security`
};

/// Whether it is safe to open an endpoint like this. Errors: Denied (an interface that other
/// machines reach, and no security: whoever reaches it can command every machine).
Result<void> check_exposure(const NetworkOptions& options);

/// Bytes and messages dropped because they failed a check; they are never delivered.
struct Rejected {
  std::uint64_t messages = 0;
  std::string last_reason;
};

/// How much may be under way unacknowledged before the oldest gives way to the newest (qos.cpp says
/// why nothing waits instead): records of one gateway, and block pieces of kMaxBlockBytes for one
/// machine. Stay below them and a live peer loses nothing; what is lost is sent or asked for again.
inline constexpr std::size_t kRecordWindow = 256;
inline constexpr std::size_t kBlockWindow = 64;
/// Machines one server attaches; announcements beyond are rejected.
inline constexpr std::size_t kMaxMachines = 4096;

/// A message written while a connection breaks or comes back can be lost without an error: whoever
/// needs an answer repeats the message (records, requests, orders with their id, and the answers to
/// repeated ones) until it has one.

/// Every callback runs on a thread of the endpoint: it must return at once (post to your own
/// executor) and must not call back into the endpoint or destroy it. Callbacks of different kinds
/// may run at the same time. After the endpoint's destructor returns, no callback runs any more.
struct GatewayHandlers {
  std::function<void(Command)> on_command;
  std::function<void(RecordAck)> on_ack;
  std::function<void(BlockData)> on_block;
  /// true: a server hears this gateway and is heard by it; repeated when another server takes over
  /// or the same one is back. Another one takes over only when the present one is lost; until then
  /// nothing is taken from it. false: none is left.
  std::function<void(bool is_connected)> on_server;
};

/// A gateway's end, for one machine. Nothing is delivered before the gateway wrote its Announce;
/// the endpoint repeats it to every server that comes. The write functions never wait longer than a
/// few milliseconds: Errc::Timeout means "not taken, try later"; any thread. What is written while
/// no server is connected is lost, except the last Announce and Status. Errors of writing: Syntax,
/// LimitExceeded (a member that cannot be), Timeout, Io.
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
  virtual bool is_connected() const = 0;
  virtual Rejected rejected() const = 0;
};

struct ServerHandlers {
  /// The machine can be written to from now on. Again whenever it is back or announces something
  /// else; a restarted gateway can come (with another session) without on_lost before. Its status
  /// and records may arrive a little earlier; those of any other participant never do.
  std::function<void(Announce)> on_announce;
  std::function<void(std::string machine)> on_lost;  ///< its lease ended, or it left
  /// Another participant announces the same machine while the present one lives: it is not heard
  /// until that one is lost. false: no longer.
  std::function<void(std::string machine, bool is_there)> on_rival;
  std::function<void(Status)> on_status;
  std::function<void(Record)> on_record;
  std::function<void(CommandResult)> on_command_result;
  std::function<void(BlockRequest)> on_request;
};

/// The server's end. Machines are attached as they announce themselves; each gets writers and
/// bounded readers of its own, so a hung gateway holds up nobody else. Writes as above; several
/// threads may write, one at a time per machine.
class ServerEndpoint {
 public:
  /// Errors: Busy (another server of this domain runs here), and those of GatewayEndpoint::open.
  static Result<std::unique_ptr<ServerEndpoint>> open(const NetworkOptions& options,
                                                      ServerHandlers handlers);
  virtual ~ServerEndpoint() = default;
  /// Errors: NotFound (not connected), Syntax, LimitExceeded, Timeout (not taken: try later), Io.
  virtual Result<void> write(const RecordAck& message) = 0;
  virtual Result<void> write(const Command& message) = 0;
  virtual Result<void> write(const BlockData& message) = 0;
  virtual Rejected rejected() const = 0;
};

}  // namespace dripline::dds
