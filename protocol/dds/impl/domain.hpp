#pragma once

#include "protocol/dds/configuration.hpp"
#include "protocol/dds/impl/entity.hpp"
#include "protocol/dds/impl/topic.hpp"

namespace dripline::dds {

/// One end's own domain (sockets and threads) and its participant. Every endpoint has its own, so
/// several in one process talk over the network as separate processes do.
struct Domain {
  Entity domain, participant;  // in this order: the participant goes first
  std::string key;             ///< GUID of the participant, 32 hexadecimal digits
};

/// Errors: Busy (server: another holds its port), Io, and those of the configuration.
Result<Domain> open_domain(const NetworkOptions& options, Role role);

template <class Message>
Result<Entity> create_topic(const Domain& domain) {
  return own(dds_create_topic(domain.participant.get(), &Topic<Message>::descriptor(),
                              Topic<Message>::kName, nullptr, nullptr),
             Topic<Message>::kName);
}

}  // namespace dripline::dds
