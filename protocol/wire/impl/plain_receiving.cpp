#include "protocol/wire/impl/discipline_base.hpp"
#include "protocol/wire/impl/plain_line.hpp"

namespace dripline::wire {

namespace {

/// A sender that continues after our DC3 did not receive it: it is repeated after this many
/// characters.
constexpr std::size_t kStopAgain = 16;
/// A sender that stays silent after our DC1 may not have received it.
constexpr LineTime kReleaseAgain = std::chrono::seconds(1);

}  // namespace

Result<void> PlainLine::begin_receive(std::string_view name, LineTime now) {
  if (inbound_.is_open) return fail(reader_.rules().busy());
  if (is_dc_codes()) {
    if (const auto idle = check_idle(); !idle) return idle;
  }
  if (const auto can = reader_.rules().check_begin(); !can) return can;
  open_reception(std::string(name), now);
  start_reading();
  return {};
}

/// A control starts and stops the reader, or the host in its place.
void PlainLine::start_reading() {
  if (role_ != Role::Control) return;
  if (settings_.control.tape_start) return say(*settings_.control.tape_start);
  if (is_softly_held() && is_ready_) say(kDc1);
}

void PlainLine::stop_reading() {
  if (role_ != Role::Control) return;
  if (settings_.control.tape_stop) return say(*settings_.control.tape_stop);
  if (is_dc_codes()) say(kDc3);
}

void PlainLine::open_reception(std::string name, LineTime now) {
  inbound_ = {};
  inbound_.is_open = true;
  // A control waits for its host; a text that a host receives has begun.
  if (role_ == Role::Host) inbound_.heard = now;
  reader_.begin();
  after_stop_ = 0;
  // Between two texts the sender was not held.
  if (role_ == Role::Host && is_dc_codes() && !is_ready_) hold_off();
  emit(TransferBegan{true, std::move(name)});
}

void PlainLine::close_reception() {
  inbound_ = {};
}

void PlainLine::end_reception() {
  emit(TransferEnded{.is_receiving = true});
  close_reception();
  stop_reading();
}

/// No character ended it.
void PlainLine::cut_reception() {
  emit(TransferEnded{.is_receiving = true, .is_cut = true});
  close_reception();
  stop_reading();
}

/// A text that a host receives while it feeds is no program: the feed continues.
void PlainLine::fail_reception(Error error, LineTime now) {
  if (role_ == Role::Host && is_sending()) {
    emit_fault(std::move(error));
    cut_reception();
    return;
  }
  stop_reading();
  fail_transfer(std::move(error), now);
}

void PlainLine::take_data(std::byte character, LineTime now) {
  if (!inbound_.is_open) {
    // A control receives only on its operator's command. Leaders and line ends begin no text.
    if (role_ != Role::Host || !reader_.begins(character)) return;
    if (is_dc_codes()) emit_fault({Errc::Corrupt, "text came without DC2 before it"});
    open_reception("", now);
  }
  release_again_.reset();
  if (is_stop_said_ && is_overrun(now)) return;
  const auto read = reader_.read(character);
  if (!read) {
    fail_reception(read.error(), now);
  } else if (*read) {
    end_reception();
  } else if (reader_.has_begun()) {
    inbound_.heard = now;
  }
}

/// A character came although this end sent stop; returns whether that ends the reception.
bool PlainLine::is_overrun(LineTime now) {
  ++after_stop_;
  if (after_stop_ > settings_.control.buffer_size) {
    if (const auto error = reader_.rules().overrun(settings_.control.buffer_size)) {
      fail_reception(*error, now);
      return true;
    }
  }
  if (settings_.flow == Flow::XonXoff && after_stop_ % kStopAgain == 0) say(kDc3);
  return false;
}

/// Whether a host receives text that is no transfer: text before DC2 or before the start character,
/// or a DC2 with nothing after it. It must not keep a program from the line.
bool PlainLine::is_stray() const {
  if (!inbound_.is_open || role_ != Role::Host) return false;
  if (is_dc_codes()) return !inbound_.is_punch || !reader_.has_begun();
  return settings_.start_character && !reader_.has_mark();
}

/// The text that was received is kept.
void PlainLine::drop_stray() {
  reader_.finish();
  cut_reception();
}

void PlainLine::punch_on(LineTime now) {
  const bool follows_stray = inbound_.is_open && !inbound_.is_punch && reader_.has_begun();
  if (follows_stray) cut_reception();
  if (!inbound_.is_open) open_reception("", now);
  if (!inbound_.is_punch) {  // it begins now, or a host waited for it
    reader_.expect_print();
    inbound_.is_punch = true;
    return;
  }
  if (reader_.has_begun()) emit_fault({Errc::Corrupt, "DC2 came again inside a program"});
}

/// A program has its end character before DC4; printed text has neither mark.
void PlainLine::punch_off(LineTime now) {
  if (!inbound_.is_open) return;  // its end character has ended it
  if (reader_.is_framed() && reader_.has_mark()) {
    return fail_reception({Errc::Corrupt, "DC4 came before the end character"}, now);
  }
  reader_.finish();
  end_reception();
}

/// Silence ends an unframed reception and breaks off one that should end with a character.
std::optional<LineTime> PlainLine::silence_deadline() const {
  if (!inbound_.is_open || !inbound_.heard || !is_ready_) return std::nullopt;
  const bool is_framed = reader_.is_framed() || (is_dc_codes() && role_ == Role::Host);
  if (!is_framed) return *inbound_.heard + settings_.idle_end;
  const auto limit = pause_limit();
  return limit ? std::optional(*inbound_.heard + *limit) : std::nullopt;
}

/// A host may hold its control without limit; a host gives up.
std::optional<std::chrono::milliseconds> PlainLine::pause_limit() const {
  return role_ == Role::Host ? settings_.pause_limit : settings_.answer_limit;
}

void PlainLine::silent_too_long(LineTime now) {
  const bool is_punch = is_dc_codes() && role_ == Role::Host;
  if (reader_.is_framed() || is_punch) {
    const std::string_view what = reader_.is_framed() ? "the end character" : "DC4";
    return fail_reception({Errc::Timeout, fmt::format("{} did not come: silence for {} ms", what,
                                                      pause_limit()->count())},
                          now);
  }
  reader_.finish();
  cut_reception();
}

void PlainLine::hold_off() {
  say(kDc3);
  owes_dc1_ = role_ == Role::Host;
}

void PlainLine::set_ready(bool is_ready, LineTime now) {
  if (std::exchange(is_ready_, is_ready) == is_ready) return;
  is_stop_said_ = false;
  after_stop_ = 0;
  if (is_ready && inbound_.heard) inbound_.heard = now;        // this end caused the silence
  const bool is_reading = !is_dc_codes() || inbound_.is_open;  // DC1 starts an idle reader
  if (is_softly_held() && !is_ready && is_reading) hold_off();
  const bool owes_dc1 = is_ready && std::exchange(owes_dc1_, false);
  if (is_softly_held() && is_ready && (is_reading || owes_dc1)) say(kDc1);
  // Elsewhere DC1 asks for a program.
  const bool may_repeat = settings_.flow == Flow::XonXoff && !settings_.wait_for_xon;
  release_again_.reset();
  if (is_ready && may_repeat && inbound_.is_open) release_again_ = now + kReleaseAgain;
  if (settings_.flow == Flow::RtsCts) output_.rts = is_ready;
}

void PlainLine::next_program(std::string name) {
  emit(TransferEnded{.is_receiving = true});
  emit(TransferBegan{true, std::move(name)});
}

}  // namespace dripline::wire
