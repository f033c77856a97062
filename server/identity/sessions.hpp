#pragma once

#include <chrono>
#include <string>

#include "server/identity/passwords.hpp"

namespace dripline::identity {

struct SignIn {
  std::string user, password, address;
  CredentialKind kind = CredentialKind::Page;  ///< or Login
  std::chrono::hours life{12};
};

/// What users who signed in with their passwords keep until they sign out. Any thread.
class Sessions {
 public:
  Sessions(AccountBook& book, Passwords& passwords) : book_(book), passwords_(passwords) {}

  /// Takes 0.1 s and more. Errors: those of Passwords::verify, and the store's.
  Result<Issued> sign_in(const SignIn& request);
  /// Ends the caller's session. Errors: Conflict (it is a token).
  Result<void> sign_out(const Caller& caller);
  /// Now and then: removes sessions that have expired.
  void tidy();

 private:
  Result<Issued> begin(const SignIn& request);

  AccountBook& book_;
  Passwords& passwords_;
};

}  // namespace dripline::identity
