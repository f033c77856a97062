#pragma once

#include <mutex>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "server/identity/caller.hpp"
#include "server/identity/directory.hpp"
#include "server/library/audit_trail.hpp"

namespace dripline::identity {

using storage::UserState;

/// The accounts that Sessions, Users, Tokens and MachineGroups share: in memory, in the store and
/// in the audit trail. Reading never waits for the store. Any thread.
class AccountBook {
 public:
  struct Parts {
    storage::AccountStore& store;
    library::AuditTrail& audit;
    const Clock& clock;
  };
  AccountBook(const Parts& parts, const storage::AccountData& data)
      : parts_(parts), directory_(data) {}

  storage::AccountStore& store() const { return parts_.store; }
  const Clock& clock() const { return parts_.clock; }
  void note(const storage::Actor& who, std::string action, std::string subject, std::string detail);

  /// One change at a time: taken before anything is read that the change depends on.
  [[nodiscard]] std::unique_lock<std::mutex> begin_change() { return std::unique_lock(changing_); }
  /// `look` gets the directory as it is now and keeps no reference into it.
  template <class Look>
  auto read(Look look) const {
    const std::lock_guard lock(mutex_);
    return look(directory_);
  }
  /// After begin_change, but for the use of a credential, which is no change.
  template <class Update>
  auto update(Update update) {
    const std::lock_guard lock(mutex_);
    return update(directory_);
  }
  template <class Entry>
  void put(const Entry& entry) {
    update([&](Directory& directory) { directory.put(entry); });
  }

  /// Errors: NotFound, also of a removed user.
  Result<User> user(const std::string& name) const;
  /// The user, when the caller may change its password and tokens. Errors: NotFound, Denied.
  Result<User> manageable(const Caller& by, const std::string& name) const;
  /// Errors: NotFound.
  Result<MachineGroup> group(const std::string& name) const;
  Result<void> check_groups(const std::set<std::string>& groups) const;
  /// The names of the user's sessions, oldest first.
  std::vector<std::string> sessions_of(const std::string& user) const;

 private:
  const Parts parts_;
  std::mutex changing_;  ///< taken before mutex_
  mutable std::mutex mutex_;
  Directory directory_;  ///< changed with both taken; only note_use needs mutex_ alone
};

/// A token or session of `user` that is limited, to a lower role or to groups, gives itself nothing
/// and takes nothing from others: that would be more than it has. Errors: Denied.
Result<void> check_unlimited(const Caller& by, const User& user);

/// A name of a user, a token or a group: 1 to 64 characters, lower-case letters, digits, `.`, `-`
/// and `_`, beginning with a letter or digit. Errors: Syntax.
Result<void> check_account_name(std::string_view what, std::string_view name);
bool is_session(const Credential& credential);
/// "lathes, mills", or "none".
std::string names_text(const std::set<std::string>& names);
/// A right was taken away, but the disk does not know it.
Error only_until_restart(const std::string& what, const Error& error);
/// 256 random bits.
std::string new_secret();

}  // namespace dripline::identity
