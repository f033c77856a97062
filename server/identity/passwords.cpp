#include "server/identity/passwords.hpp"

#include "protocol/process/log.hpp"
#include "server/identity/account_limits.hpp"

namespace dripline::identity {

Error Passwords::denied() {
  return {Errc::Denied, "user and password do not belong together, or the user is locked"};
}

/// A name that no user has may be a password in the wrong field, so it is not written down.
void Passwords::note_refused(const Attempt& attempt, bool is_known, std::string_view why) {
  refusals_.note({.who = {is_known ? attempt.user : "", "", attempt.address},
                  .action = "sign-in.refused",
                  .subject = is_known ? attempt.user : "unknown user",
                  .detail = std::string(why)});
}

Result<std::string> Passwords::verify(const Attempt& attempt) {
  if (attempt.password.size() > AccountLimits::kMaxPassword) {
    return fail(Errc::LimitExceeded, "a password of {} bytes: at most {}", attempt.password.size(),
                AccountLimits::kMaxPassword);
  }
  const auto user = book_.user(attempt.user);
  const std::string limited = attempt.user.substr(0, AccountLimits::kMaxName);
  if (const auto wait = attempts_.begin(limited, attempt.address, book_.clock().steady_now())) {
    note_refused(attempt, user.has_value(), "too many attempts");
    return fail(Errc::Busy, "too many attempts to sign in: try again in {} s", wait->count());
  }
  const std::string digest = user ? user->password : "";
  const auto is_right = hasher_.verify(digest, attempt.password);
  if (!is_right && is_right.error().code == Errc::Busy) {
    attempts_.give_back(limited, attempt.address);
    return fail(is_right.error());
  }
  if (!is_right) process::log_error("user {}: {}", attempt.user, is_right.error().what);
  if (is_right && *is_right && user->state == UserState::Active) {
    attempts_.succeed(limited, attempt.address);
    return digest;
  }
  note_refused(attempt, user.has_value(),
               is_right && *is_right ? "the user is locked" : "wrong password");
  return fail(denied());
}

Result<void> Passwords::check(const std::string& password) {
  constexpr std::size_t kMin = AccountLimits::kMinPassword;
  constexpr std::size_t kMax = AccountLimits::kMaxPassword;
  if (password.size() < kMin)
    return fail(Errc::Syntax, "a password of {} characters: at least {}", password.size(), kMin);
  if (password.size() <= kMax) return {};
  return fail(Errc::LimitExceeded, "a password of {} bytes: at most {}", password.size(), kMax);
}

std::string Passwords::renewed(const std::string& outdated, const std::string& password) {
  if (!hasher_.is_outdated(outdated)) return {};
  return hasher_.hash(password).value_or("");
}

}  // namespace dripline::identity
