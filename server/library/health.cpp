#include "server/library/health.hpp"

#include <algorithm>

namespace dripline::library {

std::string_view to_string(Health::Level level) {
  switch (level) {
    case Health::Level::Ok:
      return "ok";
    case Health::Level::Degraded:
      return "degraded";
    case Health::Level::Failed:
      return "failed";
  }
  return "failed";
}

void Health::report(const std::string& owner, Finding finding) {
  const std::lock_guard lock(mutex_);
  const std::pair key(finding.subject, owner);
  if (finding.level == Level::Ok) {
    findings_.erase(key);
  } else {
    findings_[key] = std::move(finding);
  }
}

void Health::looked() {
  const std::lock_guard lock(mutex_);
  looked_ = clock_.steady_now();
}

Health::State Health::state() const {
  const std::lock_guard lock(mutex_);
  State state;
  for (const auto& [key, finding] : findings_) state.findings.push_back(finding);
  if (looked_ && clock_.steady_now() - *looked_ > kSilence) {
    state.findings.push_back({.level = Level::Failed,
                              .subject = "store",
                              .what = "the store does not answer",
                              .detail = {}});
  }
  for (const auto& finding : state.findings) state.level = std::max(state.level, finding.level);
  return state;
}

}  // namespace dripline::library
