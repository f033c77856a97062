#include "protocol/pki/verification.hpp"

#include <openssl/pem.h>
#include <openssl/x509_vfy.h>

#include "protocol/pki/openssl.hpp"

namespace dripline::pki {
namespace {

Result<CertificatePointer> certificate_of(std::string_view pem) {
  auto x509 = parse_x509(pem);
  if (!x509) return fail(Errc::Syntax, "it is no certificate (PEM): {}", openssl_reason());
  return x509;
}

/// That trusts one authority.
Result<StorePointer> store_of(std::string_view authority) {
  const auto root = certificate_of(authority);
  if (!root) return fail(root.error().code, "of the authority: {}", root.error().what);
  StorePointer store(X509_STORE_new());
  if (!store || X509_STORE_add_cert(store.get(), root->get()) != 1)
    return fail(Errc::Io, "the authority's certificate cannot be used: {}", openssl_reason());
  return store;
}

}  // namespace

Result<void> check_key(std::string_view certificate, std::string_view key) {
  const auto x509 = certificate_of(certificate);
  if (!x509) return fail(x509.error());
  const auto secret = parse_key(key);
  if (!secret) {
    return fail(Errc::Syntax, "it is no private key (PEM, without a password): {}",
                openssl_reason());
  }
  if (X509_check_private_key(x509->get(), secret.get()) != 1) {
    openssl_reason();
    return fail(Errc::Denied, "it is the private key of another certificate");
  }
  return {};
}

Result<void> check_issue(const Issue& issue, UtcTime now) {
  const auto x509 = certificate_of(issue.certificate);
  if (!x509) return fail(x509.error());
  const auto store = store_of(issue.authority);
  if (!store) return fail(store.error());
  const VerificationPointer verification(X509_STORE_CTX_new());
  if (!verification ||
      X509_STORE_CTX_init(verification.get(), store->get(), x509->get(), nullptr) != 1)
    return fail(Errc::Io, "the certificate cannot be verified: {}", openssl_reason());
  unsigned long flags = 0;
  if (issue.revocation_list) {
    const auto list = parse_crl(*issue.revocation_list);
    if (!list || X509_STORE_add_crl(store->get(), list.get()) != 1)
      return fail(Errc::Syntax, "the list of revoked certificates cannot be read: {}",
                  openssl_reason());
    flags = X509_V_FLAG_CRL_CHECK;
  }
  const auto seconds = std::chrono::floor<std::chrono::seconds>(now).time_since_epoch().count();
  X509_STORE_CTX_set_time(verification.get(), flags, static_cast<std::time_t>(seconds));
  X509_STORE_CTX_set_flags(verification.get(), flags);
  const bool is_good = X509_verify_cert(verification.get()) == 1;
  if (is_good) return {};
  openssl_reason();
  return fail(Errc::Denied, "{}",
              X509_verify_cert_error_string(X509_STORE_CTX_get_error(verification.get())));
}

Result<std::string> open_document(std::string_view document, std::string_view authority) {
  const auto store = store_of(authority);
  if (!store) return fail(store.error());
  const auto bio = reader_of(document);
  BIO* content = nullptr;
  const DocumentPointer signed_text(bio ? SMIME_read_PKCS7(bio.get(), &content) : nullptr);
  const BioPointer owner(content);
  if (!signed_text || content == nullptr)
    return fail(Errc::Syntax, "it is no signed document (S/MIME): {}", openssl_reason());
  const auto text = memory();
  if (!text || PKCS7_verify(signed_text.get(), nullptr, store->get(), content, text.get(),
                            PKCS7_TEXT) != 1) {
    return fail(Errc::Denied, "it was changed, or another authority signed it: {}",
                openssl_reason());
  }
  return text_of(text.get());
}

}  // namespace dripline::pki
