#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace dripline::api {

struct Event {
  std::string kind;     ///< machine, run, record
  std::string machine;  ///< whom it concerns
  std::string data;     ///< JSON in one line
};

/// One listener's queue, bounded: who is too slow is cut off instead of holding up anybody. Of the
/// `machine` events only the latest of each machine waits. Any thread.
class EventSubscription {
 public:
  static constexpr std::size_t kMaxEvents = 2048;
  static constexpr std::size_t kMaxBytes = 2 * 1024 * 1024;

  explicit EventSubscription(std::optional<std::string> machine) : machine_(std::move(machine)) {}
  void push(const Event& event);
  void close();
  /// Everything that waits, as text of the event stream format; empty when nothing does.
  std::string take();
  bool is_closed() const;
  /// Called after a push into an empty queue and after close, on their thread.
  void on_ready(std::function<void()> wake);

 private:
  void close_locked();

  const std::optional<std::string> machine_;
  mutable std::mutex mutex_;
  std::deque<Event> waiting_;
  std::size_t bytes_ = 0;
  bool is_closed_ = false;
  std::function<void()> wake_;
};

/// Passes events to everybody who listens. Any thread.
class EventHub {
 public:
  static constexpr std::size_t kMaxSubscriptions = 256;
  /// nullptr when there are too many. Ends when the last pointer to it is dropped.
  std::shared_ptr<EventSubscription> subscribe(std::optional<std::string> machine);
  void publish(const Event& event);
  bool has_listeners() const;
  void close();

 private:
  std::vector<std::shared_ptr<EventSubscription>> listeners() const;

  mutable std::mutex mutex_;
  std::vector<std::weak_ptr<EventSubscription>> subscriptions_;
};

}  // namespace dripline::api
