#include "protocol/dds/security_folder.hpp"

#include <gtest/gtest.h>
#include <filesystem>

#include "shop_authority.hpp"

namespace dripline::dds::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::days;

class SecurityFolderTest : public testing::Test {
 protected:
  fs::path lathe() { return shop_.folder(ShopAuthority::gateway("lathe-1")); }
  Result<SecurityFolder> open(const std::string& machine = "lathe-1", days later = {}) {
    return open_security_folder(lathe(), {.role = Role::Gateway, .machine = machine},
                                shop_.clock().now() + later);
  }
  /// The error names the file and has this part.
  void expect_refused(Errc code, const char* file, const std::string& part) {
    const auto opened = open();
    ASSERT_FALSE(opened) << part;
    EXPECT_EQ(opened.error().code, code) << opened.error().what;
    EXPECT_NE(opened.error().what.find(file), std::string::npos) << opened.error().what;
    EXPECT_NE(opened.error().what.find(part), std::string::npos) << opened.error().what;
  }

  ShopAuthority shop_;
};

TEST_F(SecurityFolderTest, NamesItsFilesAndItsCertificate) {
  const auto opened = open();
  ASSERT_TRUE(opened) << opened.error().what;
  EXPECT_EQ(opened->certificate.common_name, "lathe-1");
  EXPECT_EQ(opened->files.private_key, (lathe() / "key.pem").string());
  EXPECT_EQ(opened->files.revocation_list, (lathe() / "revoked.pem").string());
  fs::remove(lathe() / "revoked.pem");
  EXPECT_FALSE(open().value().files.revocation_list);
}

TEST_F(SecurityFolderTest, NeedsEveryFile) {
  for (const char* file : {"identity_ca.pem", "permissions_ca.pem", "certificate.pem", "key.pem",
                           "permissions.p7s", "governance.p7s"}) {
    const auto kept = text_of(lathe() / file);
    fs::remove(lathe() / file);
    expect_refused(Errc::NotFound, file, "No such file");
    write_text(lathe() / file, "something else");
    const auto opened = open();
    ASSERT_FALSE(opened) << file;
    EXPECT_EQ(opened.error().code, Errc::Syntax) << opened.error().what;
    write_text(lathe() / file, kept);
    ASSERT_TRUE(open()) << file;
  }
  const auto nowhere = open_security_folder("/nowhere", {}, shop_.clock().now());
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().code, Errc::NotFound);
}

TEST_F(SecurityFolderTest, IsRefusedWhenOthersCanReadTheKey) {
  fs::permissions(lathe() / "key.pem", fs::perms(0644));
  expect_refused(Errc::Denied, "key.pem", "chmod 600");
  fs::permissions(lathe() / "key.pem", fs::perms(0640));  // root's, for the group of the daemon
  EXPECT_TRUE(open());
}

TEST_F(SecurityFolderTest, IsOfOneMachineOnly) {
  const auto other = open("lathe-2");
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, Errc::Denied);
  EXPECT_NE(other.error().what.find("'lathe-1', not of machine 'lathe-2'"), std::string::npos);
  EXPECT_EQ(open_security_folder(lathe(), {.role = Role::Server}, shop_.clock().now()).error().code,
            Errc::Denied);
  const auto server = shop_.folder(authority::the_server());
  EXPECT_TRUE(open_security_folder(server, {.role = Role::Server}, shop_.clock().now()));
  const auto posing = open_security_folder(server, {.role = Role::Gateway, .machine = "server"},
                                           shop_.clock().now());
  ASSERT_FALSE(posing);
  EXPECT_EQ(posing.error().code, Errc::Denied);
}

TEST_F(SecurityFolderTest, IsRefusedOutsideItsTime) {
  const auto late = open("lathe-1", days(10));
  ASSERT_FALSE(late);
  EXPECT_NE(late.error().what.find("has expired"), std::string::npos) << late.error().what;
  const auto early = open("lathe-1", -days(2));
  ASSERT_FALSE(early);
  EXPECT_NE(early.error().what.find("is the clock right?"), std::string::npos);
}

TEST_F(SecurityFolderTest, IsRefusedWithAnotherKeyOrAnotherAuthority) {
  const auto key = text_of(lathe() / "key.pem");
  write_text(lathe() / "key.pem", authority::make_key().value());
  expect_refused(Errc::Denied, "key.pem", "of another certificate");
  write_text(lathe() / "key.pem", key);

  ShopAuthority foreign;
  const auto theirs = foreign.folder(ShopAuthority::gateway("lathe-1"));
  const auto own = text_of(lathe() / "identity_ca.pem");
  write_text(lathe() / "identity_ca.pem", text_of(theirs / "identity_ca.pem"));
  expect_refused(Errc::Denied, "certificate.pem", "");
  write_text(lathe() / "identity_ca.pem", own);
  write_text(lathe() / "permissions_ca.pem", text_of(theirs / "permissions_ca.pem"));
  expect_refused(Errc::Denied, "governance.p7s", "another authority");
}

TEST_F(SecurityFolderTest, IsRefusedWithChangedOrForeignPermissions) {
  const auto kept = text_of(lathe() / "permissions.p7s");
  auto changed = kept;
  const auto at = changed.find("machine.lathe-1");
  ASSERT_NE(at, std::string::npos);
  changed[at + std::string("machine.lathe-").size()] = '2';
  write_text(lathe() / "permissions.p7s", changed);
  expect_refused(Errc::Denied, "permissions.p7s", "it was changed");
  const auto others = shop_.folder(ShopAuthority::gateway("lathe-2"));
  write_text(lathe() / "permissions.p7s", text_of(others / "permissions.p7s"));
  expect_refused(Errc::Denied, "permissions.p7s", "no permissions for CN=lathe-1");
}

TEST_F(SecurityFolderTest, IsRefusedWhenItsCertificateIsRevoked) {
  const auto stolen = shop_.path() / "stolen";
  fs::copy(lathe(), stolen);
  const auto server = shop_.folder(authority::the_server());
  ASSERT_TRUE(shop_->revoke(ShopAuthority::gateway("lathe-1")));
  write_text(stolen / "revoked.pem", text_of(server / "revoked.pem"));
  const auto opened = open_security_folder(stolen, {.role = Role::Gateway, .machine = "lathe-1"},
                                           shop_.clock().now());
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().what.find("certificate revoked"), std::string::npos);
}

}  // namespace
}  // namespace dripline::dds::test
