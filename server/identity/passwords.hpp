#pragma once

#include <string>

#include "server/identity/account_book.hpp"
#include "server/identity/attempt_limits.hpp"
#include "server/identity/password_hasher.hpp"
#include "server/identity/refusal_log.hpp"

namespace dripline::identity {

/// Whether a password is its user's, how often it may be tried, and new ones. Takes 0.1 s and
/// more. Any thread.
class Passwords {
 public:
  struct Options {
    PasswordHasher::Options hashing = {};
    AttemptLimits::Options attempts = {};
  };
  struct Attempt {
    std::string user, password, address;
  };
  Passwords(const AccountBook& book, RefusalLog& refusals, const Options& options)
      : book_(book), refusals_(refusals), hasher_(options.hashing), attempts_(options.attempts) {}

  /// The digest that the password was compared with. Errors: Denied (one text for a wrong
  /// password, an unknown, a locked and a removed user, and one without a password), Busy (too
  /// many attempts, or at once), LimitExceeded (a password over kMaxPassword).
  Result<std::string> verify(const Attempt& attempt);
  /// Whether a new password may be taken. Errors: Syntax, LimitExceeded (its length).
  static Result<void> check(const std::string& password);
  /// Errors: those of the hasher.
  Result<std::string> hash(const std::string& password) { return hasher_.hash(password); }
  /// A digest for a password that `outdated` was right for, when it should be replaced; else empty.
  std::string renewed(const std::string& outdated, const std::string& password);
  const PasswordHasher& hasher() const { return hasher_; }

  static Error denied();

 private:
  void note_refused(const Attempt& attempt, bool is_known, std::string_view why);

  const AccountBook& book_;
  RefusalLog& refusals_;
  PasswordHasher hasher_;
  AttemptLimits attempts_;
};

}  // namespace dripline::identity
