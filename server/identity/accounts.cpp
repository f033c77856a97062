#include "server/identity/accounts.hpp"

#include <fmt/ranges.h>
#include <algorithm>

#include "protocol/base/names.hpp"
#include "protocol/base/random.hpp"
#include "protocol/process/log.hpp"

namespace dripline::identity {
namespace {

constexpr std::size_t kSecretBytes = 32;

std::string list_text(const std::set<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

bool is_session(const Credential& credential) {
  return credential.kind != CredentialKind::Token;
}

Result<void> check_password(const std::string& password) {
  if (password.size() < Accounts::kMinPassword) {
    return fail(Errc::Syntax, "a password of {} characters: at least {}", password.size(),
                Accounts::kMinPassword);
  }
  if (password.size() <= Accounts::kMaxPassword) return {};
  return fail(Errc::LimitExceeded, "a password of {} bytes: at most {}", password.size(),
              Accounts::kMaxPassword);
}

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '_';
}

tl::unexpected<Error> no_user(const std::string& name) {
  return fail(Errc::NotFound, "user {} is not known", name);
}

tl::unexpected<Error> no_group(const std::string& name) {
  return fail(Errc::NotFound, "machine group {} is not known", name);
}

/// A right was taken away, but the disk does not know it.
Error only_until_restart(const std::string& what, const Error& error) {
  return {error.code,
          fmt::format("{}, but only until the server starts again: {}", what, error.what)};
}

}  // namespace

Result<void> check_account_name(std::string_view what, std::string_view name) {
  const bool is_good = !name.empty() && name.size() <= Accounts::kMaxName &&
                       std::ranges::all_of(name, is_name_character) &&
                       std::string_view(".-_").find(name.front()) == std::string_view::npos;
  if (is_good) return {};
  return fail(Errc::Syntax,
              "{} '{}': 1 to {} lower-case letters, digits, '.', '-' and '_', beginning with a "
              "letter or a digit",
              what, name.substr(0, Accounts::kMaxName), Accounts::kMaxName);
}

Result<std::unique_ptr<Accounts>> Accounts::open(const Parts& parts, const Options& options) {
  const auto data = parts.store.load();
  if (!data) return fail(data.error());
  return std::unique_ptr<Accounts>(new Accounts(parts, options, *data));
}

Accounts::Accounts(const Parts& parts, const Options& options, const storage::AccountData& data)
    : store_(parts.store),
      audit_(parts.audit),
      clock_(parts.clock),
      hasher_(options.hashing),
      attempts_(options.attempts),
      refusals_(parts.audit, options.refusals),
      directory_(data),
      uses_stored_(parts.clock.steady_now()) {}

void Accounts::note(const storage::Actor& who, std::string action, std::string subject,
                    std::string detail) {
  audit_.write({.who = who,
                .action = std::move(action),
                .subject = std::move(subject),
                .detail = std::move(detail)});
}

Result<void> Accounts::use_local_secret(const std::string& secret, bool recover) {
  const std::lock_guard changing(changing_);
  const User* const known = directory_.user(kFirstUser);
  const bool is_first = directory_.users().empty();
  if (is_first || recover) {
    User first = known != nullptr ? *known : User{};
    first.name = kFirstUser;
    first.role = Role::Administrator;
    first.state = UserState::Active;
    if (known == nullptr) first.created = clock_.now();
    if (auto saved = store_.save_user(first, {}); !saved) return saved;
    const std::lock_guard lock(mutex_);
    directory_.put(first);
  }
  if (is_first || recover) note("dncd", is_first ? "user.add" : "user.recover", kFirstUser, "");
  const User* const first = directory_.user(kFirstUser);
  if (first == nullptr || first->state != UserState::Active) {
    process::log_info("user {} is locked or removed: the token of the state folder is not used",
                      kFirstUser);
    return {};
  }
  const Digest digest = sha256(secret);
  const Credential* const same = directory_.credential(kFirstUser, kLocalToken);
  if (same != nullptr && same->sha256 == digest) return {};
  Credential token;
  token.user = kFirstUser;
  token.name = kLocalToken;
  token.sha256 = digest;
  token.role = Role::Administrator;
  token.created = clock_.now();
  if (auto saved = store_.save_credential(token, {}); !saved) return saved;
  note("dncd", "token.add", kFirstUser, fmt::format("{}, of the state folder", kLocalToken));
  const std::lock_guard lock(mutex_);
  directory_.put(token);
  return {};
}

std::optional<Caller> Accounts::find(const PresentedSecret& presented, const std::string& address) {
  if (presented.secret.empty()) return std::nullopt;
  const Digest digest = sha256(presented.secret);
  const UtcTime now = clock_.now();
  const std::lock_guard lock(mutex_);
  const Credential* const found = directory_.valid(digest, now);
  if (found == nullptr) return std::nullopt;
  // A cookie is no token and a token no cookie: each has its own protection.
  const bool is_page = found->kind == CredentialKind::Page;
  if (is_page != (presented.from == PresentedSecret::From::Cookie)) return std::nullopt;
  Caller caller{.user = found->user,
                .role = directory_.role_of(*found),
                .credential = found->name,
                .kind = found->kind,
                .groups = found->groups,
                .expires = found->expires,
                .sha256 = digest,
                .address = address};
  directory_.note_use(digest, now, address);
  used_.insert(digest);
  return caller;
}

bool Accounts::is_valid(const Caller& caller) const {
  const std::lock_guard lock(mutex_);
  return directory_.valid(caller.sha256, clock_.now()) != nullptr;
}

bool Accounts::may_act_on(const Caller& caller, const std::string& machine) const {
  const std::lock_guard lock(mutex_);
  const Credential* const found = directory_.valid(caller.sha256, clock_.now());
  return found != nullptr && directory_.may_act_on(*found, machine);
}

std::set<std::string> Accounts::groups_of(const Caller& caller) const {
  const std::lock_guard lock(mutex_);
  const User* const owner = directory_.user(caller.user);
  if (owner == nullptr) return {};
  const std::set<std::string> every{storage::kAllMachines};
  const auto& owners = owner->role == Role::Administrator ? every : owner->groups;
  if (!caller.groups || caller.groups->contains(storage::kAllMachines)) return owners;
  if (owners.contains(storage::kAllMachines)) return *caller.groups;
  std::set<std::string> both;
  std::ranges::set_intersection(owners, *caller.groups, std::inserter(both, both.end()));
  return both;
}

// -- sessions -------------------------------------------------------------------------------------

/// A name that no user has may be a password in the wrong field, so it is not written down.
void Accounts::note_refused(const SignIn& request, bool is_known, std::string_view why) {
  refusals_.note({.who = {is_known ? request.user : "", "", request.address},
                  .action = "sign-in.refused",
                  .subject = is_known ? request.user : "unknown user",
                  .detail = std::string(why)});
}

/// The digest that the password was compared with.
Result<std::string> Accounts::verified(const SignIn& request) {
  if (request.password.size() > kMaxPassword) {
    return fail(Errc::LimitExceeded, "a password of {} bytes: at most {}", request.password.size(),
                kMaxPassword);
  }
  const auto user = known_user(request.user);
  const std::string limited = request.user.substr(0, kMaxName);
  if (const auto wait = attempts_.begin(limited, request.address, clock_.steady_now())) {
    note_refused(request, user.has_value(), "too many attempts");
    return fail(Errc::Busy, "too many attempts to sign in: try again in {} s", wait->count());
  }
  const std::string digest = user ? user->password : "";
  const auto is_right = hasher_.verify(digest, request.password);
  if (!is_right && is_right.error().code == Errc::Busy) {
    attempts_.give_back(limited, request.address);
    return fail(is_right.error());
  }
  if (!is_right) process::log_error("user {}: {}", request.user, is_right.error().what);
  if (is_right && *is_right && user->state == UserState::Active) {
    attempts_.succeed(limited, request.address);
    return digest;
  }
  note_refused(request, user.has_value(),
               is_right && *is_right ? "the user is locked" : "wrong password");
  return fail(Errc::Denied, "user and password do not belong together, or the user is locked");
}

Result<Issued> Accounts::sign_in(const SignIn& request) {
  const auto digest = verified(request);
  if (!digest) return fail(digest.error());
  std::string renewed;
  if (hasher_.is_outdated(*digest)) renewed = hasher_.hash(request.password).value_or("");
  const std::lock_guard changing(changing_);
  auto user = known_user(request.user);
  // Locked, or given another password, while this one was compared.
  if (!user || user->state != UserState::Active || user->password != *digest)
    return fail(Errc::Denied, "user and password do not belong together, or the user is locked");
  if (!renewed.empty()) user->password = renewed;
  user->signed_in = clock_.now();
  if (auto saved = store_.save_user(*user, {}); !saved) return fail(saved.error());
  {
    const std::lock_guard lock(mutex_);
    directory_.put(*user);
  }
  return begin_session(request);
}

/// The caller has taken changing_.
Result<Issued> Accounts::begin_session(const SignIn& request) {
  const auto open = sessions_of(request.user);
  const std::size_t over = open.size() < kMaxSessions ? 0 : open.size() - kMaxSessions + 1;
  const std::vector<std::string> ended(open.begin(),
                                       open.begin() + static_cast<std::ptrdiff_t>(over));
  Issued issued;
  issued.secret = random_hex(kSecretBytes);
  Credential& session = issued.credential;
  session.user = request.user;
  constexpr std::size_t kNameBytes = 4;
  session.name = fmt::format("{}-{}", storage::to_string(request.kind), random_hex(kNameBytes));
  session.kind = request.kind;
  session.sha256 = sha256(issued.secret);
  session.role = Role::Administrator;  // as high as the user's, whatever that becomes
  session.created = clock_.now();
  session.expires = clock_.now() + std::min(request.life, kMaxSessionLife);
  session.used = clock_.now();
  session.used_from = request.address;
  if (auto saved = store_.save_credential(session, ended); !saved) return fail(saved.error());
  {
    const std::lock_guard lock(mutex_);
    for (const auto& name : ended) directory_.remove_credential(request.user, name);
    directory_.put(session);
  }
  note({request.user, session.name, request.address}, "sign-in", request.user,
       fmt::format("{} until {}", storage::to_string(request.kind), to_iso8601(*session.expires)));
  return issued;
}

/// Oldest first.
std::vector<std::string> Accounts::sessions_of(const std::string& user) const {
  std::vector<Credential> sessions;
  {
    const std::lock_guard lock(mutex_);
    sessions = directory_.credentials_of(user);
  }
  std::erase_if(sessions, [](const Credential& credential) { return !is_session(credential); });
  std::ranges::sort(sessions, {}, &Credential::created);
  std::vector<std::string> names;
  names.reserve(sessions.size());
  for (auto& session : sessions) names.push_back(std::move(session.name));
  return names;
}

Result<void> Accounts::sign_out(const Caller& caller) {
  if (caller.kind == CredentialKind::Token) {
    return fail(Errc::Conflict, "token {} is no session: revoke it to end it", caller.credential);
  }
  const std::lock_guard changing(changing_);
  {
    const std::lock_guard lock(mutex_);
    directory_.remove_credential(caller.user, caller.credential);
  }
  note(caller.actor(), "sign-out", caller.user, "");
  if (auto removed = store_.remove_credentials(caller.user, {caller.credential}); !removed)
    return fail(only_until_restart("signed out", removed.error()));
  return {};
}

// -- users ----------------------------------------------------------------------------------------

Result<User> Accounts::known_user(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const User* const found = directory_.user(name);
  if (found == nullptr || found->state == UserState::Removed) return no_user(name);
  return *found;
}

/// The user, when the caller may change its password and tokens.
Result<User> Accounts::manageable(const Caller& by, const std::string& name) const {
  if (by.user != name && by.role != Role::Administrator)
    return fail(Errc::Denied, "user {}: only the user and administrators may do this", name);
  return known_user(name);
}

std::vector<User> Accounts::users() const {
  std::vector<User> list;
  const std::lock_guard lock(mutex_);
  for (const auto& [name, user] : directory_.users()) {
    if (user.state != UserState::Removed) list.push_back(user);
  }
  return list;
}

Result<User> Accounts::user(const Caller& by, const std::string& name) const {
  return manageable(by, name);
}

Result<void> Accounts::check_groups(const std::set<std::string>& groups) const {
  const std::lock_guard lock(mutex_);
  for (const auto& name : groups) {
    if (directory_.group(name) == nullptr) return no_group(name);
  }
  return {};
}

Result<User> Accounts::add_user(const Caller& by, const NewUser& wanted) {
  if (auto good = check_account_name("user", wanted.name); !good) return fail(good.error());
  if (auto good = check_groups(wanted.groups); !good) return fail(good.error());
  User user;
  user.name = wanted.name;
  user.role = wanted.role;
  user.groups = wanted.groups;
  if (wanted.password) {
    if (auto good = check_password(*wanted.password); !good) return fail(good.error());
    auto digest = hasher_.hash(*wanted.password);
    if (!digest) return fail(digest.error());
    user.password = *std::move(digest);
  }
  const std::lock_guard changing(changing_);
  if (const User* const known = directory_.user(user.name)) {
    return fail(Errc::Conflict, "user {} {}", user.name,
                known->state == UserState::Removed
                    ? "was removed, and a name is never used again: the audit trail has it"
                    : "exists already");
  }
  if (directory_.users().size() >= kMaxUsers)
    return fail(Errc::LimitExceeded, "{} users: at most {}", kMaxUsers, kMaxUsers);
  user.created = clock_.now();
  if (auto saved = store_.save_user(user, {}); !saved) return fail(saved.error());
  {
    const std::lock_guard lock(mutex_);
    directory_.put(user);
  }
  note(by.actor(), "user.add", user.name,
       fmt::format("role {}, groups {}", storage::to_string(user.role), list_text(user.groups)));
  return user;
}

Result<User> Accounts::change_user(const Caller& by, const std::string& name,
                                   const UserChange& change) {
  if (change.groups) {
    if (auto good = check_groups(*change.groups); !good) return fail(good.error());
  }
  const std::lock_guard changing(changing_);
  auto user = known_user(name);
  if (!user) return user;
  std::string detail;
  if (change.role && *change.role != user->role) {
    detail += fmt::format("role {} to {}; ", storage::to_string(user->role),
                          storage::to_string(*change.role));
    user->role = *change.role;
  }
  if (change.groups && *change.groups != user->groups) {
    detail += fmt::format("groups {} to {}; ", list_text(user->groups), list_text(*change.groups));
    user->groups = *change.groups;
  }
  const UserState state =
      change.is_locked ? (*change.is_locked ? UserState::Locked : UserState::Active) : user->state;
  if (state != user->state) detail += state == UserState::Locked ? "locked; " : "unlocked; ";
  user->state = state;
  if (detail.empty()) return user;
  const bool is_administrator =
      user->role == Role::Administrator && user->state == UserState::Active;
  if (!is_administrator && !directory_.has_other_administrator(name))
    return fail(Errc::Conflict, "user {} is the last administrator", name);
  if (state == UserState::Locked) {
    const std::lock_guard lock(mutex_);
    User locked = *directory_.user(name);
    locked.state = state;
    directory_.put(locked);
  }
  note(by.actor(), "user.change", name, detail.substr(0, detail.size() - 2));
  if (auto saved = store_.save_user(*user, {}); !saved) {
    if (state != UserState::Locked) return fail(saved.error());
    return fail(only_until_restart(fmt::format("user {} is locked", name), saved.error()));
  }
  const std::lock_guard lock(mutex_);
  directory_.put(*user);
  return user;
}

Result<void> Accounts::set_password(const Caller& by, const std::string& name,
                                    const NewPassword& wanted) {
  const auto before = manageable(by, name);
  if (!before) return fail(before.error());
  if (auto good = check_password(wanted.password); !good) return good;
  if (by.user == name && !before->password.empty()) {
    const auto right = verified({.user = name, .password = wanted.current, .address = by.address});
    if (!right && right.error().code != Errc::Denied) return fail(right.error());
    if (!right) return fail(Errc::Denied, "the current password is another one");
  }
  const auto digest = hasher_.hash(wanted.password);
  if (!digest) return fail(digest.error());
  const std::lock_guard changing(changing_);
  auto user = known_user(name);
  if (!user) return fail(user.error());
  user->password = *digest;
  auto ended = sessions_of(name);
  if (by.user == name) std::erase(ended, by.credential);
  if (auto saved = store_.save_user(*user, ended); !saved) return saved;
  {
    const std::lock_guard lock(mutex_);
    directory_.put(*user);
    for (const auto& session : ended) directory_.remove_credential(name, session);
  }
  note(by.actor(), "user.password", name, fmt::format("{} sessions ended", ended.size()));
  return {};
}

Result<void> Accounts::remove_user(const Caller& by, const std::string& name) {
  const std::lock_guard changing(changing_);
  auto user = known_user(name);
  if (!user) return fail(user.error());
  if (!directory_.has_other_administrator(name))
    return fail(Errc::Conflict, "user {} is the last administrator", name);
  user->state = UserState::Removed;
  user->password.clear();
  user->groups.clear();
  {
    const std::lock_guard lock(mutex_);
    directory_.put(*user);
    directory_.remove_credentials_of(name);
  }
  note(by.actor(), "user.remove", name, "");
  if (auto saved = store_.save_user(*user, {}); !saved)
    return fail(only_until_restart(fmt::format("user {} is removed", name), saved.error()));
  return {};
}

// -- tokens ---------------------------------------------------------------------------------------

Result<std::vector<Credential>> Accounts::credentials(const Caller& by,
                                                      const std::string& user) const {
  if (auto good = manageable(by, user); !good) return fail(good.error());
  const std::lock_guard lock(mutex_);
  return directory_.credentials_of(user);
}

/// At most what its user and the caller have.
Result<void> Accounts::check_token(const Caller& by, const User& owner,
                                   const Credential& token) const {
  const Role highest = std::min(owner.role, by.role);
  if (token.role > highest) {
    return fail(Errc::Denied, "a token of role {}: at most {}", storage::to_string(token.role),
                storage::to_string(highest));
  }
  if (by.kind == CredentialKind::Token && by.expires && *token.expires > *by.expires) {
    return fail(Errc::Denied, "a token that lasts until {}: {}, by which it is made, ends at {}",
                to_iso8601(*token.expires), by.credential, to_iso8601(*by.expires));
  }
  const auto reaches = [&](const std::set<std::string>& groups, const std::string& group) {
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

Result<Issued> Accounts::add_token(const Caller& by, const std::string& user,
                                   const NewToken& wanted) {
  if (auto good = check_account_name("token", wanted.name); !good) return fail(good.error());
  if (wanted.life < std::chrono::days(1) || wanted.life > kMaxTokenLife) {
    return fail(Errc::LimitExceeded, "a token for {} days: 1 to {}", wanted.life.count(),
                kMaxTokenLife.count());
  }
  if (wanted.groups) {
    if (auto good = check_groups(*wanted.groups); !good) return fail(good.error());
  }
  const std::lock_guard changing(changing_);
  const auto owner = manageable(by, user);
  if (!owner) return fail(owner.error());
  Issued issued;
  issued.secret = random_hex(kSecretBytes);
  Credential& token = issued.credential;
  token.user = user;
  token.name = wanted.name;
  token.sha256 = sha256(issued.secret);
  token.role = wanted.role.value_or(std::min(owner->role, by.role));
  token.groups = wanted.groups ? wanted.groups : by.groups;
  token.created = clock_.now();
  token.expires = clock_.now() + wanted.life;
  if (auto good = check_token(by, *owner, token); !good) return fail(good.error());
  if (directory_.credential(user, wanted.name) != nullptr)
    return fail(Errc::Conflict, "user {} has a token {} already", user, wanted.name);
  if (directory_.number_of_credentials(user) >= kMaxCredentials) {
    return fail(Errc::LimitExceeded, "user {} has {} tokens and sessions: at most {}", user,
                kMaxCredentials, kMaxCredentials);
  }
  if (auto saved = store_.save_credential(token, {}); !saved) return fail(saved.error());
  {
    const std::lock_guard lock(mutex_);
    directory_.put(token);
  }
  note(by.actor(), "token.add", user,
       fmt::format("{}, role {}, groups {}, until {}", token.name, storage::to_string(token.role),
                   token.groups ? list_text(*token.groups) : "of the user",
                   to_iso8601(*token.expires)));
  return issued;
}

Result<void> Accounts::revoke(const Caller& by, const std::string& user, const std::string& name) {
  const std::lock_guard changing(changing_);
  if (auto good = manageable(by, user); !good) return fail(good.error());
  if (user == kFirstUser && name == kLocalToken) {
    return fail(Errc::Conflict,
                "token {} is the one of the state folder: remove its file there and start the "
                "server again for a new one",
                name);
  }
  {
    const std::lock_guard lock(mutex_);
    if (directory_.credential(user, name) == nullptr)
      return fail(Errc::NotFound, "user {} has no token {}", user, name);
    directory_.remove_credential(user, name);
  }
  note(by.actor(), "token.revoke", user, name);
  if (auto removed = store_.remove_credentials(user, {name}); !removed)
    return fail(only_until_restart(fmt::format("token {} is revoked", name), removed.error()));
  return {};
}

// -- groups ---------------------------------------------------------------------------------------

std::vector<MachineGroup> Accounts::groups() const {
  std::vector<MachineGroup> list;
  const std::lock_guard lock(mutex_);
  for (const auto& [name, group] : directory_.groups()) list.push_back(group);
  return list;
}

Result<MachineGroup> Accounts::group(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const MachineGroup* const found = directory_.group(name);
  if (found == nullptr) return no_group(name);
  return *found;
}

Result<Accounts::SavedGroup> Accounts::add_group(const Caller& by, const std::string& name) {
  if (auto good = check_account_name("machine group", name); !good) return fail(good.error());
  const std::lock_guard changing(changing_);
  if (const MachineGroup* const known = directory_.group(name)) return SavedGroup{*known, false};
  if (directory_.groups().size() >= kMaxGroups)
    return fail(Errc::LimitExceeded, "{} machine groups: at most {}", kMaxGroups, kMaxGroups);
  const MachineGroup group{name, {}};
  if (auto saved = store_.save_group(group); !saved) return fail(saved.error());
  {
    const std::lock_guard lock(mutex_);
    directory_.put(group);
  }
  note(by.actor(), "group.add", name, "");
  return SavedGroup{group, true};
}

/// The user or token that has the group; empty: none.
std::string Accounts::owner_of(const std::string& group) const {
  const std::lock_guard lock(mutex_);
  for (const auto& [name, user] : directory_.users()) {
    if (user.groups.contains(group)) return "user " + name;
    for (const auto& credential : directory_.credentials_of(name)) {
      if (credential.groups && credential.groups->contains(group))
        return fmt::format("token {} of user {}", credential.name, name);
    }
  }
  return {};
}

Result<void> Accounts::remove_group(const Caller& by, const std::string& name) {
  const std::lock_guard changing(changing_);
  if (directory_.group(name) == nullptr) return no_group(name);
  if (name == storage::kAllMachines)
    return fail(Errc::Conflict, "machine group {} is the one of every machine", name);
  if (const std::string owner = owner_of(name); !owner.empty())
    return fail(Errc::Conflict, "machine group {} is the one of {}", name, owner);
  if (auto removed = store_.remove_group(name); !removed) return removed;
  {
    const std::lock_guard lock(mutex_);
    directory_.remove_group(name);
  }
  note(by.actor(), "group.remove", name, "");
  return {};
}

Result<MachineGroup> Accounts::change_group(const Caller& by, const std::string& name,
                                            const std::function<void(MachineGroup&)>& change,
                                            const std::string& detail) {
  const std::lock_guard changing(changing_);
  auto group = this->group(name);
  if (!group) return group;
  if (name == storage::kAllMachines)
    return fail(Errc::Conflict, "machine group {} is the one of every machine", name);
  const auto before = group->machines;
  change(*group);
  if (group->machines == before) return group;
  if (group->machines.size() > kMaxMachines) {
    return fail(Errc::LimitExceeded, "machine group {} has {} machines: at most {}", name,
                kMaxMachines, kMaxMachines);
  }
  if (auto saved = store_.save_group(*group); !saved) return fail(saved.error());
  {
    const std::lock_guard lock(mutex_);
    directory_.put(*group);
  }
  note(by.actor(), "group.change", name, detail);
  return group;
}

Result<MachineGroup> Accounts::add_machine(const Caller& by, const std::string& group,
                                           const std::string& machine) {
  if (auto good = check_machine_name(machine); !good) return fail(good.error());
  return change_group(
      by, group, [&](MachineGroup& changed) { changed.machines.insert(machine); },
      "added " + machine);
}

Result<MachineGroup> Accounts::remove_machine(const Caller& by, const std::string& group,
                                              const std::string& machine) {
  return change_group(
      by, group, [&](MachineGroup& changed) { changed.machines.erase(machine); },
      "removed " + machine);
}

// -- now and then ---------------------------------------------------------------------------------

void Accounts::store_uses() {
  constexpr std::chrono::seconds kInterval{60};
  std::vector<storage::CredentialUse> uses;
  {
    const std::lock_guard lock(mutex_);
    const SteadyTime now = clock_.steady_now();
    if (used_.empty() || now - uses_stored_ < kInterval) return;
    uses_stored_ = now;
    for (const auto& digest : std::exchange(used_, {})) {
      const Credential* const found = directory_.credential(digest);
      if (found != nullptr && found->used)
        uses.push_back({found->user, found->name, *found->used, found->used_from});
    }
  }
  if (auto noted = store_.note_uses(uses); !noted)
    process::log_warning("last uses of tokens are not stored: {}", noted.error().what);
}

void Accounts::tidy() {
  const std::lock_guard changing(changing_);
  const UtcTime now = clock_.now();
  std::map<std::string, std::vector<std::string>> expired;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [name, user] : directory_.users()) {
      for (const auto& credential : directory_.credentials_of(name)) {
        if (is_session(credential) && credential.expires && *credential.expires <= now)
          expired[name].push_back(credential.name);
      }
    }
  }
  for (const auto& [user, names] : expired) {
    if (auto removed = store_.remove_credentials(user, names); !removed) {
      process::log_warning("expired sessions are not removed: {}", removed.error().what);
      return;
    }
    const std::lock_guard lock(mutex_);
    for (const auto& name : names) directory_.remove_credential(user, name);
  }
}

}  // namespace dripline::identity
