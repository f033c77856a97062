#pragma once

#include <optional>

#include "protocol/dds/impl/domain.hpp"
#include "protocol/dds/impl/reader.hpp"
#include "protocol/dds/impl/writer.hpp"

namespace dripline::dds {

/// An Announce whose gateway hears us, and the participant it came from.
struct Announced {
  Announce announce;
  std::string participant;
};

/// The topics of the server, created once for all machines.
struct ServerTopics {
  Entity announce, status, record, order_result, block_request, record_ack, order, block_data;
  static Result<ServerTopics> create(const Domain& domain);
};

/// The server's entities for one machine, in the machine's partition. They stay for the server's
/// life: a machine that comes back finds them, and their number is bounded by kMaxMachines.
/// The state is the watcher's.
struct Attachment {
  Entity publisher, subscriber;
  std::unique_ptr<Writer<RecordAck>> ack;
  std::unique_ptr<Writer<Order>> order;
  std::unique_ptr<Writer<BlockData>> block;
  std::unique_ptr<Reader<Status>> status;
  std::unique_ptr<Reader<Record>> record;
  std::unique_ptr<Reader<OrderResult>> order_result;
  std::unique_ptr<Reader<BlockRequest>> request;

  bool is_ready = false;              ///< on_announce was called, on_lost not since
  std::optional<Announced> waiting;   ///< heard us, but we are not yet matched with all of it
  std::string gateway;                ///< participant of the one that is ready
  std::optional<Announce> delivered;  ///< what on_announce was told last

  /// `handlers` and `rejections` must outlive the attachment.
  static Result<std::unique_ptr<Attachment>> create(const Domain& domain,
                                                    const ServerTopics& topics,
                                                    const std::string& machine,
                                                    const ServerHandlers& handlers,
                                                    Rejections& rejections,
                                                    const std::function<void()>& on_matched);
  /// All ways between us and this participant are open on our side.
  bool is_matched_with(const std::string& participant) const;
};

}  // namespace dripline::dds
