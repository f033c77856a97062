#include <algorithm>
#include <atomic>
#include <fstream>
#include <thread>

#include "server/identity/accounts.hpp"
#include "storage/sqlite_store.hpp"
#include "tests/support/manual_clock.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::identity {
namespace {

using namespace std::chrono_literals;
using From = PresentedSecret::From;

/// Forwards to a real store until `is_broken`.
class FailingStore final : public storage::AccountStore {
 public:
  explicit FailingStore(storage::AccountStore& inner) : inner_(inner) {}
  bool is_broken = false;

  Result<storage::AccountData> load() override { return inner_.load(); }
  Result<void> save_user(const User& user, const std::vector<std::string>& ended) override {
    return is_broken ? broken() : inner_.save_user(user, ended);
  }
  Result<void> save_credential(const Credential& credential,
                               const std::vector<std::string>& ended) override {
    return is_broken ? broken() : inner_.save_credential(credential, ended);
  }
  Result<void> remove_credentials(const std::string& user,
                                  const std::vector<std::string>& names) override {
    return is_broken ? broken() : inner_.remove_credentials(user, names);
  }
  Result<void> note_uses(const std::vector<storage::CredentialUse>& uses) override {
    return is_broken ? broken() : inner_.note_uses(uses);
  }
  Result<void> save_group(const MachineGroup& group) override {
    return is_broken ? broken() : inner_.save_group(group);
  }
  Result<void> remove_group(const std::string& name) override {
    return is_broken ? broken() : inner_.remove_group(name);
  }

 private:
  static Result<void> broken() { return fail(Errc::Io, "disk full"); }
  storage::AccountStore& inner_;
};

const std::string kLocalSecret(64, '0');
const std::string kPassword = "correct horse";

class AccountsTest : public testing::Test {
 protected:
  AccountsTest() { reopen(); }

  /// As after a restart of the server.
  void reopen(PasswordHasher::Options hashing = {.cost = {.passes = 1, .memory = 8192}}) {
    accounts_.reset();
    audit_.reset();
    failing_.reset();
    store_.reset();
    store_ = storage::SqliteStore::open({.file = folder_.path() / "store.sqlite"}, clock_).value();
    failing_ = std::make_unique<FailingStore>(store_->accounts);
    audit_ = std::make_unique<library::AuditTrail>(store_->audit, clock_);
    auto opened = Accounts::open({.store = *failing_, .audit = *audit_, .clock = clock_},
                                 {.hashing = hashing, .attempts = {.of_user = 5}});
    ASSERT_TRUE(opened) << opened.error().what;
    accounts_ = *std::move(opened);
    ASSERT_TRUE(accounts_->use_local_secret(kLocalSecret, false));
  }
  Accounts& accounts() { return *accounts_; }
  Caller admin() { return find(kLocalSecret).value(); }
  std::optional<Caller> find(const std::string& secret, From from = From::Bearer) {
    return accounts_->find({from, secret}, "192.0.2.1");
  }
  void add(const std::string& name, Role role, const std::set<std::string>& groups = {}) {
    const auto added = accounts_->add_user(
        admin(), {.name = name, .role = role, .groups = groups, .password = kPassword});
    ASSERT_TRUE(added) << added.error().what;
  }
  void add_group(const std::string& name, const std::vector<std::string>& machines) {
    ASSERT_TRUE(accounts_->add_group(admin(), name));
    for (const auto& machine : machines)
      ASSERT_TRUE(accounts_->add_machine(admin(), name, machine));
  }
  Result<Issued> sign_in(const std::string& user, const std::string& password = kPassword,
                         const std::string& address = "192.0.2.1") {
    return accounts_->sign_in(
        {.user = user, .password = password, .address = address, .kind = CredentialKind::Login});
  }
  std::optional<Caller> signed_in(const std::string& user) { return find(sign_in(user)->secret); }
  std::string token(const Caller& by, const std::string& user, const NewToken& wanted) {
    const auto issued = accounts_->add_token(by, user, wanted);
    EXPECT_TRUE(issued) << issued.error().what;
    return issued ? issued->secret : "";
  }
  std::vector<std::string> audited(const std::string& action) {
    accounts_->refusals().flush();
    std::vector<std::string> entries;
    const auto list = audit_->entries({});
    for (const auto& entry : list.value()) {
      if (entry.action == action)
        entries.push_back(fmt::format("{} {} {} {}", entry.who.name, entry.who.address,
                                      entry.subject, entry.detail));
    }
    return entries;
  }

  test_support::TemporaryFolder folder_;
  test_support::ManualClock clock_;
  std::unique_ptr<storage::SqliteStore> store_;
  std::unique_ptr<FailingStore> failing_;
  std::unique_ptr<library::AuditTrail> audit_;
  std::unique_ptr<Accounts> accounts_;
};

TEST_F(AccountsTest, TheFirstStartMakesOneAdministrator) {
  const auto caller = admin();
  EXPECT_EQ(caller.user, "admin");
  EXPECT_EQ(caller.role, Role::Administrator);
  EXPECT_TRUE(accounts().may_act_on(caller, "any-machine"));
  EXPECT_EQ(accounts().users().size(), 1u);
  reopen();
  EXPECT_TRUE(find(kLocalSecret));
  EXPECT_EQ(audited("user.add").size(), 1u) << "the second start makes nothing";
}

TEST_F(AccountsTest, AnotherTokenFileReplacesTheOldOne) {
  const std::string fresh(64, '1');
  ASSERT_TRUE(accounts().use_local_secret(fresh, false));
  EXPECT_TRUE(find(fresh));
  EXPECT_FALSE(find(kLocalSecret));
}

TEST_F(AccountsTest, TheTokenFileOfARemovedAdministratorIsWorthNothing) {
  add("chief", Role::Administrator);
  const auto chief = signed_in("chief").value();
  ASSERT_TRUE(accounts().remove_user(chief, "admin"));
  EXPECT_FALSE(find(kLocalSecret));
  reopen();
  EXPECT_FALSE(find(kLocalSecret)) << "a restart brings it back to no life";
  ASSERT_TRUE(accounts().use_local_secret(kLocalSecret, true));
  EXPECT_EQ(find(kLocalSecret)->role, Role::Administrator) << "unless the owner of the folder asks";
}

TEST_F(AccountsTest, ASecretIsStoredNowhere) {
  add("anna", Role::Viewer);
  const std::string secret = token(admin(), "anna", {.name = "mes"});
  const auto issued = sign_in("anna");
  reopen();
  accounts_.reset();
  for (const auto& file : std::filesystem::directory_iterator(folder_.path())) {
    std::ifstream stream(file.path(), std::ios::binary);
    const std::string bytes(std::istreambuf_iterator<char>(stream), {});
    for (const auto& text : {secret, issued->secret, kPassword})
      EXPECT_EQ(bytes.find(text), std::string::npos) << file.path();
  }
}

// -- passwords ------------------------------------------------------------------------------------

TEST_F(AccountsTest, SignsInAndOut) {
  add("anna", Role::Programmer);
  const auto issued = sign_in("anna");
  ASSERT_TRUE(issued) << issued.error().what;
  const auto caller = find(issued->secret);
  ASSERT_TRUE(caller);
  EXPECT_EQ(caller->user, "anna");
  EXPECT_EQ(caller->role, Role::Programmer);
  EXPECT_EQ(caller->address, "192.0.2.1");
  reopen();
  ASSERT_TRUE(find(issued->secret)) << "a restart signs nobody out";
  ASSERT_TRUE(accounts().sign_out(*caller));
  EXPECT_FALSE(find(issued->secret));
  EXPECT_FALSE(accounts().is_valid(*caller));
  EXPECT_EQ(audited("sign-in").size(), 1u);
  EXPECT_EQ(audited("sign-out").size(), 1u);
}

/// Neither the text nor the work that is done tells a stranger which users there are.
TEST_F(AccountsTest, RefusesEveryoneWithTheSameWords) {
  add("anna", Role::Viewer);
  add("locked", Role::Viewer);
  add("gone", Role::Viewer);
  ASSERT_TRUE(accounts().add_user(admin(), {.name = "machine"}));
  ASSERT_TRUE(accounts().change_user(admin(), "locked", {.is_locked = true}));
  ASSERT_TRUE(accounts().remove_user(admin(), "gone"));
  const auto wrong = sign_in("anna", "wrong password").error();
  EXPECT_EQ(wrong.code, Errc::Denied);
  for (const char* name : {"locked", "gone", "machine", "nobody", "", "No/Name", "admin"}) {
    const auto refused = sign_in(name);
    ASSERT_FALSE(refused) << name;
    EXPECT_EQ(refused.error().what, wrong.what) << name;
    EXPECT_EQ(refused.error().code, wrong.code) << name;
  }
  EXPECT_FALSE(sign_in("machine", "")) << "no password is not the empty password";
}

TEST_F(AccountsTest, RefusalsAreAuditedWithoutWhatWasTypedAsAName) {
  add("anna", Role::Viewer);
  (void)sign_in("anna", "wrong password");
  (void)sign_in("my secret password", "x");
  const auto entries = audited("sign-in.refused");
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[1], "anna 192.0.2.1 anna wrong password");
  EXPECT_EQ(entries[0], " 192.0.2.1 unknown user wrong password");
}

TEST_F(AccountsTest, BruteForceIsStoppedEvenWithTheRightPasswordAtTheEnd) {
  add("anna", Role::Viewer);
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(sign_in("anna", "wrong" + std::to_string(i), std::to_string(i)).error().code,
              Errc::Denied);
  EXPECT_EQ(sign_in("anna", kPassword, "elsewhere").error().code, Errc::Busy);
  clock_.advance(10min);
  EXPECT_TRUE(sign_in("anna"));
}

TEST_F(AccountsTest, AThousandGuessesAtOnceAreNoMoreThanTheLimit) {
  add("anna", Role::Viewer);
  std::atomic<int> looked_at = 0;
  std::vector<std::thread> threads;
  threads.reserve(8);
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&, i] {
      for (int guess = 0; guess < 20; ++guess) {
        const auto tried = sign_in("anna", fmt::format("guess {} {}", i, guess), std::to_string(i));
        if (tried.error().code == Errc::Denied) ++looked_at;
      }
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_LE(looked_at, 5);
}

TEST_F(AccountsTest, AMegabyteOfPasswordIsRefusedBeforeItIsHashed) {
  add("anna", Role::Viewer);
  const auto before = accounts().hasher().peak();
  EXPECT_EQ(sign_in("anna", std::string(1 << 20, 'x')).error().code, Errc::LimitExceeded);
  EXPECT_EQ(accounts()
                .set_password(admin(), "anna", {.password = std::string(1 << 20, 'x')})
                .error()
                .code,
            Errc::LimitExceeded);
  EXPECT_EQ(accounts().hasher().peak(), before);
  EXPECT_EQ(accounts().set_password(admin(), "anna", {.password = "short"}).error().code,
            Errc::Syntax);
}

TEST_F(AccountsTest, ANewPasswordEndsTheSessionsButNotTheCallers) {
  add("anna", Role::Viewer);
  const auto here = signed_in("anna").value();
  const auto there = signed_in("anna").value();
  EXPECT_EQ(accounts().set_password(here, "anna", {.password = "another horse"}).error().code,
            Errc::Denied)
      << "without the current one";
  ASSERT_TRUE(
      accounts().set_password(here, "anna", {.password = "another horse", .current = kPassword}));
  EXPECT_TRUE(accounts().is_valid(here));
  EXPECT_FALSE(accounts().is_valid(there));
  EXPECT_FALSE(sign_in("anna"));
  EXPECT_TRUE(sign_in("anna", "another horse"));
  EXPECT_EQ(accounts().set_password(here, "admin", {.password = "another horse"}).error().code,
            Errc::Denied);
}

TEST_F(AccountsTest, ARaisedCostReplacesTheDigestAtTheNextSignIn) {
  add("anna", Role::Viewer);
  reopen({.cost = {.passes = 2, .memory = 16384}});
  ASSERT_TRUE(sign_in("anna"));
  EXPECT_NE(accounts().user(admin(), "anna")->password.find("m=16,t=2"), std::string::npos);
  ASSERT_TRUE(sign_in("anna"));
}

// -- what takes rights away -----------------------------------------------------------------------

TEST_F(AccountsTest, CredentialsOfALockedOrRemovedUserAreWorthNothing) {
  add("anna", Role::Operator, {"all"});
  const std::string secret = token(admin(), "anna", {.name = "mes"});
  const auto caller = find(secret).value();
  ASSERT_TRUE(accounts().change_user(admin(), "anna", {.is_locked = true}));
  EXPECT_FALSE(find(secret));
  EXPECT_FALSE(accounts().may_act_on(caller, "lathe-1"));
  ASSERT_TRUE(accounts().change_user(admin(), "anna", {.is_locked = false}));
  EXPECT_TRUE(find(secret));
  ASSERT_TRUE(accounts().remove_user(admin(), "anna"));
  EXPECT_FALSE(find(secret));
  EXPECT_FALSE(accounts().is_valid(caller));
  reopen();
  EXPECT_FALSE(find(secret));
  EXPECT_EQ(accounts().add_user(admin(), {.name = "anna"}).error().code, Errc::Conflict)
      << "a name is never used again";
}

TEST_F(AccountsTest, TokensExpireAndAreRevoked) {
  add("anna", Role::Viewer);
  const std::string secret = token(admin(), "anna", {.name = "mes", .life = std::chrono::days(1)});
  const std::string other = token(admin(), "anna", {.name = "other"});
  clock_.advance(23h);
  EXPECT_TRUE(find(secret));
  clock_.advance(1h);
  EXPECT_FALSE(find(secret));
  EXPECT_TRUE(find(other));
  ASSERT_TRUE(accounts().revoke(admin(), "anna", "other"));
  EXPECT_FALSE(find(other));
  reopen();
  EXPECT_FALSE(find(other));
  EXPECT_EQ(accounts().revoke(admin(), "anna", "other").error().code, Errc::NotFound);
  EXPECT_EQ(accounts().revoke(admin(), "admin", "local").error().code, Errc::Conflict);
}

/// The disk is full just when a leaver is locked out.
TEST_F(AccountsTest, WhatTakesRightsAwayAppliesEvenWhenItCannotBeStored) {
  add("anna", Role::Viewer);
  add("bert", Role::Viewer);
  const std::string annas = token(admin(), "anna", {.name = "mes"});
  const std::string berts = token(admin(), "bert", {.name = "mes"});
  const std::string again = token(admin(), "bert", {.name = "again"});
  failing_->is_broken = true;
  EXPECT_EQ(accounts().remove_user(admin(), "anna").error().code, Errc::Io);
  EXPECT_FALSE(find(annas));
  EXPECT_EQ(accounts().revoke(admin(), "bert", "mes").error().code, Errc::Io);
  EXPECT_FALSE(find(berts));
  EXPECT_FALSE(accounts().change_user(admin(), "bert", {.is_locked = true}));
  EXPECT_FALSE(find(again));
  EXPECT_EQ(accounts().change_user(admin(), "bert", {.role = Role::Administrator}).error().code,
            Errc::Io);
  EXPECT_EQ(accounts().user(admin(), "bert")->role, Role::Viewer)
      << "what gives rights does not apply";
  EXPECT_FALSE(accounts().add_token(admin(), "bert", {.name = "more"}));
}

TEST_F(AccountsTest, AScopeNeverExceedsItsOwnersRights) {
  add_group("lathes", {"lathe-1"});
  add_group("mills", {"mill-1"});
  add("anna", Role::Approver, {"lathes", "mills"});
  const auto caller = signed_in("anna").value();
  const auto full = find(token(caller, "anna", {.name = "full"})).value();
  const auto lathes = find(token(caller, "anna",
                                 {.name = "lathes",
                                  .role = Role::Operator,
                                  .groups = std::set<std::string>{"lathes"}}))
                          .value();
  EXPECT_EQ(full.role, Role::Approver);
  EXPECT_TRUE(accounts().may_act_on(full, "mill-1"));
  EXPECT_EQ(lathes.role, Role::Operator);
  EXPECT_TRUE(accounts().may_act_on(lathes, "lathe-1"));
  EXPECT_FALSE(accounts().may_act_on(lathes, "mill-1"));
  EXPECT_FALSE(accounts().may_act_on(full, "robot-1"));
  // The owner is demoted, and loses a group.
  ASSERT_TRUE(accounts().change_user(
      admin(), "anna", {.role = Role::Viewer, .groups = std::set<std::string>{"mills"}}));
  EXPECT_FALSE(accounts().may_act_on(lathes, "lathe-1"));
  const auto after = accounts().credentials(admin(), "anna");
  EXPECT_EQ(after->size(), 3u);
  EXPECT_EQ(find(token(admin(), "anna", {.name = "new"}))->role, Role::Viewer);
  for (const auto& secret : {sign_in("anna")->secret}) EXPECT_EQ(find(secret)->role, Role::Viewer);
}

TEST_F(AccountsTest, ATokenMakesNoGreaterToken) {
  add_group("lathes", {"lathe-1"});
  add_group("mills", {"mill-1"});
  add("anna", Role::Approver, {"lathes", "mills"});
  const auto viewer = find(token(admin(), "anna",
                                 {.name = "viewer",
                                  .role = Role::Viewer,
                                  .groups = std::set<std::string>{"lathes"},
                                  .life = std::chrono::days(2)}))
                          .value();
  const auto refused = [&](const Caller& by, const NewToken& wanted) {
    const auto issued = accounts().add_token(by, "anna", wanted);
    return issued ? "issued" : std::string(to_string(issued.error().code));
  };
  EXPECT_EQ(refused(viewer, {.name = "a", .role = Role::Operator}), "denied");
  EXPECT_EQ(refused(viewer, {.name = "a", .life = std::chrono::days(3)}), "denied");
  EXPECT_EQ(refused(viewer, {.name = "a", .groups = std::set<std::string>{"mills"}}), "denied");
  EXPECT_EQ(refused(viewer, {.name = "a", .groups = std::set<std::string>{"all"}}), "denied");
  EXPECT_EQ(refused(admin(), {.name = "a", .role = Role::Administrator}), "denied")
      << "more than its owner has";
  EXPECT_EQ(refused(admin(), {.name = "a", .groups = std::set<std::string>{"all"}}), "denied");
  EXPECT_EQ(refused(admin(), {.name = "a", .groups = std::set<std::string>{"absent"}}),
            "not_found");
  EXPECT_EQ(refused(admin(), {.name = "a", .life = std::chrono::days(731)}), "limit_exceeded");
  EXPECT_EQ(refused(admin(), {.name = "../a"}), "syntax");
  const auto child = find(token(viewer, "anna", {.name = "b", .life = std::chrono::days(1)}));
  EXPECT_EQ(child->role, Role::Viewer);
  EXPECT_FALSE(accounts().may_act_on(*child, "mill-1")) << "the groups of the token that made it";
  EXPECT_EQ(refused(*find(kLocalSecret), {.name = "b"}), "conflict") << "names are unique";
}

TEST_F(AccountsTest, AnAdministratorsTokenCannotBeLimitedToGroupsButALowerOneCan) {
  add_group("lathes", {"lathe-1"});
  NewToken wanted{.name = "t", .role = {}, .groups = std::set<std::string>{"lathes"}};
  EXPECT_EQ(accounts().add_token(admin(), "admin", wanted).error().code, Errc::Conflict);
  wanted.role = Role::Operator;
  const auto caller = find(token(admin(), "admin", wanted)).value();
  EXPECT_TRUE(accounts().may_act_on(caller, "lathe-1"));
  EXPECT_FALSE(accounts().may_act_on(caller, "mill-1"));
}

TEST_F(AccountsTest, TheLastAdministratorStays) {
  EXPECT_EQ(accounts().remove_user(admin(), "admin").error().code, Errc::Conflict);
  EXPECT_EQ(accounts().change_user(admin(), "admin", {.role = Role::Viewer}).error().code,
            Errc::Conflict);
  EXPECT_EQ(accounts().change_user(admin(), "admin", {.is_locked = true}).error().code,
            Errc::Conflict);
  ASSERT_TRUE(accounts().add_user(admin(), {.name = "paper", .role = Role::Administrator}));
  EXPECT_EQ(accounts().remove_user(admin(), "admin").error().code, Errc::Conflict)
      << "one who can never sign in is none";
  add("chief", Role::Administrator);
  EXPECT_TRUE(accounts().remove_user(admin(), "admin"));
}

// -- the rest -------------------------------------------------------------------------------------

TEST_F(AccountsTest, ACookieIsNoTokenAndATokenNoCookie) {
  add("anna", Role::Viewer);
  const auto page = accounts().sign_in({.user = "anna", .password = kPassword, .address = "a"});
  EXPECT_TRUE(find(page->secret, From::Cookie));
  EXPECT_FALSE(find(page->secret, From::Bearer));
  EXPECT_FALSE(find(kLocalSecret, From::Cookie));
}

TEST_F(AccountsTest, TheOldestSessionMakesRoom) {
  add("anna", Role::Viewer);
  const auto first = sign_in("anna")->secret;
  for (std::size_t i = 0; i < Accounts::kMaxSessions; ++i) {
    EXPECT_TRUE(find(first).has_value() == (i < Accounts::kMaxSessions));
    clock_.advance(1s);
    ASSERT_TRUE(sign_in("anna"));
  }
  EXPECT_FALSE(find(first));
  EXPECT_EQ(accounts().credentials(admin(), "anna")->size(), Accounts::kMaxSessions);
}

TEST_F(AccountsTest, TidyRemovesSessionsThatExpiredAndKeepsTokens) {
  add("anna", Role::Viewer);
  ASSERT_TRUE(sign_in("anna"));
  token(admin(), "anna", {.name = "mes", .life = std::chrono::days(1)});
  clock_.advance(48h);
  accounts().tidy();
  ASSERT_EQ(accounts().credentials(admin(), "anna")->size(), 1u);
  reopen();
  EXPECT_EQ(accounts().credentials(admin(), "anna")->at(0).name, "mes");
}

TEST_F(AccountsTest, TheLastUseIsKept) {
  add("anna", Role::Viewer);
  const std::string secret = token(admin(), "anna", {.name = "mes"});
  clock_.advance(2min);
  ASSERT_TRUE(find(secret));
  accounts().store_uses();
  reopen();
  const auto listed = accounts().credentials(admin(), "anna")->at(0);
  EXPECT_EQ(listed.used, clock_.now());
  EXPECT_EQ(listed.used_from, "192.0.2.1");
}

TEST_F(AccountsTest, AUserSeesAndEndsOnlyTheOwnTokens) {
  add("anna", Role::Approver);
  add("bert", Role::Approver);
  const auto anna = signed_in("anna").value();
  EXPECT_EQ(accounts().credentials(anna, "bert").error().code, Errc::Denied);
  EXPECT_EQ(accounts().user(anna, "bert").error().code, Errc::Denied);
  EXPECT_EQ(accounts().user(anna, "absent").error().code, Errc::Denied) << "not even that";
  EXPECT_EQ(accounts().add_token(anna, "bert", {.name = "x"}).error().code, Errc::Denied);
  EXPECT_EQ(accounts().revoke(anna, "bert", "x").error().code, Errc::Denied);
  EXPECT_TRUE(accounts().revoke(anna, "anna", anna.credential));
  EXPECT_FALSE(accounts().is_valid(anna));
}

TEST_F(AccountsTest, AGroupInUseStays) {
  add_group("lathes", {"lathe-1"});
  add("anna", Role::Operator, {"lathes"});
  EXPECT_NE(accounts().remove_group(admin(), "lathes").error().what.find("anna"),
            std::string::npos);
  ASSERT_TRUE(accounts().change_user(admin(), "anna", {.groups = std::set<std::string>{}}));
  EXPECT_TRUE(accounts().remove_group(admin(), "lathes"));
  EXPECT_EQ(accounts().remove_group(admin(), "all").error().code, Errc::Conflict);
  EXPECT_EQ(accounts().add_machine(admin(), "all", "m").error().code, Errc::Conflict);
  EXPECT_EQ(accounts().add_machine(admin(), "absent", "m").error().code, Errc::NotFound);
}

TEST_F(AccountsTest, AMachineThatLeavesItsGroupIsOutOfReachAtOnce) {
  add_group("lathes", {"lathe-1"});
  add("anna", Role::Operator, {"lathes"});
  const auto anna = signed_in("anna").value();
  EXPECT_TRUE(accounts().may_act_on(anna, "lathe-1"));
  ASSERT_TRUE(accounts().remove_machine(admin(), "lathes", "lathe-1"));
  EXPECT_FALSE(accounts().may_act_on(anna, "lathe-1"));
}

/// A stranger in a loop makes two entries, not a million.
TEST_F(AccountsTest, RepeatedRefusalsAreCounted) {
  for (int i = 0; i < 1000; ++i) {
    accounts().refusals().note({.who = {"anna", "t", "192.0.2.9"},
                                .action = "access.refused",
                                .subject = "GET /api/v1/users",
                                .detail = "role viewer"});
  }
  const auto entries = audited("access.refused");
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[1], "anna 192.0.2.9 GET /api/v1/users role viewer");
  EXPECT_EQ(entries[0], "anna 192.0.2.9 GET /api/v1/users role viewer; 999 more like this since");
}

TEST_F(AccountsTest, ManyKindsOfRefusalsAreCountedTogether) {
  for (int i = 0; i < 1000; ++i)
    accounts().refusals().note({.who = {"", "", std::to_string(i)},
                                .action = "access.refused",
                                .subject = "s",
                                .detail = ""});
  EXPECT_LE(audited("access.refused").size(), 260u);
}

}  // namespace
}  // namespace dripline::identity
