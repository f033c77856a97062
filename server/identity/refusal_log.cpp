#include "server/identity/refusal_log.hpp"

#include "protocol/process/log.hpp"

namespace dripline::identity {

RefusalLog::RefusalLog(library::AuditTrail& audit, const Options& options)
    : audit_(audit),
      options_(options),
      thread_([this](const std::stop_token& stop) { write(stop); }) {}

RefusalLog::~RefusalLog() {
  thread_.request_stop();
  thread_.join();
}

void RefusalLog::note(Refusal refusal) {
  const std::lock_guard lock(mutex_);
  Kind kind{refusal.who.name, refusal.who.address, refusal.action, refusal.subject};
  if (kinds_.size() >= options_.kinds && !kinds_.contains(kind)) {
    refusal = {{}, "access.refused", "others", "of too many kinds to be counted each"};
    kind = {"", "", refusal.action, refusal.subject};
  }
  const auto [at, is_first] = kinds_.try_emplace(std::move(kind), Counted{refusal, 0});
  if (!is_first) {
    ++at->second.more;
    return;
  }
  ready_.push_back(std::move(refusal));
  changed_.notify_all();
}

void RefusalLog::flush() {
  std::unique_lock lock(mutex_);
  is_flushing_ = true;
  changed_.notify_all();
  written_.wait(lock, [this] { return !is_flushing_ && ready_.empty() && !is_writing_; });
}

/// An interval is over: what was counted in it becomes an entry, and the first of a kind is one
/// again.
void RefusalLog::take_counted() {
  for (auto& [kind, counted] : kinds_) {
    if (counted.more == 0) continue;
    counted.refusal.detail += fmt::format("; {} more like this since", counted.more);
    ready_.push_back(std::move(counted.refusal));
  }
  kinds_.clear();
}

void RefusalLog::write(const std::stop_token& stop) {
  auto interval_end = std::chrono::steady_clock::now() + options_.interval;
  std::unique_lock lock(mutex_);
  for (bool is_last = false; !is_last;) {
    changed_.wait_until(lock, stop, interval_end,
                        [this] { return !ready_.empty() || is_flushing_; });
    is_last = stop.stop_requested();
    if (is_last || is_flushing_ || std::chrono::steady_clock::now() >= interval_end) {
      take_counted();
      interval_end = std::chrono::steady_clock::now() + options_.interval;
    }
    is_flushing_ = false;
    is_writing_ = true;
    const auto refusals = std::exchange(ready_, {});
    lock.unlock();
    for (const auto& refusal : refusals) {
      process::log_warning("{} who={} address={} subject={}: {}", refusal.action, refusal.who.name,
                           refusal.who.address, refusal.subject, refusal.detail);
      audit_.write({.who = refusal.who,
                    .action = refusal.action,
                    .subject = refusal.subject,
                    .detail = refusal.detail});
    }
    lock.lock();
    is_writing_ = false;
    written_.notify_all();
  }
}

}  // namespace dripline::identity
