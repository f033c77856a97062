#include "gateway/feed/control_line.hpp"

#include <algorithm>
#include <chrono>

namespace dripline::feed {
namespace {

using What = LineItem::What;

std::int64_t steady_now() {
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Result<std::unique_ptr<ControlLine>> ControlLine::start(Parts parts) {
  std::unique_ptr<ControlLine> line(new ControlLine(std::move(parts)));
  serial::LineListener listener;
  listener.on_event = [raw = line.get()](wire::Event& event) { raw->on_event(event); };
  listener.on_traffic = [raw = line.get()](const serial::LineTraffic& traffic) {
    if (traffic.what == serial::LineTraffic::What::Received) raw->heard_ = steady_now();
  };
  listener.on_channel = [raw = line.get()](const Error* lost) {
    raw->put(What::Channel, lost != nullptr ? lost->what : std::string());
  };
  listener.on_steady = [raw = line.get()] { raw->put(What::Steady, {}); };
  listener.on_room = [raw = line.get()] { raw->post_pump(); };
  auto driver = serial::LineDriver::start({.address = line->parts_.address,
                                           .settings = line->parts_.settings,
                                           .role = wire::Role::Control,
                                           .listener = std::move(listener),
                                           .open = line->parts_.open});
  if (!driver) return fail(driver.error());
  line->driver_ = std::move(*driver);
  return line;
}

void ControlLine::on_event(wire::Event& event) {
  if (auto* text = std::get_if<wire::TextReceived>(&event)) return on_text(std::move(text->text));
  if (auto* began = std::get_if<wire::TransferBegan>(&event)) {
    if (!began->is_receiving) return post_pump();
    put(What::Began, std::move(began->name));
  } else if (const auto* ended = std::get_if<wire::TransferEnded>(&event)) {
    if (ended->is_receiving) {
      put(What::Ended, {});
    } else {
      const std::lock_guard lock(mutex_);
      sending_ = Sending::Nothing;
    }
    resume_line();
  } else if (auto* failed = std::get_if<wire::TransferFailed>(&event)) {
    {
      const std::lock_guard lock(mutex_);
      // A broken piece was sent: the rest is useless.
      if (sending_ != Sending::Nothing) output_.clear();
      sending_ = Sending::Nothing;
    }
    put(What::Failed, std::move(failed->error.what));
    resume_line();
  } else if (auto* fault = std::get_if<wire::LineError>(&event)) {
    put(What::Fault, std::move(fault->error.what));
  } else if (auto* asked = std::get_if<wire::TransferRequest>(&event)) {
    const bool is_offer = asked->kind == wire::TransferRequest::Kind::TakeProgram;
    put(is_offer ? What::Offered : What::Asked, std::move(asked->name));
  }
}

void ControlLine::on_text(std::string&& text) {
  bool is_full = false, is_overrun = false;
  {
    const std::lock_guard lock(mutex_);
    held_ += text.size();
    if (is_ready_ && held_ >= parts_.buffer_bytes) {
      is_ready_ = false;
      is_full = true;
    }
    is_overrun = held_ > parts_.buffer_bytes + kMaxOverrun && !std::exchange(is_overrun_, true);
    if (is_overrun_) held_ -= text.size();
  }
  if (is_full)
    driver_->post([](wire::Discipline& end, wire::LineTime now) { end.set_ready(false, now); });
  if (is_overrun)
    return put(What::Failed,
               fmt::format("the host continues to send although it is held: {} bytes beyond "
                           "a full memory",
                           kMaxOverrun));
  {
    const std::lock_guard lock(mutex_);
    if (is_overrun_) return;
  }
  put(What::Text, std::move(text));
}

void ControlLine::put(What what, std::string text) {
  {
    const std::lock_guard lock(mutex_);
    if (what == What::Text && !items_.empty() && items_.back().what == What::Text) {
      items_.back().text += text;
      return;  // the owner was notified already
    }
    // Only faults are unbounded (text is held off), and only while `take` is not called.
    if (items_.size() >= kMaxItems && what == What::Fault) return;
    items_.push_back({what, std::move(text)});
  }
  if (parts_.wake) parts_.wake();
}

std::vector<LineItem> ControlLine::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(items_, {});
}

void ControlLine::release(std::size_t bytes) {
  {
    const std::lock_guard lock(mutex_);
    held_ -= std::min(held_, bytes);
    if (held_ <= parts_.buffer_bytes / 2) is_overrun_ = false;
    if (is_ready_ || held_ > parts_.buffer_bytes / 2) return;
    is_ready_ = true;
  }
  driver_->post([](wire::Discipline& end, wire::LineTime now) { end.set_ready(true, now); });
}

void ControlLine::expect(const wire::TransferRequest* request) {
  std::optional<wire::TransferRequest> wanted;
  if (request != nullptr) wanted = *request;
  driver_->post([this, wanted](wire::Discipline& end, wire::LineTime now) {
    is_expecting_ = true;
    request_ = wanted;
    listen(end, now);
  });
}

/// Output goes first. The request to listen may have overtaken the end of the transfer before it:
/// an XMODEM that then asked its host for a program would wait for a host that asks for the output.
void ControlLine::listen(wire::Discipline& end, wire::LineTime now) {
  if (!is_expecting_) return;
  pump(end, now);
  const auto done = request_ ? end.request(*request_, now) : end.begin_receive("", now);
  const bool is_busy = !done && done.error().code == Errc::Busy;
  if (is_busy && end.state().phase == wire::Phase::Sending) return;  // again when it has ended
  is_expecting_ = false;
  if (!done && !is_busy) put(What::Fault, done.error().what);
}

void ControlLine::refuse(std::string reason) {
  driver_->post([reason = std::move(reason)](wire::Discipline& end, wire::LineTime now) {
    (void)end.refuse(reason, now);
  });
}

void ControlLine::abort() {
  driver_->post([this](wire::Discipline& end, wire::LineTime now) {
    // A line that sends and receives at once cannot report an abort; its output continues.
    const std::lock_guard lock(mutex_);
    if (sending_ == Sending::Nothing) end.abort(now);
  });
}

bool ControlLine::send(std::string_view text) {
  {
    const std::lock_guard lock(mutex_);
    if (output_.size() + text.size() > kMaxOutput) return false;
    output_ += text;
  }
  post_pump();
  return true;
}

void ControlLine::post_pump() {
  driver_->post([this](wire::Discipline& end, wire::LineTime now) { pump(end, now); });
}

/// The line is free, or freer than before.
void ControlLine::resume_line() {
  driver_->post([this](wire::Discipline& end, wire::LineTime now) {
    pump(end, now);
    listen(end, now);
  });
}

/// The present output is one transfer; text that is queued meanwhile is the next one.
void ControlLine::pump(wire::Discipline& end, wire::LineTime now) {
  const std::lock_guard lock(mutex_);
  if (output_.empty() || sending_ == Sending::End) return;
  if (sending_ == Sending::Nothing) {
    if (!end.begin_send("", now)) return;  // busy: tried again at the end of what is in progress
    sending_ = Sending::Text;
  }
  // A TNC asks its device first, and continues when the device has agreed.
  if (end.state().phase != wire::Phase::Sending) return;
  const std::size_t size = std::min(output_.size(), end.room());
  if (size == 0) return;
  const std::string piece = output_.substr(0, size);
  output_.erase(0, size);
  if (output_.empty()) sending_ = Sending::End;
  (void)end.offer(piece, output_.empty(), now);  // a failure arrives as an event
}

bool ControlLine::is_quiet() const {
  return std::chrono::nanoseconds(steady_now() - heard_) >= parts_.settings.idle_end;
}

bool ControlLine::has_sent_all() const {
  const std::lock_guard lock(mutex_);
  return output_.empty() && sending_ == Sending::Nothing;
}

}  // namespace dripline::feed
