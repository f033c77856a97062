#include "server/identity/directory.hpp"

#include <algorithm>

namespace dripline::identity {
namespace {

template <class Map, class Key>
auto find_in(const Map& map, const Key& key) -> const typename Map::mapped_type* {
  const auto found = map.find(key);
  return found == map.end() ? nullptr : &found->second;
}

}  // namespace

Directory::Directory(const storage::AccountData& data) {
  for (const auto& user : data.users) put(user);
  for (const auto& credential : data.credentials) put(credential);
  for (const auto& group : data.groups) put(group);
}

const User* Directory::user(const std::string& name) const {
  return find_in(users_, name);
}

const Credential* Directory::credential(const Digest& sha256) const {
  return find_in(credentials_, sha256);
}

const Credential* Directory::credential(const std::string& user, const std::string& name) const {
  const Digest* const digest = find_in(names_, std::pair(user, name));
  return digest == nullptr ? nullptr : credential(*digest);
}

std::vector<Credential> Directory::credentials_of(const std::string& user) const {
  std::vector<Credential> list;
  for (auto at = names_.lower_bound({user, ""}); at != names_.end() && at->first.first == user;
       ++at) {
    list.push_back(credentials_.at(at->second));
  }
  return list;
}

std::size_t Directory::number_of_credentials(const std::string& user) const {
  std::size_t number = 0;
  for (auto at = names_.lower_bound({user, ""}); at != names_.end() && at->first.first == user;
       ++at) {
    ++number;
  }
  return number;
}

const MachineGroup* Directory::group(const std::string& name) const {
  return find_in(groups_, name);
}

void Directory::put(const User& user) {
  users_[user.name] = user;
}

void Directory::put(const Credential& credential) {
  remove_credential(credential.user, credential.name);
  names_[{credential.user, credential.name}] = credential.sha256;
  credentials_[credential.sha256] = credential;
}

void Directory::put(const MachineGroup& group) {
  groups_[group.name] = group;
}

void Directory::remove_credential(const std::string& user, const std::string& name) {
  const auto found = names_.find({user, name});
  if (found == names_.end()) return;
  credentials_.erase(found->second);
  names_.erase(found);
}

void Directory::remove_credentials_of(const std::string& user) {
  for (const auto& credential : credentials_of(user)) remove_credential(user, credential.name);
}

void Directory::remove_group(const std::string& name) {
  groups_.erase(name);
}

void Directory::note_use(const Digest& sha256, UtcTime now, const std::string& from) {
  const auto found = credentials_.find(sha256);
  if (found == credentials_.end()) return;
  found->second.used = now;
  if (found->second.used_from != from) found->second.used_from = from;
}

const Credential* Directory::valid(const Digest& sha256, UtcTime now) const {
  const Credential* const found = credential(sha256);
  if (found == nullptr || (found->expires && *found->expires <= now)) return nullptr;
  const User* const owner = user(found->user);
  if (owner == nullptr || owner->state != storage::UserState::Active) return nullptr;
  return found;
}

Role Directory::role_of(const Credential& credential) const {
  const User* const owner = user(credential.user);
  return owner == nullptr ? Role::Viewer : std::min(owner->role, credential.role);
}

bool Directory::may_act_on(const Credential& credential, const std::string& machine) const {
  const User* const owner = user(credential.user);
  if (owner == nullptr) return false;
  if (owner->role != Role::Administrator && !holds(owner->groups, machine)) return false;
  return !credential.groups || holds(*credential.groups, machine);
}

bool Directory::holds(const std::set<std::string>& groups, const std::string& machine) const {
  return std::ranges::any_of(groups, [&](const std::string& name) {
    if (name == storage::kAllMachines) return true;
    const MachineGroup* const found = group(name);
    return found != nullptr && found->machines.contains(machine);
  });
}

bool Directory::has_other_administrator(const std::string& name) const {
  return std::ranges::any_of(users_, [&](const auto& entry) {
    const User& user = entry.second;
    return user.name != name && user.role == Role::Administrator &&
           user.state == storage::UserState::Active &&
           (!user.password.empty() || number_of_credentials(user.name) > 0);
  });
}

}  // namespace dripline::identity
