#include "tests/support/line/host_line.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace dripline::test_support {

HostLine::HostLine(const std::string& address, const wire::LineSettings& settings) {
  serial::LineListener listener;
  listener.on_event = [this](wire::Event& event) { on_event(event); };
  listener.on_traffic = [this](const serial::LineTraffic& traffic) {
    const std::lock_guard lock(mutex_);
    if (traffic.what == serial::LineTraffic::What::Sent) sent_ += traffic.bytes.size();
  };
  listener.on_room = [this] {
    line_->post([this](wire::Discipline& end, wire::LineTime now) { pump(end, now); });
  };
  auto line = serial::LineDriver::start({.address = address,
                                         .settings = settings,
                                         .role = wire::Role::Host,
                                         .listener = std::move(listener),
                                         .reopen_after = std::chrono::milliseconds(50)});
  if (!line) {
    std::fprintf(stderr, "host line: %s\n", line.error().what.c_str());
    std::abort();
  }
  line_ = std::move(*line);
}

HostLine::~HostLine() {
  line_.reset();  // its thread uses everything else
}

void HostLine::on_event(wire::Event& event) {
  const std::lock_guard lock(mutex_);
  if (auto* text = std::get_if<wire::TextReceived>(&event)) {
    received_ += text->text;
    receiving_ += text->text;
  } else if (const auto* ended = std::get_if<wire::TransferEnded>(&event)) {
    if (!ended->is_receiving) {
      is_sending_ = false;
    } else {
      ++transfers_received_;
      last_received_ = std::exchange(receiving_, {});
    }
  } else if (auto* failed = std::get_if<wire::TransferFailed>(&event)) {
    failures_.push_back(failed->error.what);
    is_sending_ = is_begun_ = false;
    text_.clear();
    receiving_.clear();
  } else if (auto* asked = std::get_if<wire::TransferRequest>(&event)) {
    requests_.push_back(*asked);
    if (asked->kind == wire::TransferRequest::Kind::SendProgram && !answer_.empty()) {
      text_ = std::exchange(answer_, {});
      name_ = asked->name;
      is_sending_ = true;
      is_begun_ = false;
      line_->post([this](wire::Discipline& end, wire::LineTime now) { pump(end, now); });
    }
    if (asked->kind != wire::TransferRequest::Kind::TakeProgram) return;
    line_->post(
        [](wire::Discipline& end, wire::LineTime now) { (void)end.begin_receive("", now); });
  }
}

void HostLine::send(std::string text, std::string name) {
  {
    const std::lock_guard lock(mutex_);
    text_ = std::move(text);
    name_ = std::move(name);
    is_sending_ = true;
    is_begun_ = false;
  }
  line_->post([this](wire::Discipline& end, wire::LineTime now) { pump(end, now); });
}

void HostLine::pump(wire::Discipline& end, wire::LineTime now) {
  const std::lock_guard lock(mutex_);
  if (!is_sending_ || (is_begun_ && text_.empty())) return;
  if (!is_begun_) {
    if (const auto begun = end.begin_send(name_, now); !begun) {
      failures_.push_back(begun.error().what);
      is_sending_ = false;
      return;
    }
    is_begun_ = true;
  }
  const std::string piece = text_.substr(0, end.room());
  if (piece.empty()) return;
  text_.erase(0, piece.size());
  if (const auto offered = end.offer(piece, text_.empty(), now); !offered)
    failures_.push_back(offered.error().what);
}

void HostLine::abort() {
  line_->post([](wire::Discipline& end, wire::LineTime now) { end.abort(now); });
  const std::lock_guard lock(mutex_);
  text_.clear();
  is_sending_ = false;
}

void HostLine::receive() {
  line_->post([](wire::Discipline& end, wire::LineTime now) { (void)end.begin_receive("", now); });
}

void HostLine::answer_with(std::string text) {
  const std::lock_guard lock(mutex_);
  answer_ = std::move(text);
}

std::string HostLine::received() const {
  const std::lock_guard lock(mutex_);
  return received_;
}
std::string HostLine::last_received() const {
  const std::lock_guard lock(mutex_);
  return last_received_;
}
bool HostLine::is_idle() const {
  const std::lock_guard lock(mutex_);
  return !is_sending_;
}
std::uint64_t HostLine::sent() const {
  const std::lock_guard lock(mutex_);
  return sent_;
}
std::vector<std::string> HostLine::failures() const {
  const std::lock_guard lock(mutex_);
  return failures_;
}
std::vector<wire::TransferRequest> HostLine::requests() const {
  const std::lock_guard lock(mutex_);
  return requests_;
}
std::size_t HostLine::transfers_received() const {
  const std::lock_guard lock(mutex_);
  return transfers_received_;
}

}  // namespace dripline::test_support
