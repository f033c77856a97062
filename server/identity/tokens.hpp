#pragma once

#include <chrono>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "server/identity/account_book.hpp"

namespace dripline::identity {

struct NewToken {
  std::string name;
  std::optional<Role> role = {};                     ///< absent: the highest it may have
  std::optional<std::set<std::string>> groups = {};  ///< absent: those of its user
  std::chrono::days life{90};
};

/// Tokens, of the caller or by an administrator of anybody; sessions are listed and ended like
/// them. Errors of changes: as of Accounts. Any thread.
class Tokens {
 public:
  explicit Tokens(AccountBook& book) : book_(book) {}

  Result<std::vector<Credential>> list(const Caller& by, const std::string& user) const;
  /// A token gets at most the role and the groups that its user and the caller have, and lasts no
  /// longer than a token by which it is made.
  Result<Issued> add(const Caller& by, const std::string& user, const NewToken& token);
  /// Also ends a session.
  Result<void> revoke(const Caller& by, const std::string& user, const std::string& name);

 private:
  AccountBook& book_;
};

}  // namespace dripline::identity
