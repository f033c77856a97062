#pragma once

#include <openssl/ssl.h>
#include <optional>

#include "server/identity/caller.hpp"

namespace dripline::api {

/// Of the client at the other end, when the handshake has verified it against the authority of
/// clients. nullopt: it has shown none, or one without exactly one common name.
std::optional<identity::ClientCertificate> peer_certificate(SSL* connection);

}  // namespace dripline::api
