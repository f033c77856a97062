#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clients/lib/reply.hpp"
#include "clients/lib/server_location.hpp"

namespace dripline::client {

/// One HTTP exchange; http.cpp is the only user of the HTTP library.
struct HttpRequest {
  std::string method = "GET";
  std::string path;  ///< from the root, already percent-encoded, with its query
  std::vector<std::pair<std::string, std::string>> headers;
  std::string_view body;  ///< must outlive the call
  std::string content_type = "application/json";
  /// Bytes of the body handed to the network so far; false ends the exchange.
  std::function<bool(std::uint64_t sent)> on_sent;
  /// The head of a 2xx answer arrived; false ends the exchange.
  std::function<bool()> on_head;
  /// When set and the status is 2xx, the body goes here piece by piece instead of into
  /// HttpResponse::body; false ends the exchange.
  std::function<bool(std::string_view piece)> on_body;
  std::uint64_t max_body = 64ull * 1024 * 1024;  ///< of a body kept in memory
};

struct HttpResponse {
  int status = 0;
  std::map<std::string, std::string> headers;  ///< names in lower case
  std::string body;
};

struct HttpOptions {
  std::chrono::milliseconds connect_timeout{5000};
  std::chrono::milliseconds read_timeout{60000};  ///< of silence within an answer
};

/// A connection to one server, kept open between calls. One thread at a time, except `stop`.
/// Failures: Unreachable, BadReply (a body over its bound). Any status is a success here.
class Http {
 public:
  virtual ~Http() = default;
  virtual Reply<HttpResponse> send(const HttpRequest& request) = 0;
  /// Ends a running `send`, which then fails; any thread.
  virtual void stop() = 0;
  /// Of several servers the one that answered last; null: none has, or there is one only.
  virtual const ServerAddress* answering() const { return nullptr; }
};

std::unique_ptr<Http> open_http(const ServerAddress& address, const HttpOptions& options = {});

/// Percent-encodes everything but letters, digits and `-._~`.
std::string url_encode(std::string_view text);

}  // namespace dripline::client
