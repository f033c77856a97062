#include "clients/tools/lines/line_replay.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>

#include "protocol/wire/tnc_frames.hpp"

namespace dripline::wire {
namespace {

constexpr char kDc1 = 0x11, kDc3 = 0x13;
/// How far one end may be ahead of the recording with its answers.
constexpr std::size_t kMaxAhead = 4096;
constexpr LineTime kLastWait = std::chrono::hours(1);
constexpr unsigned kMaxTicks = 100'000;

std::string shown_character(char c) {
  const auto byte = static_cast<unsigned char>(c);
  if (byte == 0x06) return "ACK";
  if (byte == 0x15) return "NAK";
  if (byte == 0x04) return "EOT";
  if (byte == 0x18) return "CAN";
  if (byte > 0x20 && byte < 0x7F) return fmt::format("'{}'", c);
  return fmt::format("0x{:02X}", static_cast<unsigned>(byte));
}

bool has_text(std::string_view bytes) {
  return std::ranges::any_of(bytes, [](char c) { return (c & 0x7F) > ' '; });
}

bool is_checked(Flow flow) {
  return flow == Flow::Xmodem || flow == Flow::HeidenhainBcc;
}

}  // namespace

Result<LineReplay> LineReplay::make(const LineSettings& settings) {
  auto host = make_discipline(settings, Role::Host);
  if (!host) return fail(host.error());
  auto control = make_discipline(settings, Role::Control);
  if (!control) return fail(control.error());
  return LineReplay(settings, std::move(*host), std::move(*control));
}

LineReplay::LineReplay(const LineSettings& settings, std::unique_ptr<Discipline> host,
                       std::unique_ptr<Discipline> control)
    : settings_(settings), report_(std::make_unique<ReplayReport>()) {
  host_.line = std::move(host);
  host_.transfers = &report_->from_control;
  control_.line = std::move(control);
  control_.transfers = &report_->to_control;
  control_.is_control = true;
}

void LineReplay::play(const RecordedTraffic& entry) {
  pass_time(std::max(now_, entry.time));
  using enum RecordedTraffic::What;
  if (entry.what == Sent) {
    report_->sent += entry.bytes.size();
    begin_control(entry);
    hear(control_, entry.bytes);
  } else if (entry.what == Received) {
    report_->received += entry.bytes.size();
    if (control_.line->state().phase == Phase::Idle) ask_as_recorded(entry.bytes);
    for (const char c : entry.bytes) {
      if (is_comparable(c)) recorded_ += c;
      if (!is_checked(settings_.flow)) hold(c);
    }
    // Only text that a plain control punches is taken: its DC3 and DC1 are none.
    const bool begins = host_.line->state().phase == Phase::Idle && has_text(entry.bytes);
    if (begins && settings_.flow != Flow::HeidenhainBcc && settings_.flow != Flow::TapeReader) {
      (void)host_.line->begin_receive("", now_);
    }
    hear(host_, entry.bytes);
  } else if (entry.what == Fault) {
    ++report_->faults;
    host_.line->fault(LineFault::Parity, now_);
    serve(host_);
  }
  compare();
}

/// The simulated control holds the line when the recorded one did, or the silence would end what it
/// takes.
void LineReplay::hold(char c) {
  const char low = static_cast<char>(c & 0x7F);
  if (low == kDc1 || low == kDc3) control_.line->set_ready(low == kDc1, now_);
  serve(control_);
}

/// A control whose operator pressed the key: it is ready when text comes.
void LineReplay::begin_control(const RecordedTraffic& entry) {
  const bool asks_first =
      settings_.flow == Flow::HeidenhainBcc || settings_.flow == Flow::Heidenhain;
  if (asks_first || control_.line->state().phase != Phase::Idle) return;
  if (!has_text(entry.bytes) && settings_.flow != Flow::TapeReader) return;
  (void)control_.line->begin_receive("", now_);
  serve(control_);
}

/// The control's own request, repeated by the simulated one.
void LineReplay::ask_as_recorded(const std::string& bytes) {
  using Kind = TransferRequest::Kind;
  const auto& tnc = settings_.heidenhain;
  if (settings_.flow == Flow::HeidenhainBcc) {
    const auto begin = bytes.find(tnc.soh);
    const auto end = bytes.find(tnc.etb, begin == bytes.npos ? 0 : begin);
    if (begin == bytes.npos || end == bytes.npos || end < begin + 3) return;
    const auto number = bytes.substr(begin + 2, end - begin - 3);
    if (bytes[end - 1] == 'E') (void)control_.line->request({Kind::SendProgram, number}, now_);
  } else if (settings_.flow == Flow::Xmodem) {
    if (bytes.front() == 'C' || bytes.front() == 0x15) (void)control_.line->begin_receive("", now_);
  } else if (bytes.find(kDc1) != bytes.npos && !has_text(bytes)) {
    (void)control_.line->begin_receive("", now_);
  }
  serve(control_);
}

void LineReplay::hear(End& end, const std::string& bytes) {
  end.line->receive(std::as_bytes(std::span(bytes)), now_);
  serve(end);
}

/// Everything that is due before `now`, in order.
void LineReplay::pass_time(LineTime now) {
  for (unsigned ticks = 0; ticks < kMaxTicks; ++ticks) {
    std::optional<LineTime> next;
    for (const End* end : {&host_, &control_}) {
      const auto due = end->line->deadline();
      if (due) next = next ? std::min(*next, *due) : due;
    }
    if (!next || *next > now) break;
    now_ = std::max(now_, *next);
    for (End* end : {&host_, &control_}) {
      const auto due = end->line->deadline();
      if (due && *due <= now_) end->line->tick(now_);
      serve(*end);
    }
  }
  now_ = now;
}

void LineReplay::serve(End& end) {
  std::array<std::byte, 256> room{};
  for (;;) {
    const auto events = end.line->take_events();
    for (const auto& event : events) take(end, event);
    const auto count = end.line->transmit(room, now_);
    if (end.is_control) {
      for (const auto byte : std::span(room).first(count)) {
        if (is_comparable(static_cast<char>(byte))) simulated_ += static_cast<char>(byte);
      }
    }
    if (count == 0 && events.empty()) return;
  }
}

void LineReplay::take(End& end, const Event& event) {
  const std::string_view who = end.is_control ? "the control" : "the host";
  auto& transfers = *end.transfers;
  if (const auto* began = std::get_if<TransferBegan>(&event)) {
    if (began->is_receiving) transfers.push_back({began->name, "", false});
  } else if (const auto* text = std::get_if<TextReceived>(&event)) {
    if (transfers.empty()) transfers.push_back({});
    if (text_kept_ + text->text.size() > kMaxText) return say("too much text: no more is kept");
    text_kept_ += text->text.size();
    transfers.back().text += text->text;
  } else if (const auto* ended = std::get_if<TransferEnded>(&event)) {
    if (ended->is_receiving && !transfers.empty()) transfers.back().has_ended = true;
  } else if (const auto* failed = std::get_if<TransferFailed>(&event)) {
    say(fmt::format("{} would end the transfer: {}", who, failed->error.what));
  } else if (const auto* error = std::get_if<LineError>(&event)) {
    say(fmt::format("{} notices: {}", who, error->error.what));
  } else if (const auto* request = std::get_if<TransferRequest>(&event)) {
    if (request->kind == TransferRequest::Kind::TakeProgram) {
      (void)end.line->begin_receive(request->name, now_);
    }
  }
}

/// Only a checked protocol's answers are decided by what came before; when a control sends stop and
/// go is its own affair.
bool LineReplay::is_comparable(char c) const {
  const char low = static_cast<char>(c & 0x7F);
  return is_checked(settings_.flow) && low != kDc1 && low != kDc3;
}

void LineReplay::compare() {
  const std::size_t both = std::min(recorded_.size(), simulated_.size());
  for (std::size_t i = 0; i < both; ++i) {
    if (recorded_[i] == simulated_[i]) continue;
    ++report_->deviations;
    say(fmt::format("the recorded control sent {}, the simulated one {}",
                    shown_character(recorded_[i]), shown_character(simulated_[i])));
  }
  recorded_.erase(0, both);
  simulated_.erase(0, both);
  if (recorded_.size() > kMaxAhead) recorded_.clear();
  if (simulated_.size() > kMaxAhead) simulated_.clear();
}

void LineReplay::say(std::string text) {
  if (report_->findings.size() >= kMaxFindings) return;
  report_->findings.push_back(
      fmt::format("{:.3f} s: {}", std::chrono::duration<double>(now_).count(), text));
}

ReplayReport LineReplay::finish() {
  pass_time(now_ + kLastWait);
  compare();
  if (!recorded_.empty() && !control_.transfers->empty()) {
    report_->deviations += recorded_.size();
    say(fmt::format("the recorded control sent {} characters more than the simulated one",
                    recorded_.size()));
  }
  return std::move(*report_);
}

}  // namespace dripline::wire
