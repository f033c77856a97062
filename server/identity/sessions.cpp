#include "server/identity/sessions.hpp"

#include <map>

#include "protocol/base/random.hpp"
#include "protocol/process/log.hpp"
#include "server/identity/account_limits.hpp"

namespace dripline::identity {

Result<Issued> Sessions::sign_in(const SignIn& request) {
  const auto digest = passwords_.verify({request.user, request.password, request.address});
  if (!digest) return fail(digest.error());
  const std::string renewed = passwords_.renewed(*digest, request.password);
  const auto changing = book_.begin_change();
  auto user = book_.user(request.user);
  // Locked, or given another password, while this one was compared.
  if (!user || user->state != UserState::Active || user->password != *digest)
    return fail(Passwords::denied());
  if (!renewed.empty()) user->password = renewed;
  user->signed_in = book_.clock().now();
  if (auto saved = book_.store().save_user(*user, {}); !saved) return fail(saved.error());
  book_.put(*user);
  return begin(request);
}

/// The caller has begun the change.
Result<Issued> Sessions::begin(const SignIn& request) {
  auto ended = book_.sessions_of(request.user);
  constexpr std::size_t kMax = AccountLimits::kMaxSessions;
  ended.resize(ended.size() < kMax ? 0 : ended.size() - kMax + 1);
  const UtcTime now = book_.clock().now();
  Issued issued;
  issued.secret = new_secret();
  Credential& session = issued.credential;
  session.user = request.user;
  constexpr std::size_t kNameBytes = 4;
  session.name = fmt::format("{}-{}", storage::to_string(request.kind), random_hex(kNameBytes));
  session.kind = request.kind;
  session.sha256 = sha256(issued.secret);
  session.role = Role::Administrator;  // as high as the user's, whatever that becomes
  session.created = now;
  session.expires = now + std::min(request.life, AccountLimits::kMaxSessionLife);
  session.used = now;
  session.used_from = request.address;
  if (auto saved = book_.store().save_credential(session, ended); !saved)
    return fail(saved.error());
  book_.update([&](Directory& directory) {
    for (const auto& name : ended) directory.remove_credential(request.user, name);
    directory.put(session);
  });
  book_.note(
      {request.user, session.name, request.address}, "sign-in", request.user,
      fmt::format("{} until {}", storage::to_string(request.kind), to_iso8601(*session.expires)));
  return issued;
}

Result<void> Sessions::sign_out(const Caller& caller) {
  if (caller.kind == CredentialKind::Token) {
    return fail(Errc::Conflict, "token {} is no session: revoke it to end it", caller.credential);
  }
  const auto changing = book_.begin_change();
  book_.update(
      [&](Directory& directory) { directory.remove_credential(caller.user, caller.credential); });
  book_.note(caller.actor(), "sign-out", caller.user, "");
  if (auto removed = book_.store().remove_credentials(caller.user, {caller.credential}); !removed)
    return fail(only_until_restart("signed out", removed.error()));
  return {};
}

void Sessions::tidy() {
  const auto changing = book_.begin_change();
  const UtcTime now = book_.clock().now();
  std::map<std::string, std::vector<std::string>> expired;
  book_.read([&](const Directory& directory) {
    for (const auto& [name, user] : directory.users()) {
      for (const auto& credential : directory.credentials_of(name)) {
        if (is_session(credential) && credential.expires && *credential.expires <= now)
          expired[name].push_back(credential.name);
      }
    }
  });
  for (const auto& entry : expired) {
    const auto& user = entry.first;
    const auto& names = entry.second;
    if (auto removed = book_.store().remove_credentials(user, names); !removed) {
      process::log_warning("expired sessions are not removed: {}", removed.error().what);
      return;
    }
    book_.update([&](Directory& directory) {
      for (const auto& name : names) directory.remove_credential(user, name);
    });
  }
}

}  // namespace dripline::identity
