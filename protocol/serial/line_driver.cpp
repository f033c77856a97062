#include "protocol/serial/line_driver.hpp"

#include <poll.h>
#include <pthread.h>
#include <sys/prctl.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <mutex>
#include <thread>

#include "protocol/serial/impl/command_queue.hpp"

namespace dripline::serial {
namespace {

using namespace std::chrono_literals;
using wire::LineTime;

constexpr int kMaxReads = 32;  ///< reads of the channel before other work
constexpr LineTime kLinesInterval = 100ms, kHeldLinesInterval = 2ms;
constexpr LineTime kLongestWait = 1s, kForbiddenInterval = 20ms;
constexpr std::size_t kRoomStep = 256;  ///< additional room that is worth a call

std::string_view words_of(wire::LineFault fault) {
  constexpr std::array<std::string_view, 4> kWords{"parity error", "framing error", "overrun",
                                                   "break"};
  return kWords[static_cast<std::size_t>(fault)];
}

class Line final : public LineDriver {
 public:
  Line(Parts parts, std::unique_ptr<wire::Discipline> discipline)
      : parts_(std::move(parts)),
        discipline_(std::move(discipline)),
        pacer_(wire::character_time(parts_.settings)) {}
  ~Line() override { Line::stop(); }
  void stop() override {
    stops_ = true;
    commands_.wake();
    if (thread_.joinable()) thread_.join();
    channel_.reset();
    is_open_ = false;
  }
  void begin() { thread_ = std::thread(&Line::run, this); }

  void post(std::function<void(wire::Discipline&, LineTime)> work) override {
    commands_.push(std::move(work));
  }
  wire::LineState state() const override {
    const std::lock_guard lock(mutex_);
    return state_;
  }
  bool is_open() const override { return is_open_; }

 private:
  void run();
  void turn();
  void open();
  void note_steady();
  void lose(const Error& error);
  void fail_transfer(const Error& error);
  void do_posted();
  Result<void> read();
  Result<void> look_at_lines();
  Result<void> transmit();
  Result<void> hand_over(std::span<const std::byte> characters);
  Result<void> set_lines();
  void publish();
  void watch_room();
  LineTime next_turn() const;
  void wait();

  LineTime now() const { return std::chrono::steady_clock::now() - began_; }
  void tell(LineTraffic::What what, std::span<const std::byte> bytes, std::string_view text) {
    if (parts_.listener.on_traffic) parts_.listener.on_traffic({what, now(), bytes, text});
  }
  bool may_transmit() const { return !parts_.may_transmit || parts_.may_transmit(); }
  bool polls_lines_closely() const { return wire::is_held_by_cts(parts_.settings); }

  Parts parts_;
  std::unique_ptr<wire::Discipline> discipline_;
  std::unique_ptr<Channel> channel_;
  Pacer pacer_;
  CommandQueue commands_;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();

  std::array<std::byte, 512> input_{};
  std::array<std::byte, Pacer::kWindow>
      held_{};  ///< from the discipline, not yet accepted by the channel
  std::size_t held_count_ = 0;
  bool is_forbidden_ = false;  ///< to transmit
  bool has_input_ = false, may_have_more_ = true, has_lines_ = true;
  LineTime open_at_{}, look_at_{}, ticked_{-1};
  std::optional<LineTime> steady_at_;  ///< of an opening that may not last
  std::optional<wire::InputLines> input_lines_;
  std::optional<wire::OutputLines> output_lines_;
  std::string fault_;  ///< reported last
  std::size_t told_room_ = 0;

  mutable std::mutex mutex_;
  wire::LineState state_;
  std::atomic<bool> is_open_ = false, stops_ = false;
  std::thread thread_;
};

void Line::run() {
  sigset_t all;
  sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, nullptr);
  ::pthread_setname_np(::pthread_self(), "line");
  ::prctl(PR_SET_TIMERSLACK, 1000UL);  // ns; 50 us otherwise, more than half a character
  while (!stops_) {
    turn();
    wait();
  }
}

void Line::turn() {
  do_posted();
  is_forbidden_ = !may_transmit();
  if (!channel_ && now() >= open_at_ && !is_forbidden_) open();
  if (channel_) {
    Result<void> done = has_input_ ? read() : Result<void>();
    if (done && now() >= look_at_) done = look_at_lines();
    if (!done) lose(done.error());
  }
  const auto deadline = discipline_->deadline();
  if (deadline && *deadline <= now()) {
    ticked_ = *deadline;
    discipline_->tick(now());
    may_have_more_ = true;
  }
  if (channel_) {
    Result<void> done = transmit();
    if (done) done = set_lines();
    if (!done) lose(done.error());
  }
  note_steady();
  publish();
}

void Line::note_steady() {
  if (!steady_at_ || now() < *steady_at_) return;
  steady_at_.reset();
  if (parts_.listener.on_steady) parts_.listener.on_steady();
}

void Line::do_posted() {
  for (const auto& work : commands_.take()) {
    work(*discipline_, now());
    may_have_more_ = true;
  }
}

void Line::open() {
  auto opened = parts_.open ? parts_.open()
                            : open_channel(parts_.address, parts_.settings, parts_.open_limit);
  if (!opened) {
    open_at_ = now() + parts_.reopen_after;
    if (std::exchange(fault_, opened.error().what) == opened.error().what) return;
    tell(LineTraffic::What::Note, {}, opened.error().what);
    if (parts_.listener.on_channel) parts_.listener.on_channel(&opened.error());
    return;
  }
  channel_ = std::move(*opened);
  fault_.clear();
  has_input_ = may_have_more_ = has_lines_ = true;
  input_lines_.reset();
  output_lines_.reset();
  look_at_ = now();
  steady_at_ = now() + parts_.steady_after;
  is_open_ = true;
  tell(LineTraffic::What::Note, {}, "open");
  if (parts_.listener.on_channel) parts_.listener.on_channel(nullptr);
}

void Line::lose(const Error& error) {
  channel_.reset();
  steady_at_.reset();
  is_open_ = false;
  held_count_ = 0;
  open_at_ = now() + parts_.reopen_after;
  fault_ = error.what;
  tell(LineTraffic::What::Note, {}, error.what);
  const bool is_checked = parts_.settings.flow == wire::Flow::Xmodem ||
                          parts_.settings.flow == wire::Flow::HeidenhainBcc;
  // Otherwise the discipline would wait forever for a block or an ACK that was lost with the
  // channel.
  if (!is_checked || discipline_->state().may_wait_without_limit) fail_transfer(error);
  if (parts_.listener.on_channel) parts_.listener.on_channel(&error);
}

void Line::fail_transfer(const Error& error) {
  const bool is_idle = discipline_->state().phase == wire::Phase::Idle;
  if (is_idle && !discipline_->state().is_asked) return;
  publish();
  discipline_->abort(now());  // the requesting end may be gone too
  // The characters that end the transfer must not reach the peer after reopening.
  std::array<std::byte, 64> discarded;
  for (int i = 0; i < 64 && discipline_->transmit(discarded, now()) > 0;) ++i;
  bool is_reported = false;
  for (wire::Event& event : discipline_->take_events()) {
    if (std::holds_alternative<wire::TransferFailed>(event)) is_reported = true;
    if (parts_.listener.on_event) parts_.listener.on_event(event);
  }
  if (is_idle) return;
  wire::Event failed = wire::TransferFailed{error};
  if (!is_reported && parts_.listener.on_event) parts_.listener.on_event(failed);
}

Result<void> Line::read() {
  has_input_ = false;
  for (int i = 0; i < kMaxReads; ++i) {
    const auto received = channel_->read(input_);
    if (!received) return fail(received.error());
    if (received->bytes == 0 && !received->fault) return {};
    may_have_more_ = true;
    const auto bytes = std::span<const std::byte>(input_).first(received->bytes);
    if (!bytes.empty()) {
      tell(LineTraffic::What::Received, bytes, {});
      discipline_->receive(bytes, now());
    }
    if (received->fault) {
      tell(LineTraffic::What::Fault, {}, words_of(*received->fault));
      discipline_->fault(*received->fault, now());
    }
  }
  has_input_ = true;
  return {};
}

Result<void> Line::look_at_lines() {
  const bool is_held = polls_lines_closely() && input_lines_ && !input_lines_->cts;
  look_at_ = now() + (is_held ? kHeldLinesInterval : kLinesInterval);
  if (!has_lines_) return {};
  const auto lines = channel_->input_lines();
  if (!lines) return fail(lines.error());
  // A device server reports them a little after the connection.
  if (!*lines || *lines == input_lines_) return {};
  input_lines_ = *lines;
  const auto word = [](bool is_on) { return is_on ? "on" : "off"; };
  tell(LineTraffic::What::Lines, {},
       fmt::format("CTS {} DSR {} DCD {}", word(input_lines_->cts), word(input_lines_->dsr),
                   word(input_lines_->dcd)));
  discipline_->lines(*input_lines_, now());
  may_have_more_ = true;
  return {};
}

Result<void> Line::transmit() {
  is_forbidden_ = !may_transmit();  // now: the thread may have been frozen since it was asked
  if (is_forbidden_) return {};
  if (held_count_ > 0) {
    const std::array<std::byte, Pacer::kWindow> again = held_;
    if (const auto done = hand_over(std::span(again).first(held_count_)); !done) return done;
    if (held_count_ > 0) return {};
  }
  if (!may_have_more_) return {};
  const std::size_t allowance = pacer_.allowance(now(), channel_->unsent());
  if (allowance == 0) return {};
  if (polls_lines_closely()) {
    if (const auto done = look_at_lines(); !done) return done;
  }
  std::array<std::byte, Pacer::kWindow> characters;
  const std::size_t count = discipline_->transmit(std::span(characters).first(allowance), now());
  may_have_more_ = count == allowance;
  if (count == 0) return {};
  pacer_.handed_over(count, now());
  return hand_over(std::span<const std::byte>(characters).first(count));
}

/// Characters that the channel does not accept stay here; they count as in the driver.
Result<void> Line::hand_over(std::span<const std::byte> characters) {
  const auto taken = channel_->write(characters);
  if (!taken) return fail(taken.error());
  if (*taken > 0) tell(LineTraffic::What::Sent, characters.first(*taken), {});
  const auto rest = characters.subspan(*taken);
  std::copy(rest.begin(), rest.end(), held_.begin());
  held_count_ = rest.size();
  return {};
}

Result<void> Line::set_lines() {
  const wire::OutputLines wanted = discipline_->output_lines();
  if (output_lines_ == wanted) return {};
  output_lines_ = wanted;
  return channel_->set_output_lines(wanted);
}

void Line::publish() {
  for (wire::Event& event : discipline_->take_events()) {
    if (parts_.listener.on_event) parts_.listener.on_event(event);
  }
  watch_room();
  const wire::LineState now_is = discipline_->state();
  const std::lock_guard lock(mutex_);
  state_ = now_is;
}

/// Reports room when there is enough of it, not for every character that left.
void Line::watch_room() {
  if (discipline_->state().phase != wire::Phase::Sending) {
    told_room_ = 0;
    return;
  }
  const std::size_t room = discipline_->room();
  const bool is_worth_it = room >= told_room_ + kRoomStep || !may_have_more_;
  if (room <= told_room_ || !is_worth_it) {
    told_room_ = std::min(told_room_, room);
    return;
  }
  if (parts_.listener.on_room) parts_.listener.on_room();
  told_room_ = discipline_->room();
  may_have_more_ = true;
}

LineTime Line::next_turn() const {
  const LineTime at = now();
  LineTime next = at + kLongestWait;
  if (const auto deadline = discipline_->deadline()) {
    // A deadline that a tick did not move must not cause a busy loop.
    next = std::min(next, *deadline == ticked_ ? at + 1ms : *deadline);
  }
  if (is_forbidden_) next = std::min(next, at + kForbiddenInterval);
  if (steady_at_) next = std::min(next, *steady_at_);
  if (!channel_) return is_forbidden_ ? next : std::min(next, open_at_);
  if (has_lines_) next = std::min(next, look_at_);
  if (is_forbidden_) return next;
  if (held_count_ > 0)
    next = std::min(next, at + std::clamp<LineTime>(2 * pacer_.character_time(), 200us, 5ms));
  else if (may_have_more_)
    next = std::min(next, pacer_.next(at, channel_->unsent()));
  return next;
}

void Line::wait() {
  std::array<pollfd, 2> entries{pollfd{commands_.descriptor(), POLLIN, 0}, pollfd{-1, POLLIN, 0}};
  if (channel_) entries[1].fd = channel_->descriptor();
  const LineTime left = has_input_ ? LineTime{} : std::max(next_turn() - now(), LineTime{});
  const auto seconds = std::chrono::floor<std::chrono::seconds>(left);
  const timespec limit{seconds.count(), (left - seconds).count()};
  (void)::ppoll(entries.data(), entries.size(), &limit, nullptr);
  if (entries[1].revents != 0) has_input_ = true;
}

}  // namespace

Result<std::unique_ptr<LineDriver>> LineDriver::start(Parts parts) {
  std::unique_ptr<wire::Discipline> discipline;
  if (parts.make_discipline) {
    discipline = parts.make_discipline();
  } else {
    auto made = wire::make_discipline(parts.settings, parts.role);
    if (!made) return fail(made.error());
    discipline = std::move(*made);
  }
  auto line = std::make_unique<Line>(std::move(parts), std::move(discipline));
  line->begin();
  return std::unique_ptr<LineDriver>(std::move(line));
}

}  // namespace dripline::serial
