#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "storage/account_store.hpp"

namespace dripline::identity {

using storage::Credential;
using storage::MachineGroup;
using storage::Role;
using storage::User;

/// Users, credentials and groups in memory, as the store has them, so that a request is judged
/// without waiting. A value; not thread-safe.
class Directory {
 public:
  Directory() = default;
  explicit Directory(const storage::AccountData& data);

  const User* user(const std::string& name) const;
  const std::map<std::string, User>& users() const { return users_; }
  const Credential* credential(const Digest& sha256) const;
  const Credential* credential(const std::string& user, const std::string& name) const;
  std::vector<Credential> credentials_of(const std::string& user) const;
  std::size_t number_of_credentials(const std::string& user) const;
  const MachineGroup* group(const std::string& name) const;
  const std::map<std::string, MachineGroup>& groups() const { return groups_; }

  void put(const User& user);
  /// Replaces the one of the same user and name.
  void put(const Credential& credential);
  void put(const MachineGroup& group);
  void remove_credential(const std::string& user, const std::string& name);
  void remove_credentials_of(const std::string& user);
  void remove_group(const std::string& name);
  void note_use(const Digest& sha256, UtcTime now, const std::string& from);

  /// The credential with this digest, while it is valid: it has not expired and its user is active.
  const Credential* valid(const Digest& sha256, UtcTime now) const;
  /// The lower of the user's role and the credential's.
  Role role_of(const Credential& credential) const;
  /// Whether both the user and the credential may act on this machine.
  bool may_act_on(const Credential& credential, const std::string& machine) const;
  /// Whether `machine` is in one of these groups.
  bool holds(const std::set<std::string>& groups, const std::string& machine) const;
  /// Whether another user than `name` is an active administrator who has a password or a token.
  bool has_other_administrator(const std::string& name) const;

 private:
  std::map<std::string, User> users_;
  std::map<Digest, Credential> credentials_;
  std::map<std::pair<std::string, std::string>, Digest> names_;  ///< (user, name)
  std::map<std::string, MachineGroup> groups_;
};

}  // namespace dripline::identity
