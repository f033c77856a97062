#include "server/app/impl/cut_off_watch.hpp"

#include <condition_variable>
#include <mutex>
#include <utility>

#include "protocol/process/log.hpp"

namespace dripline::app {
namespace {

/// Who did it, in the audit trail.
constexpr const char* kWatch = "server (watch of gateways)";
constexpr std::chrono::hours kSameAgain{1};

}  // namespace

void CutOffWatch::begin() {
  thread_ = std::jthread([this](const std::stop_token& stop) {
    std::mutex mutex;
    std::condition_variable_any stopped;
    std::unique_lock lock(mutex);
    while (!stop.stop_requested() && !has_left_) {
      look();
      stopped.wait_for(lock, stop, kEvery, [] { return false; });
    }
  });
}

void CutOffWatch::look() {
  const std::size_t heard = parts_.heard();
  look_at_standbys(heard, parts_.clock.steady_now());
  // The store may have taken long.
  CutOffRule::Judgment judgment = rule_.judge({.now = parts_.clock.steady_now(),
                                               .heard = parts_.heard(),
                                               .is_machine_known = parts_.is_machine_known()});
  using Step = CutOffRule::Step;
  if (judgment.step == Step::Keep) {
    if (auto kept = parts_.store.note_own_hand_overs(rule_.kept()); !kept)
      process::log_warning("that gateways are heard again was not stored: {}", kept.error().what);
  }
  if (judgment.step == Step::HandOver) {
    const auto done = hand_over(judgment);
    has_left_ = done.has_value();
    if (!done) judgment.reason = done.error().what;
  }
  report(judgment);
}

/// A row that changes is of a server that looks; so it is read at least as often as it is written.
void CutOffWatch::look_at_standbys(std::size_t heard, SteadyTime now) {
  const auto every = heard == 0 ? 2 * kEvery : kWaitingEvery;
  if (looked_at_standbys_ && now - *looked_at_standbys_ < every) return;
  looked_at_standbys_ = now;
  const auto waiting = parts_.store.waiting();
  if (waiting) rule_.note(*waiting, parts_.clock.steady_now());
}

Result<void> CutOffWatch::hand_over(const CutOffRule::Judgment& judgment) {
  if (auto free = parts_.check_free(); !free) return free;
  if (parts_.heard() > 0) return fail(Errc::Conflict, "a gateway is heard again");
  if (auto noted = parts_.audit.write_before({.who = kWatch,
                                              .action = "server.hand_over",
                                              .subject = parts_.server,
                                              .detail = judgment.finding});
      !noted)
    return noted;
  if (auto kept = parts_.store.note_own_hand_overs(rule_.after_hand_over()); !kept) return kept;
  process::log_warning("{}: the library is handed over to it", judgment.finding);
  parts_.leave();
  return {};
}

/// Each decision once, when it is made.
void CutOffWatch::report(const CutOffRule::Judgment& judgment) {
  using Level = library::Health::Level;
  const bool is_other = judgment.finding != finding_;
  if (is_other || judgment.reason != reason_) {
    parts_.health.report("", {.level = judgment.finding.empty() ? Level::Ok : Level::Degraded,
                              .subject = kSubject,
                              .what = judgment.finding,
                              .detail = judgment.reason});
    if (is_other && judgment.finding.empty())
      process::log_info("gateways are heard again, or by no server that waits");
  }
  finding_ = judgment.finding;
  if (std::exchange(reason_, judgment.reason) != judgment.reason) note_reason();
}

/// What comes and goes all the time, as a forger can make it, does not fill log and audit trail.
void CutOffWatch::note_reason() {
  if (reason_.empty()) return;
  const SteadyTime now = parts_.clock.steady_now();
  const auto [entry, is_first] = noted_.try_emplace(reason_, now);
  if (!is_first && now - entry->second < kSameAgain) return;
  entry->second = now;
  process::log_warning("{}. The library stays: {}", finding_, reason_);
  parts_.audit.write({.who = kWatch,
                      .action = "server.stay",
                      .subject = parts_.server,
                      .detail = finding_ + ": " + reason_});
}

}  // namespace dripline::app
