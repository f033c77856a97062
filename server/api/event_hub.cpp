#include "server/api/event_hub.hpp"

#include <algorithm>

namespace dripline::api {

void EventSubscription::push(const Event& event) {
  if (machine_ && *machine_ != event.machine) return;
  std::function<void()> wake;
  {
    const std::lock_guard lock(mutex_);
    if (is_closed_) return;
    if (event.kind == "machine") {
      const auto older = std::ranges::find_if(waiting_, [&](const Event& other) {
        return other.kind == event.kind && other.machine == event.machine;
      });
      if (older != waiting_.end()) {
        bytes_ += event.data.size() - older->data.size();
        older->data = event.data;
        return;
      }
    }
    if (waiting_.empty()) wake = wake_;
    bytes_ += event.data.size();
    waiting_.push_back(event);
    if (waiting_.size() > kMaxEvents || bytes_ > kMaxBytes) {
      close_locked();
      wake = wake_;
    }
  }
  if (wake) wake();
}

void EventSubscription::close_locked() {
  is_closed_ = true;
  waiting_.clear();
  bytes_ = 0;
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
  {
    const std::lock_guard lock(mutex_);
    events.swap(waiting_);
    bytes_ = 0;
  }
  std::string text;
  for (const auto& event : events) {
    text += "event: " + event.kind + "\ndata: " + event.data + "\n\n";
  }
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
  const std::lock_guard lock(mutex_);
  std::erase_if(subscriptions_, [](const auto& subscription) { return subscription.expired(); });
  if (subscriptions_.size() >= kMaxSubscriptions) return nullptr;
  auto subscription = std::make_shared<EventSubscription>(std::move(machine));
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

void EventHub::close() {
  for (const auto& listener : listeners()) listener->close();
}

}  // namespace dripline::api
