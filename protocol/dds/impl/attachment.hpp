#pragma once

#include <optional>

#include "protocol/dds/impl/domain.hpp"
#include "protocol/dds/impl/peer_reader.hpp"
#include "protocol/dds/impl/writer.hpp"

namespace dripline::dds {

/// An Announce as it arrived.
struct Arrived {
  Announce announce;
  std::string heard;                 ///< the server its gateway is matched with
  dds_instance_handle_t writer = 0;  ///< its origin
  std::string participant;           ///< likewise, when the watcher has looked it up
};

/// The topics of the server, created once for all machines.
struct ServerTopics {
  Entity announce, status, record, command_result, block_request, record_ack, command, block_data,
      line_request, line_data;
  static Result<ServerTopics> create(const Domain& domain);
};

/// The server's entities for one machine, in the machine's partition. They stay when the machine is
/// lost, so that one that comes back finds them; their number is bounded by kMaxMachines, and then
/// a lost machine is dropped. The watcher owns the state.
struct Attachment {
  Entity publisher, subscriber;
  std::unique_ptr<Writer<RecordAck>> ack;
  std::unique_ptr<Writer<Command>> command;
  std::unique_ptr<Writer<BlockData>> block;
  std::unique_ptr<PeerReader<Status>> status;
  std::unique_ptr<PeerReader<Record>> record;
  std::unique_ptr<PeerReader<CommandResult>> command_result;
  std::unique_ptr<PeerReader<BlockRequest>> request;
  /// Null: the machine has no line of its own. What is lost before they are matched is repeated.
  std::unique_ptr<Writer<LineRequest>> line_request;
  std::unique_ptr<PeerReader<LineData>> line_data;
  bool has_line() const { return line_request != nullptr; }

  bool is_ready = false;           ///< on_announce was called, on_lost not since
  std::optional<Arrived> waiting;  ///< it names us, but not all of its endpoints are matched yet
  /// The participant of the machine's gateway, and its Announce's writer. It stays until it is
  /// lost, even if others announce the machine; empty: none.
  std::string gateway;
  dds_instance_handle_t announcer = 0;
  std::optional<Arrived> rival;       ///< the latest other participant that announced the machine
  std::optional<Announce> delivered;  ///< the latest argument of on_announce

  struct Whose {
    std::string machine;
    bool has_line = false;
    std::uint64_t term = 0;  ///< NetworkOptions::term
  };
  /// `handlers` and `rejections` must outlive the attachment.
  static Result<std::unique_ptr<Attachment>> create(const Domain& domain,
                                                    const ServerTopics& topics, const Whose& whose,
                                                    const ServerHandlers& handlers,
                                                    Rejections& rejections,
                                                    const std::function<void()>& on_matched);
  /// Whether all our readers and writers are matched with this participant.
  bool is_matched_with(const std::string& participant) const;
  /// Rejects messages of other participants for this machine; empty: those of all.
  void set_gateway(const std::string& participant);
  /// Status gets a reader that has its own idea of what comes next (qos.cpp), in place of the
  /// present one.
  Result<void> renew_status(const ServerTopics& topics, const std::string& machine,
                            const ServerHandlers& handlers, Rejections& rejections,
                            const std::function<void()>& on_matched);
  /// Looks up the participants of new writers.
  void resolve();
};

}  // namespace dripline::dds
