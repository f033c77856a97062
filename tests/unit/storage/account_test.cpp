#include "tests/unit/storage/store_fixture.hpp"

namespace dripline::storage {
namespace {

class AccountTest : public ContractTest {
 protected:
  User user(const std::string& name) {
    User made;
    made.name = name;
    made.role = Role::Operator;
    made.created = clock_.now();
    return made;
  }
  Credential credential(const std::string& user, const std::string& name) {
    Credential made;
    made.user = user;
    made.name = name;
    made.sha256 = sha256(user + name);
    made.role = Role::Viewer;
    made.created = clock_.now();
    return made;
  }
  AccountData load() {
    auto data = store_->accounts.load();
    EXPECT_TRUE(data) << data.error().what;
    return data.value_or(AccountData{});
  }
  AccountStore& accounts() { return store_->accounts; }
};

TEST_P(AccountTest, KeepsUsersWithTheirGroups) {
  ASSERT_TRUE(accounts().save_group({"lathes", {"lathe-1", "lathe-2"}}));
  User anna = user("anna");
  anna.groups = {"lathes", kAllMachines};
  anna.password = "$argon2id$";
  ASSERT_TRUE(accounts().save_user(anna, {}));
  anna.role = Role::Approver;
  anna.groups = {"lathes"};
  anna.signed_in = clock_.now();
  ASSERT_TRUE(accounts().save_user(anna, {}));
  reopen();
  const auto data = load();
  ASSERT_EQ(data.users.size(), 1u);
  EXPECT_EQ(data.users[0].role, Role::Approver);
  EXPECT_EQ(data.users[0].groups, std::set<std::string>{"lathes"});
  EXPECT_EQ(data.users[0].password, "$argon2id$");
  EXPECT_EQ(data.users[0].signed_in, clock_.now());
  ASSERT_EQ(data.groups.size(), 2u);
  EXPECT_EQ(data.groups[1].machines, (std::set<std::string>{"lathe-1", "lathe-2"}));
}

TEST_P(AccountTest, ARemovedUserStaysAndLosesEveryCredential) {
  User anna = user("anna");
  ASSERT_TRUE(accounts().save_user(anna, {}));
  ASSERT_TRUE(accounts().save_credential(credential("anna", "one"), {}));
  ASSERT_TRUE(accounts().save_credential(credential("anna", "two"), {}));
  anna.state = UserState::Removed;
  ASSERT_TRUE(accounts().save_user(anna, {}));
  const auto data = load();
  EXPECT_EQ(data.users.at(0).state, UserState::Removed);
  EXPECT_TRUE(data.credentials.empty());
}

TEST_P(AccountTest, KeepsCredentials) {
  ASSERT_TRUE(accounts().save_group({"mills", {}}));
  ASSERT_TRUE(accounts().save_user(user("anna"), {}));
  Credential token = credential("anna", "mes");
  token.kind = CredentialKind::Login;
  token.role = Role::Programmer;
  token.groups = std::set<std::string>{"mills"};
  token.expires = clock_.now() + std::chrono::hours(1);
  ASSERT_TRUE(accounts().save_credential(token, {}));
  ASSERT_TRUE(accounts().save_credential(credential("anna", "other"), {}));
  ASSERT_TRUE(
      accounts().note_uses({{"anna", "mes", clock_.now(), "192.0.2.1"}, {"x", "y", {}, ""}}));
  reopen();
  auto data = load();
  ASSERT_EQ(data.credentials.size(), 2u);
  EXPECT_EQ(data.credentials[0].kind, CredentialKind::Login);
  EXPECT_EQ(data.credentials[0].sha256, sha256(std::string_view("annames")));
  EXPECT_EQ(data.credentials[0].groups, std::set<std::string>{"mills"});
  EXPECT_EQ(data.credentials[0].expires, token.expires);
  EXPECT_EQ(data.credentials[0].used, clock_.now());
  EXPECT_EQ(data.credentials[0].used_from, "192.0.2.1");
  EXPECT_EQ(data.credentials[1].groups, std::nullopt);
  ASSERT_TRUE(accounts().save_credential(credential("anna", "third"), {"other"}));
  ASSERT_TRUE(accounts().remove_credentials("anna", {"mes", "absent"}));
  data = load();
  ASSERT_EQ(data.credentials.size(), 1u);
  EXPECT_EQ(data.credentials[0].name, "third");
}

TEST_P(AccountTest, RefusesWhatRefersToNothing) {
  EXPECT_EQ(accounts().save_credential(credential("stranger", "x"), {}).error().code,
            Errc::Conflict);
  User anna = user("anna");
  anna.groups = {"absent"};
  EXPECT_EQ(accounts().save_user(anna, {}).error().code, Errc::Conflict);
  EXPECT_TRUE(load().users.empty()) << "all or nothing";
  anna.groups = {kAllMachines};
  ASSERT_TRUE(accounts().save_user(anna, {}));
  EXPECT_EQ(accounts().remove_group(kAllMachines).error().code, Errc::Conflict);
  ASSERT_TRUE(accounts().save_credential(credential("anna", "x"), {}));
  Credential same = credential("anna", "y");
  same.sha256 = sha256(std::string_view("annax"));
  EXPECT_EQ(accounts().save_credential(same, {}).error().code, Errc::Conflict);
}

TEST_P(AccountTest, AGroupChangesItsMachines) {
  ASSERT_TRUE(accounts().save_group({"mills", {"mill-1", "mill-2"}}));
  ASSERT_TRUE(accounts().save_group({"mills", {"mill-3"}}));
  EXPECT_EQ(load().groups.at(1).machines, std::set<std::string>{"mill-3"});
  ASSERT_TRUE(accounts().remove_group("mills"));
  EXPECT_EQ(load().groups.size(), 1u);
}

TEST_P(AccountTest, AuditEntriesNameCredentialAndAddress) {
  ASSERT_TRUE(store_->audit.add(
      {clock_.now(), {"anna", "page-1", "192.0.2.1"}, "run.start", "r1", "detail"}));
  const auto entry = store_->audit.list({})->at(0);
  EXPECT_EQ(entry.who.name, "anna");
  EXPECT_EQ(entry.who.credential, "page-1");
  EXPECT_EQ(entry.who.address, "192.0.2.1");
  EXPECT_EQ(entry.detail, "detail");
}

/// A row that no program of ours wrote is never taken for a right.
TEST_P(AccountTest, AnUnknownRoleIsCorrupt) {
  ASSERT_TRUE(accounts().save_user(user("anna"), {}));
  damage(engine_ == sql::Engine::Sqlite
             ? "PRAGMA ignore_check_constraints = 1; UPDATE user SET role = 'root'"
             : "ALTER TABLE \"user\" DROP CONSTRAINT user_role_check; "
               "UPDATE \"user\" SET role = 'root'");
  EXPECT_EQ(store_->accounts.load().error().code, Errc::Corrupt);
}

ON_BOTH_ENGINES(AccountTest);

}  // namespace
}  // namespace dripline::storage
