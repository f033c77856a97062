#include "server/api/impl/peer_certificate.hpp"

#include <fmt/core.h>
#include <openssl/x509.h>
#include <memory>

namespace dripline::api {
namespace {

constexpr int kMaxSerial = 20;  ///< bytes (RFC 5280)

/// Empty: there is none, there are several, or it is no plain text.
std::string common_name(const X509* certificate) {
  const X509_NAME* const subject = X509_get_subject_name(certificate);
  const int at = X509_NAME_get_index_by_NID(subject, NID_commonName, -1);
  if (at < 0 || X509_NAME_get_index_by_NID(subject, NID_commonName, at) >= 0) return {};
  const ASN1_STRING* const text = X509_NAME_ENTRY_get_data(X509_NAME_get_entry(subject, at));
  unsigned char* bytes = nullptr;
  const int size = ASN1_STRING_to_UTF8(&bytes, text);
  if (size < 0) return {};
  std::string name(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
  OPENSSL_free(bytes);
  return name.find('\0') == std::string::npos ? name : std::string();
}

std::string serial_of(const X509* certificate) {
  const ASN1_INTEGER* const serial = X509_get0_serialNumber(certificate);
  const int size = ASN1_STRING_length(serial);
  if (size < 1 || size > kMaxSerial) return {};
  const unsigned char* const bytes = ASN1_STRING_get0_data(serial);
  std::string digits;
  for (int i = 0; i < size; ++i) digits += fmt::format("{:02X}", bytes[i]);
  return digits;
}

std::optional<UtcTime> expiry_of(const X509* certificate) {
  tm time{};
  if (ASN1_TIME_to_tm(X509_get0_notAfter(certificate), &time) != 1) return std::nullopt;
  return UtcTime(std::chrono::seconds(::timegm(&time)));
}

}  // namespace

std::optional<identity::ClientCertificate> peer_certificate(SSL* connection) {
  const std::unique_ptr<X509, decltype(&X509_free)> certificate(
      SSL_get1_peer_certificate(connection), &X509_free);
  if (!certificate || SSL_get_verify_result(connection) != X509_V_OK) return std::nullopt;
  const auto expires = expiry_of(certificate.get());
  identity::ClientCertificate shown{common_name(certificate.get()), serial_of(certificate.get()),
                                    expires.value_or(UtcTime{})};
  if (shown.user.empty() || shown.serial.empty() || !expires) return std::nullopt;
  return shown;
}

}  // namespace dripline::api
