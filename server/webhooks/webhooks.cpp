#include "server/webhooks/webhooks.hpp"

#include <fmt/ranges.h>
#include <algorithm>

#include "protocol/base/names.hpp"
#include "protocol/base/random.hpp"
#include "protocol/process/log.hpp"

namespace dripline::webhooks {
namespace {

constexpr std::uint64_t kBatch = 100;
constexpr std::size_t kSecretBytes = 32;
constexpr std::size_t kMaxFault = 512;

bool wants(const storage::Webhook& webhook, const storage::Event& event) {
  return webhook.kinds.empty() ||
         std::ranges::find(webhook.kinds, event.kind) != webhook.kinds.end();
}

}  // namespace

const std::vector<std::string>& Webhooks::kinds() {
  static const std::vector<std::string> kKinds{"revision", "run", "alarm", "import", "job", "part"};
  return kKinds;
}

Webhooks::Webhooks(Parts parts, const Options& options)
    : parts_(std::move(parts)), options_(options) {}

Webhooks::~Webhooks() {
  stop();
}

void Webhooks::stop() {
  std::map<std::uint64_t, std::jthread> ended;
  {
    const std::lock_guard lock(mutex_);
    is_stopping_ = true;
    ended.swap(workers_);
  }
  tests_.request_stop();
  for (auto& [id, worker] : ended) worker.request_stop();
}

void Webhooks::begin() {
  const auto webhooks = parts_.store.list();
  if (!webhooks) {
    process::log_error("webhooks are not delivered: {}", webhooks.error().what);
    return;
  }
  for (const auto& webhook : *webhooks) start_worker(webhook);
}

void Webhooks::start_worker(const storage::Webhook& webhook) {
  const std::lock_guard lock(mutex_);
  if (is_stopping_) return;
  workers_[webhook.id] =
      std::jthread([this, id = webhook.id](const std::stop_token& stop) { work(stop, id); });
}

Result<storage::Webhook> Webhooks::add(const Addition& addition, const storage::Actor& who) {
  if (auto good = check_machine_name(addition.name); !good)
    return fail(good.error().code, "webhook: {}", good.error().what);
  if (auto good = check_url(addition.url); !good) return fail(good.error());
  for (const auto& kind : addition.kinds) {
    if (std::ranges::find(kinds(), kind) != kinds().end()) continue;
    return fail(Errc::Syntax, "'{}' is no kind of event: {}", kind, fmt::join(kinds(), ", "));
  }
  storage::Webhook webhook;
  webhook.name = addition.name;
  webhook.url = addition.url;
  webhook.secret = random_hex(kSecretBytes);
  webhook.kinds = addition.kinds;
  webhook.author = who.name;
  webhook.created = parts_.clock.now();
  auto added = parts_.store.add(webhook, who);
  if (added) start_worker(*added);
  return added;
}

Result<void> Webhooks::remove(const std::string& name, const storage::Actor& who) {
  const auto webhook = parts_.store.find(name);
  if (!webhook) return fail(webhook.error());
  if (auto removed = parts_.store.remove(name, who, parts_.clock.now()); !removed) return removed;
  std::jthread ended;  // joined outside of the lock, when a delivery that is in progress is over
  {
    const std::lock_guard lock(mutex_);
    const auto found = workers_.find(webhook->id);
    if (found != workers_.end()) {
      ended = std::move(found->second);
      workers_.erase(found);
    }
  }
  if (parts_.on_fault) parts_.on_fault(name, "");
  return {};
}

Result<void> Webhooks::test(const std::string& name) {
  const auto webhook = parts_.store.find(name);
  if (!webhook) return fail(webhook.error());
  const storage::Event event{.id = 0,
                             .time = parts_.clock.now(),
                             .kind = "test",
                             .data = fmt::format(R"({{"webhook":"{}"}})", name)};
  auto delivery = make_delivery(*webhook, event, parts_.server, parts_.clock.now());
  return parts_.sender.send(delivery, tests_.get_token());
}

void Webhooks::sleep(const std::stop_token& stop, std::chrono::milliseconds pause) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, stop, pause, [] { return false; });
}

std::chrono::milliseconds Webhooks::pause_after(std::uint64_t failures) const {
  constexpr std::uint64_t kMaxDoublings = 20;
  const auto doubled = options_.first_retry * (1LL << std::min(failures, kMaxDoublings));
  return std::min(std::chrono::milliseconds(doubled), options_.longest_retry);
}

void Webhooks::work(const std::stop_token& stop, std::uint64_t id) {
  std::uint64_t failures = 0;
  while (!stop.stop_requested()) {
    const Round round = deliver(stop, id);
    if (round.is_over) return;
    if (round.has_failed) {
      sleep(stop, pause_after(failures++));
    } else {
      failures = 0;
      if (!round.is_more) sleep(stop, options_.look);
    }
  }
}

Webhooks::Round Webhooks::deliver(const std::stop_token& stop, std::uint64_t id) {
  (void)parts_.store.trim();
  const auto webhook = parts_.store.receiver(id);
  if (!webhook) {
    const bool is_removed = webhook.error().code == Errc::NotFound;
    return {.is_over = is_removed, .has_failed = !is_removed};
  }
  const auto events = parts_.store.events(webhook->delivered, kBatch);
  if (!events) return {.has_failed = true};
  if (events->empty()) {
    report(*webhook, "");
    return {};
  }
  const auto delivered = deliver_batch(stop, *webhook, *events);
  if (delivered || stop.stop_requested()) {
    report(*webhook, "");
    return {.is_more = true};
  }
  const std::string fault = delivered.error().what.substr(0, kMaxFault);
  if (webhook->failures == 0)
    process::log_warning("webhook {} is not delivered: {}", webhook->name, fault);
  (void)parts_.store.set_failing(id, fault, parts_.clock.now());
  report(*webhook, fault);
  return {.has_failed = true};
}

/// The cursor is stored after each event: what a kill repeats is one.
Result<void> Webhooks::deliver_batch(const std::stop_token& stop, const storage::Webhook& webhook,
                                     const std::vector<storage::Event>& events) {
  std::uint64_t passed = webhook.delivered;
  for (const auto& event : events) {
    if (stop.stop_requested()) break;
    if (!wants(webhook, event)) {
      passed = event.id;
      continue;
    }
    const auto now = parts_.clock.now();
    auto sent = parts_.sender.send(make_delivery(webhook, event, parts_.server, now), stop);
    if (!sent) return sent;
    auto stored = parts_.store.set_delivered(webhook.id, event.id, parts_.clock.now());
    if (!stored) return stored;
    passed = 0;
  }
  if (passed == 0 || passed == webhook.delivered) return {};
  return parts_.store.set_delivered(webhook.id, passed, parts_.clock.now());
}

void Webhooks::report(const storage::Webhook& webhook, const std::string& fault) {
  if (!parts_.on_fault) return;
  const bool is_long = !fault.empty() && webhook.failing_since &&
                       parts_.clock.now() - *webhook.failing_since >= options_.long_failing;
  if (fault.empty() || is_long) parts_.on_fault(webhook.name, fault);
}

}  // namespace dripline::webhooks
