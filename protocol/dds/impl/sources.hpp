#pragma once

#include <dds/dds.h>

#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace dripline::dds {

/// Passes on what comes from one participant, the peer, and refuses all else. Whose writer a sample
/// came from must not be asked in a listener, so the first samples of a writer wait until the
/// owner's watcher has asked. The samples of one writer keep their order. Thread-safe; handlers are
/// called without a lock.
template <class Message>
class Sources {
 public:
  static constexpr std::size_t kMaxWaiting = 512;  ///< more are refused
  static constexpr std::size_t kMaxWriters = 64;   ///< remembered; then they are asked for again

  struct Handlers {
    std::function<void(Message)> deliver;
    std::function<void()> refuse;
    std::function<void()> on_waiting;  ///< somebody must call settle
  };
  explicit Sources(Handlers handlers) : handlers_(std::move(handlers)) {}

  /// Empty: nobody is believed.
  void set_peer(const std::string& participant) {
    const std::lock_guard lock(mutex_);
    peer_ = participant;
  }

  /// On the reader's thread.
  void take(dds_instance_handle_t writer, Message message) {
    switch (judge(writer, message)) {
      case Verdict::Believed:
        return handlers_.deliver(std::move(message));
      case Verdict::Refused:
        return handlers_.refuse();
      case Verdict::Waits:
        return handlers_.on_waiting();
    }
  }

  /// On the watcher's thread. `participant_of` tells whose a writer is; empty: it is gone.
  void settle(const std::function<std::string(dds_instance_handle_t)>& participant_of) {
    std::map<dds_instance_handle_t, std::string> asked;
    for (;;) {
      std::deque<Sample> samples;
      std::string peer;
      {
        const std::lock_guard lock(mutex_);
        if (waiting_.empty()) {  // only now: what came meanwhile must not overtake
          if (writers_.size() + asked.size() > kMaxWriters) writers_.clear();
          writers_.merge(asked);
          return;
        }
        samples.swap(waiting_);
        peer = peer_;
      }
      for (auto& [writer, message] : samples) {
        const auto known = asked.find(writer);
        const std::string participant =
            known != asked.end() ? known->second
                                 : asked.emplace(writer, participant_of(writer)).first->second;
        if (!peer.empty() && participant == peer) {
          handlers_.deliver(std::move(message));
        } else {
          handlers_.refuse();
        }
      }
    }
  }

 private:
  enum class Verdict { Believed, Refused, Waits };
  using Sample = std::pair<dds_instance_handle_t, Message>;

  Verdict judge(dds_instance_handle_t writer, Message& message) {
    const std::lock_guard lock(mutex_);
    const auto known = writers_.find(writer);
    if (known != writers_.end()) {
      const bool is_peer = !peer_.empty() && known->second == peer_;
      return is_peer ? Verdict::Believed : Verdict::Refused;
    }
    if (waiting_.size() >= kMaxWaiting) return Verdict::Refused;
    waiting_.emplace_back(writer, std::move(message));
    return Verdict::Waits;
  }

  const Handlers handlers_;
  std::mutex mutex_;
  std::string peer_;
  std::map<dds_instance_handle_t, std::string> writers_;
  std::deque<Sample> waiting_;
};

}  // namespace dripline::dds
