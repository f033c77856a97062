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
};

struct HttpOptions {
  HttpAddress address;
  std::optional<TlsFiles> tls;
  unsigned handler_threads = 16;  ///< so many requests may wait for storage or gateways at once
  std::size_t max_connections = 256;
  std::uint64_t max_body = 0;                  ///< a larger one ends the connection
  std::chrono::milliseconds heartbeat{15000};  ///< of event streams
};

/// The sockets in front of a handler. One thread moves bytes; the handler and the body sources run
/// on threads of their own. Long bodies are pulled as fast as the client takes them.
class HttpServer {
 public:
  using RequestHandler = std::function<Response(Request)>;

  /// Listens when it returns. Errors: Denied (exposed without TLS), Io (address in use, certificate
  /// unreadable).
  static Result<std::unique_ptr<HttpServer>> start(const HttpOptions& options,
                                                   RequestHandler handler);
  /// Accepts nothing more, closes what is open, waits for running handlers.
  virtual ~HttpServer() = default;
  virtual std::uint16_t port() const = 0;
};

}  // namespace dripline::api
