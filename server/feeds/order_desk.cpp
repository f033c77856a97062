#include "server/feeds/order_desk.hpp"

#include <algorithm>
#include <thread>

#include "protocol/base/random.hpp"
#include "protocol/dds/stop_orders.hpp"
#include "server/feeds/identifiers.hpp"

namespace dripline::feeds {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMaxGivenUp = 64;
constexpr auto kRetry = 10ms;  ///< before an order is offered again to a full queue

/// These are sent at once, whatever is known of the gateway. Whether an override is lowered is for
/// the gateway to say.
bool may_stop(const dds::Order& order) {
  return dds::is_stop(order.action, order.argument, order.value) ||
         dds::is_override(order.action) || order.action == dds::OrderAction::Refuse;
}

}  // namespace

OrderDesk::OrderDesk(dds::ServerEndpoint& endpoint, const Clock& clock, Options options,
                     std::function<void(const dds::Order&)> on_late_start)
    : session_(random_number() | 1),
      endpoint_(endpoint),
      clock_(clock),
      options_(options),
      on_late_start_(std::move(on_late_start)) {}

SteadyTime OrderDesk::stamp(dds::Order& order) {
  order.id = make_order_id();
  order.expires = may_stop(order) ? UtcTime::max() : clock_.now() + options_.expiry;
  order.server = session_;
  const std::lock_guard lock(mutex_);
  order.number = ++last_number_;
  return clock_.steady_now() + options_.expiry;
}

Result<void> OrderDesk::send(dds::Order order) {
  const SteadyTime deadline = stamp(order);
  return write_in_time(order, deadline);
}

/// To the gateway that speaks for the machine at this moment, in terms of its clock.
Result<void> OrderDesk::send_to_present(dds::Order order, SteadyTime deadline) {
  if (options_.gateway_of) {
    const auto gateway = options_.gateway_of(order.machine);
    order.session = gateway.session;
    if (gateway.steady_ahead) {
      order.deadline =
          std::chrono::duration_cast<std::chrono::microseconds>(deadline.time_since_epoch()) +
          *gateway.steady_ahead;
    } else if (!may_stop(order)) {
      return fail(Errc::Timeout, "machine {} has not reported its status yet", order.machine);
    }
  }
  return endpoint_.write(order);
}

Result<void> OrderDesk::carry_out(dds::Order order) {
  const SteadyTime deadline = stamp(order);
  const std::string id = order.id;
  {
    const std::lock_guard lock(mutex_);
    waiting_[id] = {.order = order, .result = {}, .deadline = deadline};
  }
  const auto written = write_in_time(order, deadline);
  const auto outcome = written ? await(id) : written;
  const std::lock_guard lock(mutex_);
  const bool is_unknown = !outcome && outcome.error().code == Errc::Timeout;
  if (is_unknown && order.action == dds::OrderAction::Start) {
    given_up_.push_back(std::move(order));
    if (given_up_.size() > kMaxGivenUp) given_up_.pop_front();
  }
  waiting_.erase(id);
  return outcome;
}

Result<void> OrderDesk::write_in_time(const dds::Order& order, SteadyTime deadline) {
  const auto limit = std::chrono::steady_clock::now() + options_.expiry;
  for (;;) {
    auto written = send_to_present(order, deadline);
    if (written || written.error().code != Errc::Timeout) return written;
    if (std::chrono::steady_clock::now() >= limit) return written;
    std::this_thread::sleep_for(kRetry);
  }
}

Result<void> OrderDesk::await(const std::string& id) {
  const auto expiry = std::chrono::steady_clock::now() + options_.expiry;
  const auto limit = expiry + options_.grace;
  std::unique_lock lock(mutex_);
  const Waiting& waiting = waiting_.at(id);
  const auto is_settled = [&] { return waiting.result.has_value() || is_stopping_; };
  for (auto next = std::chrono::steady_clock::now() + options_.repeat; next < expiry;
       next += options_.repeat) {
    if (changed_.wait_until(lock, next, is_settled)) break;
    dds::Order again = waiting.order;
    lock.unlock();
    // A full queue or a machine that went away: the next round tries again, until the limit.
    [[maybe_unused]] const auto written = send_to_present(std::move(again), waiting.deadline);
    lock.lock();
  }
  const bool is_decided = changed_.wait_until(lock, limit, is_settled);
  if (waiting.result) {
    if (waiting.result->accepted) return {};
    return fail(Errc::Busy, "machine {} refused {}: {}", waiting.order.machine,
                dds::to_string(waiting.order.action), waiting.result->reason);
  }
  if (is_decided) return fail(Errc::Io, "the server is stopping");
  return fail(Errc::Timeout, "machine {} did not answer {} within {} s", waiting.order.machine,
              dds::to_string(waiting.order.action),
              std::chrono::duration<double>(options_.expiry).count());
}

void OrderDesk::on_result(const dds::OrderResult& result) {
  std::optional<dds::Order> late;
  {
    const std::lock_guard lock(mutex_);
    if (const auto found = waiting_.find(result.id); found != waiting_.end()) {
      if (found->second.order.machine == result.machine) found->second.result = result;
    } else if (result.accepted) {
      const auto given_up = std::ranges::find(given_up_, result.id, &dds::Order::id);
      if (given_up != given_up_.end()) {
        late = std::move(*given_up);
        given_up_.erase(given_up);
      }
    }
  }
  changed_.notify_all();
  if (late) on_late_start_(*late);
}

void OrderDesk::on_run_seen(const std::string& machine, const std::string& run) {
  {
    const std::lock_guard lock(mutex_);
    for (auto& [id, waiting] : waiting_) {
      const bool is_start = waiting.order.action == dds::OrderAction::Start &&
                            waiting.order.run == run && waiting.order.machine == machine;
      if (!is_start || waiting.result) continue;
      waiting.result = dds::OrderResult{
          .machine = waiting.order.machine, .id = id, .accepted = true, .reason = {}};
    }
  }
  changed_.notify_all();
}

bool OrderDesk::is_waiting_for(const std::string& run) const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(waiting_, [&](const auto& entry) {
    const dds::Order& order = entry.second.order;
    return order.action == dds::OrderAction::Start && order.run == run;
  });
}

void OrderDesk::stop() {
  {
    const std::lock_guard lock(mutex_);
    is_stopping_ = true;
  }
  changed_.notify_all();
}

}  // namespace dripline::feeds
