#include "tests/load/event_watch.hpp"

#include <httplib.h>

#include <algorithm>
#include <charconv>
#include <chrono>

#include "protocol/base/clock.hpp"

namespace dripline::load {
namespace {

constexpr std::size_t kSlots = 60'000;  // the last one holds everything slower

/// What follows `key` in the JSON of a status, up to the end of a number or text.
std::string_view value_of(std::string_view json, std::string_view key) {
  const auto at = json.find(key);
  if (at == std::string_view::npos) return {};
  const auto rest = json.substr(at + key.size());
  return rest.substr(0, rest.find_first_of(",}\""));
}

}  // namespace

void EventWatch::start(std::string url, std::string token, std::string path) {
  stop();
  url_ = std::move(url);
  token_ = std::move(token);
  path_ = std::move(path);
  is_ending_ = false;
  reset();
  thread_ = std::thread([this] { read(); });
}

void EventWatch::stop() {
  is_ending_ = true;
  if (thread_.joinable()) thread_.join();
}

void EventWatch::reset() {
  const std::lock_guard lock(mutex_);
  last_.clear();
  by_ms_.assign(kSlots, 0);
  events_ = bytes_ = 0;
}

void EventWatch::read() {
  while (!is_ending_) {
    httplib::Client client(url_);
    client.set_bearer_token_auth(token_);
    client.set_read_timeout(1);
    text_.clear();
    (void)client.Get(path_, [this](const char* bytes, std::size_t size) {
      take({bytes, size});
      return !is_ending_;
    });
    if (!is_ending_) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

void EventWatch::take(std::string_view bytes) {
  text_ += bytes;
  std::size_t begin = 0;
  for (;;) {
    const auto end = text_.find("\n\n", begin);
    if (end == std::string::npos) break;
    take_event(std::string_view(text_).substr(begin, end - begin));
    begin = end + 2;
  }
  text_.erase(0, begin);
}

void EventWatch::take_event(std::string_view event) {
  {
    const std::lock_guard lock(mutex_);
    bytes_ += event.size() + 2;
  }
  if (!event.starts_with("event: machine\n")) return;
  const auto executed = value_of(event, "\"executed\":");
  const auto machine = value_of(event, "\"name\":\"");
  const auto time = parse_iso8601(value_of(event, "\"time\":\""));
  std::uint64_t number = 0;
  const auto read = std::from_chars(executed.data(), executed.data() + executed.size(), number);
  if (read.ec == std::errc{} && !machine.empty() && time)
    count(machine, number, time->time_since_epoch().count());
}

void EventWatch::count(std::string_view machine, std::uint64_t number, std::int64_t written_us) {
  const std::int64_t now = SystemClock().now().time_since_epoch().count();
  const std::lock_guard lock(mutex_);
  ++events_;
  const auto known = last_.find(machine);
  if (known == last_.end()) {
    last_.emplace(machine, number);
    return;
  }
  if (number <= known->second) return;  // the same status again: something else has changed
  for (std::uint64_t n = number; n > known->second; --n) {
    const double earlier = static_cast<double>(number - n) * interval_us_;
    const double delay_ms = (static_cast<double>(now - written_us) + earlier) / 1000;
    ++by_ms_[std::min(static_cast<std::size_t>(std::max(0.0, delay_ms)), kSlots - 1)];
  }
  known->second = number;
}

Delays EventWatch::delays() const {
  const std::lock_guard lock(mutex_);
  Delays delays{.events = events_, .bytes = bytes_};
  for (const auto statuses : by_ms_) delays.seen += statuses;
  std::uint64_t passed = 0;
  for (std::size_t ms = 0; ms < by_ms_.size(); ++ms) {
    if (by_ms_[ms] == 0) continue;
    const auto before = static_cast<double>(passed);
    passed += by_ms_[ms];
    const auto after = static_cast<double>(passed);
    const auto all = static_cast<double>(delays.seen);
    if (before < all * 0.5 && after >= all * 0.5) delays.median_ms = static_cast<double>(ms);
    if (before < all * 0.99 && after >= all * 0.99) delays.p99_ms = static_cast<double>(ms);
    delays.max_ms = static_cast<double>(ms);
  }
  return delays;
}

}  // namespace dripline::load
