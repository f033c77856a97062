#include "server/identity/machine_groups.hpp"

#include "protocol/base/names.hpp"
#include "server/identity/account_limits.hpp"

namespace dripline::identity {
namespace {

/// The user or token that has the group; empty: none.
std::string owner_of(const Directory& directory, const std::string& group) {
  for (const auto& [name, user] : directory.users()) {
    if (user.groups.contains(group)) return "user " + name;
    for (const auto& credential : directory.credentials_of(name)) {
      if (credential.groups && credential.groups->contains(group))
        return fmt::format("token {} of user {}", credential.name, name);
    }
  }
  return {};
}

/// Errors: NotFound, Conflict (the group of every machine).
Result<MachineGroup> changeable(const AccountBook& book, const std::string& name) {
  auto group = book.group(name);
  if (group && name == storage::kAllMachines)
    return fail(Errc::Conflict, "machine group {} is the one of every machine", name);
  return group;
}

}  // namespace

std::vector<MachineGroup> MachineGroups::list() const {
  return book_.read([](const Directory& directory) {
    std::vector<MachineGroup> groups;
    for (const auto& [name, group] : directory.groups()) groups.push_back(group);
    return groups;
  });
}

Result<MachineGroups::Saved> MachineGroups::add(const Caller& by, const std::string& name) {
  if (auto good = check_account_name("machine group", name); !good) return fail(good.error());
  const auto changing = book_.begin_change();
  if (auto known = book_.group(name)) return Saved{*std::move(known), false};
  constexpr std::size_t kMax = AccountLimits::kMaxGroups;
  if (book_.read([](const Directory& directory) { return directory.groups().size(); }) >= kMax)
    return fail(Errc::LimitExceeded, "{} machine groups: at most {}", kMax, kMax);
  const MachineGroup group{name, {}};
  if (auto saved = book_.store().save_group(group); !saved) return fail(saved.error());
  book_.put(group);
  book_.note(by.actor(), "group.add", name, "");
  return Saved{group, true};
}

Result<void> MachineGroups::remove(const Caller& by, const std::string& name) {
  const auto changing = book_.begin_change();
  if (auto group = changeable(book_, name); !group) return fail(group.error());
  const auto owner = book_.read([&](const Directory& d) { return owner_of(d, name); });
  if (!owner.empty()) return fail(Errc::Conflict, "machine group {} is the one of {}", name, owner);
  if (auto removed = book_.store().remove_group(name); !removed) return removed;
  book_.update([&](Directory& directory) { directory.remove_group(name); });
  book_.note(by.actor(), "group.remove", name, "");
  return {};
}

Result<MachineGroup> MachineGroups::change(const Caller& by, const std::string& name,
                                           const std::function<void(MachineGroup&)>& change,
                                           const std::string& detail) {
  const auto changing = book_.begin_change();
  auto group = changeable(book_, name);
  if (!group) return group;
  const auto before = group->machines;
  change(*group);
  if (group->machines == before) return group;
  constexpr std::size_t kMax = AccountLimits::kMaxMachines;
  if (group->machines.size() > kMax) {
    return fail(Errc::LimitExceeded, "machine group {} has {} machines: at most {}", name, kMax,
                kMax);
  }
  if (auto saved = book_.store().save_group(*group); !saved) return fail(saved.error());
  book_.put(*group);
  book_.note(by.actor(), "group.change", name, detail);
  return group;
}

Result<MachineGroup> MachineGroups::add_machine(const Caller& by, const std::string& group,
                                                const std::string& machine) {
  if (auto good = check_machine_name(machine); !good) return fail(good.error());
  return change(
      by, group, [&](MachineGroup& changed) { changed.machines.insert(machine); },
      "added " + machine);
}

Result<MachineGroup> MachineGroups::remove_machine(const Caller& by, const std::string& group,
                                                   const std::string& machine) {
  return change(
      by, group, [&](MachineGroup& changed) { changed.machines.erase(machine); },
      "removed " + machine);
}

}  // namespace dripline::identity
