#include <spdlog/spdlog.h>
#include <algorithm>

#include "gateway/app/gateway.hpp"
#include "protocol/base/names.hpp"
#include "protocol/base/random.hpp"

/// The part of the gateway that is a control at the end of a line: text that comes begins a run and
/// is its program, what the program prints goes back.
namespace dripline::gateway {

using feed::LineItem;
using What = feed::LineItem::What;

namespace {

constexpr std::chrono::seconds kListenAgain{1};

/// On such a line silence is no end: a program that is drip-fed ends with its own last block.
bool is_open_ended(const wire::LineSettings& settings) {
  const bool is_plain = settings.flow == wire::Flow::None || settings.flow == wire::Flow::XonXoff ||
                        settings.flow == wire::Flow::RtsCts;
  return is_plain && !settings.end_character && !settings.wait_for_xon;
}

/// On such a line nothing comes unless the control's operator asks.
bool must_ask(const wire::LineSettings& settings) {
  return settings.flow == wire::Flow::Heidenhain || settings.flow == wire::Flow::HeidenhainBcc;
}

constexpr std::string_view kNext = "next";

bool is_blank(std::string_view text) {
  return text.find_first_not_of(" \t\r\n") == std::string_view::npos;
}

}  // namespace

void Gateway::serve_line(SteadyTime now) {
  if (parts_.line == nullptr) return;
  const bool is_stopped = machine_.panel().emergency_stop;
  if (line_ == Line::Closed && !is_stopped) listen(true);
  if (!is_stopped) {
    for (LineItem& item : std::exchange(held_items_, {})) take_line_item(item);
  }
  for (LineItem& item : parts_.line->take()) {
    if (is_stopped && is_of_next_run(item)) {
      held_items_.push_back(std::move(item));
    } else {
      take_line_item(item);
    }
  }
  release_line();
  if (line_ == Line::Draining && !session_ && parts_.line->is_quiet()) listen_at_ = now;
  if (!listen_at_ || now < *listen_at_) return;
  if (is_stopped) {
    listen_at_ = now + kListenAgain;
  } else {
    listen(true);
  }
}

/// Under an emergency stop no run begins: its text waits where it is, and the line's window holds
/// the host.
bool Gateway::is_of_next_run(const LineItem& item) const {
  return line_ == Line::Listening && !session_ &&
         (item.what == What::Began || item.what == What::Text || item.what == What::Ended ||
          item.what == What::Failed);
}

void Gateway::take_line_item(LineItem& item) {
  switch (item.what) {
    case What::Began:
      if (line_ == Line::Listening) line_program_ = std::move(item.text);
      return;
    case What::Text:
      return take_line_text(item.text);
    case What::Ended:
      return line_text_ended();
    case What::Failed:
      return line_failed(item.text);
    case What::Offered:
      return session_ ? parts_.line->refuse("a program is running") : listen(false);
    case What::Asked:
      return parts_.line->refuse("no program is to be sent from here");
    case What::Fault:
      if (const auto text = fmt::format("line: {}", item.text);
          std::exchange(line_fault_, text) != text)
        spdlog::warn("{} {}", text, label());
      // What was asked for could not begin, a busy line for instance.
      if (line_ == Line::Listening) listen_at_ = parts_.clock.steady_now() + kListenAgain;
      return;
    case What::Channel:
      spdlog::info("line {} {} {}", parts_.line->address(),
                   item.text.empty() ? "is open" : item.text, label());
      line_fault_ = item.text.empty() ? "" : fmt::format("line: {}", item.text);
      return;
  }
}

void Gateway::take_line_text(std::string_view text) {
  if (line_ == Line::Listening && !is_blank(text) && !session_ && !begin_line_run()) {
    line_ = Line::Draining;
    parts_.line->abort();
  }
  if (line_ != Line::Feeding) return parts_.line->release(text.size());
  line_fault_.clear();
  line_feed_->append(text);
}

void Gateway::line_text_ended() {
  if (line_ == Line::Feeding && is_open_ended(parts_.line->settings()))
    return parts_.line->expect();  // silence only: the run goes on when more comes
  if (line_ == Line::Feeding) {
    line_feed_->end();
    line_ = Line::Complete;
  } else if (line_ == Line::Listening) {
    listen(false);
  } else if (line_ == Line::Draining && !session_) {
    listen(true);
  }
}

void Gateway::line_failed(const std::string& reason) {
  if (const auto text = fmt::format("line: {}", reason); std::exchange(line_fault_, text) != text)
    spdlog::warn("{} {}", text, label());
  if (line_ == Line::Feeding) {
    line_feed_->break_off(line_fault_);
    line_ = Line::Complete;
  } else if (line_ == Line::Listening || (line_ == Line::Draining && !session_)) {
    listen_at_ = parts_.clock.steady_now() + kListenAgain;
  }
}

bool Gateway::begin_line_run() {
  const bool is_named = check_program_name(line_program_).has_value();
  const report::ActiveRun run{.run = "line-" + random_hex(8),
                              .program = is_named ? line_program_ : "line",
                              .revision = "",
                              .control = parts_.options.control};
  auto feed = std::make_unique<feed::LineFeed>();
  auto* raw = feed.get();
  if (const auto done = begin_run(run, std::move(feed), {}); !done) {
    spdlog::error("program {} from line {} not begun: {} {}", run.program, parts_.line->address(),
                  done.error().what, label());
    last_message_ = valid_text(done.error().what, kMaxReason);
    return false;
  }
  if (line_request_ != kNext) line_request_.clear();  // asked for until it has come
  line_feed_ = raw;
  line_released_ = 0;
  line_ = Line::Feeding;
  spdlog::info("run begins with text from line {} {}", parts_.line->address(), label());
  return true;
}

/// Asks the host for a program, if that is this control's way, or waits for one.
void Gateway::listen(bool may_ask) {
  listen_at_.reset();
  line_ = Line::Listening;
  line_program_.clear();
  const std::string& wanted = line_request_;
  if (!may_ask || wanted.empty()) {
    if (must_ask(parts_.line->settings())) return;
    return parts_.line->expect();
  }
  wire::TransferRequest request;
  if (wanted != kNext) request.name = wanted;
  parts_.line->expect(&request);
}

/// What is left of the run's text must not become the next run.
void Gateway::line_run_over() {
  if (parts_.line == nullptr) return;
  const bool is_complete = line_ == Line::Complete;
  if (!is_complete && last_execution_ != dds::Execution::ProgramCompleted) parts_.line->abort();
  line_ = is_complete ? Line::Closed : Line::Draining;
  listen_at_.reset();
  if (is_complete) listen_at_ = parts_.clock.steady_now();
  parts_.line->release(static_cast<std::size_t>(-1));
}

void Gateway::release_line() {
  if (line_feed_ == nullptr || line_feed_->consumed() <= line_released_) return;
  parts_.line->release(static_cast<std::size_t>(line_feed_->consumed() - line_released_));
  line_released_ = line_feed_->consumed();
}

/// A file of the control stays in the control.
void Gateway::print_on_line(const interpreter::Output& output) {
  using interpreter::OutputDevice;
  const bool leaves = output.device == OutputDevice::Port1 ||
                      output.device == OutputDevice::Port2 ||
                      output.device == OutputDevice::Printer;
  if (parts_.line == nullptr || !leaves) return;
  if (!parts_.line->send(std::string(output.text) + "\n"))
    spdlog::error("line {} takes no more output; the records have it {}", parts_.line->address(),
                  label());
}

}  // namespace dripline::gateway
