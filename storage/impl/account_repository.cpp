#include "storage/impl/account_repository.hpp"

#include <map>

#include "storage/impl/programs/content.hpp"
#include "storage/sql/query.hpp"

namespace dripline::storage {
namespace {

/// The value whose word `text` is; rows hold no other unless the file was changed by hand.
template <class Enum>
Result<Enum> read_word(std::string_view text, Enum last, std::string_view what) {
  for (auto at = 0; at <= static_cast<int>(last); ++at) {
    if (to_string(static_cast<Enum>(at)) == text) return static_cast<Enum>(at);
  }
  return fail(Errc::Corrupt, "the database holds a {} '{}'", what, text);
}

struct UserRow {
  User user;
  std::string role, state;
};

UserRow read_user(const sql::Statement& row) {
  UserRow read;
  read.user.name = row.text(0);
  read.role = row.text(1);
  read.user.password = row.text(2);
  read.state = row.text(3);
  read.user.created = row.time(4);
  read.user.signed_in = row.optional_time(5);
  return read;
}

struct CredentialRow {
  Credential credential;
  std::string kind, role;
};

CredentialRow read_credential(const sql::Statement& row) {
  CredentialRow read;
  Credential& credential = read.credential;
  credential.user = row.text(0);
  credential.name = row.text(1);
  read.kind = row.text(2);
  credential.sha256 = read_digest(row, 3);
  read.role = row.text(4);
  if (row.integer(5) != 0) credential.groups.emplace();
  credential.created = row.time(6);
  credential.expires = row.optional_time(7);
  credential.used = row.optional_time(8);
  credential.used_from = row.text(9);
  return read;
}

/// (what has it, the group or machine).
using Membership = std::pair<std::string, std::string>;
Membership read_membership(const sql::Statement& row) {
  return {row.text(0), row.text(1)};
}
struct CredentialMembership {
  std::string user, name, group;
};
CredentialMembership read_credential_membership(const sql::Statement& row) {
  return {row.text(0), row.text(1), row.text(2)};
}

Result<std::vector<User>> load_users(sql::Database& database) {
  const auto rows = sql::all_rows(
      database,
      "SELECT name, role, password, state, created_us, signed_in_us FROM \"user\" ORDER BY name",
      read_user);
  if (!rows) return fail(rows.error());
  const auto groups =
      sql::all_rows(database, "SELECT \"user\", machine_group FROM user_group", read_membership);
  if (!groups) return fail(groups.error());
  std::multimap<std::string, std::string> groups_of(groups->begin(), groups->end());
  std::vector<User> users;
  for (const auto& row : *rows) {
    const auto role = read_word(row.role, Role::Administrator, "role");
    const auto state = read_word(row.state, UserState::Removed, "user's state");
    if (!role) return fail(role.error());
    if (!state) return fail(state.error());
    User user = row.user;
    user.role = *role;
    user.state = *state;
    const auto [from, to] = groups_of.equal_range(user.name);
    for (auto at = from; at != to; ++at) user.groups.insert(at->second);
    users.push_back(std::move(user));
  }
  return users;
}

Result<std::vector<Credential>> load_credentials(sql::Database& database) {
  const auto rows = sql::all_rows(
      database,
      "SELECT \"user\", name, kind, sha256, role, has_groups, created_us, expires_us, used_us, "
      "used_from FROM credential ORDER BY \"user\", name",
      read_credential);
  if (!rows) return fail(rows.error());
  const auto memberships =
      sql::all_rows(database, "SELECT \"user\", name, machine_group FROM credential_group",
                    read_credential_membership);
  if (!memberships) return fail(memberships.error());
  std::map<std::pair<std::string, std::string>, std::set<std::string>> groups_of;
  for (const auto& row : *memberships) groups_of[{row.user, row.name}].insert(row.group);
  std::vector<Credential> credentials;
  for (const auto& row : *rows) {
    const auto kind = read_word(row.kind, CredentialKind::Page, "kind of credential");
    const auto role = read_word(row.role, Role::Administrator, "role");
    if (!kind) return fail(kind.error());
    if (!role) return fail(role.error());
    Credential credential = row.credential;
    credential.kind = *kind;
    credential.role = *role;
    if (credential.groups) *credential.groups = groups_of[{credential.user, credential.name}];
    credentials.push_back(std::move(credential));
  }
  return credentials;
}

Result<std::vector<MachineGroup>> load_groups(sql::Database& database) {
  const auto rows =
      sql::all_rows(database,
                    "SELECT machine_group.name, coalesce(machine, '') FROM machine_group "
                    "LEFT JOIN machine_group_member ON machine_group = name "
                    "ORDER BY name, machine",
                    read_membership);
  if (!rows) return fail(rows.error());
  std::vector<MachineGroup> groups;
  for (const auto& [name, machine] : *rows) {
    if (groups.empty() || groups.back().name != name) groups.push_back({name, {}});
    if (!machine.empty()) groups.back().machines.insert(machine);
  }
  return groups;
}

Result<void> remove_credential(sql::Database& database, const std::string& user,
                               const std::string& name) {
  return sql::run(database, "DELETE FROM credential WHERE \"user\" = ?1 AND name = ?2", user, name);
}

Result<void> remove_each(sql::Database& database, const std::string& user,
                         const std::vector<std::string>& names) {
  Result<void> done;
  for (auto name = names.begin(); done && name != names.end(); ++name) {
    done = remove_credential(database, user, *name);
  }
  return done;
}

Result<void> save_user_groups(sql::Database& database, const User& user) {
  auto done = sql::run(database, "DELETE FROM user_group WHERE \"user\" = ?1", user.name);
  for (auto group = user.groups.begin(); done && group != user.groups.end(); ++group) {
    done = sql::run(database, "INSERT INTO user_group (\"user\", machine_group) VALUES (?1, ?2)",
                    user.name, *group);
  }
  return done;
}

Result<void> insert_credential(sql::Database& database, const Credential& credential) {
  auto done = sql::run(
      database,
      "INSERT INTO credential (\"user\", name, kind, sha256, role, has_groups, created_us, "
      "expires_us, used_us, used_from) VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10)",
      credential.user, credential.name, to_string(credential.kind),
      std::span<const std::byte>(credential.sha256.bytes), to_string(credential.role),
      credential.groups ? 1 : 0, credential.created, credential.expires, credential.used,
      credential.used_from);
  if (!credential.groups) return done;
  for (auto group = credential.groups->begin(); done && group != credential.groups->end();
       ++group) {
    done =
        sql::run(database,
                 "INSERT INTO credential_group (\"user\", name, machine_group) VALUES (?1, ?2, ?3)",
                 credential.user, credential.name, *group);
  }
  return done;
}

}  // namespace

Result<AccountData> AccountRepository::load() {
  return connections_.read([](sql::Database& database) -> Result<AccountData> {
    auto users = load_users(database);
    if (!users) return fail(users.error());
    auto credentials = load_credentials(database);
    if (!credentials) return fail(credentials.error());
    auto groups = load_groups(database);
    if (!groups) return fail(groups.error());
    return AccountData{*std::move(users), *std::move(credentials), *std::move(groups)};
  });
}

Result<void> AccountRepository::save_user(const User& user, const std::vector<std::string>& ended) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    auto done = sql::run(
        database,
        "INSERT INTO \"user\" (name, role, password, state, created_us, signed_in_us) "
        "VALUES (?1, ?2, ?3, ?4, ?5, ?6) ON CONFLICT (name) DO UPDATE SET role = excluded.role, "
        "password = excluded.password, state = excluded.state, "
        "signed_in_us = excluded.signed_in_us",
        user.name, to_string(user.role), user.password, to_string(user.state), user.created,
        user.signed_in);
    if (done) done = save_user_groups(database, user);
    if (!done) return done;
    if (user.state == UserState::Removed) {
      return sql::run(database, "DELETE FROM credential WHERE \"user\" = ?1", user.name);
    }
    return remove_each(database, user.name, ended);
  });
}

Result<void> AccountRepository::save_credential(const Credential& credential,
                                                const std::vector<std::string>& ended) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    auto done = remove_each(database, credential.user, ended);
    if (done) done = remove_credential(database, credential.user, credential.name);
    if (!done) return done;
    return insert_credential(database, credential);
  });
}

Result<void> AccountRepository::remove_credentials(const std::string& user,
                                                   const std::vector<std::string>& names) {
  return connections_.write(
      [&](sql::Database& database) { return remove_each(database, user, names); });
}

Result<void> AccountRepository::note_uses(const std::vector<CredentialUse>& uses) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    Result<void> done;
    for (auto use = uses.begin(); done && use != uses.end(); ++use) {
      done = sql::run(
          database,
          "UPDATE credential SET used_us = ?3, used_from = ?4 WHERE \"user\" = ?1 AND name = ?2",
          use->user, use->name, use->used, use->from);
    }
    return done;
  });
}

Result<void> AccountRepository::save_group(const MachineGroup& group) {
  return connections_.write([&](sql::Database& database) -> Result<void> {
    auto done = sql::run(
        database, "INSERT INTO machine_group (name) VALUES (?1) ON CONFLICT (name) DO NOTHING",
        group.name);
    if (done) {
      done = sql::run(database, "DELETE FROM machine_group_member WHERE machine_group = ?1",
                      group.name);
    }
    for (auto machine = group.machines.begin(); done && machine != group.machines.end();
         ++machine) {
      done = sql::run(database,
                      "INSERT INTO machine_group_member (machine_group, machine) VALUES (?1, ?2)",
                      group.name, *machine);
    }
    return done;
  });
}

Result<void> AccountRepository::remove_group(const std::string& name) {
  return connections_.write([&](sql::Database& database) {
    return sql::run(database, "DELETE FROM machine_group WHERE name = ?1", name);
  });
}

}  // namespace dripline::storage
