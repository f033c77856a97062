#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "server/identity/attempt_limits.hpp"
#include "server/identity/directory.hpp"
#include "server/identity/password_hasher.hpp"
#include "server/identity/presented_secret.hpp"
#include "server/identity/refusal_log.hpp"
#include "server/library/audit_trail.hpp"

namespace dripline::identity {

using storage::CredentialKind;
using storage::UserState;

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
  Credential credential;
  std::string secret;
};

struct SignIn {
  std::string user, password, address;
  CredentialKind kind = CredentialKind::Page;  ///< or Login
  std::chrono::hours life{12};
};

struct NewUser {
  std::string name;
  Role role = Role::Viewer;
  std::set<std::string> groups = {};
  std::optional<std::string> password = {};
};

/// What is absent stays as it is.
struct UserChange {
  std::optional<Role> role = {};
  std::optional<std::set<std::string>> groups = {};
  std::optional<bool> is_locked = {};
};

struct NewPassword {
  std::string password;
  std::string current = {};  ///< of the caller who changes the own one
};

struct NewToken {
  std::string name;
  std::optional<Role> role = {};                     ///< absent: the highest it may have
  std::optional<std::set<std::string>> groups = {};  ///< absent: those of its user
  std::chrono::days life{90};
};

/// Users, groups of machines, and what users show to be themselves: passwords, tokens, sessions.
/// Judging a request (`find`, `is_valid`, `may_act_on`) looks into memory and never waits; changes
/// are on disk when they return, and in the audit trail. What takes a right away applies at once,
/// even when it cannot be stored. Any thread.
/// Errors of changes: Denied (the caller may not), NotFound, Conflict, Syntax, LimitExceeded, and
/// the store's.
class Accounts {
 public:
  struct Options {
    PasswordHasher::Options hashing = {};
    AttemptLimits::Options attempts = {};
    RefusalLog::Options refusals = {};
  };
  struct Parts {
    storage::AccountStore& store;
    library::AuditTrail& audit;
    const Clock& clock;
  };
  /// Errors: those of AccountStore::load.
  static Result<std::unique_ptr<Accounts>> open(const Parts& parts, const Options& options);
  Accounts(const Parts& parts, const Options& options, const storage::AccountData& data);

  /// At the start: `secret` is the token of user kFirstUser that the state folder keeps; a server
  /// without users makes that user first. When it is no longer an active administrator the secret
  /// is worth nothing, unless `recover` makes it one again.
  Result<void> use_local_secret(const std::string& secret, bool recover);

  // -- judging requests --
  /// nullopt: it is nobody's, expired, revoked, or of a user that is locked or removed.
  std::optional<Caller> find(const PresentedSecret& presented, const std::string& address);
  /// Whether the caller's credential is still valid, for answers that never end.
  bool is_valid(const Caller& caller) const;
  bool may_act_on(const Caller& caller, const std::string& machine) const;
  /// The groups whose machines the caller may act on.
  std::set<std::string> groups_of(const Caller& caller) const;
  RefusalLog& refusals() { return refusals_; }

  // -- sessions --
  /// Takes 0.1 s and more. Errors: Denied (one text for a wrong password, an unknown, a locked and
  /// a removed user, and one without a password), Busy (too many attempts, or at once),
  /// LimitExceeded (a password over kMaxPassword).
  Result<Issued> sign_in(const SignIn& request);
  /// Ends the caller's session. Errors: Conflict (it is a token).
  Result<void> sign_out(const Caller& caller);

  // -- users --
  std::vector<User> users() const;
  /// Errors: NotFound, Denied (of another user, for callers who are no administrators).
  Result<User> user(const Caller& by, const std::string& name) const;
  Result<User> add_user(const Caller& by, const NewUser& user);
  Result<User> change_user(const Caller& by, const std::string& name, const UserChange& change);
  /// Ends the user's sessions, but not the caller's.
  Result<void> set_password(const Caller& by, const std::string& name, const NewPassword& password);
  Result<void> remove_user(const Caller& by, const std::string& name);

  // -- tokens, of the caller or by an administrator of anybody --
  Result<std::vector<Credential>> credentials(const Caller& by, const std::string& user) const;
  /// A token gets at most the role and the groups that its user and the caller have, and lasts no
  /// longer than a token by which it is made.
  Result<Issued> add_token(const Caller& by, const std::string& user, const NewToken& token);
  /// Also ends a session.
  Result<void> revoke(const Caller& by, const std::string& user, const std::string& name);

  // -- groups of machines --
  std::vector<MachineGroup> groups() const;
  Result<MachineGroup> group(const std::string& name) const;
  struct SavedGroup {
    MachineGroup group;
    bool is_new = false;
  };
  Result<SavedGroup> add_group(const Caller& by, const std::string& name);
  Result<void> remove_group(const Caller& by, const std::string& name);
  Result<MachineGroup> add_machine(const Caller& by, const std::string& group,
                                   const std::string& machine);
  Result<MachineGroup> remove_machine(const Caller& by, const std::string& group,
                                      const std::string& machine);

  /// Now and then: stores which credentials were used, at most once a minute.
  void store_uses();
  /// Now and then: removes sessions that have expired.
  void tidy();
  const PasswordHasher& hasher() const { return hasher_; }

  static constexpr const char* kFirstUser = "admin";
  static constexpr const char* kLocalToken = "local";
  static constexpr std::size_t kMinPassword = 10;    ///< bytes
  static constexpr std::size_t kMaxPassword = 1024;  ///< bytes
  static constexpr std::size_t kMaxName = 64;
  static constexpr std::size_t kMaxUsers = 10'000;
  static constexpr std::size_t kMaxCredentials = 100;  ///< of a user
  static constexpr std::size_t kMaxSessions = 20;      ///< of a user; the oldest one makes room
  static constexpr std::size_t kMaxGroups = 1000;
  static constexpr std::size_t kMaxMachines = 10'000;  ///< of a group
  static constexpr std::chrono::days kMaxTokenLife{730};
  static constexpr std::chrono::hours kMaxSessionLife{720};

 private:
  void note(const storage::Actor& who, std::string action, std::string subject, std::string detail);
  void note_refused(const SignIn& request, bool is_known, std::string_view why);
  Result<User> known_user(const std::string& name) const;
  Result<User> manageable(const Caller& by, const std::string& name) const;
  Result<std::string> verified(const SignIn& request);
  Result<Issued> begin_session(const SignIn& request);
  std::string owner_of(const std::string& group) const;
  std::vector<std::string> sessions_of(const std::string& user) const;
  Result<void> check_token(const Caller& by, const User& owner, const Credential& token) const;
  Result<void> check_groups(const std::set<std::string>& groups) const;
  Result<MachineGroup> change_group(const Caller& by, const std::string& name,
                                    const std::function<void(MachineGroup&)>& change,
                                    const std::string& detail);

  storage::AccountStore& store_;
  library::AuditTrail& audit_;
  const Clock& clock_;
  PasswordHasher hasher_;
  AttemptLimits attempts_;
  RefusalLog refusals_;
  std::mutex changing_;  ///< one change at a time; taken before mutex_
  mutable std::mutex mutex_;
  Directory directory_;    ///< changed with both taken; only note_use needs mutex_ alone
  std::set<Digest> used_;  ///< since they were stored last
  SteadyTime uses_stored_;
};

/// A name of a user, a token or a group: 1 to 64 characters, lower-case letters, digits, `.`, `-`
/// and `_`, beginning with a letter or digit. Errors: Syntax.
Result<void> check_account_name(std::string_view what, std::string_view name);

}  // namespace dripline::identity
