#include <stdlib.h>
#include <fstream>
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
  void make_open(const char* name, const char* content) {
    fs::create_directory(root_ / name);
    if (*content != 0) std::ofstream(root_ / name / content) << "kept";
    fs::permissions(root_ / name, fs::perms::all);
  }
  fs::path root_;
};

TEST_F(PrivateFolder, IsMadeForItsOwnerAlone) {
  const auto made = make_private_folder(root_ / "a" / "b", {});
  ASSERT_TRUE(made) << made.error().what;
  EXPECT_EQ(*made, "");
  EXPECT_EQ(mode(root_ / "a" / "b"), 0700u);
}

TEST_F(PrivateFolder, IsClosedToOthersWithAWord) {
  fs::create_directory(root_ / "open");
  fs::permissions(root_ / "open", fs::perms::all);
  const auto closed = make_private_folder(root_ / "open", {});
  ASSERT_TRUE(closed) << closed.error().what;
  EXPECT_NE(closed->find("mode 777"), std::string::npos) << *closed;
  EXPECT_EQ(mode(root_ / "open"), 0750u);
  EXPECT_EQ(make_private_folder(root_ / "open", {}).value(), "");
}

TEST_F(PrivateFolder, WithAMarkIsClosedWithWhatIsInIt) {
  make_open("used", "server.lock");
  std::ofstream(root_ / "used" / "another") << "kept";
  ASSERT_TRUE(make_private_folder(root_ / "used", {"database", "server.lock"}));
  EXPECT_EQ(mode(root_ / "used"), 0750u);
}

TEST_F(PrivateFolder, WithOtherContentStaysAsItIs) {
  make_open("foreign", "letters");
  const auto refused = make_private_folder(root_ / "foreign", {"server.lock"});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, Errc::Denied);
  EXPECT_NE(refused.error().what.find("'letters' in it is not of Dripline"), std::string::npos)
      << refused.error().what;
  EXPECT_EQ(mode(root_ / "foreign"), 0777u);
  // Closed by its owner it may be used: no one loses it.
  fs::permissions(root_ / "foreign", fs::perms::owner_all);
  EXPECT_EQ(make_private_folder(root_ / "foreign", {"server.lock"}).value(), "");
}

TEST_F(PrivateFolder, ThatIsSharedStaysAsItIsEvenEmptyOrMarked) {
  for (const char* content : {"", "server.lock"}) {
    make_open("shared", content);
    fs::permissions(root_ / "shared", fs::perms::all | fs::perms::sticky_bit);
    const auto refused = make_private_folder(root_ / "shared", {"server.lock"});
    ASSERT_FALSE(refused) << content;
    EXPECT_NE(refused.error().what.find("sticky"), std::string::npos) << refused.error().what;
    EXPECT_EQ(mode(root_ / "shared"), 01777u);
  }
}

TEST_F(PrivateFolder, OfOursIsClosedWhateverIsInIt) {
  make_open("part", "anything");
  ASSERT_TRUE(make_private_subfolder(root_ / "part"));
  EXPECT_EQ(mode(root_ / "part"), 0750u);
}

}  // namespace

}  // namespace dripline
