#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <iterator>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "server/mqtt/broker_link.hpp"

namespace dripline::mqtt {

/// A broker in the test's hands.
class FakeLink final : public BrokerLink {
 public:
  Result<void> open(const Message& will, const std::string& subscribed) override {
    const std::lock_guard lock(mutex_);
    subscribed_ = subscribed;
    ++opened;
    will_ = will;
    pending_.clear();
    is_connected_ = false;
    if (is_down) return fail(Errc::Io, "nothing there");
    return {};
  }
  Result<std::uint64_t> publish(const Message& message) override {
    const std::lock_guard lock(mutex_);
    ++next_;
    pending_.emplace_back(next_, message);
    most_pending = std::max(most_pending.load(), pending_.size());
    return next_;
  }
  Progress wait(std::chrono::milliseconds limit) override {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, limit, [&] {
      return is_awake_ || is_down || !is_connected_ || !sent_.empty() ||
             (!is_silent && is_answered_next());
    });
    is_awake_ = false;
    if (is_down) return {.is_lost = true, .fault = "lost"};
    Progress progress{
        .is_connected = true, .is_lost = false, .fault = "", .acknowledged = {}, .received = {}};
    is_connected_ = true;
    progress.received = std::exchange(sent_, {});
    while (!is_silent && is_answered_next()) {
      const auto next = next_answered();
      const auto& [id, message] = *next;
      const bool is_refused = !refused.empty() && message.topic.find(refused) != std::string::npos;
      if (!is_refused) got.push_back(message);
      progress.acknowledged.push_back({id, is_refused ? "not authorized" : ""});
      pending_.erase(next);
    }
    return progress;
  }
  void wake() override {
    const std::lock_guard lock(mutex_);
    is_awake_ = true;
    changed_.notify_all();
  }
  void close() override {
    const std::lock_guard lock(mutex_);
    ++closed;
  }
  void drop() override {
    const std::lock_guard lock(mutex_);
    ++dropped;
  }
  void set(bool FakeLink::*what, bool value) {
    const std::lock_guard lock(mutex_);
    this->*what = value;
    changed_.notify_all();
  }
  std::vector<Message> received(const std::string& part) {
    const std::lock_guard lock(mutex_);
    std::vector<Message> some;
    std::ranges::copy_if(got, std::back_inserter(some), [&](const Message& message) {
      return message.topic.find(part) != std::string::npos;
    });
    return some;
  }
  /// As from another client of the broker.
  void send(const std::string& payload) {
    const std::lock_guard lock(mutex_);
    sent_.push_back(payload);
    changed_.notify_all();
  }
  std::string subscribed() {
    const std::lock_guard lock(mutex_);
    return subscribed_;
  }
  Message will() {
    const std::lock_guard lock(mutex_);
    return will_;
  }

  bool is_down = false;    ///< connections fail
  bool is_silent = false;  ///< nothing is acknowledged
  std::string refused;     ///< part of the topics
  std::string kept;        ///< likewise: these are not acknowledged
  std::atomic<int> opened = 0, closed = 0, dropped = 0;
  std::atomic<std::size_t> most_pending = 0;

 private:
  using Pending = std::deque<std::pair<std::uint64_t, Message>>;

  Pending::iterator next_answered() {
    return std::ranges::find_if(pending_, [this](const auto& one) {
      return kept.empty() || one.second.topic.find(kept) == std::string::npos;
    });
  }
  bool is_answered_next() { return next_answered() != pending_.end(); }

  std::mutex mutex_;
  std::condition_variable changed_;
  Pending pending_;
  std::vector<Message> got;
  Message will_;
  std::string subscribed_;
  std::vector<std::string> sent_;
  std::uint64_t next_ = 0;
  bool is_connected_ = false, is_awake_ = false;
};

}  // namespace dripline::mqtt
