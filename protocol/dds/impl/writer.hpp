#pragma once

#include <functional>
#include <memory>

#include "protocol/dds/impl/encode.hpp"
#include "protocol/dds/impl/entity.hpp"
#include "protocol/dds/qos.hpp"

namespace dripline::dds {

/// Checks, converts and writes messages of one topic. write() is safe on any thread.
template <class Message>
class Writer {
 public:
  /// `on_matched` (the matched readers changed) runs on a DDS thread, never after the destructor.
  /// `term`: of a server, which readers learn before any message.
  static Result<std::unique_ptr<Writer>> create(const Entity& publisher, const Entity& topic,
                                                std::function<void()> on_matched,
                                                std::uint64_t term = 0) {
    std::unique_ptr<Writer> writer(new Writer(std::move(on_matched)));
    const Listener listener(dds_create_listener(writer.get()));
    dds_lset_publication_matched(
        listener.get(), [](dds_entity_t, const dds_publication_matched_status_t, void* self) {
          static_cast<Writer*>(self)->on_matched_();
        });
    const Qos qos = topic_qos<Message>();
    set_term(qos, term);
    auto entity = own(dds_create_writer(publisher.get(), topic.get(), qos.get(), listener.get()),
                      Topic<Message>::kName);
    if (!entity) return fail(entity.error());
    writer->entity_ = std::move(*entity);
    return writer;
  }
  ~Writer() { dds_set_listener(entity_.get(), nullptr); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// `adjust` may set members that only the sample has.
  template <class Adjust>
  Result<void> write(const Message& message, Adjust adjust) {
    SampleOf<Message> sample;
    if (auto encoded = encode(message, sample); !encoded) return encoded;
    adjust(sample);
    const dds_return_t rc = dds_write(entity_.get(), &sample);
    if (rc == DDS_RETCODE_OK) return {};
    return fail(rc == DDS_RETCODE_TIMEOUT ? Errc::Timeout : Errc::Io, "DDS: writing {}: {}",
                Topic<Message>::kName, dds_strretcode(rc));
  }
  Result<void> write(const Message& message) {
    return write(message, [](auto&) {});
  }
  /// Without a reader, messages are lost.
  bool has_readers() const { return dds_get_matched_subscriptions(entity_.get(), nullptr, 0) > 0; }
  dds_entity_t get() const { return entity_.get(); }

 private:
  explicit Writer(std::function<void()> on_matched) : on_matched_(std::move(on_matched)) {}

  std::function<void()> on_matched_;
  Entity entity_;
};

}  // namespace dripline::dds
