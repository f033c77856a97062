#include "gateway/line/line_session.hpp"

#include <algorithm>
#include <utility>

#include "gateway/line/line_words.hpp"

namespace dripline::line {
namespace {

constexpr double kAheadSeconds = 0.5;
constexpr std::size_t kLeastAhead = 1024;  ///< a block of a checked protocol, and the next one
constexpr std::size_t kMaxAhead = 16 * 1024;

bool is_checked_flow(wire::Flow flow) {
  return flow == wire::Flow::Xmodem || flow == wire::Flow::HeidenhainBcc;
}

std::size_t ahead_of(const wire::LineSettings& settings) {
  const double wanted = wire::characters_per_second(settings) * kAheadSeconds;
  const auto least = is_checked_flow(settings.flow) ? kLeastAhead : kLeastAhead / 4;
  return std::clamp(static_cast<std::size_t>(wanted), least, kMaxAhead);
}

std::string place_of(const SendProgress& progress) {
  return place_words(progress.sent.line, progress.sent.sequence,
                     progress.is_checked ? "accepted" : "sent");
}

}  // namespace

std::string_view to_string(SendOutcome outcome) {
  switch (outcome) {
    case SendOutcome::Completed:
      return "completed";
    case SendOutcome::Aborted:
      return "aborted";
    case SendOutcome::Interrupted:
      return "interrupted";
  }
  return "interrupted";
}

LineSession::LineSession(const wire::LineSettings& settings, SessionHost& host)
    : host_(host),
      is_checked_(is_checked_flow(settings.flow)),
      ahead_(ahead_of(settings)),
      idle_end_(settings.flow == wire::Flow::DcCodes ? std::chrono::milliseconds(0)
                                                     : settings.idle_end),
      rest_gap_(settings.flow == wire::Flow::DcCodes ? std::chrono::milliseconds(0)
                                                     : settings.rest_gap) {}

Result<void> LineSession::begin(SendJob job, wire::Discipline& line, wire::LineTime now) {
  if (sending_) return fail(Errc::Busy, "the line is sending {}", sending_->job.id);
  opened_.reset();  // what it prints from now on it prints for this
  is_rest_due_ = false;
  Sending sending;
  sending.job = std::move(job);
  sending_ = std::move(sending);
  auto begun = start_over(line, now);
  if (!begun) sending_.reset();
  return begun;
}

/// From the job's beginning; nothing of it may have left.
Result<void> LineSession::start_over(wire::Discipline& line, wire::LineTime now) {
  Sending fresh;
  fresh.job = std::move(sending_->job);
  fresh.is_held = sending_->is_held;
  fresh.ledger = BlockLedger(fresh.job.first_line);
  fresh.next_fetch = fresh.job.first_byte;
  sending_ = std::move(fresh);
  if (auto begun = line.begin_send(sending_->job.name, now); !begun) return begun;
  sending_->text = sending_->ledger.add_head(sending_->job.head);
  if (sending_->job.text) {
    sending_->text += sending_->ledger.add(*sending_->job.text, true);
    sending_->is_fetched = true;
  }
  fetch_more();
  fill(line, now);
  return {};
}

void LineSession::fetch_more() {
  if (!sending_ || sending_->is_fetched || sending_->is_fetching) return;
  const std::uint64_t ahead = sending_->job.prefetch > 0 ? sending_->job.prefetch : kPrefetch;
  if (sending_->text.size() > ahead / 2) return;
  sending_->is_fetching = true;
  host_.fetch(sending_->job, sending_->next_fetch);
}

void LineSession::supply(const std::string& id, std::uint64_t offset, const std::string& piece,
                         wire::Discipline& line, wire::LineTime now) {
  // Requested by a job that is over, or that has started again since.
  if (!sending_ || sending_->job.id != id || offset != sending_->next_fetch) return;
  if (!std::exchange(sending_->is_fetching, false)) return;
  sending_->next_fetch += piece.size();
  sending_->is_fetched = sending_->next_fetch >= sending_->job.size;
  sending_->text += sending_->ledger.add(piece, sending_->is_fetched);
  fetch_more();
  fill(line, now);
}

void LineSession::supply_failed(const std::string& id, const Error& error, wire::Discipline& line,
                                wire::LineTime now) {
  if (!sending_ || sending_->job.id != id) return;
  count(line.state());
  line.abort(now);
  finish(SendOutcome::Interrupted, error.what);
}

void LineSession::fill(wire::Discipline& line, wire::LineTime now) {
  while (sending_ && !sending_->is_held && !sending_->is_offered && !sending_->waits_for_line) {
    if (!offer_some(line, now)) break;
  }
  if (!sending_) return;
  count(line.state());
  fetch_more();
}

/// One piece, as far as there is text and room. False: not now.
bool LineSession::offer_some(wire::Discipline& line, wire::LineTime now) {
  Sending& sending = *sending_;
  const std::uint64_t offered = sending.ledger.offered() - sending.text.size();
  const std::uint64_t left = std::max(line.state().text_sent, sending.accepted);
  const std::uint64_t under_way = offered > left ? offered - left : 0;
  if (under_way >= ahead_) return false;
  const std::size_t room = std::min<std::size_t>(line.room(), ahead_ - under_way);
  const std::size_t size = std::min(room, sending.text.size());
  const bool is_last = sending.is_fetched && size == sending.text.size();
  if (size == 0 && !is_last) return false;
  note_offer(size);
  const auto taken = line.offer(std::string_view(sending.text).substr(0, size), is_last, now);
  if (!taken) {
    if (line.state().phase != wire::Phase::Idle) line.abort(now);
    count(line.state());
    finish(SendOutcome::Interrupted, taken.error().what);
    return false;
  }
  sending.text.erase(0, size);
  sending.is_offered = is_last;
  return !is_last;
}

/// Before the next `size` characters may leave. What waits here is no longer than its bytes in the
/// program, so the number is never too small.
void LineSession::note_offer(std::size_t size) {
  Sending& sending = *sending_;
  const std::uint64_t fetched = sending.next_fetch - sending.job.first_byte;
  const std::uint64_t left = sending.text.size() - size;
  sending.offered = std::max(sending.offered, fetched > left ? fetched - left : 0);
  host_.on_progress(*progress());
}

void LineSession::count(const wire::LineState& line) {
  if (!sending_ || sending_->waits_for_line) return;
  sending_->awaits_start = line.awaits_start;
  const std::uint64_t offered = sending_->ledger.offered() - sending_->text.size();
  const std::uint64_t left = is_checked_ ? sending_->accepted : line.text_sent;
  const std::uint64_t before = sending_->ledger.place().bytes;
  sending_->ledger.advance(std::min(left, offered));
  if (sending_->ledger.place().bytes != before) host_.on_progress(*progress());
}

void LineSession::finish(SendOutcome outcome, std::string reason) {
  SendEnd end{.progress = *progress(),
              .outcome = outcome,
              .reason = std::move(reason),
              .may_have_left = !sending_->awaits_start};
  const bool is_in_head = end.progress.sent.bytes == 0 && sending_->ledger.left() > 0;
  if (outcome != SendOutcome::Completed && is_in_head) end.reason += fmt::format("; {}", kHeadLeft);
  sending_.reset();
  if (outcome != SendOutcome::Completed) end.reason += "; " + place_of(end.progress);
  host_.on_sent(end);
}

bool LineSession::hold(const std::string& id) {
  if (!sending_ || sending_->job.id != id) return false;
  sending_->is_held = true;
  return true;
}

bool LineSession::resume(const std::string& id, wire::Discipline& line, wire::LineTime now) {
  if (!sending_ || sending_->job.id != id) return false;
  sending_->is_held = false;
  fill(line, now);
  return true;
}

bool LineSession::abort(const std::string& id, const std::string& reason, wire::Discipline& line,
                        wire::LineTime now) {
  if (!sending_ || sending_->job.id != id) return false;
  count(line.state());
  line.abort(now);
  finish(SendOutcome::Aborted, reason);
  return true;
}

Result<void> LineSession::begin_receive(wire::Discipline& line, wire::LineTime now) {
  if (sending_) return fail(Errc::Busy, "the line is sending {}", sending_->job.id);
  if (is_receiving_) return fail(Errc::Busy, "the line is receiving");
  if (auto begun = line.begin_receive("", now); !begun) return begun;
  is_receiving_ = is_asking_ = true;
  is_rest_due_ = false;
  host_.on_incoming({.what = Incoming::What::Began, .text = {}, .is_program = true});
  return {};
}

bool LineSession::stop_receiving(const std::string& reason, wire::Discipline& line,
                                 wire::LineTime now) {
  if (!is_receiving_ || sending_) return false;
  line.abort(now);
  end_receiving({.what = Incoming::What::Failed, .text = reason});
  return true;
}

void LineSession::on_room(wire::Discipline& line, wire::LineTime now) {
  fill(line, now);
}

void LineSession::on_lost(const Error& error, wire::Discipline& line) {
  // It continues unless it waited without a limit: then the driver has dropped it.
  if (is_checked_ && line.state().phase != wire::Phase::Idle) return;
  if (is_receiving_) end_receiving({.what = Incoming::What::Failed, .text = error.what});
  if (!sending_ || sending_->waits_for_line) return;
  count(line.state());
  if (sending_->ledger.left() > 0) {
    return finish(SendOutcome::Interrupted, fmt::format("the line is lost: {}", error.what));
  }
  sending_->waits_for_line = true;
}

void LineSession::on_open(wire::Discipline& line, wire::LineTime now) {
  opened_ = now;
  if (!sending_ || !sending_->waits_for_line) return;
  if (line.state().phase != wire::Phase::Idle) line.abort(now);
  if (auto begun = start_over(line, now); !begun) {
    finish(SendOutcome::Interrupted, begun.error().what);
  }
}

void LineSession::poll(wire::Discipline& line, wire::LineTime now) {
  if (sending_ && sending_->waits_for_line) {
    if (!sending_->waits_since) sending_->waits_since = now;
    if (now - *sending_->waits_since > kLineLimit) {
      finish(SendOutcome::Interrupted,
             fmt::format("the line did not come back for {} minutes", kLineLimit.count()));
    }
    return;
  }
  fill(line, now);
}

void LineSession::stop(const std::string& reason, const wire::LineState& last) {
  if (is_receiving_) end_receiving({.what = Incoming::What::Failed, .text = reason});
  count(last);
  if (sending_) finish(SendOutcome::Interrupted, reason);
}

std::uint64_t LineSession::text_ahead() const {
  if (!sending_) return 0;
  const std::uint64_t fetched = sending_->next_fetch - sending_->job.first_byte;
  return fetched - std::min(fetched, sending_->ledger.place().bytes);
}

std::optional<SendProgress> LineSession::progress() const {
  if (!sending_) return std::nullopt;
  return SendProgress{.kind = sending_->job.kind,
                      .id = sending_->job.id,
                      .size = sending_->job.size,
                      .sent = sending_->ledger.place(),
                      .offered = sending_->offered,
                      .is_checked = is_checked_,
                      .is_held = sending_->is_held,
                      .is_waiting_for_line = sending_->waits_for_line};
}

void LineSession::on_event(wire::Event event, wire::Discipline& line, wire::LineTime now) {
  if (auto* received = std::get_if<wire::TextReceived>(&event)) {
    take_text(std::move(received->text), line, now);
  } else if (auto* began = std::get_if<wire::TransferBegan>(&event)) {
    if (!began->is_receiving) return;
    if (std::exchange(is_asking_, false)) return;  // reported when it was requested
    is_receiving_ = true;
    begin_receiving(std::move(began->name), now);
  } else if (const auto* ended = std::get_if<wire::TransferEnded>(&event)) {
    if (ended->is_receiving) {
      return end_receiving({.what = Incoming::What::Ended, .text = {}, .is_cut = ended->is_cut});
    }
    if (!sending_) return;
    sending_->ledger.advance_to_end();
    finish(SendOutcome::Completed, "");
  } else if (const auto* accepted = std::get_if<wire::TextAccepted>(&event)) {
    if (!sending_) return;
    sending_->accepted = accepted->bytes;
    fill(line, now);
  } else if (const auto* failed = std::get_if<wire::TransferFailed>(&event)) {
    on_failed(failed->error, line);
  } else if (const auto* fault = std::get_if<wire::LineError>(&event)) {
    host_.on_fault(fault->error);
    if (is_receiving_) {
      host_.on_incoming({.what = Incoming::What::Damaged, .text = fault->error.what});
    }
  } else if (const auto* request = std::get_if<wire::TransferRequest>(&event)) {
    host_.on_request(*request);
  } else if (const auto* refused = std::get_if<wire::ReleaseRefused>(&event)) {
    host_.on_release_refused(*refused);
  }
}

/// A character that begins each text of itself (DC2) begins no rest.
void LineSession::begin_receiving(std::string name, wire::LineTime now) {
  const auto opened = std::exchange(opened_, std::nullopt);
  const bool is_due = std::exchange(is_rest_due_, false) && opened && now - *opened < kRestLimit;
  const bool is_first = opened && now - *opened < rest_gap_;
  host_.on_incoming({.what = Incoming::What::Began,
                     .text = std::move(name),
                     .may_be_rest = is_due || (opened && now - *opened < idle_end_),
                     .is_first = is_first});
}

/// Both directions may have been active; the one that the line still does has not failed.
void LineSession::on_failed(const Error& error, wire::Discipline& line) {
  host_.on_fault(error);
  if (error.code == Errc::Io) return on_lost(error, line);
  if (is_receiving_) end_receiving({.what = Incoming::What::Failed, .text = error.what});
  if (!sending_ || line.state().phase == wire::Phase::Sending) return;
  count(line.state());
  finish(SendOutcome::Interrupted, error.what);
}

void LineSession::end_receiving(Incoming incoming) {
  is_receiving_ = false;
  host_.on_incoming(std::move(incoming));
}

/// Reported once, not for every piece.
void LineSession::lose_text() {
  if (std::exchange(is_losing_, true)) return;
  const Error error{Errc::LimitExceeded,
                    fmt::format("what came is lost: {} bytes wait to be stored, and the control is "
                                "not held by XOFF or RTS",
                                backlog_)};
  host_.on_fault(error);
  host_.on_incoming({.what = Incoming::What::Damaged, .text = error.what, .is_cut = true});
}

void LineSession::take_text(std::string text, wire::Discipline& line, wire::LineTime now) {
  if (backlog_ + text.size() > kMaxBacklog) return lose_text();
  is_losing_ = false;
  backlog_ += text.size();
  host_.on_incoming({.what = Incoming::What::Text, .text = std::move(text)});
  if (backlog_ <= kHoldBacklog || is_held_off_) return;
  is_held_off_ = true;
  line.set_ready(false, now);
}

void LineSession::kept(std::size_t bytes, wire::Discipline& line, wire::LineTime now) {
  backlog_ -= std::min(backlog_, bytes);
  if (!is_held_off_ || backlog_ > kHoldBacklog / 2) return;
  is_held_off_ = false;
  line.set_ready(true, now);
}

}  // namespace dripline::line
