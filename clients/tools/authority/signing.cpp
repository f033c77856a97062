#include "clients/tools/authority/signing.hpp"

#include <openssl/bn.h>
#include <openssl/ec.h>
#include <openssl/obj_mac.h>
#include <openssl/pem.h>
#include <openssl/x509v3.h>
#include <ctime>
#include <memory>

#include "protocol/base/random.hpp"
#include "protocol/pki/openssl.hpp"

namespace dripline::authority {
namespace {

using pki::CertificatePointer;
using pki::KeyPointer;
using pki::Release;

tl::unexpected<Error> not_made(std::string_view what) {
  return fail(Errc::Io, "{} cannot be made: {}", what, pki::openssl_reason());
}

std::time_t unix_seconds(UtcTime time) {
  return static_cast<std::time_t>(
      std::chrono::floor<std::chrono::seconds>(time).time_since_epoch().count());
}

using IntegerPointer = std::unique_ptr<ASN1_INTEGER, Release<ASN1_INTEGER_free>>;
using TimePointer = std::unique_ptr<ASN1_TIME, Release<ASN1_TIME_free>>;

IntegerPointer serial_number(const std::string& digits) {
  BIGNUM* read = nullptr;
  BN_hex2bn(&read, digits.c_str());
  const std::unique_ptr<BIGNUM, Release<BN_free>> number(read);
  return IntegerPointer(number ? BN_to_ASN1_INTEGER(number.get(), nullptr) : nullptr);
}

TimePointer time_stamp(UtcTime time) {
  return TimePointer(ASN1_TIME_set(nullptr, unix_seconds(time)));
}

bool add_entry(X509_NAME* name, const char* kind, const std::string& text) {
  return text.empty() ||
         X509_NAME_add_entry_by_txt(name, kind, MBSTRING_UTF8,
                                    reinterpret_cast<const unsigned char*>(text.data()),
                                    static_cast<int>(text.size()), -1, 0) == 1;
}

bool add_extension(X509* certificate, X509* issuer, int kind, const char* value) {
  X509V3_CTX context;
  X509V3_set_ctx_nodb(&context);
  X509V3_set_ctx(&context, issuer, certificate, nullptr, nullptr, 0);
  const std::unique_ptr<X509_EXTENSION, Release<X509_EXTENSION_free>> extension(
      X509V3_EXT_conf_nid(nullptr, &context, kind, value));
  return extension && X509_add_ext(certificate, extension.get(), -1) == 1;
}

bool add_extensions(X509* certificate, X509* issuer, Purpose purpose) {
  const auto add = [&](int kind, const char* value) {
    return add_extension(certificate, issuer, kind, value);
  };
  if (!add(NID_subject_key_identifier, "hash")) return false;
  switch (purpose) {
    case Purpose::IdentityAuthority:
      return add(NID_basic_constraints, "critical,CA:TRUE,pathlen:0") &&
             add(NID_key_usage, "critical,keyCertSign,cRLSign");
    case Purpose::PermissionsAuthority:
      return add(NID_basic_constraints, "critical,CA:FALSE") &&
             add(NID_key_usage, "critical,digitalSignature") &&
             add(NID_ext_key_usage, "emailProtection");  // as S/MIME asks of a signer
    case Purpose::Identity:
      // Without emailProtection: it must not sign documents.
      return add(NID_basic_constraints, "critical,CA:FALSE") &&
             add(NID_key_usage, "critical,digitalSignature,keyAgreement") &&
             add(NID_ext_key_usage, "clientAuth,serverAuth") &&
             add(NID_authority_key_identifier, "keyid");
  }
  return false;
}

Result<std::string> pem_of(X509* certificate) {
  const auto bio = pki::memory();
  if (!bio || PEM_write_bio_X509(bio.get(), certificate) != 1) return not_made("a certificate");
  return pki::text_of(bio.get());
}

/// Of the public half of `key`; `issuer` null: signed by itself.
Result<std::string> make(const Request& request, const std::string& key, X509* issuer,
                         EVP_PKEY* issuer_key) {
  const KeyPointer own_key = pki::parse_key(key);
  const CertificatePointer made(X509_new());
  if (!own_key || !made) return not_made("a certificate");
  const auto serial = serial_number(request.serial);
  X509_NAME* const name = X509_get_subject_name(made.get());
  const auto begin = time_stamp(request.validity.not_before);
  const auto end = time_stamp(request.validity.not_after);
  constexpr long kVersion3 = 2;
  const bool is_filled =
      serial && begin && end && X509_set_version(made.get(), kVersion3) == 1 &&
      X509_set_serialNumber(made.get(), serial.get()) == 1 && add_entry(name, "O", request.shop) &&
      add_entry(name, "OU", request.unit) && add_entry(name, "CN", request.name) &&
      X509_set1_notBefore(made.get(), begin.get()) == 1 &&
      X509_set1_notAfter(made.get(), end.get()) == 1 &&
      X509_set_pubkey(made.get(), own_key.get()) == 1 &&
      X509_set_issuer_name(made.get(), issuer == nullptr ? name : X509_get_subject_name(issuer)) ==
          1 &&
      add_extensions(made.get(), issuer == nullptr ? made.get() : issuer, request.purpose);
  if (!is_filled) return not_made("a certificate");
  EVP_PKEY* const signing = issuer == nullptr ? own_key.get() : issuer_key;
  if (X509_sign(made.get(), signing, EVP_sha256()) == 0) return not_made("a certificate");
  return pem_of(made.get());
}

struct OpenSigner {
  CertificatePointer certificate;
  KeyPointer key;
};

Result<OpenSigner> open(const Signer& signer) {
  OpenSigner opened{pki::parse_x509(signer.certificate), pki::parse_key(signer.key)};
  if (!opened.certificate || !opened.key)
    return fail(Errc::Io, "the authority's certificate or key cannot be read: {}",
                pki::openssl_reason());
  return opened;
}

using RevokedPointer = std::unique_ptr<X509_REVOKED, Release<X509_REVOKED_free>>;

bool add_revoked(X509_CRL* list, const Issued& issued) {
  const auto serial = serial_number(issued.serial);
  const auto time = time_stamp(*issued.revoked);
  RevokedPointer entry(X509_REVOKED_new());
  const bool is_added = entry && serial && time &&
                        X509_REVOKED_set_serialNumber(entry.get(), serial.get()) == 1 &&
                        X509_REVOKED_set_revocationDate(entry.get(), time.get()) == 1 &&
                        X509_CRL_add0_revoked(list, entry.get()) == 1;
  if (is_added) (void)entry.release();  // the list owns it
  return is_added;
}

}  // namespace

Result<std::string> make_key() {
  const KeyPointer key(EVP_EC_gen("P-256"));
  const auto bio = pki::memory();
  if (!key || !bio ||
      PEM_write_bio_PrivateKey(bio.get(), key.get(), nullptr, nullptr, 0, nullptr, nullptr) != 1)
    return not_made("a key");
  return pki::text_of(bio.get());
}

std::string new_serial() {
  constexpr std::size_t kBytes = 15;               // a serial is positive and at most 20 bytes long
  std::string digits = "40" + random_hex(kBytes);  // no zero in front, which would not come back
  for (char& c : digits) c = c >= 'a' ? static_cast<char>(c - 'a' + 'A') : c;
  return digits;
}

Result<std::string> make_root(const Request& request, const std::string& key) {
  return make(request, key, nullptr, nullptr);
}

Result<std::string> make_certificate(const Request& request, const std::string& key,
                                     const Signer& signer) {
  const auto opened = open(signer);
  if (!opened) return fail(opened.error());
  return make(request, key, opened->certificate.get(), opened->key.get());
}

Result<std::string> make_revocation_list(const std::vector<Issued>& issued, const Signer& signer,
                                         UtcTime now) {
  const auto opened = open(signer);
  if (!opened) return fail(opened.error());
  const pki::RevocationListPointer list(X509_CRL_new());
  const auto begin = time_stamp(now - kClockTolerance);
  constexpr long kVersion2 = 1;
  if (!list || !begin || X509_CRL_set_version(list.get(), kVersion2) != 1 ||
      X509_CRL_set_issuer_name(list.get(), X509_get_subject_name(opened->certificate.get())) != 1 ||
      X509_CRL_set1_lastUpdate(list.get(), begin.get()) != 1 ||
      X509_CRL_set1_nextUpdate(list.get(), X509_get0_notAfter(opened->certificate.get())) != 1) {
    return not_made("the list of revoked certificates");
  }
  for (const auto& each : issued) {
    if (each.revoked && !add_revoked(list.get(), each))
      return not_made("the list of revoked certificates");
  }
  const auto bio = pki::memory();
  if (X509_CRL_sort(list.get()) != 1 ||
      X509_CRL_sign(list.get(), opened->key.get(), EVP_sha256()) == 0 || !bio ||
      PEM_write_bio_X509_CRL(bio.get(), list.get()) != 1)
    return not_made("the list of revoked certificates");
  return pki::text_of(bio.get());
}

Result<std::string> sign_document(const std::string& text, const Signer& signer) {
  const auto opened = open(signer);
  if (!opened) return fail(opened.error());
  const auto content = pki::reader_of(text);
  const auto out = pki::memory();
  constexpr int kFlags = PKCS7_TEXT | PKCS7_DETACHED | PKCS7_STREAM;
  const pki::DocumentPointer document(
      content
          ? PKCS7_sign(opened->certificate.get(), opened->key.get(), nullptr, content.get(), kFlags)
          : nullptr);
  if (!document || !out || SMIME_write_PKCS7(out.get(), document.get(), content.get(), kFlags) != 1)
    return not_made("a signed document");
  return pki::text_of(out.get());
}

}  // namespace dripline::authority
