#include "server/api/event_hub.hpp"

#include <algorithm>
#include <utility>

namespace dripline::api {

bool EventSubscription::wants(const Event& event) const {
  if (!interest_.port.empty() || !event.port.empty()) return interest_.port == event.port;
  return !interest_.machine || *interest_.machine == event.machine;
}

void EventSubscription::push_machine(const Event& event) {
  const auto [place, is_new] = machines_.try_emplace(event.machine, waiting_.size());
  if (is_new) {
    waiting_.push_back(event);
  } else {
    waiting_[place->second].data = event.data;
  }
}

bool EventSubscription::is_full(const Event& event) const {
  return waiting_.size() - machines_.size() >= kMaxEvents || bytes_ + event.data.size() > kMaxBytes;
}

void EventSubscription::push(const Event& event) {
  if (!wants(event)) return;
  std::function<void()> wake;
  {
    const std::lock_guard lock(mutex_);
    if (is_closed_) return;
    const bool is_counted = !event.port.empty();
    if (is_counted && (lost_ > 0 || is_full(event))) {  // adjacent gaps are one gap
      ++lost_;
      return;
    }
    if (waiting_.empty()) wake = wake_;
    if (event.kind == "machine") {
      push_machine(event);
    } else if (is_full(event)) {
      close_locked();
      wake = wake_;
    } else {
      bytes_ += event.data.size();
      waiting_.push_back(event);
    }
  }
  if (wake) wake();
}

void EventSubscription::close_locked() {
  is_closed_ = true;
  waiting_.clear();
  machines_.clear();
  bytes_ = 0;
  lost_ = 0;
}

void EventSubscription::close() {
  std::function<void()> wake;
  {
    const std::lock_guard lock(mutex_);
    close_locked();
    wake = wake_;
  }
  if (wake) wake();
}

std::string EventSubscription::take() {
  std::deque<Event> events;
  std::uint64_t lost = 0;
  {
    const std::lock_guard lock(mutex_);
    events.swap(waiting_);
    machines_.clear();
    bytes_ = 0;
    lost = std::exchange(lost_, 0);
  }
  std::string text;
  for (const auto& event : events) {
    text.append("event: ").append(event.kind).append("\ndata: ").append(event.data).append("\n\n");
  }
  if (lost > 0) text += "event: lost\ndata: {\"lost\":" + std::to_string(lost) + "}\n\n";
  return text;
}

bool EventSubscription::is_closed() const {
  const std::lock_guard lock(mutex_);
  return is_closed_;
}

void EventSubscription::on_ready(std::function<void()> wake) {
  const std::lock_guard lock(mutex_);
  wake_ = std::move(wake);
}

std::shared_ptr<EventSubscription> EventHub::subscribe(std::optional<std::string> machine) {
  return add({.machine = std::move(machine), .port = {}});
}

std::shared_ptr<EventSubscription> EventHub::subscribe_port(const std::string& port) {
  return add({.machine = {}, .port = port});
}

std::shared_ptr<EventSubscription> EventHub::add(Interest interest) {
  const std::lock_guard lock(mutex_);
  std::erase_if(subscriptions_, [](const auto& subscription) { return subscription.expired(); });
  if (subscriptions_.size() >= kMaxSubscriptions) return nullptr;
  auto subscription = std::make_shared<EventSubscription>(std::move(interest));
  subscriptions_.push_back(subscription);
  return subscription;
}

std::vector<std::shared_ptr<EventSubscription>> EventHub::listeners() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<EventSubscription>> listeners;
  for (const auto& weak : subscriptions_) {
    if (auto subscription = weak.lock()) listeners.push_back(std::move(subscription));
  }
  return listeners;
}

void EventHub::publish(const Event& event) {
  for (const auto& listener : listeners()) listener->push(event);
}

bool EventHub::has_listeners() const {
  return !listeners().empty();
}

bool EventHub::has_port_listeners(const std::string& port) const {
  return std::ranges::any_of(listeners(),
                             [&](const auto& listener) { return listener->port() == port; });
}

void EventHub::close() {
  for (const auto& listener : listeners()) listener->close();
}

}  // namespace dripline::api
