#include <fstream>

#include "tests/unit/server/identity/accounts_fixture.hpp"

namespace dripline::identity {
namespace {

TEST_F(AccountsTest, TheFirstStartMakesOneAdministrator) {
  const auto caller = admin();
  EXPECT_EQ(caller.user, "admin");
  EXPECT_EQ(caller.role, Role::Administrator);
  EXPECT_TRUE(accounts().may_act_on(caller, "any-machine"));
  EXPECT_EQ(accounts().users().list().size(), 1u);
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
  ASSERT_TRUE(accounts().users().remove(chief, "admin"));
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

TEST_F(AccountsTest, CredentialsOfALockedOrRemovedUserAreWorthNothing) {
  add("anna", Role::Operator, {"all"});
  const std::string secret = token(admin(), "anna", {.name = "mes"});
  const auto caller = find(secret).value();
  ASSERT_TRUE(accounts().users().change(admin(), "anna", {.is_locked = true}));
  EXPECT_FALSE(find(secret));
  EXPECT_FALSE(accounts().may_act_on(caller, "lathe-1"));
  ASSERT_TRUE(accounts().users().change(admin(), "anna", {.is_locked = false}));
  EXPECT_TRUE(find(secret));
  ASSERT_TRUE(accounts().users().remove(admin(), "anna"));
  EXPECT_FALSE(find(secret));
  EXPECT_FALSE(accounts().is_valid(caller));
  reopen();
  EXPECT_FALSE(find(secret));
  EXPECT_EQ(accounts().users().add(admin(), {.name = "anna"}).error().code, Errc::Conflict)
      << "a name is never used again";
}

/// The disk is full just when a leaver is locked out.
TEST_F(AccountsTest, WhatTakesRightsAwayAppliesEvenWhenItCannotBeStored) {
  add("anna", Role::Viewer);
  add("bert", Role::Viewer);
  const std::string annas = token(admin(), "anna", {.name = "mes"});
  const std::string berts = token(admin(), "bert", {.name = "mes"});
  const std::string again = token(admin(), "bert", {.name = "again"});
  failing_->is_broken = true;
  EXPECT_EQ(accounts().users().remove(admin(), "anna").error().code, Errc::Io);
  EXPECT_FALSE(find(annas));
  EXPECT_EQ(accounts().tokens().revoke(admin(), "bert", "mes").error().code, Errc::Io);
  EXPECT_FALSE(find(berts));
  EXPECT_FALSE(accounts().users().change(admin(), "bert", {.is_locked = true}));
  EXPECT_FALSE(find(again));
  EXPECT_EQ(accounts().users().change(admin(), "bert", {.role = Role::Administrator}).error().code,
            Errc::Io);
  EXPECT_EQ(accounts().users().find(admin(), "bert")->role, Role::Viewer)
      << "what gives rights does not apply";
  EXPECT_FALSE(accounts().tokens().add(admin(), "bert", {.name = "more"}));
}

TEST_F(AccountsTest, TheLastAdministratorStays) {
  EXPECT_EQ(accounts().users().remove(admin(), "admin").error().code, Errc::Conflict);
  EXPECT_EQ(accounts().users().change(admin(), "admin", {.role = Role::Viewer}).error().code,
            Errc::Conflict);
  EXPECT_EQ(accounts().users().change(admin(), "admin", {.is_locked = true}).error().code,
            Errc::Conflict);
  ASSERT_TRUE(accounts().users().add(admin(), {.name = "paper", .role = Role::Administrator}));
  EXPECT_EQ(accounts().users().remove(admin(), "admin").error().code, Errc::Conflict)
      << "one who can never sign in is none";
  add("chief", Role::Administrator);
  EXPECT_TRUE(accounts().users().remove(admin(), "admin"));
}

TEST_F(AccountsTest, ACookieIsNoTokenAndATokenNoCookie) {
  add("anna", Role::Viewer);
  const auto page =
      accounts().sessions().sign_in({.user = "anna", .password = kPassword, .address = "a"});
  EXPECT_TRUE(find(page->secret, From::Cookie));
  EXPECT_FALSE(find(page->secret, From::Bearer));
  EXPECT_FALSE(find(kLocalSecret, From::Cookie));
}

TEST_F(AccountsTest, AGroupInUseStays) {
  add_group("lathes", {"lathe-1"});
  add("anna", Role::Operator, {"lathes"});
  EXPECT_NE(accounts().groups().remove(admin(), "lathes").error().what.find("anna"),
            std::string::npos);
  ASSERT_TRUE(accounts().users().change(admin(), "anna", {.groups = std::set<std::string>{}}));
  EXPECT_TRUE(accounts().groups().remove(admin(), "lathes"));
  EXPECT_EQ(accounts().groups().remove(admin(), "all").error().code, Errc::Conflict);
  EXPECT_EQ(accounts().groups().add_machine(admin(), "all", "m").error().code, Errc::Conflict);
  EXPECT_EQ(accounts().groups().add_machine(admin(), "absent", "m").error().code, Errc::NotFound);
}

TEST_F(AccountsTest, AMachineThatLeavesItsGroupIsOutOfReachAtOnce) {
  add_group("lathes", {"lathe-1"});
  add("anna", Role::Operator, {"lathes"});
  const auto anna = signed_in("anna").value();
  EXPECT_TRUE(accounts().may_act_on(anna, "lathe-1"));
  ASSERT_TRUE(accounts().groups().remove_machine(admin(), "lathes", "lathe-1"));
  EXPECT_FALSE(accounts().may_act_on(anna, "lathe-1"));
}

}  // namespace
}  // namespace dripline::identity
