#include "gateway/line/port_line.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "gateway/line/line_words.hpp"
#include "gateway/line/port_transfer.hpp"
#include "protocol/process/log.hpp"

namespace dripline::line {
namespace {

bool is_answer(const SendProgress& progress) {
  return progress.kind == JobKind::Answer;
}

/// The control may wait for more of it.
bool is_unfinished(const std::optional<PortTransfer>& transfer) {
  return transfer && transfer->state != TransferState::Completed;
}

TransferState state_of(SendOutcome outcome) {
  switch (outcome) {
    case SendOutcome::Completed:
      return TransferState::Completed;
    case SendOutcome::Aborted:
      return TransferState::Aborted;
    case SendOutcome::Interrupted:
      return TransferState::Interrupted;
  }
  return TransferState::Interrupted;
}

}  // namespace

PortLine::PortLine(Parts parts)
    : parts_(std::move(parts)),
      recorder_(parts_.recording, parts_.clock, parts_.on_traffic),
      losses_(parts_.names.address),
      session_(parts_.settings, *this),
      transfer_(parts_.before.transfer),
      may_be_in_text_(parts_.before.may_be_in_text) {
  if (parts_.is_upload_broken) session_.expect_rest();
}

std::shared_ptr<PortLine> PortLine::make(Parts parts) {
  return std::shared_ptr<PortLine>(new PortLine(std::move(parts)));
}

PortLine::~PortLine() {
  // The driver's thread calls this object until it is joined.
  close("the server is stopping");
}

serial::LineListener PortLine::line_listener() {
  return {.on_event =
              [this](wire::Event& event) {
                with_line([this, event = std::move(event)](wire::Discipline& line,
                                                           wire::LineTime now) mutable {
                  session_.on_event(std::move(event), line, now);
                  refresh();
                });
              },
          .on_traffic = [this](const serial::LineTraffic& traffic) { recorder_.add(traffic); },
          .on_channel = [this](const Error* lost) { on_channel(lost); },
          .on_room =
              [this] {
                with_line([this](wire::Discipline& line, wire::LineTime now) {
                  session_.on_room(line, now);
                });
              },
          .on_steady = [this] { on_steady(); }};
}

void PortLine::open() {
  // Held while the driver starts, so that its first calls find it here.
  const std::lock_guard lock(mutex_);
  if (is_closed_ || driver_) return;
  serial::LineDriver::Parts parts{.address = parts_.names.address,
                                  .settings = parts_.settings,
                                  .role = wire::Role::Host,
                                  .listener = line_listener(),
                                  .may_transmit = parts_.may_send};
  auto driver =
      parts_.open ? parts_.open(std::move(parts)) : serial::LineDriver::start(std::move(parts));
  if (driver) {
    driver_ = *std::move(driver);
    if (parts_.before.may_be_in_text)
      driver_->post([](wire::Discipline& line, wire::LineTime) { line.expect_release(); });
    return;
  }
  fault_ = driver.error().what;
  process::log_error("port={} cannot be used: {}", parts_.names.name, fault_);
}

void PortLine::close(const std::string& reason) {
  std::unique_ptr<serial::LineDriver> driver;
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(is_closed_, true)) return;
    driver = std::move(driver_);
  }
  if (driver) driver->stop();
  session_.stop(reason, driver ? driver->state() : wire::LineState{});
  refresh();
  recorder_.flush();
}

bool PortLine::with_line(Work work) {
  const std::lock_guard lock(mutex_);
  if (!driver_) return false;
  driver_->post(std::move(work));
  return true;
}

void PortLine::on_channel(const Error* lost) {
  set_fault(lost != nullptr ? lost->what : "");
  if (lost != nullptr) {
    with_line([this, error = *lost](wire::Discipline& line, wire::LineTime) {
      session_.on_lost(error, line);
      refresh();
    });
  } else {
    recorder_.on_opened();
    with_line([this](wire::Discipline& line, wire::LineTime now) {
      session_.on_open(line, now);
      refresh();
    });
  }
  log_line(lost != nullptr ? losses_.on_lost(lost->what, parts_.clock.steady_now())
                           : losses_.on_open());
  parts_.post([on_change = parts_.listener.on_change] { on_change(); });
}

void PortLine::on_steady() {
  log_line(losses_.on_steady());
}

void PortLine::log_line(const std::optional<LossLog::Message>& message) const {
  log_message(fmt::format("port={} machine={}", parts_.names.name, parts_.names.machine), message);
}

void PortLine::set_fault(const std::string& words) {
  const std::lock_guard lock(mutex_);
  fault_ = words;
}

/// What others may know of the session, copied for them on the session's thread.
void PortLine::refresh() {
  auto progress = session_.progress();
  const std::lock_guard lock(mutex_);
  progress_ = std::move(progress);
  text_ahead_ = session_.text_ahead();
  is_receiving_ = session_.is_receiving();
}

LineView PortLine::view() const {
  LineView view;
  view.names = parts_.names;
  view.settings = parts_.settings;
  view.sent = recorder_.sent();
  view.received = recorder_.received();
  const std::lock_guard lock(mutex_);
  view.fault = store_fault_.empty() ? fault_ : store_fault_;
  if (parts_.may_send && !parts_.may_send()) {
    view.fault =
        "nothing is sent: this server does not reach the database, and another one may have taken "
        "over";
  }
  view.waiting_since = waiting_since_;
  if (progress_ && progress_->kind == JobKind::Run) view.run = progress_->id;
  view.transfer = transfer_;
  if (transfer_ && progress_ && progress_->id == transfer_->id) {
    view.transfer->sent = progress_->sent.bytes;
    view.transfer->at_most = progress_->offered;
  }
  if (!driver_) return view;
  view.is_open = driver_->is_open();
  view.line = driver_->state();
  const bool is_over = request_ && request_->answer.empty() && !view.line.is_asked;
  if (!is_over) view.request = request_;
  return view;
}

std::uint64_t PortLine::text_ahead() const {
  const std::lock_guard lock(mutex_);
  return text_ahead_;
}

std::optional<SendProgress> PortLine::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

bool PortLine::is_busy() const {
  const std::lock_guard lock(mutex_);
  if (progress_ && !is_answer(*progress_)) return true;
  return is_receiving_ && may_be_program_ && !(driver_ && driver_->state().is_stray);
}

void PortLine::note_kind(bool may_be_program) {
  const std::lock_guard lock(mutex_);
  may_be_program_ = may_be_program;
}

void PortLine::note_store_fault(const std::string& words) {
  const std::lock_guard lock(mutex_);
  store_fault_ = words;
}

void PortLine::note(const std::string& text) {
  recorder_.add({.what = serial::LineTraffic::What::Note, .time = {}, .bytes = {}, .text = text});
}

void PortLine::tick() {
  with_line([this](wire::Discipline& line, wire::LineTime now) {
    session_.poll(line, now);
    refresh();
  });
  watch_wait();
  recorder_.flush();
}

void PortLine::watch_wait() {
  const std::lock_guard lock(mutex_);
  const bool is_waiting = driver_ && driver_->state().may_wait_without_limit;
  if (!is_waiting) {
    waiting_since_.reset();
  } else if (!waiting_since_) {
    waiting_since_ = parts_.clock.now();
  }
}

/// Before it begins, because its end may come at once. What was shown before.
std::optional<PortTransfer> PortLine::show_transfer(const SendJob& job) {
  const std::lock_guard lock(mutex_);
  was_in_text_ = std::exchange(may_be_in_text_, true);
  auto before = transfer_;
  const bool is_read_at_once = job.kind == JobKind::Answer && sends_at_once(parts_.settings);
  if (job.kind == JobKind::Transfer || is_read_at_once) {
    before_answer_ = before;
    transfer_ = PortTransfer{.id = job.id, .programs = programs_of(job), .size = job.size};
  }
  return before;
}

void PortLine::take_back(std::optional<PortTransfer> before) {
  const std::lock_guard lock(mutex_);
  transfer_ = std::move(before);
  may_be_in_text_ = was_in_text_;
}

/// A program that the control has read to its end began at its beginning.
void PortLine::end_transfer(const SendEnd& end) {
  const std::lock_guard lock(mutex_);
  const bool is_completed = end.outcome == SendOutcome::Completed;
  may_be_in_text_ = !is_completed && (end.may_have_left || was_in_text_);
  if (end.progress.kind == JobKind::Run && end.outcome == SendOutcome::Completed) {
    if (is_unfinished(transfer_)) transfer_.reset();
    return;
  }
  if (!transfer_ || transfer_->id != end.progress.id) return;
  if (is_answer(end.progress) && !is_cut_off(end)) {  // then it is not remembered
    transfer_ = std::exchange(before_answer_, std::nullopt);
    return;
  }
  transfer_->sent = end.progress.sent.bytes;
  transfer_->at_most = std::max(end.progress.offered, end.progress.sent.bytes);
  transfer_->state = state_of(end.outcome);
  transfer_->reason = end.reason;
}

Result<void> PortLine::keep_memory() {
  if (!parts_.keep) return {};
  LineMemory memory;
  {
    const std::lock_guard lock(mutex_);
    if (is_unfinished(transfer_)) memory.transfer = transfer_;
    memory.may_be_in_text = may_be_in_text_;
  }
  return parts_.keep(memory);
}

void PortLine::on_sent(const SendEnd& end) {
  end_transfer(end);
  if (auto kept = keep_memory(); !kept)
    process::log_error("port={}: the end of {} is not kept: {}", parts_.names.name, end.progress.id,
                       kept.error().what);
  refresh();  // the listener must not find it any more
  parts_.post([on_sent = parts_.listener.on_sent, end] { on_sent(end); });
}

void PortLine::on_incoming(Incoming incoming) {
  refresh();  // a listener that acts on the end must not find the line receiving
  incoming.arrived = parts_.clock.steady_now();
  // Destroyed lines keep nothing up: the text is kept all the same.
  parts_.post([weak = weak_from_this(), on_incoming = parts_.listener.on_incoming,
               incoming = std::move(incoming)] {
    const std::size_t size = incoming.what == Incoming::What::Text ? incoming.text.size() : 0;
    on_incoming(incoming, [weak, size] {
      const auto self = weak.lock();
      if (!self || size == 0) return;
      PortLine& port = *self;
      port.with_line([&port, size](wire::Discipline& line, wire::LineTime now) {
        port.session_.kept(size, line, now);
      });
    });
  });
}

/// What is sent now is the answer.
void PortLine::answer_request() {
  const std::lock_guard lock(mutex_);
  request_.reset();
}

void PortLine::on_request(const wire::TransferRequest& request) {
  if (request.kind != wire::TransferRequest::Kind::TakeProgram) {
    const std::lock_guard lock(mutex_);
    request_ = PortRequest{.since = parts_.clock.now(), .program = request.name, .answer = {}};
  }
  parts_.post([on_request = parts_.listener.on_request, request] { on_request(request); });
}

/// A text that is on the line now has not begun.
void PortLine::on_release_refused(const wire::ReleaseRefused& refused) {
  was_in_text_ = false;
  if (!session_.progress()) {
    may_be_in_text_ = false;
    if (auto kept = keep_memory(); !kept)
      process::log_warning("port={}: not kept that the control was refused: {}", parts_.names.name,
                           kept.error().what);
  }
  if (refused.is_known && parts_.listener.on_release_refused)
    parts_.post(parts_.listener.on_release_refused);
}

void PortLine::on_fault(const Error& error) {
  process::log_warning("port={} machine={}: {}", parts_.names.name, parts_.names.machine,
                       error.what);
  set_fault(error.what);
  note(error.what);
}

void PortLine::on_progress(const SendProgress& progress) {
  if (parts_.listener.on_progress) parts_.listener.on_progress(progress);
}

}  // namespace dripline::line
