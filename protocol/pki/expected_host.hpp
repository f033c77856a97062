#pragma once

#include <cstdint>
#include <string>

#include "protocol/base/result.hpp"

struct X509_VERIFY_PARAM_st;  // OpenSSL's X509_VERIFY_PARAM

namespace dripline::pki {

enum class HostKind : std::uint8_t { Name, Address };

/// From now on a server's certificate is good only if its subjectAltName names `host`: an IP
/// address as an address, anything else as a name. The common name is never looked at (RFC 9110,
/// 4.3.4), and a `*` is one whole component of at least three. Of a client's SSL or SSL_CTX, before
/// its handshake. Returns what the host is: only a name is sent as SNI. Errors: Syntax (no name of
/// a host).
Result<HostKind> expect_host(X509_VERIFY_PARAM_st* parameters, const std::string& host);

/// Whether a result of SSL_get_verify_result says that the certificate is another host's.
bool is_other_host(long verify_result);

}  // namespace dripline::pki
