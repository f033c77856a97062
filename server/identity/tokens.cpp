#include "server/identity/tokens.hpp"

#include <algorithm>

#include "server/identity/account_limits.hpp"
#include "server/identity/accounts.hpp"

namespace dripline::identity {
namespace {

/// At most what its user and the caller have.
Result<void> check_token(const Caller& by, const User& owner, const Credential& token) {
  const Role highest = std::min(owner.role, by.role);
  if (token.role > highest) {
    return fail(Errc::Denied, "a token of role {}: at most {}", storage::to_string(token.role),
                storage::to_string(highest));
  }
  if (by.kind == CredentialKind::Token && by.expires && *token.expires > *by.expires) {
    return fail(Errc::Denied, "a token that lasts until {}: {}, by which it is made, ends at {}",
                to_iso8601(*token.expires), by.credential, to_iso8601(*by.expires));
  }
  const auto reaches = [](const std::set<std::string>& groups, const std::string& group) {
    return groups.contains(storage::kAllMachines) || groups.contains(group);
  };
  for (const auto& group : token.groups.value_or(std::set<std::string>{})) {
    const bool is_owners = owner.role == Role::Administrator || reaches(owner.groups, group);
    if (!is_owners || (by.groups && !reaches(*by.groups, group)))
      return fail(Errc::Denied, "a token for machine group {}, which {} does not have", group,
                  is_owners ? by.credential : owner.name);
  }
  if (token.role == Role::Administrator && token.groups) {
    return fail(Errc::Conflict,
                "a token of role administrator has every machine: give it a lower role to limit "
                "its groups");
  }
  return {};
}

Result<void> check_room(const Directory& directory, const Credential& token) {
  if (directory.credential(token.user, token.name) != nullptr)
    return fail(Errc::Conflict, "user {} has a token {} already", token.user, token.name);
  constexpr std::size_t kMax = AccountLimits::kMaxCredentials;
  if (directory.number_of_credentials(token.user) < kMax) return {};
  return fail(Errc::LimitExceeded, "user {} has {} tokens and sessions: at most {}", token.user,
              kMax, kMax);
}

}  // namespace

Result<std::vector<Credential>> Tokens::list(const Caller& by, const std::string& user) const {
  if (auto good = book_.manageable(by, user); !good) return fail(good.error());
  return book_.read([&](const Directory& directory) { return directory.credentials_of(user); });
}

Result<Issued> Tokens::add(const Caller& by, const std::string& user, const NewToken& wanted) {
  if (auto good = check_account_name("token", wanted.name); !good) return fail(good.error());
  if (wanted.life < std::chrono::days(1) || wanted.life > AccountLimits::kMaxTokenLife) {
    return fail(Errc::LimitExceeded, "a token for {} days: 1 to {}", wanted.life.count(),
                AccountLimits::kMaxTokenLife.count());
  }
  if (wanted.groups) {
    if (auto good = book_.check_groups(*wanted.groups); !good) return fail(good.error());
  }
  const auto changing = book_.begin_change();
  const auto owner = book_.manageable(by, user);
  if (!owner) return fail(owner.error());
  Issued issued;
  issued.secret = new_secret();
  Credential& token = issued.credential;
  token.user = user;
  token.name = wanted.name;
  token.sha256 = sha256(issued.secret);
  token.role = wanted.role.value_or(std::min(owner->role, by.role));
  token.groups = wanted.groups ? wanted.groups : by.groups;
  token.created = book_.clock().now();
  token.expires = token.created + wanted.life;
  if (auto good = check_token(by, *owner, token); !good) return fail(good.error());
  const auto room = book_.read([&](const Directory& d) { return check_room(d, token); });
  if (!room) return fail(room.error());
  if (auto saved = book_.store().save_credential(token, {}); !saved) return fail(saved.error());
  book_.put(token);
  book_.note(
      by.actor(), "token.add", user,
      fmt::format("{}, role {}, groups {}, until {}", token.name, storage::to_string(token.role),
                  token.groups ? names_text(*token.groups) : "of the user",
                  to_iso8601(*token.expires)));
  return issued;
}

Result<void> Tokens::revoke(const Caller& by, const std::string& user, const std::string& name) {
  const auto changing = book_.begin_change();
  const auto owner = book_.manageable(by, user);
  if (!owner) return fail(owner.error());
  if (by.user != user || by.credential != name) {
    if (auto good = check_unlimited(by, *owner); !good) return good;
  }
  if (user == Accounts::kFirstUser && name == Accounts::kLocalToken) {
    return fail(Errc::Conflict,
                "token {} is the one of the state folder: remove its file there and start the "
                "server again for a new one",
                name);
  }
  const bool is_known = book_.update([&](Directory& directory) {
    const bool was_there = directory.credential(user, name) != nullptr;
    directory.remove_credential(user, name);
    return was_there;
  });
  if (!is_known) return fail(Errc::NotFound, "user {} has no token {}", user, name);
  book_.note(by.actor(), "token.revoke", user, name);
  if (auto removed = book_.store().remove_credentials(user, {name}); !removed)
    return fail(only_until_restart(fmt::format("token {} is revoked", name), removed.error()));
  return {};
}

}  // namespace dripline::identity
