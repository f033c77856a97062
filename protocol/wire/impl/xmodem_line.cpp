#include "protocol/wire/impl/xmodem_line.hpp"

#include "protocol/wire/impl/discipline_base.hpp"

/// The common part of both directions of XMODEM; see xmodem_sending.cpp and xmodem_receiving.cpp.
namespace dripline::wire {

using namespace xmodem;

namespace {

constexpr int kCancels = 5;  // any two in a row are enough
/// A receiver asks every three seconds (C) or ten (NAK): one that is silent for longer has given
/// up.
constexpr LineTime kRequestLife = std::chrono::seconds(15);

}  // namespace

std::unique_ptr<Discipline> make_xmodem(const LineSettings& settings, Role role) {
  return std::make_unique<XmodemLine>(settings, role);
}

XmodemLine::XmodemLine(const LineSettings& settings, Role role)
    : DisciplineBase(settings, role),
      checked_(settings.code, settings.end_of_block),
      encoder_(settings.code, settings.end_of_block),
      decoder_(settings.code) {}

void XmodemLine::receive(std::span<const std::byte> bytes, LineTime now) {
  for (const std::byte byte : bytes) take(byte, now);
}

void XmodemLine::take(std::byte character, LineTime now) {
  const char c = static_cast<char>(character);
  if (step_ == Step::InBlock) return take_block(character, now);
  if (is_canceled(c, now)) return;
  if (step_ == Step::Idle) return take_idle(c, now);
  if (is_sender_step()) return take_answer(c, now);
  take_block_start(c, now);
}

/// Two CAN in a row outside a block.
bool XmodemLine::is_canceled(char character, LineTime now) {
  const bool was_can = std::exchange(was_can_, character == kCan);
  if (!was_can || !was_can_ || step_ == Step::Idle) return false;
  fail_transfer({Errc::Denied, "the other end canceled the transfer (CAN)"}, now);
  return true;
}

void XmodemLine::take_idle(char character, LineTime now) {
  if (character == kEot && was_received_) return say(kAck);  // our answer was lost
  if (character != kNak && character != kCrcWanted) return;
  asked_at_ = now;
  check_ = character == kCrcWanted ? Check::Crc : Check::Sum;
  if (role_ != Role::Host) return;
  deadline_ = now + kRequestLife;
  if (!std::exchange(is_asked_, true)) {
    emit(TransferRequest{TransferRequest::Kind::SendProgram, ""});
  }
}

void XmodemLine::fault(LineFault /*fault*/, LineTime now) {
  was_can_ = false;
  if (step_ == Step::InBlock) {
    reader_.damage();
    take_block(std::byte{0}, now);
  } else if (step_ == Step::AwaitBlock || step_ == Step::AfterBlock || step_ == Step::AfterEot ||
             step_ == Step::Purge) {
    purge(now);
  }
  // An answer that cannot be read is no answer.
}

void XmodemLine::cancel() {
  for (int i = 0; i < kCancels; ++i) say(kCan);
}

void XmodemLine::give_up(Error error, LineTime now) {
  cancel();
  fail_transfer(std::move(error), now);
}

Result<void> XmodemLine::request(const TransferRequest& request, LineTime now) {
  using Kind = TransferRequest::Kind;
  if (role_ == Role::Control && request.kind == Kind::SendProgram) {
    return begin_receive(request.name, now);
  }
  return fail(Errc::Unsupported, "XMODEM has no characters to ask for that");
}

Result<void> XmodemLine::refuse(std::string_view /*reason*/, LineTime /*now*/) {
  if (!std::exchange(is_asked_, false)) {
    return fail(Errc::Conflict, "the other end asked for nothing");
  }
  drop_request();
  cancel();
  return {};
}

/// Nothing is in progress.
void XmodemLine::drop_request() {
  is_asked_ = false;
  asked_at_.reset();
  deadline_.reset();
}

void XmodemLine::abort(LineTime now) {
  if (step_ != Step::Idle) cancel();
  drop_transfer(now);
  drop_request();
}

void XmodemLine::transfer_over(LineTime /*now*/) {
  step_ = Step::Idle;
  deadline_.reset();
  asked_at_.reset();
  data_.clear();
  block_.clear();
  was_can_ = false;
}

LineState XmodemLine::state() const {
  LineState state;
  state.phase = phase_;
  state.text_sent = text_sent();
  state.is_stopping = !is_ready_;
  state.is_asked = is_asked_;
  if (step_ == Step::AwaitStart) state.waiting_for = "NAK";
  if (step_ == Step::AwaitAnswer || step_ == Step::AwaitEnd) state.waiting_for = "ACK";
  if (is_receiving() && step_ != Step::Withhold) state.waiting_for = "block";
  state.awaits_start = step_ == Step::AwaitStart;
  const bool has_limit = state.awaits_start ? deadline_.has_value() : !!settings_.answer_limit;
  state.may_wait_without_limit = !state.waiting_for.empty() && !has_limit;
  return state;
}

}  // namespace dripline::wire
