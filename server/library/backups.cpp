#include "server/library/backups.hpp"

#include <algorithm>

#include "protocol/process/log.hpp"

namespace dripline::library {
namespace {

constexpr std::chrono::hours kRetry{1};

double megabytes(std::uint64_t bytes) {
  constexpr double kMega = 1e6;
  return static_cast<double>(bytes) / kMega;
}

}  // namespace

std::string_view to_string(Backups::Kind kind) {
  return kind == Backups::Kind::Make ? "make" : "verify";
}

Backups::Backups(Parts parts, const Options& options)
    : options_(options), parts_(std::move(parts)), started_(parts_.clock.now()) {
  refresh();
  report();
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

Backups::~Backups() = default;

Backups::State Backups::state() const {
  const std::lock_guard lock(mutex_);
  auto work = work_;
  if (!work && asked_) work = Work{.kind = asked_->kind, .id = asked_->id};
  return {.folder = parts_.folder.path().string(),
          .every = options_.every,
          .list = list_,
          .work = work,
          .last = last_,
          .is_overdue = is_overdue()};
}

bool Backups::knows(const std::string& id) const {
  return std::ranges::any_of(list_.backups, [&](const auto& known) { return known.id == id; });
}

Result<void> Backups::begin(const storage::Actor& who, Order order) {
  const std::lock_guard lock(mutex_);
  if (!order.id.empty() && !knows(order.id))
    return fail(Errc::NotFound, "there is no backup '{}'", order.id);
  if (work_ || asked_) return fail(Errc::Busy, "another backup is being made or verified");
  parts_.audit.write({.who = who,
                      .action = order.kind == Kind::Make ? "backup.make" : "backup.verify",
                      .subject = order.id,
                      .detail = {}});
  asked_ = std::move(order);
  changed_.notify_all();
  return {};
}

Result<void> Backups::begin_make(const storage::Actor& who) {
  return begin(who, {.kind = Kind::Make, .id = {}});
}

Result<void> Backups::begin_verify(const storage::Actor& who, const std::string& id) {
  return begin(who, {.kind = Kind::Verify, .id = id});
}

Result<void> Backups::remove(const storage::Actor& who, const std::string& id) {
  const std::lock_guard lock(mutex_);
  if (!knows(id)) return fail(Errc::NotFound, "there is no backup '{}'", id);
  if (work_ || asked_) return fail(Errc::Busy, "another backup is being made or verified");
  if (list_.backups.size() == 1) return fail(Errc::Conflict, "backup {} is the only one", id);
  if (auto removed = parts_.folder.remove(id); !removed) return removed;
  std::erase_if(list_.backups, [&](const auto& known) { return known.id == id; });
  parts_.audit.write({.who = who, .action = "backup.remove", .subject = id, .detail = {}});
  return {};
}

void Backups::run(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    auto order = asked_ ? std::exchange(asked_, std::nullopt) : due();
    if (order) {
      work_ = Work{.kind = order->kind, .id = order->id};
      lock.unlock();
      carry_out(*order, stop);
      lock.lock();
      work_.reset();
    }
    report();
    changed_.wait_for(lock, stop, options_.look_every, [this] { return asked_.has_value(); });
  }
}

/// With the mutex taken.
std::optional<Backups::Order> Backups::due() const {
  const UtcTime now = parts_.clock.now();
  if (options_.every.count() == 0 || (failed_ && *failed_ <= now && now < *failed_ + kRetry))
    return std::nullopt;
  const auto* const last = backup::newest(list_.backups, now);
  if (last == nullptr || now >= last->made + options_.every) return Order{};
  const bool was_read_lately = std::ranges::any_of(list_.backups, [&](const auto& backup) {
    return backup.verified && *backup.verified <= now &&
           now < *backup.verified + options_.verify_every;
  });
  if (last->verified || was_read_lately) return std::nullopt;
  return Order{.kind = Kind::Verify, .id = last->id};
}

void Backups::carry_out(const Order& order, const std::stop_token& stop) {
  const backup::Watch watch = [&](backup::Phase phase, std::uint64_t done, std::uint64_t total) {
    const std::lock_guard lock(mutex_);
    work_->phase = phase;
    work_->done = done;
    work_->total = total;
    return !stop.stop_requested();
  };
  Outcome outcome{.kind = order.kind, .id = order.id, .at = {}, .error = {}};
  if (order.kind == Kind::Make) {
    make(watch, outcome);
  } else if (auto good = parts_.folder.verify(order.id, parts_.clock.now(), watch); !good) {
    outcome.error = good.error().what;
  }
  outcome.at = parts_.clock.now();
  if (stop.stop_requested()) return;
  if (!outcome.error.empty())
    process::log_error("backup, {}: {}", to_string(order.kind), outcome.error);
  refresh();
  const std::lock_guard lock(mutex_);
  failed_ = outcome.error.empty() ? std::nullopt : std::optional(outcome.at);
  last_ = outcome;
}

void Backups::make(const backup::Watch& watch, Outcome& outcome) {
  const auto made = parts_.folder.make(parts_.source, parts_.clock.now(), watch);
  if (!made) {
    outcome.error = made.error().what;
    return;
  }
  outcome.id = made->id;
  process::log_info("backup {}: {:.1f} MB, of which {:.1f} MB were new on the backup's disk",
                    made->id, megabytes(made->size), megabytes(made->added));
  const auto pruned = parts_.folder.prune(options_.retention, parts_.clock.now());
  if (!pruned) {
    outcome.error = pruned.error().what;
  } else if (pruned->backups > 0) {
    process::log_info("{} old backups removed, {:.1f} MB freed", pruned->backups,
                      megabytes(pruned->bytes));
  }
}

/// The folder as it is now.
void Backups::refresh() {
  auto list = parts_.folder.list();
  const std::lock_guard lock(mutex_);
  if (list) {
    list_ = *std::move(list);
  } else {
    list_.damaged = {list.error().what};
  }
}

/// With the mutex taken. One missed interval is a server that was switched off over night; two are
/// a backup that is missing unnoticed.
bool Backups::is_overdue() const {
  if (options_.every.count() == 0) return false;
  const UtcTime now = parts_.clock.now();
  const auto* const last = backup::newest(list_.backups, now);
  return now > (last == nullptr ? started_ : last->made) + 2 * options_.every;
}

/// With the mutex taken.
void Backups::report() {
  Health::Finding finding{
      .level = Health::Level::Ok, .subject = "backup", .what = {}, .detail = {}};
  if (!list_.damaged.empty()) {
    finding.what = "a backup is damaged";
    finding.detail = list_.damaged.front();
  } else if (last_ && !last_->error.empty()) {
    finding.what = "the last backup was not made or is damaged";
    finding.detail = last_->error;
  } else if (is_overdue()) {
    finding.what = "the newest backup is older than it should be";
    const auto* const last = backup::newest(list_.backups, parts_.clock.now());
    finding.detail = last == nullptr ? "there is none" : last->id;
  } else if (!list_.backups.empty() && list_.backups.back().made > parts_.clock.now()) {
    finding.what = "a backup is of a time that has not come: look at the clock, then remove it";
    finding.detail = list_.backups.back().id;
  }
  if (!finding.what.empty()) finding.level = Health::Level::Degraded;
  parts_.health.report("", std::move(finding));
}

}  // namespace dripline::library
