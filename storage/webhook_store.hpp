#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/base/clock.hpp"
#include "protocol/base/result.hpp"
#include "storage/actor.hpp"

namespace dripline::storage {

/// Something that changed, as it was stored in the transaction of the change.
struct Event {
  std::uint64_t id = 0;  ///< grows in the order of the changes
  UtcTime time;
  std::string kind;  ///< revision, run, alarm, import, job, part
  std::string data;  ///< a JSON object
};

/// A receiver of events, and how far it has got.
struct Webhook {
  std::uint64_t id = 0;  ///< the store gives it
  std::string name, url, secret;
  std::vector<std::string> kinds;  ///< of events; empty: all
  std::string author;
  UtcTime created;
  std::uint64_t delivered = 0;  ///< the last event that was delivered or passed over
  std::optional<UtcTime> delivered_at = {};
  std::uint64_t failures = 0;  ///< since the last success
  std::optional<UtcTime> failing_since = {};
  std::string fault;          ///< of the last failure
  std::uint64_t lost = 0;     ///< events that were dropped while it failed
  std::uint64_t waiting = 0;  ///< events that it has not got; the store counts them
};

/// Webhooks and the events for them. Events are kept while a webhook has not got them, at most
/// kMaxEvents; there are none without a webhook. Promises of every store: storage/store.hpp.
class WebhookStore {
 public:
  virtual ~WebhookStore() = default;

  /// In order of their names.
  virtual Result<std::vector<Webhook>> list() = 0;
  /// Errors: NotFound.
  virtual Result<Webhook> find(const std::string& name) = 0;
  /// What is to be delivered to, each time: without the count of what waits. Errors: NotFound.
  virtual Result<Webhook> receiver(std::uint64_t id) = 0;
  /// It gets what happens from now on. The audit entry (webhook.add) is part of the transaction.
  /// Errors: Conflict (the name is taken), LimitExceeded (more than kMaxWebhooks).
  virtual Result<Webhook> add(const Webhook& webhook, const Actor& who) = 0;
  /// Errors: NotFound.
  virtual Result<void> remove(const std::string& name, const Actor& who, UtcTime time) = 0;

  /// The events after `after`, oldest first.
  virtual Result<std::vector<Event>> events(std::uint64_t after, std::uint64_t limit) = 0;
  /// It has got everything up to this event. Events that every webhook has are dropped. Nothing
  /// when it was removed meanwhile.
  virtual Result<void> set_delivered(std::uint64_t id, std::uint64_t event, UtcTime time) = 0;
  virtual Result<void> set_failing(std::uint64_t id, const std::string& fault, UtcTime time) = 0;
  /// Drops the oldest events beyond kMaxEvents; those who have not got them have lost them.
  virtual Result<void> trim() = 0;

  static constexpr std::uint64_t kMaxWebhooks = 16;
  static constexpr std::uint64_t kMaxEvents = 100'000;
};

}  // namespace dripline::storage
