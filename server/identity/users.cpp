#include "server/identity/users.hpp"

#include "server/identity/account_limits.hpp"

namespace dripline::identity {
namespace {

/// Makes `user` what `change` asks for; what became different, for the audit trail.
std::string apply_change(User& user, const UserChange& change) {
  std::string detail;
  if (change.role && *change.role != user.role) {
    detail += fmt::format("role {} to {}; ", storage::to_string(user.role),
                          storage::to_string(*change.role));
    user.role = *change.role;
  }
  if (change.groups && *change.groups != user.groups) {
    detail += fmt::format("groups {} to {}; ", names_text(user.groups), names_text(*change.groups));
    user.groups = *change.groups;
  }
  const UserState state =
      change.is_locked ? (*change.is_locked ? UserState::Locked : UserState::Active) : user.state;
  if (state != user.state) detail += state == UserState::Locked ? "locked; " : "unlocked; ";
  user.state = state;
  return detail.substr(0, detail.size() - std::min<std::size_t>(detail.size(), 2));
}

}  // namespace

std::vector<User> Users::list() const {
  return book_.read([](const Directory& directory) {
    std::vector<User> users;
    for (const auto& [name, user] : directory.users()) {
      if (user.state != UserState::Removed) users.push_back(user);
    }
    return users;
  });
}

Result<User> Users::find(const Caller& by, const std::string& name) const {
  return book_.manageable(by, name);
}

Result<User> Users::add(const Caller& by, const NewUser& wanted) {
  if (auto good = check_account_name("user", wanted.name); !good) return fail(good.error());
  if (auto good = book_.check_groups(wanted.groups); !good) return fail(good.error());
  User user;
  user.name = wanted.name;
  user.role = wanted.role;
  user.groups = wanted.groups;
  if (wanted.password) {
    if (auto good = Passwords::check(*wanted.password); !good) return fail(good.error());
    auto digest = passwords_.hash(*wanted.password);
    if (!digest) return fail(digest.error());
    user.password = *std::move(digest);
  }
  const auto changing = book_.begin_change();
  const auto room = book_.read([&](const Directory& directory) -> Result<void> {
    if (const User* const known = directory.user(user.name)) {
      return fail(Errc::Conflict, "user {} {}", user.name,
                  known->state == UserState::Removed
                      ? "was removed, and a name is never used again: the audit trail has it"
                      : "exists already");
    }
    constexpr std::size_t kMax = AccountLimits::kMaxUsers;
    if (directory.users().size() < kMax) return {};
    return fail(Errc::LimitExceeded, "{} users: at most {}", kMax, kMax);
  });
  if (!room) return fail(room.error());
  user.created = book_.clock().now();
  if (auto saved = book_.store().save_user(user, {}); !saved) return fail(saved.error());
  book_.put(user);
  book_.note(
      by.actor(), "user.add", user.name,
      fmt::format("role {}, groups {}", storage::to_string(user.role), names_text(user.groups)));
  return user;
}

Result<void> Users::check_other_administrator(const std::string& name) const {
  if (book_.read([&](const Directory& d) { return d.has_other_administrator(name); })) return {};
  return fail(Errc::Conflict, "user {} is the last administrator", name);
}

Result<User> Users::change(const Caller& by, const std::string& name, const UserChange& change) {
  if (change.groups) {
    if (auto good = book_.check_groups(*change.groups); !good) return fail(good.error());
  }
  const auto changing = book_.begin_change();
  auto user = book_.user(name);
  if (!user) return user;
  User locked = *user;
  const std::string detail = apply_change(*user, change);
  if (detail.empty()) return user;
  if (user->role != Role::Administrator || user->state != UserState::Active) {
    if (auto good = check_other_administrator(name); !good) return fail(good.error());
  }
  const bool is_locked = user->state == UserState::Locked;
  if (is_locked) {
    locked.state = UserState::Locked;
    book_.put(locked);
  }
  book_.note(by.actor(), "user.change", name, detail);
  if (auto saved = book_.store().save_user(*user, {}); !saved) {
    if (!is_locked) return fail(saved.error());
    return fail(only_until_restart(fmt::format("user {} is locked", name), saved.error()));
  }
  book_.put(*user);
  return user;
}

Result<void> Users::set_password(const Caller& by, const std::string& name,
                                 const NewPassword& wanted) {
  const auto before = book_.manageable(by, name);
  if (!before) return fail(before.error());
  if (auto good = Passwords::check(wanted.password); !good) return good;
  if (before->password.empty()) {
    if (auto good = check_unlimited(by, *before); !good) return good;
  } else if (by.user == name) {
    const auto right = passwords_.verify({name, wanted.current, by.address});
    if (!right && right.error().code != Errc::Denied) return fail(right.error());
    if (!right) return fail(Errc::Denied, "the current password is another one");
  }
  const auto digest = passwords_.hash(wanted.password);
  if (!digest) return fail(digest.error());
  const auto changing = book_.begin_change();
  auto user = book_.user(name);
  if (!user) return fail(user.error());
  user->password = *digest;
  auto ended = book_.sessions_of(name);
  if (by.user == name) std::erase(ended, by.credential);
  if (auto saved = book_.store().save_user(*user, ended); !saved) return saved;
  book_.update([&](Directory& directory) {
    directory.put(*user);
    for (const auto& session : ended) directory.remove_credential(name, session);
  });
  book_.note(by.actor(), "user.password", name, fmt::format("{} sessions ended", ended.size()));
  return {};
}

Result<void> Users::remove(const Caller& by, const std::string& name) {
  const auto changing = book_.begin_change();
  auto user = book_.user(name);
  if (!user) return fail(user.error());
  if (auto good = check_other_administrator(name); !good) return good;
  user->state = UserState::Removed;
  user->password.clear();
  user->groups.clear();
  book_.update([&](Directory& directory) {
    directory.put(*user);
    directory.remove_credentials_of(name);
  });
  book_.note(by.actor(), "user.remove", name, "");
  if (auto saved = book_.store().save_user(*user, {}); !saved)
    return fail(only_until_restart(fmt::format("user {} is removed", name), saved.error()));
  return {};
}

}  // namespace dripline::identity
