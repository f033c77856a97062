#include "protocol/wire/impl/tnc_standard.hpp"

#include <algorithm>

#include "protocol/wire/impl/discipline_base.hpp"
#include "protocol/wire/tape_code.hpp"
#include "protocol/wire/tnc_frames.hpp"

namespace dripline::wire {
namespace {

constexpr std::size_t kSentHead = 40;  // enough of a line to see an END

std::optional<LineTime> after(std::optional<std::chrono::milliseconds> limit, LineTime now) {
  return limit ? std::optional(now + *limit) : std::nullopt;
}

}  // namespace

// Calls of the owner

Result<void> TncStandard::begin_send(std::string_view name, LineTime now) {
  if (auto idle = check_idle(); !idle) return idle;
  begin_transfer(Phase::Sending, std::string(name));
  blanks_left_ = settings_.leader;
  is_stopped_ = false;
  const bool may_begin = !is_host() || std::exchange(is_asked_, false);
  stage_ = may_begin ? Stage::Leader : Stage::Start;
  limit_ = may_begin ? std::nullopt : after(settings_.start_limit, now);
  note_hold(now);
  return {};
}

Result<void> TncStandard::begin_receive(std::string_view name, LineTime) {
  if (auto idle = check_idle(); !idle) return idle;
  begin_transfer(Phase::Receiving, std::string(name));
  is_asked_ = false;
  if (is_host() && !is_ready_) hold(true);
  if (is_host()) return {};
  wanted_ = name;
  is_holding_ = !is_ready_;
  if (is_ready_ || is_held_by_cts_) queue_control(kDc1);
  return {};
}

Result<void> TncStandard::request(const TransferRequest& request, LineTime now) {
  if (is_host()) return fail(Errc::Unsupported, "a TNC asks its host; the host cannot ask it");
  using enum TransferRequest::Kind;
  if (request.kind == TakeProgram) return begin_send(request.name, now);
  return begin_receive(request.kind == Directory ? "" : request.name, now);
}

Result<void> TncStandard::refuse(std::string_view, LineTime) {
  if (!is_asked_) return fail(Errc::Conflict, "the control has asked for nothing");
  is_asked_ = false;
  queue_control(settings_.heidenhain.eot);
  return {};
}

void TncStandard::set_ready(bool is_ready, LineTime now) {
  if (std::exchange(is_ready_, is_ready) == is_ready) return;
  if (is_held_by_cts_) output_.rts = is_ready;
  if (is_ready && is_holding_) {
    hold(false);
    restart_silence(now);
  } else if (!is_ready && is_receiving()) {
    hold(true);
    limit_.reset();
  }
}

/// Where RTS holds the other end, it follows `set_ready` without a character.
void TncStandard::hold(bool is_holding) {
  is_holding_ = is_holding;
  if (!is_held_by_cts_) queue_control(is_holding ? kDc3 : kDc1);
}

void TncStandard::abort(LineTime now) {
  is_asked_ = false;
  if (phase_ == Phase::Idle) return;
  const bool is_known_there = !is_host() || stage_ != Stage::Start || has_received_;
  drop_transfer(now);
  if (is_known_there) queue_control(settings_.heidenhain.eot);
}

LineState TncStandard::state() const {
  LineState state;
  state.phase = phase_;
  state.is_stopped = is_held();
  state.is_stopping = is_holding_;
  state.is_asked = is_asked_;
  state.awaits_start = is_sending() && stage_ == Stage::Start;
  if (is_sending()) {
    if (stage_ == Stage::Start || is_held()) state.waiting_for = is_cts_off() ? "CTS" : "DC1";
    if (stage_ == Stage::Answer) state.waiting_for = "EOT";
  } else if (is_receiving() && !has_received_) {
    state.waiting_for = "text";
  }
  state.may_wait_without_limit = !state.waiting_for.empty() && !limit_;
  state.text_sent = text_sent();
  return state;
}

void TncStandard::transfer_over(LineTime) {
  limit_.reset();
  stage_ = Stage::Start;
  out_.clear();
  out_at_ = 0;
  sent_line_.clear();
  wanted_.clear();
  line_.clear();
  number_.reset();
  has_sent_end_ = has_received_ = is_open_ = has_end_ = is_skipping_ = false;
  if (std::exchange(is_hold_reported_, false)) emit(FlowChanged{false});
  is_stopped_ = false;
  if (is_holding_) hold(false);
}

void TncStandard::lines(InputLines lines, LineTime now) {
  if (input_.dsr && !lines.dsr) is_asked_ = false;
  const bool is_cut = has_lost_dsr(lines);
  DisciplineBase::lines(lines, now);
  if (is_cut && is_host() && is_sending() && stage_ != Stage::Start) return give_up(cut_off(), now);
  note_hold(now);
}

/// Reports that the other end holds or releases us, and starts or ends the limit of that wait.
void TncStandard::note_hold(LineTime now) {
  if (!is_sending() || is_hold_reported_ == is_held()) return;
  is_hold_reported_ = is_held();
  const bool has_own_limit = stage_ == Stage::Start || stage_ == Stage::Answer;
  if (!has_own_limit) limit_ = is_held() ? after(settings_.hold_limit, now) : std::nullopt;
  emit(FlowChanged{is_held()});
}

void TncStandard::give_up(Error error, LineTime now) {
  fail_transfer(std::move(error), now);
  queue_control(settings_.heidenhain.eot);
}

void TncStandard::tick(LineTime now) {
  if (!limit_ || *limit_ > now) return;
  limit_.reset();
  if (is_sending()) {
    const bool is_answer = stage_ == Stage::Answer;
    const char* missing = is_cts_off() ? "no CTS in time" : "no DC1 in time";
    return give_up({Errc::Timeout, is_answer ? "no EOT in time: does the control want a program of "
                                               "another number?"
                                             : missing},
                   now);
  }
  if (!is_receiving()) return;
  is_silent_ = true;
  if (!line_.empty()) end_line(now);
  if (is_receiving()) {
    emit_fault({Errc::Timeout, "no ETX after the program"});
    end_program(now);
  }
  is_silent_ = false;
}

// Sending

std::size_t TncStandard::transmit(std::span<std::byte> room, LineTime now) {
  if (is_cts_off()) return 0;
  std::size_t count = take_controls(room);
  while (count < room.size() && is_sending() && !is_stopped_) {
    if (out_at_ == out_.size()) refill(now);
    if (out_at_ == out_.size()) break;
    room[count++] = static_cast<std::byte>(out_[out_at_++]);
    if (out_at_ < out_.size()) continue;
    if (stage_ == Stage::Text) count_sent(1);
    if (stage_ == Stage::End) end_sent(now);
  }
  return count;
}

void TncStandard::refill(LineTime) {
  out_.clear();
  out_at_ = 0;
  if (stage_ == Stage::Leader) {
    if (blanks_left_ > 0) {
      --blanks_left_;
      out_.push_back('\0');
      return;
    }
    stage_ = Stage::Text;
  }
  if (stage_ != Stage::Text) return;
  if (has_text()) return encode_next();
  if (!is_text_taken()) return;
  stage_ = Stage::End;
  out_ = settings_.heidenhain.etx;
  if (!is_host()) out_ += settings_.heidenhain.eot;
}

void TncStandard::encode_next() {
  const char c = queued_text().front();
  take_text(1);
  note_sent(c);
  if (c == '\n') {
    out_ = end_of_block_rows(CharacterCode::Ascii, settings_.end_of_block);
  } else {
    out_ = c == '\r' ? '\0' : c;  // CR belongs to its LF; a NUL in its place is ignored
  }
}

void TncStandard::note_sent(char c) {
  if (c != '\n') {
    if (sent_line_.size() < kSentHead) sent_line_ += c;
    return;
  }
  if (read_tnc_line(sent_line_).kind == TncLineKind::End) has_sent_end_ = true;
  sent_line_.clear();
}

void TncStandard::end_sent(LineTime now) {
  if (!is_host()) return end_transfer(now);
  stage_ = Stage::Answer;
  limit_ = after(settings_.answer_limit, now);
}

Result<void> TncStandard::check_text(std::string_view text, std::size_t line) {
  std::size_t column = 0;
  for (const char c : text) {
    ++column;
    if (c == '\n') {
      ++line;
      column = 0;
    } else if (c != '\r' && (c < ' ' || c == 0x7F)) {
      return fail(Errc::Syntax, "line {}: character 0x{:02X} cannot be sent to a TNC", line,
                  static_cast<unsigned>(static_cast<unsigned char>(c)));
    }
  }
  return {};
}

/// A control that has room again for what another host has begun: its operator begins again.
bool TncStandard::is_release() {
  const bool is_begin = phase_ == Phase::Idle || (is_sending() && stage_ == Stage::Start);
  if (!is_begin || !std::exchange(is_release_due_, false)) return false;
  queue_control(settings_.heidenhain.eot);
  emit_fault({Errc::Conflict, "DC1 came for the program that was broken off: EOT answers it"});
  emit(ReleaseRefused{.is_known = true});
  return true;
}

void TncStandard::on_dc1(LineTime now) {
  if (is_release()) return;
  if (is_sending() && stage_ == Stage::Answer) end_transfer(now);  // it asks for the next program
  if (is_sending()) {
    if (stage_ == Stage::Start) stage_ = Stage::Leader;
    limit_ = is_cts_off() ? after(settings_.hold_limit, now) : std::nullopt;
    is_stopped_ = false;
    note_hold(now);
  } else if (phase_ == Phase::Idle && is_host() && !is_asked_) {
    is_asked_ = true;
    emit(TransferRequest{TransferRequest::Kind::SendProgram, ""});
  }
}

void TncStandard::on_dc3(LineTime now) {
  if (!is_sending() || stage_ == Stage::Start || is_stopped_) return;
  if (stage_ == Stage::Answer || settings_.heidenhain.stop == TncStop::Rts) return;
  is_stopped_ = true;
  note_hold(now);
}

void TncStandard::on_eot(LineTime now) {
  is_asked_ = is_release_due_ = false;
  if (is_sending()) {
    if (stage_ == Stage::Answer || (is_host() && has_sent_end_)) return end_transfer(now);
    if (stage_ == Stage::Start) return;
    return fail_transfer({Errc::Corrupt, "the other end ended the transmission"}, now);
  }
  if (!is_receiving()) return;
  if (!has_received_ && !is_host()) {
    return fail_transfer({Errc::NotFound, "the device has no such program"}, now);
  }
  if (!line_.empty()) end_line(now);
  if (is_receiving() && has_received_) end_program(now);
}

// Receiving

void TncStandard::receive(std::span<const std::byte> bytes, LineTime now) {
  for (const auto byte : bytes) {
    on_character(static_cast<char>(byte & std::byte{0x7F}), now);
  }
}

void TncStandard::on_character(char c, LineTime now) {
  const auto& tnc = settings_.heidenhain;
  if (c == kDc1) return on_dc1(now);
  if (c == kDc3) return on_dc3(now);
  if (c == tnc.eot) return on_eot(now);
  if (c == tnc.etx) {
    if (!is_receiving()) return;
    if (!line_.empty()) end_line(now);
    if (is_receiving() && has_received_) end_program(now);
    return;
  }
  const bool is_line_end = c == '\r' || c == '\n';
  if ((c < ' ' && !is_line_end) || c == 0x7F) return;
  if (phase_ == Phase::Idle && is_host() && !is_line_end) {
    is_asked_ = is_release_due_ = false;  // the control sends now
    begin_transfer(Phase::Receiving, "");
    if (spoiled_ && now - *spoiled_ < settings_.idle_end) {
      emit_fault({Errc::Corrupt, "a character before the first one was spoiled"});
    }
    spoiled_.reset();
    if (!is_ready_) hold(true);
  }
  if (!is_receiving()) return;
  restart_silence(now);
  if (!is_line_end) return add(c, now);
  if (!line_.empty()) end_line(now);
}

void TncStandard::fault(LineFault fault, LineTime now) {
  static constexpr std::string_view kWords[] = {"parity", "framing", "overrun", "break"};
  if (phase_ == Phase::Idle) spoiled_ = now;
  if (!is_receiving()) return;
  emit_fault({Errc::Corrupt,
              fmt::format("{} error after '{}'", kWords[static_cast<std::size_t>(fault)], line_)});
  if (!has_received_ && line_.empty()) return;  // most likely a blank of the leader
  restart_silence(now);
  add('?', now);
}

void TncStandard::add(char c, LineTime now) {
  if (line_.size() >= kMaxTncLine) {
    return give_up(
        {Errc::LimitExceeded, fmt::format("a line of more than {} characters came", kMaxTncLine)},
        now);
  }
  line_ += c;
}

void TncStandard::end_line(LineTime now) {
  const std::string line = std::exchange(line_, {});
  has_received_ = true;
  take_line(line, now);
}

void TncStandard::take_line(const std::string& line, LineTime now) {
  const TncLine read = read_tnc_line(line);
  if (read.kind == TncLineKind::Begin) {
    if (has_end_) {  // the next program, without ETX between them
      end_program(now);
      begin_transfer(Phase::Receiving, read.program);
      has_received_ = true;
    }
    is_open_ = true;
    number_.reset();
    is_skipping_ = !wanted_.empty() && read.program != wanted_;
  } else if (!wanted_.empty() && !is_open_) {
    return;  // between programs
  }
  const bool is_end = read.kind == TncLineKind::End;
  if (is_end) is_open_ = false;
  if (is_skipping_) {
    is_skipping_ = !is_end;
    return;
  }
  check_number(read);
  // Nothing says that a printed line which silence ends is whole; END and a program's blocks are.
  const bool is_cut = is_silent_ && !is_open_ && !is_end;
  emit_text(is_cut ? line : line + "\n");
  has_end_ = is_end;
  // A control that wants one program ends the transmission when it has it.
  if (is_end && !wanted_.empty()) end_program(now);
}

void TncStandard::check_number(const TncLine& read) {
  if (read.number && number_ && *read.number != *number_ + 1) {
    emit_fault(
        {Errc::Corrupt, fmt::format("block {} came after block {}", *read.number, *number_)});
  }
  if (read.number) number_ = read.number;
}

void TncStandard::end_program(LineTime now) {
  if (is_open_ || (!wanted_.empty() && !has_end_)) {
    if (!wanted_.empty() && !is_open_) return;  // another program: the wanted one may follow
    return give_up({Errc::Corrupt, "program incomplete: its END line did not come"}, now);
  }
  emit(TransferEnded{.is_receiving = true, .is_cut = is_silent_});
  drop_transfer(now);
  if (!is_host()) queue_control(settings_.heidenhain.eot);
}

void TncStandard::restart_silence(LineTime now) {
  if (!is_receiving() || is_holding_) return limit_.reset();
  const bool may_end = !is_open_ && wanted_.empty();
  limit_ = may_end ? std::optional<LineTime>(now + settings_.idle_end)
                   : after(is_host() ? settings_.pause_limit : settings_.answer_limit, now);
}

std::unique_ptr<Discipline> make_tnc_standard(const LineSettings& settings, Role role) {
  return std::make_unique<TncStandard>(settings, role);
}

}  // namespace dripline::wire
