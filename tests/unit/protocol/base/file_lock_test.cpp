#include "protocol/base/descriptor.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <string>

namespace dripline {
namespace {

class FileLockTest : public testing::Test {
 protected:
  std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / ("file-lock-" + std::to_string(::getpid()));
  void TearDown() override { std::filesystem::remove(file_); }
};

TEST_F(FileLockTest, RefusesTheSecondNamingThingAndOwner) {
  const auto held = FileLock::acquire(file_, "the lathe's line");
  ASSERT_TRUE(held) << held.error().what;
  const auto second = FileLock::acquire(file_, "the lathe's line");
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, Errc::Busy);
  const std::string expected =
      "the lathe's line is in use by process " + std::to_string(::getpid());
  EXPECT_EQ(second.error().what.substr(0, expected.size()), expected);
}

TEST_F(FileLockTest, IsFreeAgainWhenItsOwnerIsGone) {
  { ASSERT_TRUE(FileLock::acquire(file_, "it")); }
  EXPECT_TRUE(FileLock::acquire(file_, "it"));
}

}  // namespace
}  // namespace dripline
