#pragma once

#include <optional>
#include <set>
#include <string>

#include "storage/account_store.hpp"
#include "storage/actor.hpp"

namespace dripline::identity {

using storage::CredentialKind;
using storage::Role;

/// Whose request it is, by which credential, and from where.
struct Caller {
  std::string user;
  Role role = Role::Viewer;  ///< the lower of the user's and the credential's
  std::string credential;    ///< its name
  CredentialKind kind = CredentialKind::Token;
  std::optional<std::set<std::string>> groups;  ///< of the credential, when it has its own
  std::optional<UtcTime> expires;
  Digest sha256;
  std::string address;

  storage::Actor actor() const { return {user, credential, address}; }
};

/// A new credential. Its secret is shown once and stored nowhere.
struct Issued {
  storage::Credential credential;
  std::string secret;
};

}  // namespace dripline::identity
