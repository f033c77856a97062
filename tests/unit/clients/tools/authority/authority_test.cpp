#include "clients/tools/authority/authority.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "protocol/dds/security_folder.hpp"
#include "protocol/pki/identity_files.hpp"
#include "protocol/pki/verification.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/manual_clock.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dripline::authority::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::days;

const Holder kLathe{Role::Gateway, "lathe-1"};

class AuthorityTest : public testing::Test {
 protected:
  AuthorityTest() {
    const auto made = Authority::create(folder(), "Example Shop", clock_);
    EXPECT_TRUE(made) << made.error().what;
  }
  fs::path folder() const { return temporary_.path() / "pki"; }
  Authority open() const { return Authority::open(folder(), clock_).value(); }
  Result<dds::SecurityFolder> verified(const Holder& holder) const {
    const auto role = holder.role == Role::Server ? dds::Role::Server : dds::Role::Gateway;
    return dds::open_security_folder(
        folder() / (holder.role == Role::Server ? "server" : "gateways/" + holder.name),
        {.role = role, .machine = holder.name}, clock_.now());
  }
  static mode_t mode_of(const fs::path& file) {
    struct stat facts {};
    EXPECT_EQ(::stat(file.c_str(), &facts), 0) << file;
    return facts.st_mode & 07777;
  }
  static std::string text_of(const fs::path& file) { return pki::read_file(file.string()).value(); }

  test_support::TemporaryFolder temporary_;
  const SystemClock clock_;
};

TEST_F(AuthorityTest, GivesServerAndGatewaysFoldersThatTheDaemonsTake) {
  auto authority = open();
  for (const Holder& holder : {the_server(), kLathe}) {
    const auto issued = authority.issue(holder, 100);
    ASSERT_TRUE(issued) << issued.error().what;
    const auto folder = verified(holder);
    ASSERT_TRUE(folder) << folder.error().what;
    EXPECT_EQ(folder->certificate.common_name, holder.name);
    EXPECT_EQ(folder->certificate.serial, issued->serial);
    EXPECT_EQ(folder->certificate.not_after, issued->validity.not_after);
    EXPECT_EQ(pki::days_left(issued->validity.not_after, clock_.now()), 99);
  }
}

TEST_F(AuthorityTest, KeepsKeysForTheirOwnerAlone) {
  auto authority = open();
  ASSERT_TRUE(authority.issue(kLathe, 100));
  EXPECT_EQ(mode_of(folder()), 0700U);
  EXPECT_EQ(mode_of(folder() / "authority" / "identity_ca.key"), 0600U);
  EXPECT_EQ(mode_of(folder() / "authority" / "permissions_ca.key"), 0600U);
  EXPECT_EQ(mode_of(authority.folder_of(kLathe)), 0700U);
  EXPECT_EQ(mode_of(authority.folder_of(kLathe) / pki::kKeyFile), 0600U);
}

TEST_F(AuthorityTest, DoesNotWorkWithAKeyThatOthersCanRead) {
  fs::permissions(folder() / "authority" / "identity_ca.key", fs::perms(0644));
  const auto opened = Authority::open(folder(), clock_);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, Errc::Denied);
}

TEST_F(AuthorityTest, OfOneFolderIsMadeOnceAndUsedByOneProcess) {
  EXPECT_EQ(Authority::create(folder(), "Other", clock_).error().code, Errc::Conflict);
  const auto first = open();
  EXPECT_EQ(Authority::open(folder(), clock_).error().code, Errc::Busy);
  const auto nowhere = Authority::open(temporary_.path() / "nowhere", clock_);
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().code, Errc::NotFound);
}

TEST_F(AuthorityTest, RenewsWithAnotherKeyAndKeepsNoHalfFolder) {
  auto authority = open();
  EXPECT_EQ(authority.renew(kLathe, 10).error().code, Errc::NotFound);
  const auto first = authority.issue(kLathe, 10).value();
  const auto key = text_of(authority.folder_of(kLathe) / pki::kKeyFile);
  EXPECT_EQ(authority.issue(kLathe, 10).error().code, Errc::Conflict);
  const auto second = authority.renew(kLathe, 20).value();
  EXPECT_NE(first.serial, second.serial);
  EXPECT_NE(text_of(authority.folder_of(kLathe) / pki::kKeyFile), key);
  EXPECT_EQ(verified(kLathe).value().certificate.serial, second.serial);
  EXPECT_EQ(authority.identities().size(), 1U);
  for (const auto& entry : fs::directory_iterator(folder() / "gateways"))
    EXPECT_EQ(entry.path().filename(), "lathe-1");
}

TEST_F(AuthorityTest, RevokesEveryCertificateOfAMachineInAllFolders) {
  const Holder other{Role::Gateway, "lathe-2"};
  {
    auto authority = open();
    ASSERT_TRUE(authority.issue(the_server(), 10));
    ASSERT_TRUE(authority.issue(other, 10));
    ASSERT_TRUE(authority.issue(kLathe, 10));
  }
  const auto stolen = temporary_.path() / "stolen";
  fs::copy(folder() / "gateways/lathe-1", stolen);
  {
    auto authority = open();
    ASSERT_TRUE(authority.renew(kLathe, 10));
    ASSERT_TRUE(authority.revoke(kLathe));
    EXPECT_TRUE(authority.revoke(kLathe));  // once more changes nothing
    EXPECT_FALSE(authority.has_folder(kLathe));
    EXPECT_EQ(authority.renew(kLathe, 10).error().code, Errc::Conflict);
    EXPECT_TRUE(authority.identities().back().revoked || authority.identities()[1].revoked);
  }
  for (const auto& place : {folder() / "server", folder() / "gateways/lathe-2"}) {
    const auto list = text_of(place / pki::kRevokedFile);
    const auto checked =
        pki::check_issue({.certificate = text_of(stolen / pki::kCertificateFile),
                          .authority = text_of(place / pki::kIdentityAuthorityFile),
                          .revocation_list = list},
                         clock_.now());
    ASSERT_FALSE(checked) << place;
    EXPECT_EQ(checked.error().what, "certificate revoked");
  }
  EXPECT_TRUE(verified(the_server()));
  EXPECT_TRUE(verified(other));
  // The machine gets another computer.
  ASSERT_TRUE(open().issue(kLathe, 10));
  EXPECT_TRUE(verified(kLathe)) << verified(kLathe).error().what;
}

TEST_F(AuthorityTest, RefusesNamesThatCouldEnterADocumentOrLeaveTheFolder) {
  auto authority = open();
  for (const std::string name :
       {"", "..", "../x", "a/b", "a,CN=server", "a<b>", "a&b", "Lathe", "a=b", "a\n"}) {
    const auto issued = authority.issue({Role::Gateway, name}, 10);
    ASSERT_FALSE(issued) << name;
    EXPECT_EQ(issued.error().code, Errc::Syntax) << name;
  }
  for (const std::string name : {"", "a,b", "a<b", "a&b", "a=b", " a", "a\n", "a/b", "ä"})
    EXPECT_FALSE(check_shop_name(name)) << name;
  EXPECT_FALSE(check_shop_name(std::string(65, 'a')));
  EXPECT_TRUE(check_shop_name("Smith _ Sons-2 Co. Ltd"));
  EXPECT_EQ(authority.issue(kLathe, 0).error().code, Errc::LimitExceeded);
  EXPECT_EQ(authority.issue(kLathe, 99'999).error().code, Errc::LimitExceeded);
}

TEST_F(AuthorityTest, RefusesADamagedLedger) {
  std::ofstream(folder() / "authority" / "issued.json") << "{\"shop\":7}";
  const auto opened = Authority::open(folder(), clock_);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, Errc::Corrupt);
}

/// OpenSSL's own program as the other opinion.
TEST_F(AuthorityTest, MakesWhatOpensslVerifies) {
  auto authority = open();
  ASSERT_TRUE(authority.issue(the_server(), 10));
  const auto place = authority.folder_of(the_server()).string();
  const auto run = [&](const std::string& arguments) {
    return test_support::run_to_end({"/bin/sh", "-c", "cd '" + place + "' && openssl " + arguments},
                                    temporary_.path() / "openssl.out");
  };
  const auto chain =
      run("verify -x509_strict -CAfile identity_ca.pem -CRLfile revoked.pem -crl_check "
          "certificate.pem");
  EXPECT_EQ(chain.status, 0) << chain.output;
  for (const std::string name : {"permissions.p7s", "governance.p7s"}) {
    const auto good = run("smime -verify -text -CAfile permissions_ca.pem -in " + name);
    EXPECT_EQ(good.status, 0) << good.output;
    EXPECT_NE(good.output.find("<dds>"), std::string::npos) << good.output;
    const auto bad = run("smime -verify -text -CAfile identity_ca.pem -in " + name);
    EXPECT_NE(bad.status, 0) << bad.output;
  }
}

}  // namespace
}  // namespace dripline::authority::test
