#include "server/ports/requests/offer_trail.hpp"

#include <utility>

#include "protocol/process/log.hpp"

namespace dripline::ports {
namespace {

constexpr const char* kOffer = "port.offer";
constexpr const char* kOffered = "port.offered";
/// Entries that are looked through. Between the beginning of an offer and a look there are those of
/// its transfer's time: a server that is away adds none.
constexpr std::uint64_t kLookedAt = 5000;

}  // namespace

Result<std::optional<std::string>> broken_offer(storage::AuditStore& audit,
                                                const std::string& machine) {
  const auto entries = audit.list({.limit = kLookedAt});
  if (!entries) return fail(entries.error());
  for (const auto& entry : *entries) {
    if (entry.subject != machine) continue;
    if (entry.action == kOffered) return std::nullopt;
    if (entry.action == kOffer) return entry.detail;
  }
  return std::nullopt;
}

Result<void> OfferTrail::note(const char* action, const std::string& detail) const {
  return audit_->add({.time = clock_->now(),
                      .who = {kRequestAuthor, "", ""},
                      .action = action,
                      .subject = machine_,
                      .detail = detail});
}

Result<void> OfferTrail::begin(const std::string& job, const std::string& program) {
  if (auto noted = note(kOffer, program); !noted) return noted;
  has_looked_ = true;
  broken_.reset();
  job_ = job;
  program_ = program;
  return {};
}

void OfferTrail::end(const SendEnd& end) {
  if (job_.empty() || end.progress.id != job_) return;
  job_.clear();
  const bool has_begun = end.progress.sent.bytes > 0 || end.progress.is_checked;
  broken_ = program_;
  if (end.outcome == SendOutcome::Completed) return close("sent to its end");
  if (!has_begun) close("nothing of it was sent");
}

Result<std::optional<std::string>> OfferTrail::broken() {
  if (has_looked_) return broken_;
  auto found = broken_offer(*audit_, machine_);
  if (!found) return found;
  has_looked_ = true;
  broken_ = *std::move(found);
  return broken_;
}

/// Where that cannot be stored the next server asks the operator once more.
void OfferTrail::close(const std::string& why) {
  const auto known = broken();
  if (!known || !*known) return;
  const auto noted = note(kOffered, fmt::format("{}: {}", **known, why));
  broken_.reset();
  if (!noted)
    process::log_warning("machine={}: the end of an offered program is not stored: {}", machine_,
                         noted.error().what);
}

}  // namespace dripline::ports
