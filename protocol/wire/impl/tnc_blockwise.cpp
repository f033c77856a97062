#include "protocol/wire/impl/tnc_blockwise.hpp"

#include <algorithm>

namespace dripline::wire {
namespace {

/// Longer than any sender's pause inside a block.
constexpr LineTime kBlockSilence = std::chrono::seconds(1);
/// After this time an answer is being withheld.
constexpr LineTime kHoldSeen = std::chrono::seconds(2);

std::string_view text_of(std::string_view line) {
  if (line.ends_with('\n')) line.remove_suffix(1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

}  // namespace

TncBlockwise::TncBlockwise(const LineSettings& settings, Role role)
    : DisciplineBase(settings, role), reader_(settings.heidenhain) {}

// From the line

void TncBlockwise::receive(std::span<const std::byte> bytes, LineTime now) {
  for (const auto byte : bytes) {
    if (const auto frame = reader_.read(static_cast<std::uint8_t>(byte))) handle(*frame, now);
    silence_ = reader_.is_inside() ? std::optional(now + kBlockSilence) : std::nullopt;
  }
}

void TncBlockwise::fault(LineFault, LineTime now) {
  if (const auto frame = reader_.fault()) handle(*frame, now);
  silence_ = reader_.is_inside() ? std::optional(now + kBlockSilence) : std::nullopt;
}

void TncBlockwise::handle(const TncFrame& frame, LineTime now) {
  using enum TncFrame::Kind;
  switch (frame.kind) {
    case Heading:
      return on_heading(frame.text, now);
    case Block:
    case Broken:
      return on_block(frame, now);
    case Ack:
    case Nak:
      if (wait_ == Wait::BlockAnswer) return on_block_answer(frame.kind == Ack, now);
      return frame.kind == Ack ? on_ack(now) : on_nak(now);
    case Etx:
      return on_etx(now);
    case Eot:
      return on_eot(now);
    case Noise:
      return on_noise(now);
  }
}

/// An answer applies when the whole block is out; an earlier one is a repeated answer to the block
/// before.
void TncBlockwise::on_block_answer(bool is_good, LineTime now) {
  if (!is_out_heard(now)) return;
  set_stopped(false);
  is_garbled_ = false;
  if (!is_good) {
    const auto text = block_.substr(1, block_.find(settings_.heidenhain.etb) - 1);
    emit_fault({Errc::Corrupt, fmt::format("the other end refused the block '{}'", text_of(text))});
    if (may_try_again()) return resend_block(now);
    return give_up({Errc::Corrupt, fmt::format("a block was refused {} times", tries_ + 1)}, now);
  }
  block_.clear();
  accepted_ += block_bytes_;
  wait_for(Wait::Nothing, std::nullopt);
  emit(TextAccepted{accepted_});
  send_next(now);
}

void TncBlockwise::on_noise(LineTime now) {
  if (wait_ != Wait::BlockAnswer || !is_out_empty() || is_garbled_) return;
  is_garbled_ = true;
  const auto limit = after_answer_limit(now);
  if (limit && (!limit_ || *limit < *limit_)) limit_ = limit;
}

void TncBlockwise::on_block(const TncFrame& frame, LineTime now) {
  const bool is_good = frame.kind == TncFrame::Kind::Block;
  if (!is_receiving() || wait_ != Wait::Block || owes_ack_) {
    if (!is_receiving()) on_stray_block(now);
    return;
  }
  if (is_good) return take_block(frame.text, now);
  emit_fault({Errc::Corrupt, fmt::format("a block came {}", frame.text)});
  if (!may_try_again()) {
    return give_up({Errc::Corrupt, fmt::format("a block came wrong {} times", tries_ + 1)}, now);
  }
  queue_control(settings_.heidenhain.nak);
  wait_for(Wait::Block, limit_);
}

void TncBlockwise::take_block(const std::string& text, LineTime now) {
  begin_tries();
  if (has_received_ && text == last_line_ && is_numbered(text)) {
    emit_fault({Errc::Corrupt, fmt::format("the block '{}' came twice", text)});
  } else {
    if (!has_received_) first_line_ = text;
    has_received_ = true;
    last_line_ = text;
    emit_text(text + "\n");
  }
  acknowledge(now);
}

void TncBlockwise::acknowledge(LineTime now) {
  owes_ack_ = !is_ready_;
  if (owes_ack_) return wait_for(Wait::Block, std::nullopt);
  queue_control(settings_.heidenhain.ack);
  const bool is_host = role_ == Role::Host;
  wait_for(Wait::Block,
           is_host ? after_pause_limit(now, settings_.retries + 1) : after_hold_limit(now));
}

void TncBlockwise::set_ready(bool is_ready, LineTime now) {
  is_ready_ = is_ready;
  if (is_ready && owes_ack_) acknowledge(now);
}

void TncBlockwise::tick(LineTime now) {
  if (silence_ && *silence_ <= now) {
    silence_.reset();
    if (const auto frame = reader_.silence()) handle(*frame, now);
  }
  if (hold_seen_ && *hold_seen_ <= now) {
    hold_seen_.reset();
    set_stopped(true);
  }
  if (!limit_ || *limit_ > now) return;
  limit_.reset();
  wait_ == Wait::BlockAnswer ? on_block_limit(now) : on_limit(now);
}

void TncBlockwise::on_block_limit(LineTime now) {
  if (repeats_unanswered() && may_try_again()) return resend_block(now);
  give_up({Errc::Timeout,
           is_garbled_ ? "the answer to a block was spoiled on the line" : "no ACK in time"},
          now);
}

std::optional<LineTime> TncBlockwise::deadline() const {
  std::optional<LineTime> next = silence_;
  for (const auto& time : {is_out_empty() ? limit_ : std::nullopt, hold_seen_}) {
    if (time) next = next ? std::min(*next, *time) : time;
  }
  return next;
}

// To the line

std::size_t TncBlockwise::transmit(std::span<std::byte> room, LineTime now) {
  std::size_t count = take_controls(room);
  const bool had_out = !is_out_empty();
  for (; count < room.size() && !is_out_empty(); ++count) {
    room[count] = static_cast<std::byte>(out_[out_at_++]);
  }
  if (had_out && is_out_empty()) out_sent(now);
  return count;
}

void TncBlockwise::out_sent(LineTime now) {
  if (wait_ == Wait::BlockAnswer) {
    if (!is_counted_) count_sent(block_bytes_);
    is_counted_ = true;
    is_garbled_ = false;
    hold_seen_ = now + kHoldSeen;
    limit_ = repeats_unanswered() ? after_answer_limit(now) : after_hold_limit(now);
  } else if (wait_ == Wait::HeadingAnswer || wait_ == Wait::EndAnswer) {
    limit_ = after_answer_limit(now);
  }
  on_out_sent(now);
}

void TncBlockwise::put_out(std::string characters, std::size_t tail) {
  out_ = std::move(characters);
  out_at_ = 0;
  out_tail_ = tail;
}

/// The other end answers when it has the BCC, while the following DC1 is still on the line.
bool TncBlockwise::is_out_heard(LineTime now) {
  if (is_out_empty()) return true;
  if (out_.size() - out_at_ > out_tail_) return false;
  while (!is_out_empty()) queue_control(out_[out_at_++]);
  out_sent(now);
  return true;
}

void TncBlockwise::send_block(std::string_view line, std::size_t bytes) {
  const auto& tnc = settings_.heidenhain;
  block_ = make_tnc_block(tnc.stx, line, tnc);
  block_tail_ = role_ == Role::Control || tnc.sends_dc1_after_block ? 1 : 0;
  block_.append(block_tail_, kDc1);
  block_bytes_ = bytes;
  is_counted_ = false;
  begin_tries();
  put_out(block_, block_tail_);
  wait_for(Wait::BlockAnswer, std::nullopt);
}

void TncBlockwise::resend_block(LineTime) {
  put_out(block_, block_tail_);
  wait_for(Wait::BlockAnswer, std::nullopt);
}

void TncBlockwise::send_next(LineTime now) {
  if (!is_sending() || wait_ != Wait::Nothing) return;
  while (has_text()) {
    const auto text = queued_text();
    const auto end = text.find('\n');
    if (end == text.npos && !is_last_offered()) return;
    const std::string line(text.substr(0, end == text.npos ? end : end + 1));
    take_text(line.size());
    if (!text_of(line).empty()) return send_block(text_of(line), line.size());
    accepted_ += line.size();  // the protocol has no empty blocks
    count_sent(line.size());
  }
  if (is_text_taken()) send_end(now);
}

Result<void> TncBlockwise::check_text(std::string_view text, std::size_t line) {
  const auto& tnc = settings_.heidenhain;
  for (const char c : text) {
    if (c == '\n') {
      ++line;
      column_ = 0;
      continue;
    }
    if (c == '\r') continue;
    const bool is_text = c >= ' ' && c < 0x7F && c != tnc.etb && c != tnc.stx && c != tnc.soh;
    if (!is_text) {
      return fail(Errc::Syntax,
                  "line {}, column {}: character 0x{:02X} cannot stand in a TNC block", line,
                  column_ + 1, static_cast<unsigned>(static_cast<unsigned char>(c)));
    }
    if (++column_ > kMaxTncLine) {
      return fail(Errc::Syntax, "line {}: longer than {} characters", line, kMaxTncLine);
    }
  }
  return {};
}

// Calls of the owner, and the common part of both roles

void TncBlockwise::wait_for(Wait wait, std::optional<LineTime> limit) {
  wait_ = wait;
  limit_ = limit;
  hold_seen_.reset();
}

void TncBlockwise::begin_receiving(std::string name, LineTime now) {
  begin_transfer(Phase::Receiving, std::move(name));
  begin_tries();
  const bool is_host = role_ == Role::Host;
  wait_for(Wait::Block,
           is_host ? after_pause_limit(now, settings_.retries + 1) : after_hold_limit(now));
}

void TncBlockwise::transfer_over(LineTime) {
  wait_for(Wait::Nothing, std::nullopt);
  set_stopped(false);
  out_.clear();
  block_.clear();
  first_line_.clear();
  last_line_.clear();
  out_at_ = column_ = 0;
  accepted_ = 0;
  tries_ = 0;
  owes_ack_ = has_received_ = is_garbled_ = false;
}

Result<void> TncBlockwise::check_complete() const {
  const TncLine first = read_tnc_line(first_line_), last = read_tnc_line(last_line_);
  if (!has_received_) return fail(Errc::Corrupt, "the program has no block");
  if (first.kind != TncLineKind::Begin || last.kind == TncLineKind::End) return {};
  return fail(Errc::Corrupt, "program incomplete: it begins with '{}' and ends with '{}'",
              first_line_, last_line_);
}

void TncBlockwise::give_up(Error error, LineTime now) {
  fail_transfer(std::move(error), now);
  tell_abort("PROGRAM INCOMPLETE");
}

void TncBlockwise::abort(LineTime now) {
  drop_request();
  if (phase_ == Phase::Idle) return;
  const bool is_known_there = wait_ != Wait::Heading;
  drop_transfer(now);
  if (is_known_there) tell_abort("ABORTED");
}

bool TncBlockwise::may_try_again() {
  if (tries_ >= settings_.retries) return false;
  ++tries_;
  return true;
}

std::optional<LineTime> TncBlockwise::after_answer_limit(LineTime now, unsigned times) const {
  if (!settings_.answer_limit) return std::nullopt;
  return now + *settings_.answer_limit * times;
}

/// Waits so that the control can repeat a block that got no answer.
std::optional<LineTime> TncBlockwise::after_pause_limit(LineTime now, unsigned times) const {
  return now + settings_.pause_limit * times;
}

std::optional<LineTime> TncBlockwise::after_hold_limit(LineTime now) const {
  if (!settings_.hold_limit) return std::nullopt;
  return now + *settings_.hold_limit;
}

void TncBlockwise::set_stopped(bool is_stopped) {
  if (is_stopped_ == is_stopped) return;
  is_stopped_ = is_stopped;
  emit(FlowChanged{is_stopped});
}

bool TncBlockwise::has_no_limit() const {
  const bool is_host = role_ == Role::Host;
  if (wait_ == Wait::Heading) return !limit_;
  if (owes_ack_) return true;
  if (wait_ == Wait::Block) return !is_host && !settings_.hold_limit;
  if (wait_ != Wait::BlockAnswer) return false;
  return !(repeats_unanswered() ? settings_.answer_limit : settings_.hold_limit);
}

LineState TncBlockwise::state() const {
  constexpr std::string_view kWords[] = {"", "heading", "ACK", "ACK", "block", "EOT", "EOT"};
  LineState state;
  state.phase = phase_;
  state.is_stopped = is_stopped_;
  state.is_stopping = !is_ready_;
  state.waiting_for = kWords[static_cast<std::size_t>(wait_)];
  state.may_wait_without_limit = has_no_limit();
  state.is_asked = is_asked();
  state.awaits_start = is_sending() && wait_ == Wait::Heading;
  state.text_sent = text_sent();
  return state;
}

}  // namespace dripline::wire
