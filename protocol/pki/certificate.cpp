#include "protocol/pki/certificate.hpp"

#include <sys/stat.h>
#include <algorithm>
#include <cerrno>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>

#include "protocol/base/utf8.hpp"
#include "protocol/pki/openssl.hpp"

namespace dripline::pki {
namespace {

bool is_plain(std::string_view text) {
  constexpr unsigned char kDelete = 0x7F;
  if (std::ranges::any_of(text, [](unsigned char c) { return c < ' ' || c == kDelete; }))
    return false;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

/// One entry of a name; empty where it is not there once and as plain text.
std::string entry_of(const X509_NAME* name, int kind) {
  const int at = X509_NAME_get_index_by_NID(name, kind, -1);
  if (at < 0 || X509_NAME_get_index_by_NID(name, kind, at) >= 0) return {};
  unsigned char* bytes = nullptr;
  const int size =
      ASN1_STRING_to_UTF8(&bytes, X509_NAME_ENTRY_get_data(X509_NAME_get_entry(name, at)));
  if (size < 0) return {};
  std::string text(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(size));
  OPENSSL_free(bytes);
  return is_plain(text) ? text : std::string();
}

std::string date_text(UtcTime time) {
  constexpr std::size_t kDate = 10;
  return to_iso8601(time).substr(0, kDate);
}

}  // namespace

Result<std::string> read_file(const std::string& file) {
  struct stat facts {};
  if (::stat(file.c_str(), &facts) != 0) {
    const auto code = errno == ENOENT || errno == ENOTDIR ? Errc::NotFound : Errc::Io;
    return fail(code, "file '{}': {}", file, std::generic_category().message(errno));
  }
  if (!S_ISREG(facts.st_mode)) return fail(Errc::Io, "'{}' is not a file", file);
  if (facts.st_size < 0 || static_cast<std::uint64_t>(facts.st_size) > kMaxFile) {
    return fail(Errc::LimitExceeded, "file '{}' has {} bytes, at most {}", file, facts.st_size,
                kMaxFile);
  }
  std::ifstream in(file, std::ios::binary);
  std::string text(static_cast<std::size_t>(facts.st_size), '\0');
  if (!in || !in.read(text.data(), facts.st_size))
    return fail(Errc::Io, "file '{}' cannot be read", file);
  return text;
}

Result<Certificate> parse_certificate(std::string_view pem) {
  const auto x509 = parse_x509(pem);
  if (!x509) return fail(Errc::Syntax, "it is no certificate (PEM): {}", openssl_reason());
  const auto begin = time_of(X509_get0_notBefore(x509.get()));
  const auto end = time_of(X509_get0_notAfter(x509.get()));
  if (!begin || !end) return fail(Errc::Syntax, "the certificate's validity cannot be read");
  const auto* const subject = X509_get_subject_name(x509.get());
  Certificate certificate;
  certificate.common_name = entry_of(subject, NID_commonName);
  certificate.unit = entry_of(subject, NID_organizationalUnitName);
  certificate.subject = name_text(subject);
  certificate.issuer = name_text(X509_get_issuer_name(x509.get()));
  certificate.serial = serial_text(X509_get0_serialNumber(x509.get()));
  certificate.not_before = *begin;
  certificate.not_after = *end;
  return certificate;
}

Result<Certificate> read_certificate(const std::string& file) {
  const auto text = read_file(file);
  if (!text) return fail(text.error());
  auto certificate = parse_certificate(*text);
  if (!certificate)
    return fail(certificate.error().code, "file '{}': {}", file, certificate.error().what);
  return certificate;
}

std::int64_t days_left(UtcTime not_after, UtcTime now) {
  return std::chrono::floor<std::chrono::days>(not_after - now).count();
}

std::string expiry_text(UtcTime not_after, UtcTime now) {
  const auto days = days_left(not_after, now);
  const auto date = date_text(not_after);
  if (not_after <= now) return fmt::format("{} days ago ({})", -days - 1, date);
  return days == 0 ? fmt::format("today ({})", date) : fmt::format("in {} days ({})", days, date);
}

}  // namespace dripline::pki
