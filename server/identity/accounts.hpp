#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "server/identity/machine_groups.hpp"
#include "server/identity/presented_secret.hpp"
#include "server/identity/sessions.hpp"
#include "server/identity/tokens.hpp"
#include "server/identity/users.hpp"

namespace dripline::identity {

/// Who may do what: judging requests here, changes in the parts. Judging looks into memory and
/// never waits; changes are on disk when they return, and in the audit trail. What takes a right
/// away applies at once, even when it cannot be stored. Any thread.
/// Errors of changes: Denied (the caller may not), NotFound, Conflict, Syntax, LimitExceeded, and
/// the store's.
class Accounts {
 public:
  struct Options {
    PasswordHasher::Options hashing = {};
    AttemptLimits::Options attempts = {};
    RefusalLog::Options refusals = {};
  };
  using Parts = AccountBook::Parts;
  /// Errors: those of AccountStore::load.
  static Result<std::unique_ptr<Accounts>> open(const Parts& parts, const Options& options);
  Accounts(const Parts& parts, const Options& options, const storage::AccountData& data);

  /// At the start: `secret` is the token of user kFirstUser that the state folder keeps; a server
  /// without users makes that user first. When it is no longer an active administrator the secret
  /// is worth nothing, unless `recover` makes it one again.
  Result<void> use_local_secret(const std::string& secret, bool recover);

  /// nullopt: it is unknown, expired, revoked, or of a user that is locked or removed.
  std::optional<Caller> find(const PresentedSecret& presented, const std::string& address);
  /// By a certificate instead of a secret: the user of its name, with all his rights. nullopt:
  /// there is no such user, he is locked or removed, or it has expired or was revoked.
  std::optional<Caller> find(const ClientCertificate& certificate,
                             const std::string& address) const;
  /// Serials of certificates that are worth nothing any more, in place of the last ones.
  void revoke_certificates(std::set<std::string> serials);
  /// Whether the caller's credential is still valid, for answers that never end.
  bool is_valid(const Caller& caller) const;
  bool may_act_on(const Caller& caller, const std::string& machine) const;
  /// The groups whose machines the caller may act on.
  std::set<std::string> groups_of(const Caller& caller) const;

  Sessions& sessions() { return sessions_; }
  Users& users() { return users_; }
  Tokens& tokens() { return tokens_; }
  MachineGroups& groups() { return groups_; }
  RefusalLog& refusals() { return refusals_; }
  const PasswordHasher& hasher() const { return passwords_.hasher(); }

  /// Now and then: stores which credentials were used, at most once a minute.
  void store_uses();

  static constexpr const char* kFirstUser = "admin";
  static constexpr const char* kLocalToken = "local";

 private:
  Result<void> save_first_user(bool recover);

  AccountBook book_;
  RefusalLog refusals_;
  Passwords passwords_;
  Sessions sessions_{book_, passwords_};
  Users users_{book_, passwords_};
  Tokens tokens_{book_};
  MachineGroups groups_{book_};
  bool is_revoked(const std::string& serial) const;

  mutable std::mutex revoked_mutex_;
  std::set<std::string> revoked_;  ///< serials of certificates
  std::mutex uses_mutex_;
  std::set<Digest> used_;  ///< since they were stored last
  SteadyTime uses_stored_;
};

}  // namespace dripline::identity
