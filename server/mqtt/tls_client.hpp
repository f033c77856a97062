#pragma once

#include <openssl/ssl.h>
#include <memory>
#include <string>
#include <string_view>

#include "protocol/base/result.hpp"
#include "server/mqtt/mqtt_settings.hpp"

namespace dripline::mqtt {

/// TLS of a client as a filter of bytes, without a socket: what is sent and received in plain text
/// here, encrypted there. One thread.
class TlsClient {
 public:
  /// Trusts the authorities of the settings, or the system's, and the name of their host alone.
  /// Errors: Denied (a file; a key with a passphrase, too).
  static Result<TlsClient> make(const MqttSettings& settings);

  /// Of OpenSSL's own answers (to wishes for another handshake, other keys), for a broker that
  /// does not take them: it may send such wishes without an end.
  static constexpr std::size_t kMaxOutput = 256 * 1024;

  /// Encrypted bytes that have come; what they say is appended to `plain`. Errors: Denied,
  /// LimitExceeded (kMaxOutput).
  Result<void> receive(std::string_view encrypted, std::string& plain);
  /// Appends to what is to be sent. Errors: Denied. Only once it is open.
  Result<void> send(std::string_view plain);
  bool is_open() const { return SSL_is_init_finished(session_.get()) == 1; }
  /// What is to be sent, of the handshake too.
  std::string take_output();
  void close() { SSL_shutdown(session_.get()); }

 private:
  struct Freed {
    void operator()(SSL_CTX* context) const { SSL_CTX_free(context); }
    void operator()(SSL* session) const { SSL_free(session); }
  };
  using Context = std::unique_ptr<SSL_CTX, Freed>;
  using Session = std::unique_ptr<SSL, Freed>;

  explicit TlsClient(Session session) : session_(std::move(session)) {}
  static Result<void> add_files(SSL_CTX* context, const MqttSettings& settings);
  Result<void> end_with(int result) const;

  Session session_;
};

}  // namespace dripline::mqtt
