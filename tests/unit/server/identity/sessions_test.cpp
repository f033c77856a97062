#include <atomic>
#include <thread>

#include "server/identity/account_limits.hpp"
#include "tests/unit/server/identity/accounts_fixture.hpp"

namespace dripline::identity {
namespace {

using namespace std::chrono_literals;

class SessionsTest : public AccountsTest {};

TEST_F(SessionsTest, SignsInAndOut) {
  add("anna", Role::Programmer);
  const auto issued = sign_in("anna");
  ASSERT_TRUE(issued) << issued.error().what;
  const auto caller = find(issued->secret);
  ASSERT_TRUE(caller);
  EXPECT_EQ(caller->user, "anna");
  EXPECT_EQ(caller->role, Role::Programmer);
  EXPECT_EQ(caller->address, "192.0.2.1");
  reopen();
  ASSERT_TRUE(find(issued->secret)) << "a restart signs no user out";
  ASSERT_TRUE(accounts().sessions().sign_out(*caller));
  EXPECT_FALSE(find(issued->secret));
  EXPECT_FALSE(accounts().is_valid(*caller));
  EXPECT_EQ(audited("sign-in").size(), 1u);
  EXPECT_EQ(audited("sign-out").size(), 1u);
}

/// Neither the text nor the work that is done shows a stranger which users there are.
TEST_F(SessionsTest, RefusesEveryoneWithTheSameWords) {
  add("anna", Role::Viewer);
  add("locked", Role::Viewer);
  add("gone", Role::Viewer);
  ASSERT_TRUE(accounts().users().add(admin(), {.name = "machine"}));
  ASSERT_TRUE(accounts().users().change(admin(), "locked", {.is_locked = true}));
  ASSERT_TRUE(accounts().users().remove(admin(), "gone"));
  const auto wrong = sign_in("anna", "wrong password").error();
  EXPECT_EQ(wrong.code, Errc::Denied);
  for (const char* name : {"locked", "gone", "machine", "stranger", "", "No/Name", "admin"}) {
    const auto refused = sign_in(name);
    ASSERT_FALSE(refused) << name;
    EXPECT_EQ(refused.error().what, wrong.what) << name;
    EXPECT_EQ(refused.error().code, wrong.code) << name;
  }
  EXPECT_FALSE(sign_in("machine", "")) << "no password is not the empty password";
}

TEST_F(SessionsTest, RefusalsAreAuditedWithoutWhatWasTypedAsAName) {
  add("anna", Role::Viewer);
  (void)sign_in("anna", "wrong password");
  (void)sign_in("my secret password", "x");
  const auto entries = audited("sign-in.refused");
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[1], "anna 192.0.2.1 anna wrong password");
  EXPECT_EQ(entries[0], " 192.0.2.1 unknown user wrong password");
}

TEST_F(SessionsTest, BruteForceIsStoppedEvenWithTheRightPasswordAtTheEnd) {
  add("anna", Role::Viewer);
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(sign_in("anna", "wrong" + std::to_string(i), std::to_string(i)).error().code,
              Errc::Denied);
  EXPECT_EQ(sign_in("anna", kPassword, "elsewhere").error().code, Errc::Busy);
  clock_.advance(10min);
  EXPECT_TRUE(sign_in("anna"));
}

TEST_F(SessionsTest, AThousandGuessesAtOnceAreNoMoreThanTheLimit) {
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

TEST_F(SessionsTest, AMegabyteOfPasswordIsRefusedBeforeItIsHashed) {
  add("anna", Role::Viewer);
  const auto before = accounts().hasher().peak();
  EXPECT_EQ(sign_in("anna", std::string(1 << 20, 'x')).error().code, Errc::LimitExceeded);
  EXPECT_EQ(accounts()
                .users()
                .set_password(admin(), "anna", {.password = std::string(1 << 20, 'x')})
                .error()
                .code,
            Errc::LimitExceeded);
  EXPECT_EQ(accounts().hasher().peak(), before);
  EXPECT_EQ(accounts().users().set_password(admin(), "anna", {.password = "short"}).error().code,
            Errc::Syntax);
}

TEST_F(SessionsTest, ANewPasswordEndsTheSessionsButNotTheCallers) {
  add("anna", Role::Viewer);
  const auto here = signed_in("anna").value();
  const auto there = signed_in("anna").value();
  EXPECT_EQ(
      accounts().users().set_password(here, "anna", {.password = "another horse"}).error().code,
      Errc::Denied)
      << "without the current one";
  ASSERT_TRUE(accounts().users().set_password(here, "anna",
                                              {.password = "another horse", .current = kPassword}));
  EXPECT_TRUE(accounts().is_valid(here));
  EXPECT_FALSE(accounts().is_valid(there));
  EXPECT_FALSE(sign_in("anna"));
  EXPECT_TRUE(sign_in("anna", "another horse"));
  EXPECT_EQ(
      accounts().users().set_password(here, "admin", {.password = "another horse"}).error().code,
      Errc::Denied);
}

TEST_F(SessionsTest, ARaisedCostReplacesTheDigestAtTheNextSignIn) {
  add("anna", Role::Viewer);
  reopen({.cost = {.passes = 2, .memory = 16384}});
  ASSERT_TRUE(sign_in("anna"));
  EXPECT_NE(accounts().users().find(admin(), "anna")->password.find("m=16,t=2"), std::string::npos);
  ASSERT_TRUE(sign_in("anna"));
}

TEST_F(SessionsTest, TheOldestSessionMakesRoom) {
  add("anna", Role::Viewer);
  const auto first = sign_in("anna")->secret;
  for (std::size_t i = 0; i < AccountLimits::kMaxSessions; ++i) {
    EXPECT_TRUE(find(first).has_value() == (i < AccountLimits::kMaxSessions));
    clock_.advance(1s);
    ASSERT_TRUE(sign_in("anna"));
  }
  EXPECT_FALSE(find(first));
  EXPECT_EQ(accounts().tokens().list(admin(), "anna")->size(), AccountLimits::kMaxSessions);
}

TEST_F(SessionsTest, TidyRemovesSessionsThatExpiredAndKeepsTokens) {
  add("anna", Role::Viewer);
  ASSERT_TRUE(sign_in("anna"));
  token(admin(), "anna", {.name = "mes", .life = std::chrono::days(1)});
  clock_.advance(48h);
  accounts().sessions().tidy();
  ASSERT_EQ(accounts().tokens().list(admin(), "anna")->size(), 1u);
  reopen();
  EXPECT_EQ(accounts().tokens().list(admin(), "anna")->at(0).name, "mes");
}

/// A stranger in a loop makes two entries, not a million.
TEST_F(SessionsTest, RepeatedRefusalsAreCounted) {
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

TEST_F(SessionsTest, ManyKindsOfRefusalsAreCountedTogether) {
  for (int i = 0; i < 1000; ++i)
    accounts().refusals().note({.who = {"", "", std::to_string(i)},
                                .action = "access.refused",
                                .subject = "s",
                                .detail = ""});
  EXPECT_LE(audited("access.refused").size(), 260u);
}

}  // namespace
}  // namespace dripline::identity
