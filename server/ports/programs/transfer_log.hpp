#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "protocol/base/clock.hpp"
#include "server/ports/line_types.hpp"
#include "storage/store.hpp"

namespace dripline::ports {

/// Programs that pass a port's line without a run, in both directions. The store has the latest of
/// each with its end: one whose server was killed is found by the next server, and so is how much
/// of it may have left. On the machine's strand, but for `latest`.
class TransferLog {
 public:
  using Direction = storage::TransferDirection;
  using Transfer = storage::PortTransfer;
  struct Parts {
    storage::PortStore& ports;
    storage::AuditStore& audit;
    const Clock& clock;
    std::string port;
  };
  explicit TransferLog(Parts parts) : parts_(std::move(parts)) {}

  /// Before the line is used. What was in progress when another server, or this one before, was
  /// killed ends Interrupted: in the store, the audit trail and the log. Errors: those of the
  /// store.
  Result<void> open();
  /// A program that the control sent was cut off by that. True once.
  bool take_broken_upload() { return std::exchange(is_upload_broken_, false); }
  /// Any thread.
  std::optional<Transfer> latest(Direction direction) const;

  /// Before anything of it leaves. Errors: those of the store; it must not begin then.
  Result<void> begin_send(const SendJob& job);
  /// What a control gets by a rule, and reads at once: it is stored while it is on the line, and
  /// longer if it was cut off. It leaves also while the store is away.
  void begin_answer(const SendJob& job);
  void end_answer(const SendEnd& end);
  /// Before its text up to there may leave. Errors: those of the store; it must wait then.
  Result<void> allow(const std::string& id, std::uint64_t end);
  void note_sent(const SendProgress& progress);
  void end_send(const SendEnd& end);
  /// It was not begun after all: what was before is the latest again, or nothing.
  void take_back_send(const std::string& id);

  /// The control is asked for a program, or sends one; nothing happens while one is awaited or
  /// comes. Errors: those of the store, which `save` tries again.
  Result<void> begin_reception();
  bool is_receiving() const {
    return received_.latest && received_.latest->state == storage::TransferState::Active;
  }
  void note_received(std::size_t bytes);
  /// `program`: what is stored; empty: nothing is, as `reason` says.
  void end_reception(storage::TransferState state, const std::string& program,
                     const std::string& reason);
  /// Some times a second: stores how far it is, and what could not be stored before.
  void save();

 private:
  struct Entry {
    std::optional<Transfer> latest, before;
    std::optional<Transfer> dropped = {};  ///< there is none, but the store may have this yet
    bool is_saved = true;                  ///< the store has its beginning, or its end
    bool is_moving = false;                ///< its numbers have changed since they were stored
  };
  Entry& entry(Direction direction) { return direction == Direction::Send ? sent_ : received_; }
  Transfer* active(Direction direction);
  Transfer new_send(const SendJob& job) const;
  void show(Direction direction, const std::optional<Transfer>& transfer);
  Result<void> store(Entry& entry);
  void end(Direction direction, storage::TransferState state, const std::string& reason);
  /// In the audit trail. Errors: those of the store.
  Result<void> note_end(const Transfer& transfer, const std::string& detail) const;
  Result<void> give_up(Transfer transfer);

  const Parts parts_;
  Entry sent_, received_;
  bool is_upload_broken_ = false;
  bool is_failing_ = false;  ///< and the log has it
  mutable std::mutex mutex_;
  std::optional<Transfer> shown_sent_, shown_received_;
};

/// The text of a job whose bytes leave only after the log has stored that they may. Never near: it
/// waits for the store, and is asked for again by PortLine::on_text.
std::shared_ptr<line::TextSource> guarded(std::shared_ptr<line::TextSource> source,
                                          std::shared_ptr<TransferLog> log, std::string id);

/// As a port's view has it.
line::PortTransfer transfer_view(const storage::PortTransfer& transfer);

}  // namespace dripline::ports
