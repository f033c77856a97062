#include "tests/unit/server/identity/accounts_fixture.hpp"

namespace dripline::identity {
namespace {

using namespace std::chrono_literals;

class TokensTest : public AccountsTest {};

TEST_F(TokensTest, TokensExpireAndAreRevoked) {
  add("anna", Role::Viewer);
  const std::string secret = token(admin(), "anna", {.name = "mes", .life = std::chrono::days(1)});
  const std::string other = token(admin(), "anna", {.name = "other"});
  clock_.advance(23h);
  EXPECT_TRUE(find(secret));
  clock_.advance(1h);
  EXPECT_FALSE(find(secret));
  EXPECT_TRUE(find(other));
  ASSERT_TRUE(accounts().tokens().revoke(admin(), "anna", "other"));
  EXPECT_FALSE(find(other));
  reopen();
  EXPECT_FALSE(find(other));
  EXPECT_EQ(accounts().tokens().revoke(admin(), "anna", "other").error().code, Errc::NotFound);
  EXPECT_EQ(accounts().tokens().revoke(admin(), "admin", "local").error().code, Errc::Conflict);
}

TEST_F(TokensTest, AScopeNeverExceedsItsOwnersRights) {
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
  ASSERT_TRUE(accounts().users().change(
      admin(), "anna", {.role = Role::Viewer, .groups = std::set<std::string>{"mills"}}));
  EXPECT_FALSE(accounts().may_act_on(lathes, "lathe-1"));
  const auto after = accounts().tokens().list(admin(), "anna");
  EXPECT_EQ(after->size(), 3u);
  EXPECT_EQ(find(token(admin(), "anna", {.name = "new"}))->role, Role::Viewer);
  for (const auto& secret : {sign_in("anna")->secret}) EXPECT_EQ(find(secret)->role, Role::Viewer);
}

TEST_F(TokensTest, ATokenMakesNoGreaterToken) {
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
    const auto issued = accounts().tokens().add(by, "anna", wanted);
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

/// The first user has no password, and its tokens are given to monitoring.
TEST_F(TokensTest, ALimitedTokenSetsNoPasswordAndEndsNoOther) {
  add_group("lathes", {"lathe-1"});
  const auto viewer =
      find(token(admin(), "admin", {.name = "prometheus", .role = Role::Viewer})).value();
  const auto set = accounts().users().set_password(viewer, "admin", {.password = "evil-password"});
  ASSERT_FALSE(set);
  EXPECT_EQ(set.error().code, Errc::Denied);
  EXPECT_NE(set.error().what.find("credential prometheus of user admin is limited (viewer)"),
            std::string::npos)
      << set.error().what;
  EXPECT_FALSE(sign_in("admin", "evil-password"));
  const std::string mes = token(admin(), "admin", {.name = "mes"});
  EXPECT_EQ(accounts().tokens().revoke(viewer, "admin", "mes").error().code, Errc::Denied);
  EXPECT_TRUE(find(mes));
  EXPECT_TRUE(accounts().tokens().revoke(viewer, "admin", "prometheus")) << "itself";
  ASSERT_TRUE(accounts().users().add(
      admin(), {.name = "anna", .role = Role::Operator, .groups = {"lathes"}, .password = {}}));
  const auto of_group =
      find(token(admin(), "anna", {.name = "cell", .groups = std::set<std::string>{"lathes"}}))
          .value();
  EXPECT_EQ(accounts().users().set_password(of_group, "anna", {.password = kPassword}).error().code,
            Errc::Denied);
  const auto full = find(token(admin(), "anna", {.name = "full"})).value();
  EXPECT_TRUE(accounts().tokens().revoke(full, "anna", "cell"));
  EXPECT_TRUE(accounts().users().set_password(full, "anna", {.password = kPassword}));
}

TEST_F(TokensTest, AnAdministratorsTokenCannotBeLimitedToGroupsButALowerOneCan) {
  add_group("lathes", {"lathe-1"});
  NewToken wanted{.name = "t", .role = {}, .groups = std::set<std::string>{"lathes"}};
  EXPECT_EQ(accounts().tokens().add(admin(), "admin", wanted).error().code, Errc::Conflict);
  wanted.role = Role::Operator;
  const auto caller = find(token(admin(), "admin", wanted)).value();
  EXPECT_TRUE(accounts().may_act_on(caller, "lathe-1"));
  EXPECT_FALSE(accounts().may_act_on(caller, "mill-1"));
}

TEST_F(TokensTest, TheLastUseIsKept) {
  add("anna", Role::Viewer);
  const std::string secret = token(admin(), "anna", {.name = "mes"});
  clock_.advance(2min);
  ASSERT_TRUE(find(secret));
  accounts().store_uses();
  reopen();
  const auto listed = accounts().tokens().list(admin(), "anna")->at(0);
  EXPECT_EQ(listed.used, clock_.now());
  EXPECT_EQ(listed.used_from, "192.0.2.1");
}

TEST_F(TokensTest, AUserSeesAndEndsOnlyTheOwnTokens) {
  add("anna", Role::Approver);
  add("bert", Role::Approver);
  const auto anna = signed_in("anna").value();
  EXPECT_EQ(accounts().tokens().list(anna, "bert").error().code, Errc::Denied);
  EXPECT_EQ(accounts().users().find(anna, "bert").error().code, Errc::Denied);
  EXPECT_EQ(accounts().users().find(anna, "absent").error().code, Errc::Denied) << "not even that";
  EXPECT_EQ(accounts().tokens().add(anna, "bert", {.name = "x"}).error().code, Errc::Denied);
  EXPECT_EQ(accounts().tokens().revoke(anna, "bert", "x").error().code, Errc::Denied);
  EXPECT_TRUE(accounts().tokens().revoke(anna, "anna", anna.credential));
  EXPECT_FALSE(accounts().is_valid(anna));
}

}  // namespace
}  // namespace dripline::identity
