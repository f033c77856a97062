#pragma once

#include "protocol/dds/impl/matched.hpp"
#include "protocol/dds/impl/reader.hpp"
#include "protocol/dds/impl/sources.hpp"

namespace dripline::dds {

/// Delivers the messages of one participant; those of others are rejected and counted. Its owner
/// has a watcher thread, which calls `resolve` after each call of `wake`.
template <class Message>
class PeerReader {
 public:
  struct Options {
    std::string machine;  ///< samples with another key are rejected
    std::function<void(Message)> on_message;
    std::function<void()> wake;
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
                                     [sources = &reader->sources_](Message message, const auto&,
                                                                   dds_instance_handle_t writer) {
                                       sources->take(writer, std::move(message));
                                     },
                                 .on_gone = {},
                                 .on_matched = options.wake});
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
