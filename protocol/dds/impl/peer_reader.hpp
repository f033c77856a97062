#pragma once

#include <dds/dds.h>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "protocol/dds/impl/matched.hpp"
#include "protocol/dds/impl/reader.hpp"

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
    std::function<void(Message&&)> deliver;
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
  void take(dds_instance_handle_t writer, Message&& message) {
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
        std::string participant = known != asked.end() ? known->second : participant_of(writer);
        // One that is gone, or not here yet, may be here later.
        if (known == asked.end() && !participant.empty()) asked.emplace(writer, participant);
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

/// Delivers the messages of one participant; those of others are rejected and counted. Its owner
/// has a watcher thread, which calls `resolve` after each call of `wake`.
template <class Message>
class PeerReader {
 public:
  struct Options {
    std::string machine;  ///< samples with another key are rejected
    std::function<void(Message&&)> on_message;
    std::function<void()> wake;
    Qos qos = reader_qos<Message>();
  };
  static Result<std::unique_ptr<PeerReader>> create(const Entity& subscriber, const Entity& topic,
                                                    Rejections& rejections, Options options) {
    std::unique_ptr<PeerReader> reader(new PeerReader(
        {.deliver = std::move(options.on_message),
         .refuse =
             [&rejections] {
               rejections.add(Topic<Message>::kName, "from a participant that is not the peer");
             },
         .on_waiting = options.wake}));
    auto created =
        Reader<Message>::create(subscriber, topic, std::move(options.machine), rejections,
                                {.on_message =
                                     [sources = &reader->sources_](Message&& message, const auto&,
                                                                   dds_instance_handle_t writer) {
                                       sources->take(writer, std::move(message));
                                     },
                                 .on_gone = {},
                                 .on_matched = options.wake},
                                options.qos);
    if (!created) return fail(created.error());
    reader->reader_ = std::move(*created);
    return reader;
  }

  dds_entity_t get() const { return reader_->get(); }
  void set_peer(const std::string& participant) { sources_.set_peer(participant); }
  void resolve() {
    sources_.resolve([this](dds_instance_handle_t writer) {
      const auto source = publication(reader_->get(), writer);
      return source ? source->participant : std::string();
    });
  }

 private:
  explicit PeerReader(typename Sources<Message>::Handlers handlers)
      : sources_(std::move(handlers)) {}

  Sources<Message> sources_;
  std::unique_ptr<Reader<Message>> reader_;  // destroyed first: it calls into the sources
};

}  // namespace dripline::dds
