#include "server/identity/attempt_limits.hpp"

namespace dripline::identity {
namespace {

using namespace std::chrono_literals;

class Attempts : public testing::Test {
 protected:
  /// How many of `number` attempts may be made now.
  int pass(const std::string& user, const std::string& address, int number) {
    int passed = 0;
    for (int i = 0; i < number; ++i) {
      if (!limits.begin(user, address, now)) ++passed;
    }
    return passed;
  }
  AttemptLimits limits{{.of_user = 5, .from_address = 8, .window = 100s, .entries = 4}};
  SteadyTime now{};
};

TEST_F(Attempts, AreLimitedPerUserFromEveryAddress) {
  EXPECT_EQ(pass("anna", "a", 3), 3);
  EXPECT_EQ(pass("anna", "b", 3), 2);
  EXPECT_EQ(limits.begin("anna", "c", now), 20s);
  EXPECT_EQ(pass("bert", "c", 1), 1) << "others are free";
}

TEST_F(Attempts, AreLimitedPerAddressForEveryUser) {
  EXPECT_EQ(pass("u1", "a", 4) + pass("u2", "a", 4), 8);
  EXPECT_EQ(pass("u3", "a", 1), 0);
  EXPECT_EQ(pass("u3", "b", 1), 1);
}

TEST_F(Attempts, ComeBackWithTime) {
  EXPECT_EQ(pass("anna", "a", 9), 5);
  now += 19s;
  EXPECT_EQ(pass("anna", "a", 1), 0);
  now += 2s;
  EXPECT_EQ(pass("anna", "a", 2), 1);
  now += 1000s;
  EXPECT_EQ(pass("anna", "b", 9), 5) << "never more than the limit at once";
}

TEST_F(Attempts, ARightPasswordResetsTheUserAndNotTheAddress) {
  EXPECT_EQ(pass("mallory", "a", 4) + pass("anna", "a", 3), 7);
  limits.begin("mallory", "a", now);
  limits.succeed("mallory", "a");
  EXPECT_EQ(pass("mallory", "b", 9), 5);
  EXPECT_EQ(pass("bert", "a", 9), 1) << "one right password does not open the address";
}

/// A stranger invents names until the table is full; the one that is attacked stays limited.
TEST_F(Attempts, ManyNamesHideNoAttackOnOne) {
  EXPECT_EQ(pass("anna", "a", 9), 5);
  for (int i = 0; i < 100; ++i) pass(std::to_string(i), std::to_string(i), 1);
  EXPECT_EQ(pass("anna", "z", 9), 0);
}

}  // namespace
}  // namespace dripline::identity
