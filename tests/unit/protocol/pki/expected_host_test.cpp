#include "protocol/pki/expected_host.hpp"

#include <gtest/gtest.h>
#include <openssl/x509v3.h>

#include "protocol/pki/openssl.hpp"

namespace dripline::pki::test {
namespace {

using Extension = std::unique_ptr<X509_EXTENSION, Release<X509_EXTENSION_free>>;
using Parameters = std::unique_ptr<X509_VERIFY_PARAM, Release<X509_VERIFY_PARAM_free>>;

/// A server's certificate that its own key has signed; `names`: the subjectAltName, none if empty.
CertificatePointer make_certificate(const std::string& common_name, const std::string& names) {
  const KeyPointer key(EVP_EC_gen("P-256"));
  CertificatePointer made(X509_new());
  X509_set_version(made.get(), X509_VERSION_3);
  X509_gmtime_adj(X509_getm_notBefore(made.get()), -60);
  X509_gmtime_adj(X509_getm_notAfter(made.get()), 3600);
  X509_set_pubkey(made.get(), key.get());
  X509_NAME* const subject = X509_get_subject_name(made.get());
  X509_NAME_add_entry_by_txt(subject, "CN", MBSTRING_ASC,
                             reinterpret_cast<const unsigned char*>(common_name.c_str()), -1, -1,
                             0);
  X509_set_issuer_name(made.get(), subject);
  if (!names.empty()) {
    const Extension extension(
        X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, names.c_str()));
    EXPECT_TRUE(extension) << names;
    X509_add_ext(made.get(), extension.get(), -1);
  }
  EXPECT_GT(X509_sign(made.get(), key.get(), EVP_sha256()), 0);
  return made;
}

/// What a client that expects `host` makes of it: a result of verification.
int verify(const CertificatePointer& shown, const std::string& host) {
  const StorePointer trusted(X509_STORE_new());
  X509_STORE_add_cert(trusted.get(), shown.get());
  const VerificationPointer check(X509_STORE_CTX_new());
  X509_STORE_CTX_init(check.get(), trusted.get(), shown.get(), nullptr);
  EXPECT_TRUE(expect_host(X509_STORE_CTX_get0_param(check.get()), host));
  X509_verify_cert(check.get());
  return X509_STORE_CTX_get_error(check.get());
}

struct Row {
  const char* common_name;
  const char* names;
  const char* host;
  bool is_good;
};

TEST(ExpectedHost, IsNamedByTheSubjectAltName) {
  constexpr Row kRows[]{
      {"any", "DNS:dnc.shop.example", "dnc.shop.example", true},
      {"any", "DNS:other.example,DNS:dnc.shop.example", "DNC.shop.example", true},
      {"any", "IP:127.0.0.1", "127.0.0.1", true},
      {"any", "IP:0:0:0:0:0:0:0:1", "::1", true},
      {"any", "DNS:*.shop.example", "dnc.shop.example", true},
      {"127.0.0.1", "DNS:mallory.example", "127.0.0.1", false},
      {"localhost", "DNS:mallory.example", "localhost", false},
      {"127.0.0.1", "", "127.0.0.1", false},
      {"localhost", "", "localhost", false},
      {"any", "DNS:127.0.0.1", "127.0.0.1", false},
      {"any", "IP:127.0.0.2", "127.0.0.1", false},
      {"any", "DNS:*", "localhost", false},
      {"any", "DNS:*.example", "shop.example", false},
      {"any", "DNS:d*.shop.example", "dnc.shop.example", false},
      {"any", "DNS:*.shop.example", "a.b.shop.example", false},
  };
  for (const Row& row : kRows) {
    const int result = verify(make_certificate(row.common_name, row.names), row.host);
    EXPECT_EQ(result == X509_V_OK, row.is_good)
        << row.common_name << " " << row.names << " " << row.host << ": "
        << X509_verify_cert_error_string(result);
    EXPECT_EQ(is_other_host(result), !row.is_good) << row.names;
  }
}

TEST(ExpectedHost, IsAnAddressOrANameAndNotEmpty) {
  const Parameters parameters(X509_VERIFY_PARAM_new());
  EXPECT_EQ(expect_host(parameters.get(), "10.0.0.7").value(), HostKind::Address);
  EXPECT_EQ(expect_host(parameters.get(), "fd00::a").value(), HostKind::Address);
  EXPECT_EQ(expect_host(parameters.get(), "dnc").value(), HostKind::Name);
  EXPECT_EQ(expect_host(parameters.get(), "").error().code, Errc::Syntax);
  EXPECT_EQ(expect_host(parameters.get(), std::string("a\0b", 3)).error().code, Errc::Syntax);
}

}  // namespace
}  // namespace dripline::pki::test
