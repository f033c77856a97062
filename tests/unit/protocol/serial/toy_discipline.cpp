#include "tests/unit/protocol/serial/toy_discipline.hpp"

namespace dripline::serial {

using namespace wire;

void ToyDiscipline::receive(std::span<const std::byte> bytes, LineTime) {
  std::string text;
  for (const std::byte byte : bytes) {
    const char character = static_cast<char>(byte);
    if (character == kXoff || character == kXon) {
      is_stopped_ = character == kXoff;
      events_.emplace_back(FlowChanged{is_stopped_});
    } else {
      text += character;
    }
  }
  if (!text.empty()) events_.emplace_back(TextReceived{std::move(text)});
}

void ToyDiscipline::fault(LineFault fault, LineTime) {
  events_.emplace_back(
      LineError{Error{Errc::Corrupt, fmt::format("fault {}", static_cast<int>(fault))}});
}

void ToyDiscipline::lines(InputLines lines, LineTime) {
  if (cts_ != lines.cts) events_.emplace_back(FlowChanged{!lines.cts});
  cts_ = lines.cts;
}

std::size_t ToyDiscipline::transmit(std::span<std::byte> room, LineTime) {
  if (phase_ != Phase::Sending || is_stopped_ || !cts_) return 0;
  std::size_t count = 0;
  while (count < room.size() && !text_.empty()) {
    room[count++] = static_cast<std::byte>(text_.front());
    text_.pop_front();
  }
  if (text_.empty() && has_last_) {
    phase_ = Phase::Idle;
    events_.emplace_back(TransferEnded{});
  }
  return count;
}

Result<void> ToyDiscipline::begin_send(std::string_view, LineTime) {
  if (phase_ != Phase::Idle) return fail(Errc::Busy, "a transfer is in progress");
  phase_ = Phase::Sending;
  has_last_ = false;
  return {};
}

Result<void> ToyDiscipline::offer(std::string_view text, bool is_last, LineTime) {
  if (text.size() > room()) return fail(Errc::LimitExceeded, "more than room");
  text_.insert(text_.end(), text.begin(), text.end());
  has_last_ = is_last;
  return {};
}

Result<void> ToyDiscipline::begin_receive(std::string_view, LineTime) {
  phase_ = Phase::Receiving;
  return {};
}

void ToyDiscipline::abort(LineTime) {
  phase_ = Phase::Idle;
  text_.clear();
}

LineState ToyDiscipline::state() const {
  return {.phase = phase_,
          .is_stopped = is_stopped_,
          .is_stopping = !is_ready_,
          .waiting_for = is_stopped_ ? "DC1" : "",
          .may_wait_without_limit = false};
}

}  // namespace dripline::serial
