#pragma once

#include <chrono>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>

#include "protocol/base/digest.hpp"
#include "protocol/base/name_lookup.hpp"
#include "protocol/base/result.hpp"
#include "storage/webhook_store.hpp"

namespace dripline::webhooks {

/// What is sent for one event: a POST with this body and these header fields.
struct Delivery {
  std::string url;
  std::string id;         ///< Dripline-Delivery: the same at every try, for one event and database
  std::string kind;       ///< Dripline-Event
  std::string timestamp;  ///< Dripline-Timestamp: of this try, seconds since 1970
  std::string signature;  ///< Dripline-Signature: sha256=HEX
  std::string body;       ///< JSON
};

/// Sends deliveries. Any thread.
class Sender {
 public:
  virtual ~Sender() = default;
  /// Done when the receiver has answered with 2xx; follows no redirection, and waits at most some
  /// seconds, or until `stop`. Errors: Timeout (not reached, or no answer in time), Denied (TLS:
  /// its certificate is not trusted), Conflict (another answer; its status is named).
  virtual Result<void> send(const Delivery& delivery, const std::stop_token& stop) = 0;
};

/// Over HTTP and HTTPS (cpp-httplib). The authorities of HTTPS are the system's. `timeout` is for
/// a connection, for each piece of the answer, and, three times, for all of it: the host's name,
/// its addresses one after another, TLS and the answer.
std::unique_ptr<Sender> make_http_sender(std::chrono::milliseconds timeout,
                                         NameLookup lookup = look_up);

/// `server` is the identity of the database: together with the event's number it is unique.
Delivery make_delivery(const storage::Webhook& webhook, const storage::Event& event,
                       const std::string& server, UtcTime now);

/// HMAC (RFC 2104) with SHA-256.
Digest hmac_sha256(std::string_view key, std::string_view text);

/// http or https, a host, and neither user nor fragment. Errors: Syntax, LimitExceeded.
Result<void> check_url(std::string_view url);

}  // namespace dripline::webhooks
