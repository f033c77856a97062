#include "server/mqtt/broker_state.hpp"

#include <algorithm>
#include <utility>

#include "protocol/process/log.hpp"

namespace dripline::mqtt {

using std::chrono::milliseconds;

BrokerState::BrokerState(const Clock& clock, std::string who, std::string broker, Options options,
                         OnFault on_fault)
    : clock_(clock),
      who_(std::move(who)),
      broker_(std::move(broker)),
      options_(options),
      on_fault_(std::move(on_fault)) {}

Result<void> BrokerState::connect(BrokerLink& link, const Message& will,
                                  const std::string& subscribed, Patience patience,
                                  const std::stop_token& stop) const {
  if (auto opened = link.open(will, subscribed); !opened) return opened;
  const SteadyTime limit = clock_.steady_now() + patience.limit;
  while (!stop.stop_requested()) {
    const auto progress = link.wait(patience.look);
    if (progress.is_lost) return fail(Errc::Io, "{}", progress.fault);
    if (progress.is_connected) return {};
    if (clock_.steady_now() >= limit) return fail(Errc::Timeout, "{}: no answer in time", broker_);
  }
  return {};
}

void BrokerState::set_connected() {
  connected_at_ = clock_.steady_now();
  const std::lock_guard lock(mutex_);
  view_.is_connected = true;
  view_.since = clock_.now();
  if (++view_.connections == 1) process::log_info("{}: connected to {}", who_, broker_);
}

/// The log has the first fault of an outage.
void BrokerState::set_lost(const std::string& fault) {
  const UtcTime now = clock_.now();
  {
    const std::lock_guard lock(mutex_);
    if (view_.is_connected || !view_.since) view_.since = now;
    view_.is_connected = false;
    view_.fault = fault;
  }
  if (!failing_since_) {
    failing_since_ = now;
    process::log_warning("{}: not published: {}", who_, fault);
  }
  if (now - *failing_since_ >= options_.long_fault && on_fault_) on_fault_(broker_, fault);
}

void BrokerState::end_fault(bool has_caught_up) {
  if (!failing_since_) return;
  const bool has_lasted = clock_.steady_now() - connected_at_ >= options_.fault_ends_after;
  if (!has_caught_up && !has_lasted) return;
  failing_since_.reset();
  failures_ = 0;
  {
    const std::lock_guard lock(mutex_);
    view_.fault.clear();
  }
  process::log_info("{}: {} is reached again", who_, broker_);
  if (on_fault_) on_fault_(broker_, "");
}

void BrokerState::pause(const std::stop_token& stop) {
  constexpr unsigned kMaxDoublings = 16;
  const auto doubled = options_.first_retry * (1LL << std::min(failures_++, kMaxDoublings));
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, stop, std::min(milliseconds(doubled), options_.longest_retry),
                    [] { return false; });
}

BrokerState::View BrokerState::view() const {
  const std::lock_guard lock(mutex_);
  return view_;
}

}  // namespace dripline::mqtt
