#include "protocol/base/private_folder.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

namespace dripline {
namespace {

namespace fs = std::filesystem;

class PrivateFolder : public testing::Test {
 protected:
  PrivateFolder() {
    char name[] = "/tmp/private_folder_XXXXXX";
    root_ = ::mkdtemp(name);
  }
  ~PrivateFolder() override { fs::remove_all(root_); }
  static unsigned mode(const fs::path& path) {
    return static_cast<unsigned>(fs::status(path).permissions());
  }
  fs::path root_;
};

TEST_F(PrivateFolder, IsMadeForItsOwnerAlone) {
  const auto made = make_private_folder(root_ / "a" / "b");
  ASSERT_TRUE(made) << made.error().what;
  EXPECT_EQ(*made, "");
  EXPECT_EQ(mode(root_ / "a" / "b"), 0700u);
}

TEST_F(PrivateFolder, IsClosedToOthersWithAWord) {
  fs::create_directory(root_ / "open");
  fs::permissions(root_ / "open", fs::perms::all);
  const auto closed = make_private_folder(root_ / "open");
  ASSERT_TRUE(closed) << closed.error().what;
  EXPECT_NE(closed->find("mode 777"), std::string::npos) << *closed;
  EXPECT_EQ(mode(root_ / "open"), 0750u);
  EXPECT_EQ(make_private_folder(root_ / "open").value(), "");
}

}  // namespace
}  // namespace dripline
