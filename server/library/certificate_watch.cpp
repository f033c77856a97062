#include "server/library/certificate_watch.hpp"

#include <set>

#include <fmt/format.h>

#include "protocol/pki/certificate.hpp"
#include "protocol/process/log.hpp"

namespace dripline::library {
namespace {

using Use = WatchedCertificate::Use;

constexpr const char* kCertificateSubject = "certificate";

std::string_view holder_text(Use use) {
  switch (use) {
    case Use::Https:
      return "the TLS certificate";
    case Use::Dds:
      return "the server's DDS certificate";
    case Use::Gateway:
      return "the DDS certificate of a gateway";
  }
  return "a certificate";
}

/// No machine has a colon in its name.
std::string owner_of(const WatchedCertificate& certificate) {
  return fmt::format("{}:{}", to_string(certificate.use), certificate.machine);
}

}  // namespace

std::string_view to_string(Use use) {
  switch (use) {
    case Use::Https:
      return "https";
    case Use::Dds:
      return "dds";
    case Use::Gateway:
      return "gateway";
  }
  return "unknown";
}

Health::Finding judge_certificate(const WatchedCertificate& certificate, UtcTime now) {
  const auto left = pki::days_left(certificate.expires, now);
  Health::Finding finding{
      .level = Health::Level::Ok, .subject = kCertificateSubject, .what = {}, .detail = {}};
  finding.detail =
      fmt::format("{}it expires at {}",
                  certificate.machine.empty() ? std::string()
                                              : fmt::format("machine={}: ", certificate.machine),
                  to_iso8601(certificate.expires));
  if (certificate.expires <= now) {
    finding.level = Health::Level::Degraded;
    finding.what = fmt::format("{} has expired", holder_text(certificate.use));
  } else if (left < pki::kExpiryWarning.count()) {
    finding.level = Health::Level::Degraded;
    finding.what = fmt::format("{} expires in {} days", holder_text(certificate.use), left);
  }
  return finding;
}

void CertificateWatch::look(const std::vector<WatchedCertificate>& certificates) {
  std::set<std::string> bad;
  for (const auto& certificate : certificates) {
    auto finding = judge_certificate(certificate, clock_.now());
    if (finding.level == Health::Level::Ok) continue;
    const auto owner = owner_of(certificate);
    bad.insert(owner);
    log(owner, finding);
    health_.report(owner, std::move(finding));
  }
  std::erase_if(reported_, [&](const auto& entry) {
    const bool is_over = !bad.contains(entry.first);
    if (is_over)
      health_.report(
          entry.first,
          {.level = Health::Level::Ok, .subject = kCertificateSubject, .what = {}, .detail = {}});
    return is_over;
  });
}

void CertificateWatch::log(const std::string& owner, const Health::Finding& finding) {
  const SteadyTime now = clock_.steady_now();
  const auto [entry, is_new] = reported_.try_emplace(owner, now);
  if (!is_new && now - entry->second < kLogInterval) return;
  entry->second = now;
  process::log_warning("{}: {}", finding.what, finding.detail);
}

}  // namespace dripline::library
