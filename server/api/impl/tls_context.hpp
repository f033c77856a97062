#pragma once

#include <boost/asio/ssl/context.hpp>

#include "server/api/http_server.hpp"

namespace dripline::api {

/// TLS 1.2 and 1.3, only ciphers with forward secrecy. Errors: Denied (others may read the key), Io
/// (a file cannot be read, the key is not the certificate's).
Result<boost::asio::ssl::context> tls_context(const TlsFiles& files);

}  // namespace dripline::api
