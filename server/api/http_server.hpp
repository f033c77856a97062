#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "protocol/base/result.hpp"
#include "server/api/http_address.hpp"
#include "server/api/request.hpp"
#include "server/api/response.hpp"

namespace dripline::api {

/// File names of a PEM certificate chain and its private key.
struct TlsFiles {
  std::string certificate, key;
  /// Authorities of clients' certificates (PEM); a client may have one, and need not. Empty:
  /// clients are not asked for one.
  std::string client_authority = {};
};

/// Bounds of what hostile and hung clients can consume. A connection without a request in progress
/// makes room for a new one, the longest silent first, and so does one that sends the body of a
/// request without a caller; when there is none, the new one gets one of the `reserve` seats, where
/// only `/health` and what may stop a machine is served.
struct HttpLimits {
  std::size_t connections = 512;
  std::size_t per_address = 256;  ///< one IPv4 address or one IPv6 /64, loopback included
  std::size_t reserve = 32;
  std::size_t event_streams = 256;  ///< one address: half of per_address
  /// Request bodies over 16 KiB of all connections; those of one caller: half of it.
  std::uint64_t body_memory = 64ull * 1024 * 1024;
  std::size_t waiting_commands = 256;  ///< that machines have not answered yet; 64 more of stops
  std::chrono::milliseconds handshake{8000};
  std::chrono::milliseconds head{10000};   ///< since its first byte, or since the connection
  std::chrono::milliseconds idle{75000};   ///< between two requests of one connection
  std::chrono::milliseconds body{20000};   ///< of silence within a body
  std::chrono::milliseconds write{30000};  ///< for 256 KiB to a client that does not read
};

struct HttpOptions {
  HttpAddress address;
  bool is_open = false;  ///< listens anywhere without TLS: no token crosses, all may read all
  std::optional<TlsFiles> tls;
  unsigned handler_threads = 16;  ///< number of requests that may wait for storage at once
  HttpLimits limits;
  std::uint64_t max_body = 0;                 ///< a larger one is refused
  std::chrono::milliseconds heartbeat{3000};  ///< of event streams: the page waits 10 s
};

/// The functions that answer requests.
struct HttpHandlers {
  /// On a worker; may wait.
  std::function<Response(Request)> handle;
  /// Receives the head (with the client's address and verified certificate) alone, before a body is
  /// read, on the thread that serves the sockets: must not wait. An answer is sent at once;
  /// otherwise it may set Request::who.
  std::function<std::optional<Response>(Request&)> judge = {};
  /// Whether `handle` may wait for a machine. Each such request gets a thread, so that a gateway
  /// that hangs delays no other request. On the socket thread.
  std::function<bool(const Request&)> waits_for_machine = {};
  /// Whether a request that was judged may stop a machine: it is served in a reserve seat too. On
  /// the socket thread.
  std::function<bool(const Request&)> may_stop = {};
  /// Whether it finds out what is to be stopped: likewise, in half of these seats. On the socket
  /// thread.
  std::function<bool(const Request&)> finds_run = {};
  /// The largest body of a request that was judged, where less than HttpOptions::max_body. On the
  /// socket thread.
  std::function<std::uint64_t(const Request&)> max_body = {};
};

/// The sockets in front of the handlers. One thread moves bytes; handlers and body sources run on
/// other threads. Long bodies are pulled as fast as the client reads them.
class HttpServer {
 public:
  /// The server listens when this returns. Errors: Denied (exposed without TLS, a key that others
  /// can read), Io (address in use, certificate unreadable).
  static Result<std::unique_ptr<HttpServer>> start(const HttpOptions& options,
                                                   HttpHandlers handlers);
  /// Stops accepting and reading: idle connections are closed, and so are event streams and
  /// requests that are not whole. Waits for running handlers; what they answer is sent, within 2 s.
  virtual ~HttpServer() = default;
  virtual std::uint16_t port() const = 0;
};

}  // namespace dripline::api
