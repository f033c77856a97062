#include "protocol/pki/openssl.hpp"

#include <openssl/bn.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <algorithm>
#include <climits>
#include <ctime>

namespace dripline::pki {
namespace {

/// OpenSSL's own would ask at the terminal.
int no_password(char*, int, int, void*) {
  return -1;
}

}  // namespace

BioPointer reader_of(std::string_view bytes) {
  const auto size = std::min<std::size_t>(bytes.size(), INT_MAX);
  return BioPointer(BIO_new_mem_buf(bytes.data(), static_cast<int>(size)));
}

BioPointer memory() {
  return BioPointer(BIO_new(BIO_s_mem()));
}

std::string text_of(BIO* memory) {
  char* begin = nullptr;
  const long size = BIO_get_mem_data(memory, &begin);
  return size > 0 ? std::string(begin, static_cast<std::size_t>(size)) : std::string();
}

std::string openssl_reason() {
  const unsigned long code = ERR_peek_last_error();
  ERR_clear_error();
  const char* const reason = code == 0 ? nullptr : ERR_reason_error_string(code);
  return reason == nullptr ? "OpenSSL gives no reason" : reason;
}

CertificatePointer parse_x509(std::string_view pem) {
  const auto bio = reader_of(pem);
  return CertificatePointer(bio ? PEM_read_bio_X509(bio.get(), nullptr, no_password, nullptr)
                                : nullptr);
}

KeyPointer parse_key(std::string_view pem) {
  const auto bio = reader_of(pem);
  return KeyPointer(bio ? PEM_read_bio_PrivateKey(bio.get(), nullptr, no_password, nullptr)
                        : nullptr);
}

RevocationListPointer parse_crl(std::string_view pem) {
  const auto bio = reader_of(pem);
  return RevocationListPointer(bio ? PEM_read_bio_X509_CRL(bio.get(), nullptr, no_password, nullptr)
                                   : nullptr);
}

std::optional<UtcTime> time_of(const ASN1_TIME* time) {
  std::tm parts{};
  if (time == nullptr || ASN1_TIME_to_tm(time, &parts) != 1) return std::nullopt;
  return UtcTime(std::chrono::seconds(::timegm(&parts)));
}

std::string name_text(const X509_NAME* name) {
  const auto bio = memory();
  if (!bio || X509_NAME_print_ex(bio.get(), name, 0, XN_FLAG_RFC2253) < 0) return {};
  return text_of(bio.get());
}

std::string serial_text(const ASN1_INTEGER* serial) {
  const std::unique_ptr<BIGNUM, Release<BN_free>> number(ASN1_INTEGER_to_BN(serial, nullptr));
  char* const digits = number ? BN_bn2hex(number.get()) : nullptr;
  if (digits == nullptr) return {};
  std::string text(digits);
  OPENSSL_free(digits);
  return text;
}

}  // namespace dripline::pki
