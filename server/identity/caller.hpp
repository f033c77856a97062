#pragma once

#include <optional>
#include <set>
#include <string>

#include "storage/account_store.hpp"
#include "storage/actor.hpp"

namespace dripline::identity {

using storage::CredentialKind;
using storage::Role;

/// What the other end of a TLS connection has proved to have, issued by the authority of clients.
struct ClientCertificate {
  std::string user;    ///< its common name
  std::string serial;  ///< hexadecimal digits, capitals
  UtcTime expires;
};

/// Whose request it is, by which credential, and from where.
struct Caller {
  std::string user;
  Role role = Role::Viewer;  ///< the lower of the user's and the credential's
  std::string credential;    ///< its name
  CredentialKind kind = CredentialKind::Token;
  std::optional<std::set<std::string>> groups;  ///< of the credential, when it has its own
  std::optional<UtcTime> expires;
  Digest sha256;  ///< of the credential; of a certificate none
  std::string address;
  std::string certificate =
      {};  ///< serial of the certificate that shows the user; empty: a credential

  storage::Actor actor() const { return {user, credential, address}; }
};

/// A new credential. Its secret is shown once and stored nowhere.
struct Issued {
  storage::Credential credential;
  std::string secret;
};

}  // namespace dripline::identity
