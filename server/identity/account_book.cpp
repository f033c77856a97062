#include "server/identity/account_book.hpp"

#include <fmt/ranges.h>
#include <algorithm>

#include "protocol/base/random.hpp"
#include "server/identity/account_limits.hpp"

namespace dripline::identity {
namespace {

bool is_name_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '_';
}

}  // namespace

Result<void> check_account_name(std::string_view what, std::string_view name) {
  constexpr std::size_t kMaxName = AccountLimits::kMaxName;
  const bool is_good = !name.empty() && name.size() <= kMaxName &&
                       std::ranges::all_of(name, is_name_character) &&
                       std::string_view(".-_").find(name.front()) == std::string_view::npos;
  if (is_good) return {};
  return fail(Errc::Syntax,
              "{} '{}': 1 to {} lower-case letters, digits, '.', '-' and '_', beginning with a "
              "letter or a digit",
              what, name.substr(0, kMaxName), kMaxName);
}

Result<void> check_unlimited(const Caller& by, const User& user) {
  if (by.user != user.name || (by.role >= user.role && !by.groups)) return {};
  return fail(Errc::Denied,
              "credential {} of user {} is limited ({}{}): it changes none but itself. Use one "
              "that has all of the user's rights, or ask an administrator",
              by.credential, by.user, storage::to_string(by.role),
              by.groups ? fmt::format(", groups {}", names_text(*by.groups)) : "");
}

bool is_session(const Credential& credential) {
  return credential.kind != CredentialKind::Token;
}

std::string names_text(const std::set<std::string>& names) {
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

Error only_until_restart(const std::string& what, const Error& error) {
  return {error.code,
          fmt::format("{}, but only until the server starts again: {}", what, error.what)};
}

std::string new_secret() {
  constexpr std::size_t kSecretBytes = 32;
  return random_hex(kSecretBytes);
}

void AccountBook::note(const storage::Actor& who, std::string action, std::string subject,
                       std::string detail) {
  parts_.audit.write({.who = who,
                      .action = std::move(action),
                      .subject = std::move(subject),
                      .detail = std::move(detail)});
}

Result<User> AccountBook::user(const std::string& name) const {
  return read([&](const Directory& directory) -> Result<User> {
    const User* const found = directory.user(name);
    if (found == nullptr || found->state == UserState::Removed)
      return fail(Errc::NotFound, "user {} is not known", name);
    return *found;
  });
}

Result<User> AccountBook::manageable(const Caller& by, const std::string& name) const {
  if (by.user != name && by.role != Role::Administrator)
    return fail(Errc::Denied, "user {}: only the user and administrators may do this", name);
  return user(name);
}

Result<MachineGroup> AccountBook::group(const std::string& name) const {
  return read([&](const Directory& directory) -> Result<MachineGroup> {
    const MachineGroup* const found = directory.group(name);
    if (found == nullptr) return fail(Errc::NotFound, "machine group {} is not known", name);
    return *found;
  });
}

Result<void> AccountBook::check_groups(const std::set<std::string>& groups) const {
  for (const auto& name : groups) {
    if (auto known = group(name); !known) return fail(known.error());
  }
  return {};
}

std::vector<std::string> AccountBook::sessions_of(const std::string& user) const {
  auto sessions = read([&](const Directory& directory) { return directory.credentials_of(user); });
  std::erase_if(sessions, [](const Credential& credential) { return !is_session(credential); });
  std::ranges::sort(sessions, {}, &Credential::created);
  std::vector<std::string> names;
  names.reserve(sessions.size());
  for (auto& session : sessions) names.push_back(std::move(session.name));
  return names;
}

}  // namespace dripline::identity
