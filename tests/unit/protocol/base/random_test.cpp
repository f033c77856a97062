#include "protocol/base/random.hpp"

#include <gtest/gtest.h>
#include <set>

namespace dripline {
namespace {

TEST(RandomHex, HasTwoDigitsForEachByte) {
  EXPECT_EQ(random_hex(0), "");
  const std::string text = random_hex(16);
  EXPECT_EQ(text.size(), 32u);
  EXPECT_EQ(text.find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST(RandomHex, DoesNotComeAgain) {
  std::set<std::string> seen;
  for (int i = 0; i < 1000; ++i) seen.insert(random_hex(16));
  EXPECT_EQ(seen.size(), 1000u);
}

TEST(RandomNumber, UsesAllBits) {
  std::uint64_t ones = 0, zeros = 0;
  for (int i = 0; i < 200; ++i) {
    const std::uint64_t number = random_number();
    ones |= number;
    zeros |= ~number;
  }
  EXPECT_EQ(ones, ~std::uint64_t{0});
  EXPECT_EQ(zeros, ~std::uint64_t{0});
}

}  // namespace
}  // namespace dripline
