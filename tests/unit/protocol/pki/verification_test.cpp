#include "protocol/pki/verification.hpp"

#include "tests/unit/protocol/pki/certificates.hpp"

namespace dripline::pki::test {
namespace {

using std::chrono::days;

class Verification : public testing::Test {
 protected:
  Result<void> check(const std::string& certificate, UtcTime now = kNow) const {
    return check_issue({.certificate = certificate, .authority = ours_.certificate}, now);
  }

  const Signer ours_ = make_signer(Purpose::IdentityAuthority, "identities");
  const Signer documents_ = make_signer(Purpose::PermissionsAuthority, "permissions");
  const Signer lathe_ = make_identity(ours_, "lathe-1");
};

TEST_F(Verification, AKeyFitsItsOwnCertificateOnly) {
  EXPECT_TRUE(check_key(lathe_.certificate, lathe_.key));
  EXPECT_EQ(check_key(lathe_.certificate, ours_.key).error().code, Errc::Denied);
  EXPECT_EQ(check_key(lathe_.certificate, lathe_.certificate).error().code, Errc::Syntax);
  EXPECT_EQ(check_key(lathe_.key, lathe_.key).error().code, Errc::Syntax);
}

TEST_F(Verification, ACertificateOfTheAuthorityIsGoodWhileItIsValid) {
  EXPECT_TRUE(check(lathe_.certificate));
  EXPECT_EQ(check(lathe_.certificate, kNow + days(101)).error().code, Errc::Denied);
  EXPECT_EQ(check(lathe_.certificate, kNow - days(11)).error().code, Errc::Denied);
}

TEST_F(Verification, ACertificateOfAnotherAuthorityOfTheSameNameIsRefused) {
  const auto foreign = make_signer(Purpose::IdentityAuthority, "identities");
  const auto checked = check(make_identity(foreign, "lathe-1").certificate);
  ASSERT_FALSE(checked);
  EXPECT_EQ(checked.error().code, Errc::Denied);
}

TEST_F(Verification, AGatewayCannotCertifyAnotherOne) {
  EXPECT_FALSE(check(make_identity(lathe_, "lathe-2").certificate));
  EXPECT_FALSE(check_issue({.certificate = make_identity(lathe_, "lathe-2").certificate,
                            .authority = lathe_.certificate},
                           kNow));
}

TEST_F(Verification, ARevokedCertificateIsRefused) {
  const auto other = make_identity(ours_, "lathe-2", around_now(), "5A");
  const std::vector<authority::Issued> revoked{
      {.holder = {}, .serial = "5A", .validity = around_now(), .revoked = kNow - days(1)}};
  const auto list = authority::make_revocation_list(revoked, ours_, kNow).value();
  const auto good = check_issue(
      {.certificate = lathe_.certificate, .authority = ours_.certificate, .revocation_list = list},
      kNow);
  EXPECT_TRUE(good) << good.error().what;
  const auto bad = check_issue(
      {.certificate = other.certificate, .authority = ours_.certificate, .revocation_list = list},
      kNow);
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().what, "certificate revoked");
  // As long as the authority lives, the list holds.
  const auto late = check_issue(
      {.certificate = lathe_.certificate, .authority = ours_.certificate, .revocation_list = list},
      kNow + days(99));
  EXPECT_TRUE(late) << late.error().what;
}

class Documents : public testing::Test {
 protected:
  static authority::Validity today() {
    const UtcTime now = SystemClock().now();
    return {now - days(1), now + days(1)};
  }
  static Signer signer(Purpose purpose) {
    const auto key = authority::make_key().value();
    return {authority::make_root({.purpose = purpose,
                                  .shop = "shop",
                                  .unit = "authority",
                                  .name = "permissions",
                                  .serial = authority::new_serial(),
                                  .validity = today()},
                                 key)
                .value(),
            key};
  }
  const Signer ours_ = signer(Purpose::PermissionsAuthority);
};

TEST_F(Documents, OpenToTheTextThatWasSigned) {
  const auto document = authority::sign_document("one\ntwo\n", ours_).value();
  const auto opened = open_document(document, ours_.certificate);
  ASSERT_TRUE(opened) << opened.error().what;
  EXPECT_EQ(*opened, "one\r\ntwo\r\n");  // as S/MIME has lines
}

TEST_F(Documents, AreRefusedWhenOneLetterIsChanged) {
  auto document = authority::sign_document("machine.lathe-1\n", ours_).value();
  document.replace(document.find("lathe-1"), 7, "lathe-2");
  const auto opened = open_document(document, ours_.certificate);
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().code, Errc::Denied);
  EXPECT_EQ(open_document("no document", ours_.certificate).error().code, Errc::Syntax);
}

TEST_F(Documents, AreRefusedFromASignerWhoOnlyHasTheSameName) {
  const auto document =
      authority::sign_document("text\n", signer(Purpose::PermissionsAuthority)).value();
  EXPECT_EQ(open_document(document, ours_.certificate).error().code, Errc::Denied);
}

/// Cyclone DDS accepts a chain of signers: a gateway must not be able to sign permissions.
TEST_F(Documents, AreRefusedWhenAnIdentitySignedThemWithItsOwnCertificate) {
  const auto root = signer(Purpose::IdentityAuthority);
  const auto gateway = make_identity(root, "lathe-1", today());
  const auto document = authority::sign_document("text\n", gateway).value();
  EXPECT_EQ(open_document(document, root.certificate).error().code, Errc::Denied);
  EXPECT_EQ(open_document(document, ours_.certificate).error().code, Errc::Denied);
}

}  // namespace
}  // namespace dripline::pki::test
