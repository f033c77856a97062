#include "server/api/events/event_hub.hpp"

#include <algorithm>
#include <utility>

namespace dripline::api {

namespace {

void append_event(std::string& text, std::string_view kind, std::string_view data) {
  text.append("event: ").append(kind).append("\ndata: ").append(data).append("\n\n");
}

}  // namespace

void MachineState::publish(std::string text, std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  if (number <= number_) return;
  number_ = number;
  text_.update(std::move(text));
}

void MachineState::fill(std::string text, std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  if (number_ <= number) text_.update(std::move(text));
}

bool MachineState::is_newer(std::uint64_t number) const {
  const std::lock_guard lock(mutex_);
  return number_ > number;
}

std::string MachineState::event_after(Interest::Form form, std::uint64_t& known) {
  std::string event;
  const std::lock_guard lock(mutex_);
  if (form == Interest::Form::Whole) {
    append_event(event, "machine", text_.text());
    return event;
  }
  if (known == text_.version()) return {};
  if (known == 0 || known < text_.same_members_since()) {
    append_event(event, "machine", text_.whole());
  } else {
    append_event(event, "change", text_.change_after(known));
  }
  known = text_.version();
  return event;
}

bool EventSubscription::wants_machine(const std::string& machine) const {
  return interest_.port.empty() && (!interest_.machine || *interest_.machine == machine);
}

bool EventSubscription::wants(const Event& event) const {
  if (!interest_.port.empty() || !event.port.empty()) return interest_.port == event.port;
  return wants_machine(event.machine);
}

void EventSubscription::push_state(const std::string& machine,
                                   std::shared_ptr<MachineState> state) {
  if (!wants_machine(machine)) return;
  std::function<void()> wake;
  {
    const std::lock_guard lock(mutex_);
    if (is_closed_ || !machines_.insert(state.get()).second) return;
    if (waiting_.empty()) wake = wake_;
    waiting_.push_back({.event = {}, .state = std::move(state)});
  }
  if (wake) wake();
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
    if (is_full(event)) {
      close_locked();
      wake = wake_;
    } else {
      bytes_ += event.data.size();
      waiting_.push_back({.event = event});
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
  std::deque<Waiting> waiting;
  std::uint64_t lost = 0;
  {
    const std::lock_guard lock(mutex_);
    waiting.swap(waiting_);
    machines_.clear();
    bytes_ = 0;
    lost = std::exchange(lost_, 0);
  }
  std::string text;
  for (const auto& [event, state] : waiting) {
    if (state) {
      text += state->event_after(interest_.form, known_[state.get()]);
    } else {
      append_event(text, event.kind, event.data);
    }
  }
  if (lost > 0) append_event(text, "lost", "{\"lost\":" + std::to_string(lost) + "}");
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

std::shared_ptr<EventSubscription> EventHub::subscribe(std::optional<std::string> machine,
                                                       Interest::Form form) {
  return add({.machine = std::move(machine), .port = {}, .form = form});
}

std::shared_ptr<EventSubscription> EventHub::subscribe_port(const std::string& port) {
  return add({.machine = {}, .port = port});
}

std::shared_ptr<EventSubscription> EventHub::add(Interest interest) {
  const std::lock_guard lock(mutex_);
  std::erase_if(subscriptions_, [](const auto& subscription) { return subscription.expired(); });
  if (subscriptions_.size() >= kMaxSubscriptions) return nullptr;
  auto subscription = std::make_shared<EventSubscription>(std::move(interest), published_);
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

/// Under the lock.
std::shared_ptr<MachineState> EventHub::state_of(const std::string& machine) {
  auto& state = machines_[machine];
  if (!state) state = std::make_shared<MachineState>();
  return state;
}

void EventHub::publish(Event event) {
  if (event.kind != "machine") {
    for (const auto& listener : listeners()) listener->push(event);
    return;
  }
  std::shared_ptr<MachineState> state;
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    state = state_of(event.machine);
    number = ++published_;
  }
  state->publish(std::move(event.data), number);
  for (const auto& listener : listeners()) listener->push_state(event.machine, state);
}

void EventHub::show(EventSubscription& listener, const std::string& machine,
                    const std::function<std::string()>& text) {
  std::shared_ptr<MachineState> state;
  {
    const std::lock_guard lock(mutex_);
    state = state_of(machine);
  }
  if (!state->is_newer(listener.begin())) state->fill(text(), listener.begin());
  listener.push_state(machine, std::move(state));
}

template <class Holds>
bool EventHub::has_any(const Holds& holds) const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(subscriptions_, [&](const auto& weak) {
    const auto listener = weak.lock();
    return listener && holds(*listener);
  });
}

bool EventHub::has_listeners() const {
  return has_any([](const auto&) { return true; });
}

bool EventHub::has_listeners(const std::string& machine) const {
  return has_any([&](const auto& listener) { return listener.wants_machine(machine); });
}

bool EventHub::has_port_listeners(const std::string& port) const {
  return has_any([&](const auto& listener) { return listener.port() == port; });
}

void EventHub::close() {
  for (const auto& listener : listeners()) listener->close();
}

}  // namespace dripline::api
