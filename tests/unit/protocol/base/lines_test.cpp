#include "protocol/base/lines.hpp"

#include <gtest/gtest.h>

namespace dripline {
namespace {

TEST(Trimmed, LeavesOutBlanksAtBothEndsOnly) {
  EXPECT_EQ(trimmed(" \tde-AT; q=0.7\t "), "de-AT; q=0.7");
  EXPECT_EQ(trimmed("x"), "x");
  EXPECT_EQ(trimmed("\n"), "\n");
  EXPECT_EQ(trimmed(" \t "), "");
  EXPECT_EQ(trimmed(""), "");
}

TEST(Trimmed, LeavesOutTheBlanksThatItIsGiven) {
  EXPECT_EQ(trimmed("\tX1 \r", " \r"), "\tX1");
  EXPECT_EQ(trimmed(" \r", " \r"), "");
}

}  // namespace
}  // namespace dripline
