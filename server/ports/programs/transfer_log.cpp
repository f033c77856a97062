#include "server/ports/programs/transfer_log.hpp"

#include <algorithm>
#include <utility>

#include <fmt/ranges.h>

#include "gateway/line/line_words.hpp"
#include "protocol/base/random.hpp"
#include "protocol/process/log.hpp"

namespace dripline::ports {
namespace {

using End = storage::TransferState;

/// Whom the audit trail names for what the server finds or ends by itself.
constexpr const char* kServerAuthor = "dncd";

End end_state(SendOutcome outcome) {
  switch (outcome) {
    case SendOutcome::Completed:
      return End::Completed;
    case SendOutcome::Aborted:
      return End::Aborted;
    case SendOutcome::Interrupted:
      break;
  }
  return End::Interrupted;
}

std::string transfer_names(const storage::PortTransfer& transfer) {
  if (transfer.programs.empty()) return "a program";
  return fmt::format("{}", fmt::join(transfer.programs, ", "));
}

std::string killed_words(const storage::PortTransfer& transfer) {
  if (transfer.direction == storage::TransferDirection::Receive) {
    return fmt::format(
        "the server stopped while the control was asked for a program or sent one; at least {} "
        "bytes had come, nothing of it is stored: send it again at the control",
        transfer.passed);
  }
  if (transfer.at_most == 0) return "the server stopped before anything of it was sent";
  return fmt::format(
      "the server stopped; at least {} and at most {} of {} bytes were sent: the control may have "
      "a part of it, delete that there and send it again",
      transfer.passed, transfer.at_most, transfer.size);
}

std::string end_words(const storage::PortTransfer& transfer) {
  const std::string numbers = transfer.direction == storage::TransferDirection::Send
                                  ? fmt::format("{} of {} bytes", transfer.passed, transfer.size)
                                  : fmt::format("{} bytes", transfer.passed);
  return fmt::format("{}: {}, {}{}{}", to_string(transfer.state), transfer_names(transfer), numbers,
                     transfer.reason.empty() ? "" : ": ", transfer.reason);
}

class GuardedText final : public line::TextSource {
 public:
  GuardedText(std::shared_ptr<line::TextSource> source, std::shared_ptr<TransferLog> log,
              std::string id)
      : source_(std::move(source)), log_(std::move(log)), id_(std::move(id)) {}
  Result<std::string> read(std::uint64_t offset, std::uint64_t length) override {
    auto piece = source_->read(offset, length);
    if (!piece || piece->empty()) return piece;
    if (auto allowed = log_->allow(id_, offset + piece->size()); !allowed) return std::string();
    return piece;
  }

 private:
  const std::shared_ptr<line::TextSource> source_;
  const std::shared_ptr<TransferLog> log_;
  const std::string id_;
};

}  // namespace

Result<void> TransferLog::open() {
  const auto kept = parts_.ports.transfers(parts_.port);
  if (!kept) return fail(kept.error());
  for (const auto& transfer : *kept) {
    if (transfer.state == End::Active) {
      if (auto given_up = give_up(transfer); !given_up) return given_up;
      continue;
    }
    entry(transfer.direction).latest = transfer;
    show(transfer.direction, transfer);
  }
  return {};
}

/// The entry comes first: a kill between the two says it twice, and never not at all.
Result<void> TransferLog::give_up(Transfer transfer) {
  transfer.state = End::Interrupted;
  transfer.ended = parts_.clock.now();
  transfer.reason = killed_words(transfer);
  auto noted = note_end(
      transfer, fmt::format("interrupted: {}: {}", transfer_names(transfer), transfer.reason));
  if (!noted) return noted;
  if (auto saved = parts_.ports.save_transfer(transfer); !saved) return saved;
  process::log_warning("port={} id={} {}: {}", parts_.port, transfer.id, transfer_names(transfer),
                       transfer.reason);
  is_upload_broken_ = is_upload_broken_ || transfer.direction == Direction::Receive;
  entry(transfer.direction).latest = transfer;
  show(transfer.direction, transfer);
  return {};
}

std::optional<TransferLog::Transfer> TransferLog::latest(Direction direction) const {
  const std::lock_guard lock(mutex_);
  return direction == Direction::Send ? shown_sent_ : shown_received_;
}

void TransferLog::show(Direction direction, const std::optional<Transfer>& transfer) {
  const std::lock_guard lock(mutex_);
  (direction == Direction::Send ? shown_sent_ : shown_received_) = transfer;
}

TransferLog::Transfer* TransferLog::active(Direction direction) {
  auto& latest = entry(direction).latest;
  return latest && latest->state == End::Active ? &*latest : nullptr;
}

/// Said once, until it works again.
Result<void> TransferLog::store(Entry& entry) {
  auto saved = entry.latest ? parts_.ports.save_transfer(*entry.latest)
                            : parts_.ports.drop_transfer(*entry.dropped);
  entry.is_saved = saved.has_value();
  if (saved) entry.is_moving = false;
  if (!saved && !std::exchange(is_failing_, true)) {
    process::log_warning("port={}: what passes the line cannot be stored: {}", parts_.port,
                         saved.error().what);
  }
  if (saved) is_failing_ = false;
  return saved;
}

TransferLog::Transfer TransferLog::new_send(const SendJob& job) const {
  Transfer transfer;
  transfer.port = parts_.port;
  transfer.id = job.id;
  transfer.programs = line::programs_of(job);
  transfer.size = job.size;
  transfer.began = parts_.clock.now();
  return transfer;
}

Result<void> TransferLog::begin_send(const SendJob& job) {
  const bool was_saved = sent_.is_saved;
  sent_.before = std::exchange(sent_.latest, new_send(job));
  if (auto stored = store(sent_); !stored) {
    sent_.latest = std::exchange(sent_.before, std::nullopt);
    sent_.is_saved = was_saved;
    return stored;
  }
  show(Direction::Send, sent_.latest);
  return {};
}

void TransferLog::begin_answer(const SendJob& job) {
  if (active(Direction::Send) != nullptr) return;  // the line refuses it
  Transfer answer = new_send(job);
  answer.at_most = job.size;
  sent_.before = std::exchange(sent_.latest, std::move(answer));
  static_cast<void>(store(sent_));
  show(Direction::Send, sent_.latest);
}

void TransferLog::end_answer(const SendEnd& end) {
  line::is_cut_off(end) ? end_send(end) : take_back_send(end.progress.id);
}

void TransferLog::take_back_send(const std::string& id) {
  if (!sent_.latest || sent_.latest->id != id) return;
  sent_.dropped = std::exchange(sent_.latest, std::exchange(sent_.before, std::nullopt));
  static_cast<void>(store(sent_));
  show(Direction::Send, sent_.latest);
}

Result<void> TransferLog::allow(const std::string& id, std::uint64_t end) {
  Transfer* const transfer = active(Direction::Send);
  if (transfer == nullptr || transfer->id != id) return {};  // it is over: nothing leaves
  if (end <= transfer->at_most) return {};
  Transfer more = *transfer;
  more.at_most = end;
  auto noted = parts_.ports.note_progress(more);
  if (!noted) {
    if (!std::exchange(is_failing_, true)) {
      process::log_warning("port={} id={} waits: what may leave cannot be stored: {}", parts_.port,
                           id, noted.error().what);
    }
    return noted;
  }
  is_failing_ = false;
  *transfer = std::move(more);
  show(Direction::Send, *transfer);
  return {};
}

void TransferLog::note_sent(const SendProgress& progress) {
  Transfer* const transfer = active(Direction::Send);
  if (transfer == nullptr || transfer->id != progress.id) return;
  sent_.is_moving = sent_.is_moving || transfer->passed != progress.sent.bytes;
  transfer->passed = progress.sent.bytes;
}

void TransferLog::end_send(const SendEnd& end) {
  Transfer* const transfer = active(Direction::Send);
  if (transfer == nullptr || transfer->id != end.progress.id) return;
  transfer->passed = end.progress.sent.bytes;
  transfer->at_most = std::max(end.progress.offered, transfer->passed);
  this->end(Direction::Send, end_state(end.outcome), end.reason);
}

void TransferLog::end(Direction direction, End state, const std::string& reason) {
  Entry& entry = this->entry(direction);
  entry.latest->state = state;
  entry.latest->reason = reason;
  entry.latest->ended = parts_.clock.now();
  entry.before.reset();
  show(direction, entry.latest);
  static_cast<void>(store(entry));
  const Transfer& transfer = *entry.latest;
  // A program that came has its own entry.
  if (direction == Direction::Receive && state == End::Completed) return;
  if (auto noted = note_end(transfer, end_words(transfer)); !noted) {
    process::log_warning("port={} id={}: its end is not in the audit trail: {}", parts_.port,
                         transfer.id, noted.error().what);
  }
}

Result<void> TransferLog::note_end(const Transfer& transfer, const std::string& detail) const {
  const bool is_sent = transfer.direction == Direction::Send;
  return parts_.audit.add({.time = *transfer.ended,
                           .who = {kServerAuthor, "", ""},
                           .action = is_sent ? "port.sent" : "port.received",
                           .subject = parts_.port,
                           .detail = detail});
}

Result<void> TransferLog::begin_reception() {
  if (active(Direction::Receive) != nullptr) return {};
  Transfer transfer;
  transfer.port = parts_.port;
  transfer.direction = Direction::Receive;
  transfer.id = fmt::format("reception-{}", random_hex(4));
  transfer.began = parts_.clock.now();
  received_.latest = std::move(transfer);
  auto stored = store(received_);
  show(Direction::Receive, received_.latest);
  return stored;
}

void TransferLog::note_received(std::size_t bytes) {
  Transfer* const transfer = active(Direction::Receive);
  if (transfer == nullptr) return;
  transfer->passed += bytes;
  transfer->at_most = transfer->passed;
  received_.is_moving = true;
}

void TransferLog::end_reception(End state, const std::string& program, const std::string& reason) {
  Transfer* const transfer = active(Direction::Receive);
  if (transfer == nullptr) return;
  if (!program.empty()) transfer->programs = {program};
  if (state == End::Completed) transfer->size = transfer->passed;
  end(Direction::Receive, state, reason);
}

void TransferLog::save() {
  for (const auto direction : {Direction::Send, Direction::Receive}) {
    Entry& entry = this->entry(direction);
    if (!entry.is_saved) {
      static_cast<void>(store(entry));
      continue;
    }
    if (!entry.latest || !entry.is_moving || active(direction) == nullptr) continue;
    // Repeated soon by the next one.
    if (parts_.ports.note_progress(*entry.latest)) entry.is_moving = false;
    show(direction, entry.latest);
  }
}

std::shared_ptr<line::TextSource> guarded(std::shared_ptr<line::TextSource> source,
                                          std::shared_ptr<TransferLog> log, std::string id) {
  return std::make_shared<GuardedText>(std::move(source), std::move(log), std::move(id));
}

line::PortTransfer transfer_view(const storage::PortTransfer& transfer) {
  const auto state = [&] {
    const bool is_sent = transfer.direction == storage::TransferDirection::Send;
    switch (transfer.state) {
      case End::Active:
        return is_sent ? line::TransferState::Sending : line::TransferState::Receiving;
      case End::Completed:
        return line::TransferState::Completed;
      case End::Aborted:
        return line::TransferState::Aborted;
      case End::Interrupted:
        break;
    }
    return line::TransferState::Interrupted;
  }();
  return {.id = transfer.id,
          .programs = transfer.programs,
          .size = transfer.size,
          .sent = transfer.passed,
          .at_most = transfer.at_most,
          .state = state,
          .reason = transfer.reason,
          .began = transfer.began,
          .ended = transfer.ended};
}

}  // namespace dripline::ports
