#include "gateway/app/line_operator.hpp"

#include <algorithm>
#include <utility>

#include "gateway/line/inbound/program_head.hpp"
#include "protocol/base/names.hpp"
#include "protocol/base/random.hpp"
#include "protocol/process/log.hpp"

namespace dripline::gateway {

using feed::LineItem;
using What = feed::LineItem::What;

namespace {

constexpr std::chrono::seconds kListenAgain{1};
constexpr std::chrono::milliseconds kDrainPoll{100};
constexpr std::string_view kNext = "next";

/// On such a line silence is no end: a program that is drip-fed ends with its own last block.
bool is_open_ended(const wire::LineSettings& settings) {
  const bool is_plain = settings.flow == wire::Flow::None || settings.flow == wire::Flow::XonXoff ||
                        settings.flow == wire::Flow::RtsCts;
  return is_plain && !settings.end_character && !settings.wait_for_xon;
}

/// On such a line nothing arrives unless the control's operator asks.
bool must_ask(const wire::LineSettings& settings) {
  return settings.flow == wire::Flow::Heidenhain || settings.flow == wire::Flow::HeidenhainBcc;
}

/// Each transfer has a beginning of its own: no rest of a text can be taken for one.
bool is_framed(const wire::LineSettings& settings) {
  return must_ask(settings) || settings.flow == wire::Flow::Xmodem;
}

bool is_tape(const wire::LineSettings& settings) {
  return settings.flow == wire::Flow::TapeReader;
}

constexpr std::string_view kNeedsReset =
    "the rest of a text whose run was cut off begins no run: send the program from its beginning, "
    "or press cycle start at the machine's panel to take what comes next";
constexpr std::string_view kTapeNeedsReset =
    "the tape is where its run was cut off: put it where it has to be read from, then press cycle "
    "start at the machine's panel";
constexpr std::size_t kMaxFirstLine = 256;

constexpr std::string_view kBlanks = " \t\r\n";

bool is_blank(std::string_view text) {
  return text.find_first_not_of(kBlanks) == std::string_view::npos;
}

std::string_view first_line(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
  return text.substr(0, text.find('\n'));
}

/// Nothing but blanks has none to wait for.
bool has_first_line(std::string_view text) {
  const std::string_view line = first_line(text);
  return line.empty() || line.size() >= kMaxFirstLine || line.end() != text.end();
}

/// The rewind stop of a tape, or the name of a program.
bool is_beginning(std::string_view text) {
  const std::string_view line = first_line(text);
  return line.starts_with('%') || line::begins_program(line, false);
}

}  // namespace

LineOperator::LineOperator(Parts parts)
    : parts_(std::move(parts)),
      losses_(parts_.line.address()),
      is_in_doubt_(parts_.doubt.is_set() && !is_framed(parts_.line.settings())),
      request_(parts_.request) {}

void LineOperator::poll(SteadyTime now) {
  const bool is_stopped = parts_.machine.panel().emergency_stop;
  if (state_ == State::Closed && !is_stopped) listen(true);
  if (!is_stopped) {
    for (LineItem& item : std::exchange(held_, {})) take(item);
  }
  for (LineItem& item : parts_.line.take()) {
    if (is_stopped && belongs_to_next_run(item)) {
      held_.push_back(std::move(item));
    } else {
      take(item);
    }
  }
  release();
  const bool is_drained = state_ == State::Draining && !parts_.run.session && now >= drained_from_;
  if (is_drained && parts_.line.is_quiet()) listen_at_ = now;
  if (!listen_at_ || now < *listen_at_) return;
  if (is_stopped) {
    listen_at_ = now + kListenAgain;
  } else {
    listen(true);
  }
}

std::optional<SteadyTime> LineOperator::next_poll(SteadyTime now) const {
  std::optional<SteadyTime> next = listen_at_;
  if (state_ != State::Draining) return next;
  const SteadyTime look = now + kDrainPoll;
  return next ? std::min(*next, look) : look;
}

/// Under an emergency stop no run begins: its text waits where it is, and the line's window holds
/// the host.
bool LineOperator::belongs_to_next_run(const LineItem& item) const {
  return state_ == State::Listening && !parts_.run.session &&
         (item.what == What::Began || item.what == What::Text || item.what == What::Ended ||
          item.what == What::Failed);
}

void LineOperator::take(LineItem& item) {
  switch (item.what) {
    case What::Began:
      if (state_ == State::Listening) program_ = std::move(item.text);
      return;
    case What::Text:
      return take_text(item.text);
    case What::Ended:
      return end_text();
    case What::Failed:
      return fail_text(item.text);
    case What::Offered:
      return parts_.run.session ? parts_.line.refuse("a program is running") : listen(false);
    case What::Asked:
      return parts_.line.refuse("no program is to be sent from here");
    case What::Fault:
      set_fault(item.text);
      // What was asked for could not begin, on a busy line for instance.
      if (state_ == State::Listening) listen_at_ = parts_.clock.steady_now() + kListenAgain;
      return;
    case What::Channel:
      return on_channel(item.text);
    case What::Steady:
      return on_steady();
  }
}

void LineOperator::on_channel(const std::string& lost) {
  log_line(lost.empty() ? losses_.on_open() : losses_.on_lost(lost, parts_.clock.steady_now()));
  fault_ = lost.empty() ? "" : fmt::format("line: {}", lost);
}

void LineOperator::on_steady() {
  logged_faults_.clear();
  log_line(losses_.on_steady());
}

void LineOperator::log_line(const std::optional<line::LossLog::Message>& message) const {
  line::log_message(fmt::format("line={} {}", address(), parts_.run.label()), message);
}

/// A fault that lasts is logged once, also when a line that comes and goes repeats it.
void LineOperator::set_fault(std::string_view reason) {
  fault_ = fmt::format("line: {}", reason);
  constexpr std::size_t kMaxFaults = 16;
  if (logged_faults_.size() < kMaxFaults && logged_faults_.insert(fault_).second)
    process::log_warning("{} {}", fault_, parts_.run.label());
}

void LineOperator::take_text(std::string_view text) {
  head_ += text;
  const bool is_first = state_ == State::Listening && !parts_.run.session;
  if (is_first && is_in_doubt_ && !has_first_line(head_)) return;
  if (is_first && !is_blank(head_)) begin_text();
  const std::string taken = std::exchange(head_, {});
  if (state_ != State::Feeding) return parts_.line.release(taken.size());
  fault_.clear();
  logged_faults_.clear();
  feed_->append(taken);
}

void LineOperator::begin_text() {
  const bool is_rest = is_in_doubt_ && !is_beginning(head_);
  if (is_rest) set_fault(kNeedsReset);
  if (!is_rest) {
    const auto begun = begin_run();
    if (begun) return;
    process::log_error("text from line {} begins no run: {} {}", address(), begun.error().what,
                       parts_.run.label());
    parts_.run.last_message = valid_text(begun.error().what, kMaxReason);
  }
  doubt_text();
  state_ = State::Draining;
  parts_.line.abort();
}

void LineOperator::doubt_text() {
  is_in_doubt_ = !is_framed(parts_.line.settings());
  if (is_in_doubt_) keep_doubt(true);
}

void LineOperator::keep_doubt(bool is_in_doubt) const {
  const auto kept = is_in_doubt ? parts_.doubt.set() : parts_.doubt.clear();
  if (!kept) process::log_error("{} {}", kept.error().what, parts_.run.label());
}

/// The line listens again from `poll`.
bool LineOperator::reset() {
  if (!std::exchange(is_in_doubt_, false)) return false;
  keep_doubt(false);
  fault_.clear();
  logged_faults_.clear();
  if (state_ == State::Locked) state_ = State::Closed;
  return true;
}

/// A single line without its end is no program.
void LineOperator::drop_head() {
  if (!head_.empty()) parts_.line.release(std::exchange(head_, {}).size());
}

void LineOperator::end_text() {
  drop_head();
  if (state_ == State::Feeding && is_open_ended(parts_.line.settings()))
    return parts_.line.expect();  // silence only: the run continues when more arrives
  if (state_ == State::Feeding) {
    feed_->end();
    state_ = State::Complete;
  } else if (state_ == State::Listening) {
    listen(false);
  } else if (state_ == State::Draining && !parts_.run.session) {
    listen(true);
  }
}

/// The host may go on sending: the rest of a text that broke off must not become the next run.
void LineOperator::fail_text(const std::string& reason) {
  set_fault(reason);
  drained_from_ = parts_.clock.steady_now() + kListenAgain;
  if (state_ == State::Feeding) {
    feed_->break_off(fault_);
    state_ = State::BrokenOff;
  } else if (state_ == State::Listening) {
    drop_head();
    if (is_tape(parts_.line.settings())) doubt_text();  // in front of its first whole block
    state_ = State::Draining;
    listen_at_.reset();
  }
}

/// What the next life has to know is on disk before the first block.
Result<void> LineOperator::begin_run() {
  const bool is_named = check_program_name(program_).has_value();
  const report::ActiveRun run{.run = "line-" + random_hex(8),
                              .program = is_named ? program_ : "line",
                              .revision = "",
                              .control = parts_.control};
  auto feed = std::make_unique<feed::LineFeed>();
  auto* raw = feed.get();
  if (!is_framed(parts_.line.settings())) {
    if (auto kept = parts_.doubt.set(); !kept) return kept;
  }
  if (auto done = parts_.begin_run(run, std::move(feed)); !done) return done;
  if (request_ != kNext) request_.clear();  // asked for until it has arrived
  feed_ = raw;
  released_ = 0;
  state_ = State::Feeding;
  is_in_doubt_ = false;
  process::log_info("run begins with text from line {} {}", address(), parts_.run.label());
  return {};
}

/// Asks the host for a program where this control does so, or waits for one.
void LineOperator::listen(bool may_ask) {
  listen_at_.reset();
  drop_head();
  if (is_in_doubt_ && is_tape(parts_.line.settings())) {
    state_ = State::Locked;
    return set_fault(kTapeNeedsReset);
  }
  state_ = State::Listening;
  program_.clear();
  if (!may_ask || request_.empty()) {
    if (must_ask(parts_.line.settings())) return;
    return parts_.line.expect();
  }
  wire::TransferRequest request;
  if (request_ != kNext) request.name = request_;
  parts_.line.expect(&request);
}

/// What is left of the run's text must not become the next run.
void LineOperator::on_run_over() {
  feed_ = nullptr;
  const bool is_complete = state_ == State::Complete;
  const bool is_completed = parts_.run.last_execution == dds::Execution::ProgramCompleted;
  if (!is_complete && !is_completed) parts_.line.abort();
  const bool is_cut = !is_completed && (!is_complete || is_tape(parts_.line.settings()));
  is_cut ? doubt_text() : keep_doubt(false);
  state_ = is_complete ? State::Closed : State::Draining;
  listen_at_.reset();
  if (is_complete) listen_at_ = parts_.clock.steady_now();
  parts_.line.release(static_cast<std::size_t>(-1));
}

void LineOperator::release() {
  if (feed_ == nullptr || feed_->consumed() <= released_) return;
  parts_.line.release(static_cast<std::size_t>(feed_->consumed() - released_));
  released_ = feed_->consumed();
}

/// A file of the control stays in the control.
void LineOperator::print(const interpreter::Output& output) {
  using interpreter::OutputDevice;
  const bool leaves = output.device == OutputDevice::Port1 ||
                      output.device == OutputDevice::Port2 ||
                      output.device == OutputDevice::Printer;
  if (!leaves) return;
  if (!parts_.line.send(std::string(output.text) + "\n"))
    process::log_error("line {} takes no more output; the records have it {}", address(),
                       parts_.run.label());
}

}  // namespace dripline::gateway
