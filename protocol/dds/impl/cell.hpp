#pragma once

#include <atomic>
#include <condition_variable>
#include <map>
#include <mutex>
#include <shared_mutex>
#include <thread>

#include "protocol/dds/endpoint.hpp"
#include "protocol/dds/impl/attachment.hpp"

namespace dripline::dds {

/// The state that all cells of a server share.
struct ServerShared {
  ServerHandlers handlers;
  Rejections rejections;
  std::uint32_t cells = kFewestCells;
  std::uint64_t term = 0;                 ///< NetworkOptions::term
  std::atomic<std::size_t> machines = 0;  ///< attached so far

  /// A machine is in one cell at a time: that of its gateway, which may know of fewer cells than
  /// the server has. False: it is in another one; `wake` is called, with a lock held, when it has
  /// left that.
  bool claim(const std::string& machine, std::uint32_t cell, const std::function<void()>& wake);
  void release(const std::string& machine, std::uint32_t cell);
  /// The cell ends: it is not woken any more.
  void drop_waiting(std::uint32_t cell);
  /// The cell that has the machine; without one, where it is expected.
  std::uint32_t cell_with(const std::string& machine) const;

 private:
  struct Place {
    std::uint32_t cell = 0;
    std::map<std::uint32_t, std::function<void()>> waiting;  ///< by cell
  };
  mutable std::mutex mutex_;
  std::map<std::string, Place> places_;
};

/// One of the parts of a server: a domain of its own, with the machines that belong to it.
///
/// Threads: DDS threads deliver status, records, results and requests. `watcher_` does what must
/// not be done in a listener: it attaches machines, checks matched participants, and calls
/// on_announce and on_lost. No mutex is held while calling DDS or a handler.
class Cell {
 public:
  /// `shared` must outlive the cell.
  static Result<std::unique_ptr<Cell>> open(const NetworkOptions& options, std::uint32_t number,
                                            ServerShared& shared);
  ~Cell();
  Cell(const Cell&) = delete;
  Cell& operator=(const Cell&) = delete;

  /// As ServerEndpoint::write, for a machine of this cell.
  Result<void> write(const RecordAck& message) { return write_to(message, &Attachment::ack); }
  Result<void> write(const Command& message) { return write_to(message, &Attachment::command); }
  Result<void> write(const BlockData& message) { return write_to(message, &Attachment::block); }
  Result<void> write(const LineRequest& message) {
    return write_to(message, &Attachment::line_request);
  }
  /// As ServerEndpoint::renew_status.
  void renew_status(const std::string& machine);
  /// As ServerEndpoint::look_again, for all machines of this cell.
  void look_again() { wake_watcher(); }
  /// As ServerEndpoint::heard_gateways, in this cell.
  std::size_t heard_gateways() const;
  std::uint32_t number() const { return number_; }

 private:
  /// What happened to one machine since the watcher's last look: its announcement is gone, then
  /// these did, the latest of each writer.
  struct MachineNews {
    bool is_gone = false;
    bool is_silent = false;  ///< its statuses do not arrive
    std::map<dds_instance_handle_t, Arrived> announced;
  };
  using News = std::map<std::string, MachineNews>;

  Cell(Domain domain, ServerTopics topics, std::uint32_t number, ServerShared& shared)
      : domain_(std::move(domain)), topics_(std::move(topics)), number_(number), shared_(shared) {}

  template <class Message>
  Result<void> write_to(const Message& message,
                        std::unique_ptr<Writer<Message>> Attachment::*writer) {
    // Also before on_announce: a record that overtook it may be acknowledged.
    const auto machine = find(message.machine);
    if (machine != nullptr && (*machine).*writer == nullptr)
      return fail(Errc::Unsupported, "machine {} has no line of its own", message.machine);
    if (machine == nullptr || !((*machine).*writer)->has_readers()) {
      return fail(Errc::NotFound, "machine {} is not connected", message.machine);
    }
    return ((*machine).*writer)->write(message, [this](auto& sample) {
      sample.term = shared_.term;
    });
  }
  std::shared_ptr<Attachment> find(const std::string& machine) const {
    std::shared_lock lock(machines_mutex_);
    const auto found = machines_.find(machine);
    return found != machines_.end() ? found->second : nullptr;
  }

  Result<void> start();
  void post_announced(Arrived arrived);
  void post_gone(const std::string& machine);
  MachineNews* news_of(const std::string& machine);
  void wake_watcher();
  void watch(const std::stop_token& stop);
  void handle_lost(const std::string& machine);
  void handle_silent(const std::string& machine);
  void handle_announced(const std::string& machine, Arrived arrived);
  void handle_news_of_gateway(Attachment& attached, Arrived arrived);
  void lose(Attachment& attached, const std::string& machine);
  void drop(const std::string& machine);
  void set_rival(const std::string& machine, Attachment& attached, std::optional<Arrived> rival);
  void look_at_rival(const std::string& machine, Attachment& attached);
  bool speaks_for_another(const std::string& participant, const std::string& machine) const;
  bool has_room();
  bool claim(const std::string& machine);
  bool may_serve(const Arrived& arrived) const;
  void lose_gateway(const std::string& machine, Attachment& attached);
  std::shared_ptr<Attachment> attach(const std::string& machine, bool has_line);
  void try_ready(Attachment& machine);

  // Order matters: the listeners of readers and writers use the members above them.
  Domain domain_;
  ServerTopics topics_;
  std::uint32_t number_;
  ServerShared& shared_;

  std::mutex news_mutex_;
  std::condition_variable_any news_came_;
  News news_;
  bool matches_changed_ = false;

  Entity subscriber_;
  mutable std::shared_mutex machines_mutex_;
  std::map<std::string, std::shared_ptr<Attachment>> machines_;  // changed by the watcher only
  std::unique_ptr<Reader<Announce>> announces_;
  std::jthread watcher_;
};

}  // namespace dripline::dds
