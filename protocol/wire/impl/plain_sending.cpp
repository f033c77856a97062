#include "protocol/wire/impl/discipline_base.hpp"
#include "protocol/wire/impl/plain_line.hpp"

namespace dripline::wire {

Result<void> PlainLine::begin_send(std::string_view name, LineTime now) {
  if (const auto idle = check_idle(); !idle) return idle;
  if (is_dc_codes() && is_stray()) drop_stray();
  // A transfer that only waits continues to wait.
  if (is_dc_codes() && inbound_.is_open && reader_.has_begun()) {
    return fail(Errc::Busy, "the line is receiving");
  }
  is_asked_ = false;
  has_started_ = false;
  begin_transfer(Phase::Sending, std::string(name));
  writer_.begin();
  if (is_dc_codes() && role_ == Role::Control) say(kDc2);
  note_hold(now);
  return {};
}

Result<void> PlainLine::check_text(std::string_view text, std::size_t /*first_line*/) {
  return writer_.check(text);
}

std::size_t PlainLine::transmit(std::span<std::byte> room, LineTime now) {
  std::size_t count = take_controls(room);
  if (!is_ready_ && !has_controls()) is_stop_said_ = true;
  if (pause_until_ && *pause_until_ <= now) pause_until_.reset();
  while (is_sending() && count < room.size() && may_send() && !pause_until_) {
    const auto character = next_character();
    if (!character) break;
    room[count++] = *character;
    has_started_ = true;
    pause_after(count, writer_.ends_block(), now);
  }
  if (is_sending() && !may_send()) skip_said();
  // The control stopped us at the end character: it does not need the rest, so this end does not
  // wait.
  const bool is_over = writer_.is_done() || (writer_.is_all_said() && !may_send());
  if (is_sending() && is_text_taken() && is_over) finish_sending(now);
  return count;
}

/// Text after its end character is not significant: the rest is not sent.
void PlainLine::skip_said() {
  while (writer_.is_end_said() && writer_.wants_text()) {
    count_sent(std::exchange(text_under_way_, 0));
    if (has_text()) {
      writer_.put_text(queued_text().front());
      take_text(1);
      text_under_way_ = 1;
    } else if (is_last_offered()) {
      return writer_.end_text();
    } else {
      return;
    }
  }
}

/// nullopt: there is nothing to send until more text is offered.
std::optional<std::byte> PlainLine::next_character() {
  while (writer_.wants_text()) {
    count_sent(std::exchange(text_under_way_, 0));
    if (has_text()) {
      writer_.put_text(queued_text().front());
      take_text(1);
      text_under_way_ = 1;
    } else if (is_last_offered()) {
      writer_.end_text();
    } else {
      return std::nullopt;
    }
  }
  if (!writer_.has_next()) return std::nullopt;
  const std::byte character = writer_.next();
  if (!writer_.has_next()) count_sent(std::exchange(text_under_way_, 0));
  return character;
}

/// The pause begins when the character has left the line, which is `characters` character times
/// after now.
void PlainLine::pause_after(std::size_t characters, bool ends_block, LineTime now) {
  LineTime pause = settings_.character_delay;
  if (ends_block) pause += settings_.line_delay;
  if (pause <= LineTime::zero()) return;
  pause_until_ = now + static_cast<std::int64_t>(characters) * character_time_ + pause;
}

void PlainLine::finish_sending(LineTime now) {
  if (is_dc_codes() && role_ == Role::Control) say(kDc4);
  has_started_ = false;  // it is not broken off
  // The other direction continues.
  const Inbound inbound = inbound_;
  end_transfer(now);
  inbound_ = inbound;
}

void PlainLine::set_stopped(bool is_stopped, LineTime now) {
  if (std::exchange(is_stopped_, is_stopped) == is_stopped) return;
  emit(FlowChanged{is_stopped});
  note_hold(now);
}

/// The start of the wait for the other end's release.
void PlainLine::note_hold(LineTime now) {
  if (!is_sending() || may_send()) {
    held_since_.reset();
  } else if (!held_since_) {
    held_since_ = now;
  }
}

std::optional<LineTime> PlainLine::hold_deadline() const {
  if (!held_since_) return std::nullopt;
  const auto& limit =
      waits_for_dc1() && !has_started_ ? settings_.start_limit : settings_.hold_limit;
  if (!limit) return std::nullopt;
  return *held_since_ + *limit;
}

void PlainLine::held_too_long(LineTime now) {
  const auto waited = std::chrono::duration_cast<std::chrono::milliseconds>(now - *held_since_);
  const std::string_view what = !is_stopped_ ? "CTS stayed off"
                                : waits_for_dc1() && !has_started_
                                    ? "no DC1 came to start"
                                    : "the other end held us with DC3";
  Error error{Errc::Timeout, fmt::format("{} for {} ms", what, waited.count())};
  fail_transfer(reader_.rules().sending_failed(std::move(error)), now);
}

}  // namespace dripline::wire
