#include "server/identity/accounts.hpp"

#include <algorithm>

#include "protocol/process/log.hpp"

namespace dripline::identity {

Result<std::unique_ptr<Accounts>> Accounts::open(const Parts& parts, const Options& options) {
  const auto data = parts.store.load();
  if (!data) return fail(data.error());
  return std::make_unique<Accounts>(parts, options, *data);
}

Accounts::Accounts(const Parts& parts, const Options& options, const storage::AccountData& data)
    : book_(parts, data),
      refusals_(parts.audit, options.refusals),
      passwords_(book_, refusals_, {.hashing = options.hashing, .attempts = options.attempts}),
      uses_stored_(parts.clock.steady_now()) {}

/// Of a server without users, or when `recover` asks for it.
Result<void> Accounts::save_first_user(bool recover) {
  const bool is_first =
      book_.read([](const Directory& directory) { return directory.users().empty(); });
  if (!is_first && !recover) return {};
  User first = book_.read([&](const Directory& directory) {
    const User* const known = directory.user(kFirstUser);
    if (known != nullptr) return *known;
    User made;
    made.name = kFirstUser;
    made.created = book_.clock().now();
    return made;
  });
  first.role = Role::Administrator;
  first.state = UserState::Active;
  if (auto saved = book_.store().save_user(first, {}); !saved) return saved;
  book_.put(first);
  book_.note("dncd", is_first ? "user.add" : "user.recover", kFirstUser, "");
  return {};
}

Result<void> Accounts::use_local_secret(const std::string& secret, bool recover) {
  const auto changing = book_.begin_change();
  if (auto saved = save_first_user(recover); !saved) return saved;
  const auto first = book_.user(kFirstUser);
  if (!first || first->state != UserState::Active) {
    process::log_info("user {} is locked or removed: the token of the state folder is not used",
                      kFirstUser);
    return {};
  }
  const Digest digest = sha256(secret);
  const bool is_same = book_.read([&](const Directory& directory) {
    const Credential* const known = directory.credential(kFirstUser, kLocalToken);
    return known != nullptr && known->sha256 == digest;
  });
  if (is_same) return {};
  Credential token;
  token.user = kFirstUser;
  token.name = kLocalToken;
  token.sha256 = digest;
  token.role = Role::Administrator;
  token.created = book_.clock().now();
  if (auto saved = book_.store().save_credential(token, {}); !saved) return saved;
  book_.note("dncd", "token.add", kFirstUser, fmt::format("{}, of the state folder", kLocalToken));
  book_.put(token);
  return {};
}

std::optional<Caller> Accounts::find(const PresentedSecret& presented, const std::string& address) {
  if (presented.secret.empty()) return std::nullopt;
  const Digest digest = sha256(presented.secret);
  const UtcTime now = book_.clock().now();
  auto caller = book_.update([&](Directory& directory) -> std::optional<Caller> {
    const Credential* const found = directory.valid(digest, now);
    if (found == nullptr) return std::nullopt;
    // A cookie is no token and a token no cookie: each has its own protection.
    const bool is_page = found->kind == CredentialKind::Page;
    if (is_page != (presented.from == PresentedSecret::From::Cookie)) return std::nullopt;
    Caller known{.user = found->user,
                 .role = directory.role_of(*found),
                 .credential = found->name,
                 .kind = found->kind,
                 .groups = found->groups,
                 .expires = found->expires,
                 .sha256 = digest,
                 .address = address};
    directory.note_use(digest, now, address);
    return known;
  });
  if (!caller) return caller;
  const std::lock_guard lock(uses_mutex_);
  used_.insert(digest);
  return caller;
}

namespace {

/// A certificate as a credential of its user: it limits nothing, and no store has it.
Credential as_credential(const std::string& user, const std::string& serial) {
  Credential shown;
  shown.user = user;
  shown.name = "certificate " + serial;
  shown.role = Role::Administrator;  // the user's own is the lower one
  return shown;
}

bool is_active(const Directory& directory, const std::string& user) {
  const User* const found = directory.user(user);
  return found != nullptr && found->state == UserState::Active;
}

}  // namespace

std::optional<Caller> Accounts::find(const ClientCertificate& certificate,
                                     const std::string& address) const {
  const bool is_over = certificate.expires <= book_.clock().now();
  if (is_over || certificate.serial.empty() || is_revoked(certificate.serial)) return std::nullopt;
  return book_.read([&](const Directory& directory) -> std::optional<Caller> {
    if (!is_active(directory, certificate.user)) return std::nullopt;
    const Credential shown = as_credential(certificate.user, certificate.serial);
    return Caller{.user = certificate.user,
                  .role = directory.role_of(shown),
                  .credential = shown.name,
                  .kind = CredentialKind::Token,
                  .groups = {},
                  .expires = certificate.expires,
                  .sha256 = {},
                  .address = address,
                  .certificate = certificate.serial};
  });
}

void Accounts::revoke_certificates(std::set<std::string> serials) {
  const std::lock_guard lock(revoked_mutex_);
  revoked_ = std::move(serials);
}

bool Accounts::is_revoked(const std::string& serial) const {
  const std::lock_guard lock(revoked_mutex_);
  return revoked_.contains(serial);
}

bool Accounts::is_valid(const Caller& caller) const {
  const UtcTime now = book_.clock().now();
  if (!caller.certificate.empty()) {
    return caller.expires > now && !is_revoked(caller.certificate) &&
           book_.read(
               [&](const Directory& directory) { return is_active(directory, caller.user); });
  }
  return book_.read(
      [&](const Directory& directory) { return directory.valid(caller.sha256, now) != nullptr; });
}

bool Accounts::may_act_on(const Caller& caller, const std::string& machine) const {
  const UtcTime now = book_.clock().now();
  return book_.read([&](const Directory& directory) {
    if (!caller.certificate.empty()) {
      return is_active(directory, caller.user) &&
             directory.may_act_on(as_credential(caller.user, caller.certificate), machine);
    }
    const Credential* const found = directory.valid(caller.sha256, now);
    return found != nullptr && directory.may_act_on(*found, machine);
  });
}

std::set<std::string> Accounts::groups_of(const Caller& caller) const {
  const auto owner = book_.read([&](const Directory& directory) -> std::optional<User> {
    const User* const found = directory.user(caller.user);
    return found == nullptr ? std::nullopt : std::optional(*found);
  });
  if (!owner) return {};
  const std::set<std::string> every{storage::kAllMachines};
  const auto& owners = owner->role == Role::Administrator ? every : owner->groups;
  if (!caller.groups || caller.groups->contains(storage::kAllMachines)) return owners;
  if (owners.contains(storage::kAllMachines)) return *caller.groups;
  std::set<std::string> both;
  std::ranges::set_intersection(owners, *caller.groups, std::inserter(both, both.end()));
  return both;
}

void Accounts::store_uses() {
  constexpr std::chrono::seconds kInterval{60};
  std::set<Digest> used;
  {
    const std::lock_guard lock(uses_mutex_);
    const SteadyTime now = book_.clock().steady_now();
    if (used_.empty() || now - uses_stored_ < kInterval) return;
    uses_stored_ = now;
    used = std::exchange(used_, {});
  }
  const auto uses = book_.read([&](const Directory& directory) {
    std::vector<storage::CredentialUse> list;
    for (const auto& digest : used) {
      const Credential* const found = directory.credential(digest);
      if (found != nullptr && found->used)
        list.push_back({found->user, found->name, *found->used, found->used_from});
    }
    return list;
  });
  if (auto noted = book_.store().note_uses(uses); !noted)
    process::log_warning("last uses of tokens are not stored: {}", noted.error().what);
}

}  // namespace dripline::identity
