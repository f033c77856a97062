#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/digest.hpp"
#include "protocol/base/result.hpp"

namespace dripline::storage {

/// What a user may do; each role may do what those before it may.
enum class Role : std::uint8_t { Viewer, Operator, Programmer, Approver, Administrator };
std::string_view to_string(Role role);
/// Errors: Unsupported (names the known ones).
Result<Role> parse_role(std::string_view name);

enum class UserState : std::uint8_t { Active, Locked, Removed };
std::string_view to_string(UserState state);

struct User {
  std::string name;
  Role role = Role::Viewer;
  std::set<std::string> groups;  ///< whose machines the user may act on
  std::string password;          ///< its argon2id digest, salt and cost; empty: none
  UserState state = UserState::Active;
  UtcTime created;
  std::optional<UtcTime> signed_in;  ///< last time with the password
};

/// Token: named, for programs. Login: what `dnc login` keeps. Page: in a cookie of the web page.
enum class CredentialKind : std::uint8_t { Token, Login, Page };
std::string_view to_string(CredentialKind kind);

/// What a request carries instead of a password.
struct Credential {
  std::string user;
  std::string name;  ///< one per user
  CredentialKind kind = CredentialKind::Token;
  Digest sha256;  ///< of the secret, which is stored nowhere
  Role role = Role::Viewer;
  std::optional<std::set<std::string>> groups;  ///< at most these; absent: the user's
  UtcTime created;
  std::optional<UtcTime> expires;  ///< absent: never
  std::optional<UtcTime> used;     ///< about a minute late
  std::string used_from;
};

struct MachineGroup {
  std::string name;
  std::set<std::string> machines;
};
/// The group of every machine, also of those to come. It is always there and has no members.
inline constexpr const char* kAllMachines = "all";

struct AccountData {
  std::vector<User> users;
  std::vector<Credential> credentials;
  std::vector<MachineGroup> groups;
};

struct CredentialUse {
  std::string user, name;
  UtcTime used;
  std::string from;
};

/// Users, what they sign in with, and groups of machines. Promises of every store:
/// storage/store.hpp.
class AccountStore {
 public:
  virtual ~AccountStore() = default;

  /// Everything, also removed users. Errors: Corrupt (a word that is none of ours).
  virtual Result<AccountData> load() = 0;
  /// Adds or changes a user; `ended` credentials are removed with it, of a removed user all.
  /// Errors: Conflict (a group that is not there).
  virtual Result<void> save_user(const User& user, const std::vector<std::string>& ended) = 0;
  /// Adds or replaces one; `ended` ones of the same user are removed with it. Errors: Conflict (no
  /// such user or group, another credential has this digest).
  virtual Result<void> save_credential(const Credential& credential,
                                       const std::vector<std::string>& ended) = 0;
  /// Those that are not there are skipped.
  virtual Result<void> remove_credentials(const std::string& user,
                                          const std::vector<std::string>& names) = 0;
  virtual Result<void> note_uses(const std::vector<CredentialUse>& uses) = 0;
  virtual Result<void> save_group(const MachineGroup& group) = 0;
  /// Errors: Conflict (a user or a token has it).
  virtual Result<void> remove_group(const std::string& name) = 0;
};

}  // namespace dripline::storage
