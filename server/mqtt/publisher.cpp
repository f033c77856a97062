#include "server/mqtt/publisher.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "protocol/process/log.hpp"
#include "server/mqtt/topics.hpp"

namespace dripline::mqtt {
namespace {

using Json = nlohmann::json;
using std::chrono::milliseconds;

/// What a machine sent may hold bytes that are no text.
std::string payload_of(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

Publisher::Publisher(Parts parts, MqttSettings settings, Options options)
    : parts_(std::move(parts)),
      settings_(std::move(settings)),
      options_(options),
      queue_(settings_.status_interval),
      broker_(parts_.clock, "mqtt", settings_.broker, options.state, parts_.on_fault),
      feed_(parts_.store, kReader, {.window = options.window, .kinds = settings_.kinds}) {}

Publisher::~Publisher() {
  end();
}

void Publisher::begin() {
  // At once: what is stored from now on is published. After an error the thread tries again.
  (void)begin_reading();
  worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

void Publisher::end() {
  worker_.request_stop();
  parts_.link.wake();
  if (worker_.joinable()) worker_.join();
}

void Publisher::note(const machines::MachineView& view) {
  if (settings_.has_status && queue_.note(view)) parts_.link.wake();
}

void Publisher::note_record() {
  if (settings_.has_records && !is_record_noted_.exchange(true)) parts_.link.wake();
}

Result<Publisher::State> Publisher::state() const {
  State now{broker_.view(), settings_.broker, 0, published_records_, published_states_, missing_};
  if (!settings_.has_records) return now;
  const auto unread = parts_.store.record_readers.unread(kReader);
  if (!unread) return fail(unread.error());
  for (const auto& [cursor, last] : *unread) now.waiting += last - cursor.number;
  return now;
}

void Publisher::work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    const auto served = serve(stop);
    if (auto stored = commit(true); !stored)
      process::log_warning("mqtt: what was published is not noted: {}", stored.error().what);
    if (served || stop.stop_requested()) continue;
    broker_.set_lost(served.error().what);
    broker_.pause(stop);
  }
}

Result<void> Publisher::begin_reading() {
  if (!settings_.has_records) return {};
  return parts_.store.record_readers.begin(kReader, parts_.clock.now());
}

Result<void> Publisher::serve(const std::stop_token& stop) {
  if (auto begun = begin_reading(); !begun) return begun;
  auto served = connect(stop);
  if (served && !stop.stop_requested()) {
    greet();
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

Result<void> Publisher::connect(const std::stop_token& stop) {
  feed_.restart();
  states_.clear();
  return broker_.connect(parts_.link, online_message(false), {},
                         {.look = options_.look, .limit = options_.connect_limit}, stop);
}

/// A broker that was away has old states, or none.
void Publisher::greet() {
  oldest_record_ = oldest_state_ = {};
  looked_ = committed_ = parts_.clock.steady_now();
  is_more_ = true;  // perhaps
  if (settings_.has_status) {
    for (const auto& view : parts_.machines()) queue_.add(view);
  }
  broker_.set_connected();
}

Result<void> Publisher::publish_loop(const std::stop_token& stop) {
  if (auto published = publish_online(); !published) return published;
  while (!stop.stop_requested()) {
    if (auto published = publish_states(); !published) return published;
    if (auto published = publish_records(); !published) return published;
    if (auto received = receive(next_wait()); !received) return received;
    if (auto stored = commit(false); !stored) return stored;
    if (auto good = check_answers(); !good) return good;
    broker_.end_fault(under_way() == 0 && !is_more_);
  }
  return {};
}

Message Publisher::online_message(bool is_online) const {
  return {.topic = online_topic(settings_.prefix),
          .payload = payload_of(
              {{"online", is_online}, {"server", parts_.server}, {"version", parts_.version}}),
          .qos = 1,
          .is_retained = true};
}

Result<void> Publisher::publish_online() {
  const auto message = parts_.link.publish(online_message(true));
  if (!message) return fail(message.error());
  states_[*message] = online_topic(settings_.prefix);
  return {};
}

Result<void> Publisher::publish_states() {
  while (states_.size() < options_.window) {
    const auto view = queue_.take(parts_.clock.steady_now());
    if (!view) return {};
    const auto message =
        parts_.link.publish({.topic = status_topic(settings_.prefix, view->machine.name),
                             .payload = payload_of(parts_.status_json(*view)),
                             .qos = 1,
                             .is_retained = settings_.is_status_retained});
    if (!message) return fail(message.error());
    states_[*message] = status_topic(settings_.prefix, view->machine.name);
  }
  return {};
}

Result<void> Publisher::publish_records() {
  if (!settings_.has_records || feed_.under_way() >= options_.window) return {};
  const SteadyTime now = parts_.clock.steady_now();
  const auto since = now - looked_;
  const bool is_noted = is_record_noted_ && since >= options_.gather;
  if (!is_more_ && !is_noted && since < options_.look) return {};
  looked_ = now;
  is_record_noted_ = false;  // before the look: what comes during it is looked for again
  const auto more = feed_.fill([this](const storage::Record& record) {
    auto body = parts_.record_json(record);
    body["id"] = record_id(record);
    return parts_.link.publish({.topic = record_topic(settings_.prefix, record),
                                .payload = payload_of(body),
                                .qos = settings_.qos});
  });
  if (!more) return fail(more.error());
  is_more_ = *more;
  return {};
}

milliseconds Publisher::next_wait() const {
  const SteadyTime now = parts_.clock.steady_now();
  const auto until = [now](SteadyTime time) {
    return std::max(milliseconds(0), std::chrono::ceil<milliseconds>(time - now));
  };
  milliseconds wait = options_.look;
  const bool has_room = feed_.under_way() < options_.window;
  if (is_more_ && has_room) return milliseconds(0);
  if (is_record_noted_ && has_room) wait = std::min(wait, until(looked_ + options_.gather));
  if (feed_.has_uncommitted()) wait = std::min(wait, until(committed_ + options_.commit_after));
  if (const auto next = queue_.next_due(); next && states_.size() < options_.window)
    wait = std::min(wait, *next <= now ? milliseconds(0) : until(*next));
  return wait;
}

Result<void> Publisher::receive(milliseconds limit) {
  const auto progress = parts_.link.wait(limit);
  for (const auto& acknowledged : progress.acknowledged) {
    if (auto taken = take(acknowledged); !taken) return taken;
  }
  if (progress.is_lost) return fail(Errc::Io, "{}", progress.fault);
  return {};
}

/// What is refused is not passed over: the administrator of the broker is to know.
Result<void> Publisher::take(const BrokerLink::Acknowledgment& acknowledged) {
  std::string what;
  if (const auto state = states_.find(acknowledged.message); state != states_.end()) {
    what = state->second;
    if (acknowledged.refusal.empty()) {
      states_.erase(state);
      ++published_states_;
    }
  } else if (acknowledged.refusal.empty()) {
    if (!feed_.acknowledge(acknowledged.message)) return {};
    ++published_records_;
    missing_ = feed_.missing();
  } else {
    what = settings_.prefix + "/+/records";
  }
  if (acknowledged.refusal.empty()) return {};
  return fail(Errc::Denied, "{} refuses a message for {}: {}", settings_.broker, what,
              acknowledged.refusal);
}

Result<void> Publisher::commit(bool is_due_now) {
  const SteadyTime now = parts_.clock.steady_now();
  if (!feed_.has_uncommitted()) {
    committed_ = now;
    return {};
  }
  if (!is_due_now && now - committed_ < options_.commit_after) return {};
  committed_ = now;
  return feed_.commit();
}

void Publisher::follow(Oldest& oldest, std::uint64_t message, SteadyTime now) {
  if (message != oldest.message) oldest = {message, now};
}

/// Each sort by itself: a broker that acknowledges states may keep no record.
Result<void> Publisher::check_answers() {
  const SteadyTime now = parts_.clock.steady_now();
  follow(oldest_record_, feed_.oldest(), now);
  follow(oldest_state_, states_.empty() ? 0 : states_.begin()->first, now);
  for (const auto& [oldest, what] :
       {std::pair(oldest_record_, "records"), std::pair(oldest_state_, "states")}) {
    if (oldest.message == 0 || now - oldest.since < options_.answer_limit) continue;
    return fail(Errc::Timeout, "{}: {}: nothing acknowledged in {} s", settings_.broker, what,
                std::chrono::duration_cast<std::chrono::seconds>(options_.answer_limit).count());
  }
  return {};
}

/// Ends what is in progress, says that the server is gone, and notes how far it has got.
void Publisher::take_leave() {
  if (!broker_.view().is_connected) return;
  const auto gone = parts_.link.publish(online_message(false));
  if (gone) states_[*gone] = online_topic(settings_.prefix);
  const SteadyTime limit = parts_.clock.steady_now() + options_.farewell;
  while (under_way() > 0 && parts_.clock.steady_now() < limit) {
    if (!receive(milliseconds(20))) return;
  }
}

}  // namespace dripline::mqtt
