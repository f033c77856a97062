#include <atomic>
#include <thread>

#include "server/identity/password_hasher.hpp"

namespace dripline::identity {
namespace {

constexpr HashingCost kCheap{.passes = 1, .memory = 8192};

TEST(PasswordHasher, KnowsAPasswordAgain) {
  PasswordHasher hasher({.cost = kCheap});
  const auto digest = hasher.hash("correct horse");
  ASSERT_TRUE(digest) << digest.error().what;
  EXPECT_TRUE(digest->starts_with("$argon2id$v=19$m=8,t=1,p=1$")) << *digest;
  EXPECT_TRUE(hasher.verify(*digest, "correct horse").value());
  EXPECT_FALSE(hasher.verify(*digest, "correct horsf").value());
  EXPECT_FALSE(hasher.verify(*digest, "").value());
  EXPECT_NE(*hasher.hash("correct horse"), *digest) << "each has a salt of its own";
}

TEST(PasswordHasher, NobodysDigestIsComputedAndNeverRight) {
  PasswordHasher hasher({.cost = kCheap});
  EXPECT_FALSE(hasher.verify("", "").value());
  EXPECT_FALSE(hasher.verify("", "anything").value());
  EXPECT_EQ(hasher.peak(), 1u) << "it costs what any other does";
}

TEST(PasswordHasher, ARaisedCostMakesDigestsOutdated) {
  PasswordHasher before({.cost = kCheap});
  PasswordHasher after({.cost = {.passes = 2, .memory = 16384}});
  const auto digest = before.hash("correct horse").value();
  EXPECT_FALSE(before.is_outdated(digest));
  EXPECT_TRUE(after.is_outdated(digest));
  EXPECT_TRUE(after.verify(digest, "correct horse").value()) << "it still opens";
}

struct DigestCase {
  const char* name;
  std::string digest;
};
class DamagedDigest : public testing::TestWithParam<DigestCase> {};

TEST_P(DamagedDigest, OpensNothingAndCostsNothing) {
  PasswordHasher hasher({.cost = kCheap});
  const auto verdict = hasher.verify(GetParam().digest, "correct horse");
  if (verdict) {
    EXPECT_FALSE(*verdict);
  } else {
    EXPECT_EQ(verdict.error().code, Errc::Corrupt);
    EXPECT_EQ(hasher.peak(), 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(
    , DamagedDigest,
    testing::Values(
        DigestCase{"text", "correct horse"},
        DigestCase{"other_algorithm", "$argon2i$v=19$m=8,t=1,p=1$c2FsdHNhbHRzYWx0$YWJj"},
        DigestCase{"a_terabyte", "$argon2id$v=19$m=1073741824,t=1,p=1$c2FsdHNhbHRzYWx0$YWJj"},
        DigestCase{"a_year", "$argon2id$v=19$m=8,t=999999999,p=1$c2FsdHNhbHRzYWx0$YWJj"},
        DigestCase{"no_numbers", "$argon2id$v=19$m=,t=,p=$$"},
        DigestCase{"cut", "$argon2id$v=19$m=8,t=1,p=1$c2FsdHNhbHRzYWx0"},
        DigestCase{"empty_parts", "$argon2id$v=19$m=8,t=1,p=1$$"}),
    [](const auto& i) { return std::string(i.param.name); });

/// A flood of sign-ins takes the memory of two digests, and the rest is refused at once or waits.
TEST(PasswordHasher, ComputesFewAtOnceAndRefusesTheRest) {
  PasswordHasher hasher(
      {.cost = {.passes = 3, .memory = 16 * 1024 * 1024}, .at_once = 2, .waiting = 3});
  std::atomic<int> computed = 0, refused = 0;
  std::vector<std::thread> strangers;
  strangers.reserve(24);
  for (int i = 0; i < 24; ++i) {
    strangers.emplace_back([&] {
      const auto digest = hasher.hash("correct horse");
      if (digest) {
        ++computed;
      } else {
        EXPECT_EQ(digest.error().code, Errc::Busy);
        ++refused;
      }
    });
  }
  for (auto& stranger : strangers) stranger.join();
  EXPECT_LE(hasher.peak(), 2u);
  EXPECT_GE(computed, 2);
  EXPECT_EQ(computed + refused, 24);
  EXPECT_TRUE(hasher.hash("correct horse")) << "afterwards there is room again";
}

}  // namespace
}  // namespace dripline::identity
