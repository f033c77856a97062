#include "server/library/health.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <sys/statvfs.h>

#include "protocol/process/log.hpp"

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
  const auto silence = looked_ ? clock_.steady_now() - *looked_ : SteadyTime::duration{};
  if (silence > kPatience) {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(silence).count();
    state.findings.push_back({.level = silence > kSilence ? Level::Failed : Level::Degraded,
                              .subject = "store",
                              .what = fmt::format("the store has not answered for {} s", seconds),
                              .detail = {}});
  }
  for (const auto& finding : state.findings) state.level = std::max(state.level, finding.level);
  return state;
}

namespace {

constexpr std::uint64_t kMega = 1024 * 1024;

}  // namespace

Health::Finding judge_disk(std::uint64_t size, std::uint64_t free) {
  constexpr std::uint64_t kFailed = 8 * kMega;
  constexpr std::uint64_t kLow = 64 * kMega;
  constexpr std::uint64_t kPlenty = 2048 * kMega;
  constexpr std::uint64_t kLowPart = 20;  // one in twenty
  Health::Finding finding{.level = Health::Level::Ok, .subject = "disk", .what = {}, .detail = {}};
  finding.detail = fmt::format("{} MiB of {} MiB left", free / kMega, size / kMega);
  if (free < kFailed) {
    finding.level = Health::Level::Failed;
    finding.what = "the disk is full";
  } else if (free < kLow || (free < kPlenty && free < size / kLowPart)) {
    finding.level = Health::Level::Degraded;
    finding.what = "the disk is nearly full";
  }
  return finding;
}

Health::Finding judge_clock(UtcTime before, UtcTime store, UtcTime after, bool did_differ) {
  Health::Finding finding{.level = Health::Level::Ok, .subject = "clock", .what = {}, .detail = {}};
  const auto ahead = before - store, late = store - after;
  const auto difference = std::max(ahead, late);
  if (difference < kClockTolerance - std::chrono::seconds(did_differ ? 1 : 0)) return finding;
  finding.level = Health::Level::Degraded;
  finding.what = "the clocks of this server and of its database differ";
  finding.detail = fmt::format("this server's is {} s {}",
                               std::chrono::duration_cast<std::chrono::seconds>(difference).count(),
                               ahead > late ? "ahead" : "late");
  return finding;
}

HealthWatch::HealthWatch(Parts parts) : parts_(std::move(parts)) {
  look();
  thread_ = std::thread([this] { run(); });
}

HealthWatch::~HealthWatch() {
  {
    const std::lock_guard lock(mutex_);
    is_stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void HealthWatch::run() {
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, Health::kInterval, [this] { return is_stopping_; })) {
    lock.unlock();
    look();
    lock.lock();
  }
}

void HealthWatch::look() {
  look_at_disk();
  const auto done = parts_.probe();
  Health::Finding finding{.level = Health::Level::Ok, .subject = "store", .what = {}, .detail = {}};
  if (!done) {
    // A store that is only busy for long does not lose anything.
    const bool is_busy = done.error().code == Errc::Busy;
    finding.level = is_busy ? Health::Level::Degraded : Health::Level::Failed;
    finding.what = is_busy ? "the store is slow" : "the store cannot be written or read";
    finding.detail = done.error().what;
    process::log_error("{}: {}", finding.what, finding.detail);
  }
  parts_.health.report("", std::move(finding));
  if (done) look_at_clock();
  parts_.health.looked();
}

void HealthWatch::look_at_disk() {
  struct statvfs disk {};
  if (::statvfs(parts_.folder.c_str(), &disk) != 0) return;  // the probe reports more
  parts_.health.report("",
                       judge_disk(disk.f_blocks * disk.f_frsize, disk.f_bavail * disk.f_frsize));
}

void HealthWatch::look_at_clock() {
  if (!parts_.store_time) return;
  const UtcTime before = parts_.clock.now();
  const auto store = parts_.store_time();
  if (!store || !*store) return;  // the probe reports more
  auto finding = judge_clock(before, **store, parts_.clock.now(), does_clock_differ_);
  const bool differs = finding.level != Health::Level::Ok;
  if (differs && !does_clock_differ_) process::log_warning("{}: {}", finding.what, finding.detail);
  if (!differs && does_clock_differ_)
    process::log_info("the clocks of this server and of its database agree again");
  does_clock_differ_ = differs;
  parts_.health.report("", std::move(finding));
}

}  // namespace dripline::library
