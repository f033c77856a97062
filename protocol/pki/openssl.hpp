#pragma once

#include <openssl/bio.h>
#include <openssl/evp.h>
#include <openssl/pkcs7.h>
#include <openssl/x509.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

/// Ownership over the objects of OpenSSL, and the few conversions that everything here needs.
namespace dripline::pki {

template <auto release>
struct Release {
  template <class T>
  void operator()(T* object) const {
    release(object);
  }
};

using BioPointer = std::unique_ptr<BIO, Release<BIO_free_all>>;
using CertificatePointer = std::unique_ptr<X509, Release<X509_free>>;
using KeyPointer = std::unique_ptr<EVP_PKEY, Release<EVP_PKEY_free>>;
using RevocationListPointer = std::unique_ptr<X509_CRL, Release<X509_CRL_free>>;
using DocumentPointer = std::unique_ptr<PKCS7, Release<PKCS7_free>>;
using StorePointer = std::unique_ptr<X509_STORE, Release<X509_STORE_free>>;
using VerificationPointer = std::unique_ptr<X509_STORE_CTX, Release<X509_STORE_CTX_free>>;

/// Reads `bytes`, which must outlive it.
BioPointer reader_of(std::string_view bytes);
/// Takes what is written to it.
BioPointer memory();
std::string text_of(BIO* memory);

/// The reason of the last failure, for people; empties OpenSSL's queue of errors, which belongs to
/// the thread.
std::string openssl_reason();

/// The first one of a PEM text; null: there is none. A password is never asked for.
CertificatePointer parse_x509(std::string_view pem);
KeyPointer parse_key(std::string_view pem);
RevocationListPointer parse_crl(std::string_view pem);

/// nullopt: it is not a time.
std::optional<UtcTime> time_of(const ASN1_TIME* time);
/// "CN=lathe-1,OU=gateway,O=shop" (RFC 2253), as permissions name the holder of a certificate.
std::string name_text(const X509_NAME* name);
/// Hexadecimal digits.
std::string serial_text(const ASN1_INTEGER* serial);

}  // namespace dripline::pki
