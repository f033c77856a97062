// A certificate, PEM or what is taken for it. Properties: its texts can be printed, reading it
// twice gives the same, and days can be counted.
#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "protocol/pki/certificate.hpp"
#include "protocol/pki/verification.hpp"

namespace {

bool can_be_printed(std::string_view text) {
  return std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < ' '; });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dripline;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const UtcTime now{std::chrono::days(20'000)};
  const auto certificate = pki::parse_certificate(text);
  static_cast<void>(pki::check_issue({.certificate = text, .authority = text}, now));
  static_cast<void>(pki::check_key(text, text));
  static_cast<void>(pki::open_document(text, text));
  if (!certificate) return 0;
  const auto again = pki::parse_certificate(text);
  if (!again || *again != *certificate) std::abort();
  for (const auto* each : {&certificate->common_name, &certificate->unit, &certificate->subject,
                           &certificate->issuer, &certificate->serial}) {
    if (!can_be_printed(*each)) std::abort();
  }
  if (pki::expiry_text(certificate->not_after, now).empty()) std::abort();
  return 0;
}
