#pragma once

#include <functional>
#include <memory>
#include <mutex>

#include "protocol/dds/endpoint.hpp"
#include "protocol/dds/impl/decode.hpp"
#include "protocol/dds/impl/entity.hpp"
#include "protocol/dds/qos.hpp"

namespace dripline::dds {

/// Counts the messages an endpoint dropped. Any thread.
class Rejections {
 public:
  void add(const char* topic, std::string_view reason) {
    std::lock_guard lock(mutex_);
    ++rejected_.messages;
    rejected_.last_reason = fmt::format("{}: {}", topic, reason);
  }
  Rejected get() const {
    std::lock_guard lock(mutex_);
    return rejected_;
  }

 private:
  mutable std::mutex mutex_;
  Rejected rejected_;
};

/// Receives the samples of one topic. Called on DDS threads, one at a time for each reader.
template <class Message>
struct ReaderHandlers {
  /// `sample` has members that the message lacks, `writer` is its origin.
  std::function<void(Message&&, const SampleOf<Message>& sample, dds_instance_handle_t writer)>
      on_message;
  std::function<void(std::string machine)> on_gone;  ///< no writer of this machine is left
  std::function<void()> on_matched;                  ///< the matched writers changed
};

/// How many samples are taken at once. A reader of statuses has the latest of one machine: with the
/// room for 32 of them, its clearing was a sixth of what a status cost.
template <class Message>
inline constexpr std::size_t kSamplesAtOnce = 32;
template <>
inline constexpr std::size_t kSamplesAtOnce<Status> = 2;

/// Takes every sample in the callback that announces it, checks it and delivers it. After the
/// destructor no handler runs.
template <class Message>
class Reader {
 public:
  /// `machine`: samples with another key are rejected; empty: any key.
  static Result<std::unique_ptr<Reader>> create(const Entity& subscriber, const Entity& topic,
                                                std::string machine, Rejections& rejections,
                                                ReaderHandlers<Message> handlers,
                                                const Qos& qos = reader_qos<Message>()) {
    std::unique_ptr<Reader> reader(new Reader(std::move(machine), rejections, std::move(handlers)));
    const Listener listener(dds_create_listener(reader.get()));
    dds_lset_data_available(listener.get(), [](dds_entity_t entity, void* self) {
      static_cast<Reader*>(self)->take_all(entity);
    });
    dds_lset_subscription_matched(
        listener.get(), [](dds_entity_t, const dds_subscription_matched_status_t, void* self) {
          const auto& on_matched = static_cast<Reader*>(self)->handlers_.on_matched;
          if (on_matched) on_matched();
        });
    auto entity = own(dds_create_reader(subscriber.get(), topic.get(), qos.get(), listener.get()),
                      Topic<Message>::kName);
    if (!entity) return fail(entity.error());
    reader->entity_ = std::move(*entity);
    return reader;
  }
  ~Reader() { dds_set_listener(entity_.get(), nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  dds_entity_t get() const { return entity_.get(); }

 private:
  Reader(std::string machine, Rejections& rejections, ReaderHandlers<Message> handlers)
      : machine_(std::move(machine)), rejections_(rejections), handlers_(std::move(handlers)) {}

  // The entity is an argument: the first callback can come before create() has stored it.
  void take_all(dds_entity_t entity) {
    for (;;) {
      const Loan<kSamplesAtOnce<Message>> loan(entity);
      for (std::size_t i = 0; i < loan.size(); ++i) {
        handle(*static_cast<const SampleOf<Message>*>(loan.sample(i)), loan.info(i));
      }
      if (loan.size() < kSamplesAtOnce<Message>) return;
    }
  }

  void handle(const SampleOf<Message>& sample, const dds_sample_info_t& info) {
    if (info.instance_state != DDS_IST_ALIVE && handlers_.on_gone) {
      handlers_.on_gone(sample.machine);  // only the key is valid
    }
    if (!info.valid_data) return;
    auto message = decode(sample);
    if (message && !machine_.empty() && message->machine != machine_) {
      message = fail(Errc::Syntax, "machine {} in the partition of {}", message->machine, machine_);
    }
    if (!message) return rejections_.add(Topic<Message>::kName, message.error().what);
    handlers_.on_message(std::move(*message), sample, info.publication_handle);
  }

  std::string machine_;
  Rejections& rejections_;
  ReaderHandlers<Message> handlers_;
  Entity entity_;
};

}  // namespace dripline::dds
