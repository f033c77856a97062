#include "server/identity/revoked_certificates.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

namespace dripline::identity {
namespace {

constexpr std::size_t kMaxDigits = 40;  ///< 20 bytes (RFC 5280)
constexpr std::uintmax_t kMaxFile = 1024 * 1024;

/// An even number of digits, as a certificate's serial is shown.
std::string canonical(std::string digits) {
  digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size() - 1));
  if (digits.size() % 2 != 0) digits.insert(0, "0");
  return digits;
}

/// Empty: nothing is on the line. Errors: Syntax.
Result<std::string> read_line(std::string_view line, std::size_t number) {
  std::string digits;
  for (char c : line.substr(0, line.find('#'))) {
    if (c == ' ' || c == '\t' || c == '\r' || c == ':') continue;
    if (c >= 'a' && c <= 'f') c = static_cast<char>(c - 'a' + 'A');
    const bool is_digit = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'F');
    if (!is_digit || digits.size() >= kMaxDigits) {
      return fail(Errc::Syntax, "line {}: expected a serial of at most {} hexadecimal digits",
                  number, kMaxDigits);
    }
    digits += c;
  }
  return digits.empty() ? digits : canonical(std::move(digits));
}

}  // namespace

Result<std::set<std::string>> parse_revoked(std::string_view text) {
  std::set<std::string> serials;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const auto end = text.find('\n');
    auto serial = read_line(text.substr(0, end), number);
    if (!serial) return fail(serial.error());
    if (!serial->empty()) serials.insert(*std::move(serial));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return serials;
}

Result<std::set<std::string>> read_revoked(const std::string& file) {
  std::error_code ec;
  const auto size = std::filesystem::file_size(file, ec);
  if (!ec && size > kMaxFile)
    return fail(Errc::LimitExceeded, "{} has {} bytes, at most {}", file, size, kMaxFile);
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (ec || !stream || (size > 0 && !(text << stream.rdbuf())))
    return fail(Errc::NotFound, "{} cannot be read", file);
  auto serials = parse_revoked(text.str());
  if (!serials) return fail(serials.error().code, "{}: {}", file, serials.error().what);
  return serials;
}

}  // namespace dripline::identity
