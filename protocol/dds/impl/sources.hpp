#pragma once

#include <dds/dds.h>

#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace dripline::dds {

/// Delivers the samples of one participant, the peer, and rejects all others. A listener must not
/// look up the participant of a writer, so the first samples of a writer wait until the owner's
/// watcher has done it. The samples of one writer keep their order. Thread-safe; handlers are
/// called without a lock.
template <class Message>
class Sources {
 public:
  static constexpr std::size_t kMaxWaiting = 512;  ///< more are rejected
  static constexpr std::size_t kMaxWriters =
      64;  ///< known writers; further ones are looked up again

  struct Handlers {
    std::function<void(Message)> deliver;
    std::function<void()> refuse;
    std::function<void()> on_waiting;  ///< the owner must call resolve
  };
  explicit Sources(Handlers handlers) : handlers_(std::move(handlers)) {}

  /// Empty: all samples are rejected.
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

  /// On the watcher's thread. `participant_of` returns the participant of a writer; empty: it is
  /// gone.
  void resolve(const std::function<std::string(dds_instance_handle_t)>& participant_of) {
    std::map<dds_instance_handle_t, std::string> asked;
    for (;;) {
      std::deque<Sample> samples;
      std::string peer;
      {
        const std::lock_guard lock(mutex_);
        if (waiting_.empty()) {  // only now: samples that came meanwhile must not overtake
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
