#include "protocol/dds/impl/attachment.hpp"

#include "protocol/dds/impl/matched.hpp"

namespace dripline::dds {
namespace {

/// A reader whose messages go directly to a handler of the server.
template <class Message>
Result<void> open_reader(std::unique_ptr<PeerReader<Message>>& reader, const Entity& subscriber,
                         const Entity& topic, const std::string& machine,
                         const std::function<void(Message)>& handler, Rejections& rejections,
                         const std::function<void()>& on_matched, Qos qos = reader_qos<Message>()) {
  auto created = PeerReader<Message>::create(subscriber, topic, rejections,
                                             {.machine = machine,
                                              .on_message =
                                                  [&handler](Message&& message) {
                                                    if (handler) handler(std::move(message));
                                                  },
                                              .wake = on_matched,
                                              .qos = std::move(qos)});
  if (!created) return fail(created.error());
  reader = std::move(*created);
  return {};
}

template <class Message>
Result<void> open_writer(std::unique_ptr<Writer<Message>>& writer, const Entity& publisher,
                         const Entity& topic, std::uint64_t term,
                         const std::function<void()>& on_matched) {
  auto created = Writer<Message>::create(publisher, topic, on_matched, term);
  if (!created) return fail(created.error());
  writer = std::move(*created);
  return {};
}

template <class Message>
Result<void> open_topic(Entity& topic, const Domain& domain) {
  auto created = create_topic<Message>(domain);
  if (!created) return fail(created.error());
  topic = std::move(*created);
  return {};
}

}  // namespace

Result<ServerTopics> ServerTopics::create(const Domain& domain) {
  ServerTopics topics;
  if (auto r = open_topic<Announce>(topics.announce, domain); !r) return fail(r.error());
  if (auto r = open_topic<Status>(topics.status, domain); !r) return fail(r.error());
  if (auto r = open_topic<Record>(topics.record, domain); !r) return fail(r.error());
  if (auto r = open_topic<CommandResult>(topics.command_result, domain); !r) return fail(r.error());
  if (auto r = open_topic<BlockRequest>(topics.block_request, domain); !r) return fail(r.error());
  if (auto r = open_topic<RecordAck>(topics.record_ack, domain); !r) return fail(r.error());
  if (auto r = open_topic<Command>(topics.command, domain); !r) return fail(r.error());
  if (auto r = open_topic<BlockData>(topics.block_data, domain); !r) return fail(r.error());
  if (auto r = open_topic<LineRequest>(topics.line_request, domain); !r) return fail(r.error());
  if (auto r = open_topic<LineData>(topics.line_data, domain); !r) return fail(r.error());
  return topics;
}

Result<std::unique_ptr<Attachment>> Attachment::create(const Domain& domain,
                                                       const ServerTopics& topics,
                                                       const Whose& whose,
                                                       const ServerHandlers& handlers,
                                                       Rejections& rejections,
                                                       const std::function<void()>& on_matched) {
  auto a = std::make_unique<Attachment>();
  const std::string& machine = whose.machine;
  const Qos partition = partition_qos(partition_of(machine));
  const dds_entity_t participant = domain.participant.get();
  auto publisher = own(dds_create_publisher(participant, partition.get(), nullptr), "publisher");
  if (!publisher) return fail(publisher.error());
  a->publisher = std::move(*publisher);
  auto subscriber = own(dds_create_subscriber(participant, partition.get(), nullptr), "subscriber");
  if (!subscriber) return fail(subscriber.error());
  a->subscriber = std::move(*subscriber);

  const auto reader = [&](auto& target, const Entity& topic, const auto& handler) {
    return open_reader(target, a->subscriber, topic, machine, handler, rejections, on_matched);
  };
  const auto writer = [&](auto& target, const Entity& topic) {
    return open_writer(target, a->publisher, topic, whose.term, on_matched);
  };
  if (auto r = writer(a->ack, topics.record_ack); !r) return fail(r.error());
  if (auto r = writer(a->command, topics.command); !r) return fail(r.error());
  if (auto r = writer(a->block, topics.block_data); !r) return fail(r.error());
  if (auto r = reader(a->status, topics.status, handlers.on_status); !r) return fail(r.error());
  if (auto r = reader(a->record, topics.record, handlers.on_record); !r) return fail(r.error());
  if (auto r = reader(a->command_result, topics.command_result, handlers.on_command_result); !r) {
    return fail(r.error());
  }
  if (auto r = reader(a->request, topics.block_request, handlers.on_request); !r) {
    return fail(r.error());
  }
  if (!whose.has_line) return a;
  if (auto r = writer(a->line_request, topics.line_request); !r) return fail(r.error());
  if (auto r = reader(a->line_data, topics.line_data, handlers.on_line_data); !r) {
    return fail(r.error());
  }
  return a;
}

void Attachment::set_gateway(const std::string& participant) {
  gateway = participant;
  status->set_peer(participant);
  record->set_peer(participant);
  command_result->set_peer(participant);
  request->set_peer(participant);
  if (line_data) line_data->set_peer(participant);
}

Result<void> Attachment::renew_status(const ServerTopics& topics, const std::string& machine,
                                      const ServerHandlers& handlers, Rejections& rejections,
                                      const std::function<void()>& on_matched) {
  auto renewed = open_reader(status, subscriber, topics.status, machine, handlers.on_status,
                             rejections, on_matched, renewed_status_qos());
  if (renewed) status->set_peer(gateway);
  return renewed;
}

void Attachment::resolve() {
  status->resolve();
  record->resolve();
  command_result->resolve();
  request->resolve();
  if (line_data) line_data->resolve();
}

bool Attachment::is_matched_with(const std::string& participant) const {
  return matched_with_writer(ack->get()).contains(participant) &&
         matched_with_writer(command->get()).contains(participant) &&
         matched_with_writer(block->get()).contains(participant) &&
         matched_with_reader(status->get()).contains(participant) &&
         matched_with_reader(record->get()).contains(participant) &&
         matched_with_reader(command_result->get()).contains(participant) &&
         matched_with_reader(request->get()).contains(participant);
}

}  // namespace dripline::dds
