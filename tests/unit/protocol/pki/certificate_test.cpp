#include "protocol/pki/certificate.hpp"

#include <fstream>

#include "tests/support/temporary_folder.hpp"
#include "tests/unit/protocol/pki/certificates.hpp"

namespace dripline::pki::test {
namespace {

using std::chrono::days;
using std::chrono::hours;

TEST(Certificate, StatesItsHolderItsIssuerAndItsEnd) {
  const auto signer = make_signer(Purpose::IdentityAuthority, "identities");
  const auto made = make_identity(signer, "lathe-1", around_now(), "4AB0");
  const auto read = parse_certificate(made.certificate);
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(read->common_name, "lathe-1");
  EXPECT_EQ(read->unit, "gateway");
  EXPECT_EQ(read->subject, "CN=lathe-1,OU=gateway,O=shop");
  EXPECT_EQ(read->issuer, "CN=identities,OU=authority,O=shop");
  EXPECT_EQ(read->serial, "4AB0");
  EXPECT_EQ(read->not_before, kNow - days(10));
  EXPECT_EQ(read->not_after, kNow + days(100));
}

TEST(Certificate, IsTheFirstOfAFileThatAlsoHoldsOthers) {
  const auto signer = make_signer(Purpose::IdentityAuthority, "identities");
  const auto made = make_identity(signer, "lathe-1");
  const auto chain = made.key + made.certificate + signer.certificate;
  EXPECT_EQ(parse_certificate(chain).value().common_name, "lathe-1");
}

TEST(Certificate, IsNotReadFromAnythingElse) {
  const auto signer = make_signer(Purpose::IdentityAuthority, "identities");
  std::string damaged = signer.certificate;
  damaged[damaged.size() / 2] ^= 1;
  for (const std::string& text : {std::string(), std::string("hello"), signer.key, damaged}) {
    const auto read = parse_certificate(text);
    if (text == damaged && read) continue;  // a bit of the signature: it is still a certificate
    ASSERT_FALSE(read) << text;
    EXPECT_EQ(read.error().code, Errc::Syntax);
  }
}

TEST(Certificate, GivesNoNameThatIsNotPlainText) {
  const auto signer = make_signer(Purpose::IdentityAuthority, "identities");
  const auto made = make_identity(signer, "lathe\x1b[1m");
  const auto read = parse_certificate(made.certificate).value();
  EXPECT_EQ(read.common_name, "");
  EXPECT_EQ(read.subject.find('\x1b'), std::string::npos);
}

TEST(Certificate, NamesTheFileThatCannotBeRead) {
  const test_support::TemporaryFolder folder;
  const auto file = folder.path() / "certificate.pem";
  const auto missing = read_certificate(file.string());
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, Errc::NotFound);
  EXPECT_NE(missing.error().what.find(file.string()), std::string::npos);
  std::ofstream(file) << "nothing of the kind";
  const auto wrong = read_certificate(file.string());
  ASSERT_FALSE(wrong);
  EXPECT_EQ(wrong.error().code, Errc::Syntax);
  EXPECT_NE(wrong.error().what.find(file.string()), std::string::npos);
  EXPECT_EQ(read_certificate(folder.path().string()).error().code, Errc::Io);
  std::ofstream(file) << std::string(kMaxFile + 1, 'x');
  EXPECT_EQ(read_certificate(file.string()).error().code, Errc::LimitExceeded);
}

TEST(Expiry, IsCountedInWholeDays) {
  EXPECT_EQ(days_left(kNow + hours(24 * 30), kNow), 30);
  EXPECT_EQ(days_left(kNow + hours(24 * 30 - 1), kNow), 29);
  EXPECT_EQ(days_left(kNow + hours(1), kNow), 0);
  EXPECT_EQ(days_left(kNow - hours(1), kNow), -1);
  EXPECT_EQ(expiry_text(kNow + days(29), kNow), "in 29 days (2024-11-02)");
  EXPECT_EQ(expiry_text(kNow + hours(2), kNow), "today (2024-10-04)");
  EXPECT_EQ(expiry_text(kNow - days(3), kNow), "2 days ago (2024-10-01)");
}

}  // namespace
}  // namespace dripline::pki::test
