#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace dripline::api {

struct Event {
  std::string kind;          ///< machine, run, record; of a port: port, traffic
  std::string machine = {};  ///< the machine of the event
  std::string data;          ///< JSON in one line
  std::string port = {};     ///< the port of the event; empty: none
};

/// The events that a listener receives: those of machines, or those of one port.
struct Interest {
  std::optional<std::string> machine;  ///< absent: every machine
  std::string port;                    ///< not empty: the events of this port only
};

/// One listener's bounded queue. A listener that is too slow for the events of machines is cut off,
/// so that it delays no other; of the `machine` events only the latest of each machine waits, so
/// that those of thousands fit. A
/// line does not wait for its listeners: events for which a port's listener has no room are counted
/// and reported as `lost` {"lost": n}. Any thread.
class EventSubscription {
 public:
  static constexpr std::size_t kMaxEvents = 2048;
  static constexpr std::size_t kMaxBytes = 2 * 1024 * 1024;  ///< both without `machine` events

  explicit EventSubscription(Interest interest) : interest_(std::move(interest)) {}
  void push(const Event& event);
  void close();
  /// All events that wait, as text of the event stream format; empty when none waits.
  std::string take();
  bool is_closed() const;
  /// Called after a push into an empty queue and after close, on their thread.
  void on_ready(std::function<void()> wake);

  const std::string& port() const { return interest_.port; }

 private:
  bool wants(const Event& event) const;
  void push_machine(const Event& event);
  bool is_full(const Event& event) const;
  void close_locked();

  const Interest interest_;
  mutable std::mutex mutex_;
  std::deque<Event> waiting_;
  std::unordered_map<std::string, std::size_t> machines_;  ///< place of each `machine` event
  std::size_t bytes_ = 0;                                  ///< of the others
  std::uint64_t lost_ = 0;                                 ///< dropped after the events that wait
  bool is_closed_ = false;
  std::function<void()> wake_;
};

/// Passes events to all listeners. Any thread.
class EventHub {
 public:
  static constexpr std::size_t kMaxSubscriptions = 256;
  /// nullptr when there are too many. It ends when the last pointer to it is dropped.
  std::shared_ptr<EventSubscription> subscribe(std::optional<std::string> machine);
  std::shared_ptr<EventSubscription> subscribe_port(const std::string& port);
  void publish(const Event& event);
  bool has_listeners() const;
  bool has_port_listeners(const std::string& port) const;
  void close();

 private:
  std::shared_ptr<EventSubscription> add(Interest interest);
  std::vector<std::shared_ptr<EventSubscription>> listeners() const;

  mutable std::mutex mutex_;
  std::vector<std::weak_ptr<EventSubscription>> subscriptions_;
};

}  // namespace dripline::api
