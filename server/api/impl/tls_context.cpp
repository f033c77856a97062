#include "server/api/impl/tls_context.hpp"

#include <openssl/ssl.h>
#include <sys/stat.h>

namespace dripline::api {
namespace {

namespace ssl = boost::asio::ssl;

/// A group may read the key, as Debian's ssl-cert does; others must neither read nor write it.
Result<void> check_key_mode(const std::string& file) {
  struct stat facts {};
  if (::stat(file.c_str(), &facts) != 0) return {};  // reading it gives the better error
  if ((facts.st_mode & (S_IRWXO | S_IWGRP)) == 0) return {};
  return fail(Errc::Denied, "TLS key {} can be read or changed by others: chmod 600 it", file);
}

}  // namespace

Result<ssl::context> tls_context(const TlsFiles& files) {
  if (auto safe = check_key_mode(files.key); !safe) return fail(safe.error());
  ssl::context context(ssl::context::tls_server);
  SSL_CTX* const native = context.native_handle();
  context.set_options(ssl::context::default_workarounds | ssl::context::single_dh_use |
                      SSL_OP_NO_RENEGOTIATION | SSL_OP_CIPHER_SERVER_PREFERENCE);
  SSL_CTX_set_min_proto_version(native, TLS1_2_VERSION);
  if (SSL_CTX_set_cipher_list(native, "ECDHE+AESGCM:ECDHE+CHACHA20") != 1) {
    return fail(Errc::Io, "this OpenSSL has no TLS 1.2 ciphers with forward secrecy");
  }
  boost::system::error_code error;
  if (context.use_certificate_chain_file(files.certificate, error); error) {
    return fail(Errc::Io, "certificate {}: {}", files.certificate, error.message());
  }
  if (context.use_private_key_file(files.key, ssl::context::pem, error); error) {
    return fail(Errc::Io, "key {}: {}", files.key, error.message());
  }
  return context;
}

}  // namespace dripline::api
