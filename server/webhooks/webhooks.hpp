#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "server/webhooks/delivery.hpp"
#include "storage/store.hpp"

namespace dripline::webhooks {

/// Delivers events to webhooks: each in order, at least once, from a stored cursor, so that a
/// restart or a kill loses none. A webhook that fails is tried again, ever more rarely, and delays
/// no other. Any thread; all of Parts must outlive it.
class Webhooks {
 public:
  struct Options {
    std::chrono::milliseconds look{1000};  ///< for new events
    std::chrono::milliseconds first_retry{1000};
    std::chrono::milliseconds longest_retry{std::chrono::minutes(5)};
    std::chrono::milliseconds long_failing{std::chrono::minutes(15)};  ///< then it is a finding
  };
  struct Parts {
    storage::WebhookStore& store;
    Sender& sender;
    const Clock& clock;
    std::string server;  ///< identity of the database
    /// Why a webhook has failed for long; empty: it does not. On any thread.
    std::function<void(const std::string& webhook, const std::string& fault)> on_fault = {};
  };
  Webhooks(Parts parts, const Options& options);
  ~Webhooks();
  Webhooks(const Webhooks&) = delete;
  Webhooks& operator=(const Webhooks&) = delete;

  /// Begins to deliver.
  void begin();
  /// Before it is destroyed: no more deliveries begin, and those in progress, tests with them, are
  /// cut off.
  void stop();

  Result<std::vector<storage::Webhook>> list() { return parts_.store.list(); }
  struct Addition {
    std::string name, url;
    std::vector<std::string> kinds = {};  ///< empty: all
  };
  /// With its new secret. Errors: Syntax (name, URL, kinds), and those of WebhookStore::add.
  Result<storage::Webhook> add(const Addition& addition, const storage::Actor& who);
  Result<void> remove(const std::string& name, const storage::Actor& who);
  /// Delivers an event of the kind `test`, once, beside the others. Waits. Errors: NotFound, those
  /// of Sender::send.
  Result<void> test(const std::string& name);

  static const std::vector<std::string>& kinds();  ///< of events

 private:
  void start_worker(const storage::Webhook& webhook);
  void work(const std::stop_token& stop, std::uint64_t id);
  struct Round {
    bool is_over = false;  ///< the webhook was removed
    bool has_failed = false;
    bool is_more = false;  ///< events wait that were not looked at
  };
  Round deliver(const std::stop_token& stop, std::uint64_t id);
  Result<void> deliver_batch(const std::stop_token& stop, const storage::Webhook& webhook,
                             const std::vector<storage::Event>& events);
  void report(const storage::Webhook& webhook, const std::string& fault);
  std::chrono::milliseconds pause_after(std::uint64_t failures) const;
  void sleep(const std::stop_token& stop, std::chrono::milliseconds pause);

  const Parts parts_;
  const Options options_;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  bool is_stopping_ = false;
  std::stop_source tests_;  ///< ends those in progress
  /// One for each webhook, so that one that hangs delays no other. Last: they use the others.
  std::map<std::uint64_t, std::jthread> workers_;
};

}  // namespace dripline::webhooks
