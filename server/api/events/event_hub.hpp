#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "server/api/events/tracked_text.hpp"

namespace dripline::api {

struct Event {
  std::string kind;          ///< machine, run, record; of a port: port, traffic
  std::string machine = {};  ///< the machine of the event
  std::string data;          ///< JSON in one line
  std::string port = {};     ///< the port of the event; empty: none
};

/// The events that a listener receives: those of machines, or those of one port.
struct Interest {
  /// How the state of a machine is sent: whole each time, as `machine`, or whole once and from then
  /// on what has changed, as `change` (TrackedText).
  enum class Form { Whole, Changes };

  std::optional<std::string> machine;  ///< absent: every machine
  std::string port;                    ///< not empty: the events of this port only
  Form form = Form::Whole;
};

/// The state of one machine, which all listeners share. Any thread.
class MachineState {
 public:
  /// `number`: of the publication; a later one holds.
  void publish(std::string text, std::uint64_t number);
  /// As it is known to another client; anything published after `number` holds.
  void fill(std::string text, std::uint64_t number);
  bool is_newer(std::uint64_t number) const;
  /// The event that brings a listener who knows version `known` (0: none) here, and `known` with
  /// it. Empty: it knows this one.
  std::string event_after(Interest::Form form, std::uint64_t& known);

 private:
  mutable std::mutex mutex_;
  TrackedText text_;
  std::uint64_t number_ = 0;  ///< of the last publication
};

/// One listener's bounded queue. A listener that is too slow for the events of machines is cut off,
/// so that it delays no other; of a machine's state only that there is a new one waits, so that
/// those of thousands fit. A line does not wait for its listeners: events for which a port's
/// listener has no room are counted and reported as `lost` {"lost": n}. Any thread.
class EventSubscription {
 public:
  static constexpr std::size_t kMaxEvents = 2048;
  static constexpr std::size_t kMaxBytes = 2 * 1024 * 1024;  ///< both without states of machines

  EventSubscription(Interest interest, std::uint64_t begin)
      : interest_(std::move(interest)), begin_(begin) {}
  void push(const Event& event);
  void push_state(const std::string& machine, std::shared_ptr<MachineState> state);
  void close();
  /// All events that wait, as text of the event stream format; empty when none waits. By one thread
  /// at a time.
  std::string take();
  bool is_closed() const;
  /// Called after a push into an empty queue and after close, on their thread.
  void on_ready(std::function<void()> wake);

  const std::string& port() const { return interest_.port; }
  /// Whether it receives the state of this machine.
  bool wants_machine(const std::string& machine) const;
  /// What was published after this number came after it.
  std::uint64_t begin() const { return begin_; }

 private:
  /// A state of a machine, or any other event.
  struct Waiting {
    Event event;
    std::shared_ptr<MachineState> state = {};
  };
  bool wants(const Event& event) const;
  bool is_full(const Event& event) const;
  void close_locked();

  const Interest interest_;
  const std::uint64_t begin_;
  mutable std::mutex mutex_;
  std::deque<Waiting> waiting_;
  std::unordered_set<const MachineState*> machines_;  ///< whose states wait
  std::size_t bytes_ = 0;                             ///< of the others
  std::uint64_t lost_ = 0;                            ///< dropped after the events that wait
  bool is_closed_ = false;
  std::function<void()> wake_;
  std::unordered_map<const MachineState*, std::uint64_t> known_;  ///< versions; of take()
};

/// Passes events to all listeners. Any thread.
class EventHub {
 public:
  static constexpr std::size_t kMaxSubscriptions = 256;
  /// nullptr when there are too many. It ends when the last pointer to it is dropped.
  std::shared_ptr<EventSubscription> subscribe(std::optional<std::string> machine,
                                               Interest::Form form = Interest::Form::Whole);
  std::shared_ptr<EventSubscription> subscribe_port(const std::string& port);
  /// An event `machine` is the machine's state from now on.
  void publish(Event event);
  /// The state of a machine, to a listener that has just begun. `text`: as it is known to someone
  /// else; it is not needed when one was published since the listener began, which is newer.
  void show(EventSubscription& listener, const std::string& machine,
            const std::function<std::string()>& text);
  bool has_listeners() const;
  /// Whether any receives the state of this machine.
  bool has_listeners(const std::string& machine) const;
  bool has_port_listeners(const std::string& port) const;
  void close();

 private:
  std::shared_ptr<EventSubscription> add(Interest interest);
  std::vector<std::shared_ptr<EventSubscription>> listeners() const;
  std::shared_ptr<MachineState> state_of(const std::string& machine);
  template <class Holds>
  bool has_any(const Holds& holds) const;

  mutable std::mutex mutex_;
  std::vector<std::weak_ptr<EventSubscription>> subscriptions_;
  std::unordered_map<std::string, std::shared_ptr<MachineState>> machines_;
  std::uint64_t published_ = 0;  ///< states of machines
};

}  // namespace dripline::api
