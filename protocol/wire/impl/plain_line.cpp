#include "protocol/wire/impl/plain_line.hpp"

#include "protocol/wire/impl/discipline_base.hpp"

/// The common part of both directions of a plain line; see plain_sending.cpp and
/// plain_receiving.cpp.
namespace dripline::wire {

std::unique_ptr<Discipline> make_plain(const LineSettings& settings, Role role) {
  return std::make_unique<PlainLine>(settings, role);
}

PlainLine::PlainLine(const LineSettings& settings, Role role)
    : DisciplineBase(settings, role),
      writer_(settings_),
      reader_(settings_, role, *this),
      character_time_(character_time(settings)),
      is_stopped_(waits_for_dc1()) {}

/// Characters that start and stop; in EIA there are none, and make_discipline refuses the settings.
void PlainLine::say(char dc) {
  if (const auto row = to_line(settings_.code, dc)) queue_control(static_cast<char>(*row));
}

void PlainLine::receive(std::span<const std::byte> bytes, LineTime now) {
  for (const std::byte byte : bytes) {
    const auto plain = from_line(settings_.code, byte);
    if (plain && take_dc(*plain, now)) continue;
    take_data(byte, now);
  }
}

/// Whether `dc` controls the line.
bool PlainLine::take_dc(char dc, LineTime now) {
  if (waits_for_dc1() && dc == settings_.control.tape_start) dc = kDc1;
  if (!understands_dc1() || dc < kDc1 || dc > kDc4) return false;
  if (dc == kDc2 || dc == kDc4) {
    if (!is_dc_codes() || role_ != Role::Host) return false;
    dc == kDc2 ? punch_on(now) : punch_off(now);
    return true;
  }
  if (dc == kDc1 && !has_started_ && std::exchange(is_release_due_, false)) {
    emit_fault({Errc::Conflict,
                "DC1 came for the program that was broken off, and starts nothing: reset the "
                "control and start again"});
    emit(ReleaseRefused{});
    return true;
  }
  set_stopped(dc == kDc3, now);
  if (dc == kDc3) is_asked_ = is_release_due_ = false;  // it stops the reader it had started
  if (dc == kDc1 && waits_for_dc1() && !is_sending() && !std::exchange(is_asked_, true)) {
    emit(TransferRequest{TransferRequest::Kind::SendProgram, ""});
  }
  return true;
}

void PlainLine::fault(LineFault fault, LineTime now) {
  if (!inbound_.is_open) {
    emit_fault({Errc::Corrupt, std::string(fault_text(fault)) + " on the line"});
    return;
  }
  inbound_.heard = now;
  if (const auto read = reader_.read_fault(fault); !read) fail_reception(read.error(), now);
}

void PlainLine::lines(InputLines lines, LineTime now) {
  const bool had_cts = input_.cts;
  const bool is_gone = input_.dsr && !lines.dsr;
  const bool is_cut = has_lost_dsr(lines);
  DisciplineBase::lines(lines, now);
  if (is_cut) is_release_due_ = false;  // it was switched off, or another one is connected next
  if (is_gone && !is_sending()) drop_request();
  if (is_cut && role_ == Role::Host && is_sending() && has_started_) {
    fail_transfer(cut_off(), now);  // the amount of lost text is unknown
    return;
  }
  if (settings_.flow == Flow::RtsCts && had_cts != lines.cts) {
    emit(FlowChanged{!lines.cts});
    note_hold(now);
  }
  if (!lines.dsr && inbound_.is_open) {
    if (const auto error = reader_.rules().not_ready()) fail_reception(*error, now);
  }
}

void PlainLine::tick(LineTime now) {
  if (pause_until_ && *pause_until_ <= now) pause_until_.reset();
  if (const auto at = hold_deadline(); at && *at <= now) held_too_long(now);
  if (const auto at = silence_deadline(); at && *at <= now) silent_too_long(now);
  if (release_again_ && *release_again_ <= now) {
    release_again_.reset();
    say(kDc1);
  }
}

std::optional<LineTime> PlainLine::deadline() const {
  std::optional<LineTime> first;
  for (const auto& at : {is_sending() && may_send() ? pause_until_ : std::nullopt, hold_deadline(),
                         silence_deadline(), release_again_}) {
    if (at && (!first || *at < *first)) first = at;
  }
  return first;
}

Result<void> PlainLine::request(const TransferRequest& request, LineTime now) {
  using Kind = TransferRequest::Kind;
  if (role_ == Role::Control && request.kind == Kind::SendProgram) {
    return begin_receive(request.name, now);
  }
  return fail(Errc::Unsupported, "this line has no characters to ask for that");
}

Result<void> PlainLine::refuse(std::string_view /*reason*/, LineTime /*now*/) {
  if (!std::exchange(is_asked_, false)) {
    return fail(Errc::Conflict, "the other end asked for nothing");
  }
  is_stopped_ = waits_for_dc1();  // the requesting DC1 is used
  return {};
}

/// A control that needs a program after this sends another DC1.
void PlainLine::drop_request() {
  if (std::exchange(is_asked_, false)) is_stopped_ = waits_for_dc1();
}

void PlainLine::abort(LineTime now) {
  const bool was_punching = is_sending() && is_dc_codes() && role_ == Role::Control;
  const bool was_reading = inbound_.is_open;
  if (was_punching) say(kDc4);
  if (was_reading) stop_reading();
  drop_transfer(now);
  is_asked_ = false;
  is_stopped_ = waits_for_dc1();
}

/// The object is idle, whichever direction failed or was dropped. A control that held us in the
/// middle sends DC1 when it has room for the rest. That is no request for another program.
void PlainLine::transfer_over(LineTime /*now*/) {
  if (waits_for_dc1() && has_started_ && is_stopped_) is_release_due_ = true;
  text_under_way_ = 0;
  has_started_ = false;
  held_since_.reset();
  pause_until_.reset();
  release_again_.reset();
  close_reception();
  if (waits_for_dc1()) is_stopped_ = true;
}

LineState PlainLine::state() const {
  LineState state;
  state.phase = !is_sending() && inbound_.is_open ? Phase::Receiving : phase_;
  state.is_stopped = !may_send();
  state.is_stopping = !is_ready_;
  state.is_asked = is_asked_;
  state.text_sent = text_sent();
  if (is_sending() && !may_send()) {
    state.waiting_for = is_stopped_ ? "DC1" : "CTS";
    state.may_wait_without_limit = !hold_deadline();
    state.awaits_start = waits_for_dc1() && !has_started_;
  } else if (!is_sending() && inbound_.is_open && is_ready_) {
    state.waiting_for = "text";
    state.may_wait_without_limit = !silence_deadline();
  }
  state.is_stray = is_stray();
  return state;
}

}  // namespace dripline::wire
