#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/identity/passwords.hpp"

namespace dripline::identity {

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

/// The users. Errors of changes: as of Accounts. Any thread.
class Users {
 public:
  Users(AccountBook& book, Passwords& passwords) : book_(book), passwords_(passwords) {}

  std::vector<User> list() const;
  /// Errors: NotFound, Denied (of another user, for callers who are no administrators).
  Result<User> find(const Caller& by, const std::string& name) const;
  Result<User> add(const Caller& by, const NewUser& user);
  Result<User> change(const Caller& by, const std::string& name, const UserChange& change);
  /// Ends the user's sessions, but not the caller's.
  Result<void> set_password(const Caller& by, const std::string& name, const NewPassword& password);
  Result<void> remove(const Caller& by, const std::string& name);

 private:
  Result<void> check_other_administrator(const std::string& name) const;

  AccountBook& book_;
  Passwords& passwords_;
};

}  // namespace dripline::identity
