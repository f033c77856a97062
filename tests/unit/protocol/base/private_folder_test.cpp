#include <stdlib.h>
#include <map>

#include <gtest/gtest.h>

#include "protocol/base/private_folder.hpp"

namespace dripline {

namespace {

TEST(DefaultStateFolder, IsTheFirstThatIsSet) {
  std::map<std::string, std::string, std::less<>> variables;
  const auto folder = [&](bool is_root) {
    return default_state_folder(
        [&](std::string_view name) -> std::optional<std::string> {
          const auto found = variables.find(name);
          return found == variables.end() ? std::nullopt : std::optional(found->second);
        },
        is_root);
  };
  EXPECT_EQ(folder(false).error().code, Errc::NotFound);
  EXPECT_EQ(folder(true).value(), "/var/lib/dripline");
  variables["HOME"] = "/home/u";
  EXPECT_EQ(folder(false).value(), "/home/u/.local/state/dripline");
  variables["XDG_STATE_HOME"] = "/xdg";
  EXPECT_EQ(folder(false).value(), "/xdg/dripline");
  EXPECT_EQ(folder(true).value(), "/var/lib/dripline");
  variables["DRIPLINE_STATE"] = "/named";
  EXPECT_EQ(folder(false).value(), "/named");
  EXPECT_EQ(folder(true).value(), "/named");
}

TEST(ProcessEnvironment, TakesAnEmptyVariableForAnUnsetOne) {
  ::setenv("DRIPLINE_TEST_VARIABLE", "", 1);
  EXPECT_EQ(process_environment("DRIPLINE_TEST_VARIABLE"), std::nullopt);
  ::setenv("DRIPLINE_TEST_VARIABLE", "x", 1);
  EXPECT_EQ(process_environment("DRIPLINE_TEST_VARIABLE"), "x");
  ::unsetenv("DRIPLINE_TEST_VARIABLE");
}

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
