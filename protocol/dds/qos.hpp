#pragma once

#include "protocol/dds/impl/entity.hpp"
#include "protocol/dds/message.hpp"

/// The quality of service of every topic, with the reason for each. No other file sets QoS.
namespace dripline::dds {

/// The partition of one machine, and the one that matches all.
std::string partition_of(const std::string& machine);
std::string partition_of_all();

/// For a publisher or subscriber: a partition is fixed when it is created.
Qos partition_qos(const std::string& partition);

/// In the user data of a server's writers, which readers see when they are matched. 0: none.
void set_term(const Qos& qos, std::uint64_t term);
std::uint64_t term_in(const dds_qos_t* qos);

/// Of a reader of statuses that takes the place of one that gets none any more.
Qos renewed_status_qos();

/// Of a topic and its writers.
template <class Message>
Qos topic_qos();

/// Of a topic's readers: as that of the writers, or with less, so they always match.
template <class Message>
Qos reader_qos() {
  return topic_qos<Message>();
}

template <>
Qos topic_qos<Announce>();
template <>
Qos topic_qos<Status>();
template <>
Qos topic_qos<Record>();
template <>
Qos topic_qos<RecordAck>();
template <>
Qos topic_qos<Command>();
template <>
Qos topic_qos<CommandResult>();
template <>
Qos topic_qos<BlockRequest>();
template <>
Qos topic_qos<BlockData>();
template <>
Qos topic_qos<LineRequest>();
template <>
Qos topic_qos<LineData>();
template <>
Qos reader_qos<Status>();

}  // namespace dripline::dds
