#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"

namespace dripline::pki {

/// What a certificate (X.509) states of its holder. The texts are printable: anyone who made it may
/// have written anything into it.
struct Certificate {
  std::string common_name;      ///< empty: none, several, or not plain text
  std::string unit;             ///< the organizational unit; likewise
  std::string subject, issuer;  ///< "CN=lathe-1,OU=gateway,O=shop" (RFC 2253)
  std::string serial;           ///< hexadecimal digits
  UtcTime not_before, not_after;

  friend bool operator==(const Certificate&, const Certificate&) = default;
};

/// Files with certificates, keys and signed documents are smaller.
inline constexpr std::size_t kMaxFile = 1024 * 1024;

/// A file as it is. Errors: NotFound, LimitExceeded (over kMaxFile), Io; they name it.
Result<std::string> read_file(const std::string& file);

/// The first certificate of a PEM text. Errors: Syntax.
Result<Certificate> parse_certificate(std::string_view pem);
/// The first certificate of a PEM file. Errors: NotFound, LimitExceeded, Io, Syntax; they name it.
Result<Certificate> read_certificate(const std::string& file);

/// People are warned this long before a certificate expires.
inline constexpr std::chrono::days kExpiryWarning{30};

/// Whole days until it expires; negative: it has.
std::int64_t days_left(UtcTime not_after, UtcTime now);

/// "in 29 days (2026-12-24)", "today (2026-11-25)", "3 days ago (2026-11-22)".
std::string expiry_text(UtcTime not_after, UtcTime now);

}  // namespace dripline::pki
