#pragma once

#include "protocol/dds/configuration.hpp"
#include "protocol/dds/impl/entity.hpp"
#include "protocol/dds/impl/topic.hpp"

namespace dripline::dds {

/// A gateway's or cell's own domain (sockets and threads) and its participant. Each has its own, so
/// that several in one process use the network like separate processes.
struct Domain {
  Entity domain, participant;  // in this order: the participant is deleted first
  std::string key;             ///< GUID of the participant, 32 hexadecimal digits
};

/// Errors: Busy (another server has the port), Io, and those of the configuration.
Result<Domain> open_domain(const NetworkOptions& options, Role role, std::uint32_t cell);

template <class Message>
Result<Entity> create_topic(const Domain& domain) {
  return own(dds_create_topic(domain.participant.get(), &Topic<Message>::descriptor(),
                              Topic<Message>::kName, nullptr, nullptr),
             Topic<Message>::kName);
}

}  // namespace dripline::dds
