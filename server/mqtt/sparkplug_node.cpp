#include "server/mqtt/sparkplug_node.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace dripline::mqtt {

using std::chrono::milliseconds;

SparkplugNode::SparkplugNode(Parts parts, const MqttSettings& settings, Options options)
    : parts_(std::move(parts)),
      broker_address_(settings.broker),
      name_(settings.sparkplug_group + "/" + settings.sparkplug_node),
      options_(options),
      queue_(settings.status_interval),
      broker_(parts_.clock, "mqtt: sparkplug", settings.broker + " as " + name_, options.state,
              parts_.on_fault),
      session_(settings.sparkplug_group, settings.sparkplug_node, parts_.version,
               parts_.first_connection) {}

SparkplugNode::~SparkplugNode() {
  end();
}

void SparkplugNode::begin() {
  worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

void SparkplugNode::end() {
  worker_.request_stop();
  parts_.link.wake();
  if (worker_.joinable()) worker_.join();
}

void SparkplugNode::note(const machines::MachineView& view) {
  if (queue_.note(view)) parts_.link.wake();
}

SparkplugNode::State SparkplugNode::state() const {
  return {broker_.view(), name_, messages_, rebirths_};
}

void SparkplugNode::work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    const auto served = serve(stop);
    if (served || stop.stop_requested()) continue;
    broker_.set_lost(served.error().what);
    broker_.pause(stop);
  }
}

Result<void> SparkplugNode::serve(const std::stop_token& stop) {
  auto served = connect(stop);
  if (served && !stop.stop_requested()) {
    broker_.set_connected();
    served = publish_loop(stop);
  }
  if (!served) {
    parts_.link.drop();
    return served;
  }
  take_leave();
  parts_.link.close();
  return {};
}

Result<void> SparkplugNode::connect(const std::stop_token& stop) {
  under_way_ = 0;
  is_rebirth_wanted_ = false;
  return broker_.connect(parts_.link, session_.begin(parts_.clock.now()), session_.command_topic(),
                         {.look = options_.look, .limit = options_.connect_limit}, stop);
}

Result<void> SparkplugNode::publish_loop(const std::stop_token& stop) {
  if (auto published = publish_births(); !published) return published;
  while (!stop.stop_requested()) {
    const bool may_be_born = parts_.clock.steady_now() - born_ >= options_.rebirth_interval;
    if (is_rebirth_wanted_ && may_be_born) {
      ++rebirths_;
      if (auto published = publish_births(); !published) return published;
    }
    if (auto published = publish_states(); !published) return published;
    if (auto received = receive(next_wait()); !received) return received;
    broker_.end_fault(under_way_ == 0);
  }
  return {};
}

/// The devices follow as states.
Result<void> SparkplugNode::publish_births() {
  is_rebirth_wanted_ = false;
  born_ = parts_.clock.steady_now();
  if (auto published = publish(session_.birth(parts_.clock.now())); !published) return published;
  for (const auto& view : parts_.machines()) queue_.add(view);
  return {};
}

Result<void> SparkplugNode::publish_states() {
  while (under_way_ < options_.window) {
    const auto view = queue_.take(parts_.clock.steady_now());
    if (!view) return {};
    const auto message = session_.report(view->machine.name, view->is_heard(),
                                         metrics_of(parts_.status_json(*view)), parts_.clock.now());
    if (!message) continue;
    if (auto published = publish(*message); !published) return published;
  }
  return {};
}

Result<void> SparkplugNode::publish(const Message& message) {
  const auto published = parts_.link.publish(message);
  if (!published) return fail(published.error());
  ++under_way_;
  ++messages_;
  return {};
}

milliseconds SparkplugNode::next_wait() const {
  const SteadyTime now = parts_.clock.steady_now();
  const auto until = [now](SteadyTime time) {
    return std::max(milliseconds(0), std::chrono::ceil<milliseconds>(time - now));
  };
  milliseconds wait = options_.look;
  if (is_rebirth_wanted_) wait = std::min(wait, until(born_ + options_.rebirth_interval));
  if (const auto next = queue_.next_due(); next && under_way_ < options_.window)
    wait = std::min(wait, *next <= now ? milliseconds(0) : until(*next));
  return wait;
}

Result<void> SparkplugNode::receive(milliseconds limit) {
  const auto progress = parts_.link.wait(limit);
  for (const auto& acknowledged : progress.acknowledged) {
    if (under_way_ > 0) --under_way_;
    if (!acknowledged.refusal.empty())
      return fail(Errc::Denied, "{} refuses a message: {}", broker_address_, acknowledged.refusal);
  }
  is_rebirth_wanted_ = is_rebirth_wanted_ || std::ranges::any_of(progress.received, asks_rebirth);
  if (progress.is_lost) return fail(Errc::Io, "{}", progress.fault);
  return {};
}

void SparkplugNode::take_leave() {
  if (!broker_.view().is_connected) return;
  if (!publish(session_.death(parts_.clock.now()))) return;
  const SteadyTime limit = parts_.clock.steady_now() + options_.farewell;
  while (under_way_ > 0 && parts_.clock.steady_now() < limit) {
    if (!receive(milliseconds(20))) return;
  }
}

}  // namespace dripline::mqtt
