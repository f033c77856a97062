#include "server/mqtt/tls_client.hpp"

#include <openssl/err.h>
#include <array>

#include "protocol/pki/expected_host.hpp"

namespace dripline::mqtt {
namespace {

/// OpenSSL's own would ask at the terminal.
int no_passphrase(char*, int, int, void*) {
  return 0;
}

/// Of the thread's last failure.
std::string tls_reason() {
  const auto error = ERR_peek_last_error();
  const char* text = error == 0 ? nullptr : ERR_reason_error_string(error);
  ERR_clear_error();
  return text == nullptr ? "unknown error" : text;
}

tl::unexpected<Error> bad_file(const std::string& file) {
  return fail(Errc::Denied, "mqtt: TLS: {}: {}", file, tls_reason());
}

}  // namespace

Result<void> TlsClient::add_files(SSL_CTX* context, const MqttSettings& settings) {
  const auto& ca = settings.ca;
  const int trusted = ca.empty() ? SSL_CTX_set_default_verify_paths(context)
                                 : SSL_CTX_load_verify_locations(context, ca.c_str(), nullptr);
  if (trusted != 1) return bad_file(ca.empty() ? "the system's authorities" : ca);
  SSL_CTX_set_default_passwd_cb(context, no_passphrase);
  const auto& certificate = settings.certificate;
  if (certificate.empty()) return {};
  if (SSL_CTX_use_certificate_chain_file(context, certificate.c_str()) != 1)
    return bad_file(certificate);
  if (SSL_CTX_use_PrivateKey_file(context, settings.key.c_str(), SSL_FILETYPE_PEM) != 1)
    return bad_file(settings.key);
  return {};
}

Result<TlsClient> TlsClient::make(const MqttSettings& settings) {
  ERR_clear_error();
  const Context context(SSL_CTX_new(TLS_client_method()));
  if (!context) return fail(Errc::Io, "mqtt: TLS: {}", tls_reason());
  SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION);
  SSL_CTX_set_options(context.get(), SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION);
  SSL_CTX_set_verify(context.get(), SSL_VERIFY_PEER, nullptr);
  SSL_CTX_set_session_cache_mode(context.get(), SSL_SESS_CACHE_OFF);
  if (auto added = add_files(context.get(), settings); !added) return fail(added.error());
  Session session(SSL_new(context.get()));
  if (!session) return fail(Errc::Io, "mqtt: TLS: {}", tls_reason());
  const char* host = settings.host.c_str();
  const auto kind = pki::expect_host(SSL_get0_param(session.get()), settings.host);
  const bool is_named = kind && (*kind == pki::HostKind::Address ||
                                 SSL_set_tlsext_host_name(session.get(), host) == 1);
  BIO* const incoming = BIO_new(BIO_s_mem());
  BIO* const outgoing = BIO_new(BIO_s_mem());
  SSL_set_bio(session.get(), incoming, outgoing);  // owns both
  if (!is_named || incoming == nullptr || outgoing == nullptr)
    return fail(Errc::Io, "mqtt: TLS: {}: {}", host, tls_reason());
  SSL_set_connect_state(session.get());
  TlsClient client(std::move(session));
  if (auto begun = client.end_with(SSL_do_handshake(client.session_.get())); !begun)
    return fail(begun.error());
  return client;
}

/// "Needs more bytes" is no error.
Result<void> TlsClient::end_with(int result) const {
  if (result > 0) return {};
  const int error = SSL_get_error(session_.get(), result);
  if (error == SSL_ERROR_WANT_READ || error == SSL_ERROR_WANT_WRITE) return {};
  if (error == SSL_ERROR_ZERO_RETURN) return fail(Errc::Io, "ended the connection");
  const long verified = SSL_get_verify_result(session_.get());
  std::string why = tls_reason();
  if (verified != X509_V_OK) why += fmt::format(" ({})", X509_verify_cert_error_string(verified));
  return fail(Errc::Denied, "TLS: {}", why);
}

Result<void> TlsClient::receive(std::string_view encrypted, std::string& plain) {
  ERR_clear_error();
  BIO_write(SSL_get_rbio(session_.get()), encrypted.data(), static_cast<int>(encrypted.size()));
  std::array<char, 16 * 1024> piece{};
  while (true) {
    const int got = SSL_read(session_.get(), piece.data(), static_cast<int>(piece.size()));
    if (BIO_ctrl_pending(SSL_get_wbio(session_.get())) > kMaxOutput)
      return fail(Errc::LimitExceeded, "TLS: does not take its answers");
    if (got <= 0) return end_with(got);
    plain.append(piece.data(), static_cast<std::size_t>(got));
  }
}

Result<void> TlsClient::send(std::string_view plain) {
  ERR_clear_error();
  if (plain.empty()) return {};
  const int done = SSL_write(session_.get(), plain.data(), static_cast<int>(plain.size()));
  if (done == static_cast<int>(plain.size())) return {};
  if (auto ended = end_with(done); !ended) return ended;
  return fail(Errc::Io, "TLS: nothing can be sent now");
}

std::string TlsClient::take_output() {
  BIO* const outgoing = SSL_get_wbio(session_.get());
  std::string bytes(BIO_ctrl_pending(outgoing), '\0');
  if (bytes.empty()) return bytes;
  const int got = BIO_read(outgoing, bytes.data(), static_cast<int>(bytes.size()));
  bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return bytes;
}

}  // namespace dripline::mqtt
