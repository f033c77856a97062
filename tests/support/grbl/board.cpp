#include "tests/support/grbl/board.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

namespace dripline::test_support {

namespace {

constexpr double kAhead = 0.1;  ///< seconds between planner and axes

bool is_real_time(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return c == '?' || c == '!' || c == '~' || byte == 0x18 || byte >= 0x80;
}

}  // namespace

GrblBoard::GrblBoard(Options options) : options_(std::move(options)), at_(options_.start) {
  end_ = at_;
  settings_ = {{10, options_.reports_work_position ? "2" : "1"},
               {13, "0"},
               {20, "0"},
               {22, options_.is_locked ? "1" : "0"},
               {30, "10000"},
               {31, "0"},
               {32, "0"}};
  if (options_.reports_buffers) settings_[10] = options_.reports_work_position ? "2" : "3";
  for (std::size_t i = 0; i < options_.axes; ++i) {
    const int n = static_cast<int>(i);
    settings_[100 + n] = fmt::format("{:.3f}", options_.steps);
    settings_[110 + n] = fmt::format("{:.3f}", options_.max_rate);
    settings_[120 + n] = "500.000";
    settings_[130 + n] = "300.000";
  }
  for (const auto& [number, value] : options_.settings) settings_[number] = value;
  std::erase_if(settings_, [](const auto& setting) { return setting.second == "none"; });
  if (options_.is_locked) state_ = State::Alarm;
  greet();
}

void GrblBoard::greet() {
  output_ += options_.is_grbl_hal ? "\r\nGrblHAL 1.1f ['$' or '$HELP' for help]\r\n"
                                  : "\r\nGrbl 1.1f ['$' for help]\r\n";
  if (state_ == State::Alarm) output_ += "[MSG:'$H'|'$X' to unlock]\r\n";
}

void GrblBoard::restart() {
  soft_reset();
  output_.clear();
  state_ = options_.is_locked ? State::Alarm : State::Idle;
  at_ = end_ = {};
  greet();
}

void GrblBoard::soft_reset() {
  rx_.clear();
  moves_.clear();
  waiting_.clear();
  pending_answer_.reset();
  dwell_ = homing_ = restore_left_ = 0;
  waits_for_rest_ = is_braking_ = is_probing_ = false;
  end_ = at_;
  motion_ = 0;
  plane_ = 17;
  is_metric_ = is_absolute_ = true;
  is_timed_ = false;
  work_ = "G54";
  feed_ = spindle_ = 0;
  parsed_number_ = 0;
  feed_override_ = rapid_override_ = spindle_override_ = 100;
  override_bytes_.clear();
}

void GrblBoard::raise_alarm(int code) {
  say(fmt::format("ALARM:{}", code));
  moves_.clear();
  waiting_.clear();
  end_ = at_;
  state_ = State::Alarm;
}

void GrblBoard::cancel_jog() {
  if (state_ != State::Jog || is_braking_) return;
  is_braking_ = true;
  brake_left_ = options_.brake_seconds;
}

void GrblBoard::open_door() {
  is_door_open_ = true;
  begin_door();
}

void GrblBoard::begin_door() {
  restore_left_ = 0;
  if (state_ == State::Alarm || state_ == State::Check) return;
  if (state_ == State::Run) is_braking_ = true, brake_left_ = options_.brake_seconds;
  state_ = State::Door;
}

void GrblBoard::receive(std::string_view bytes) {
  received_ += bytes.size();
  for (const char c : bytes) {
    if (is_real_time(c)) {
      on_real_time(c);
    } else if (rx_.size() >= options_.rx_bytes) {
      has_overrun = true;
    } else if (c != '\r' && c != ' ') {
      rx_ += c;
    }
  }
}

void GrblBoard::on_real_time(char byte) {
  if (is_mute) return;
  if (homing_ > 0 && byte != '\x18') return;
  if (byte == '?') return report();
  real_time += byte;
  switch (static_cast<unsigned char>(byte)) {
    case '!':
      if (state_ == State::Jog) return cancel_jog();
      if (state_ != State::Run && state_ != State::Idle) return;
      is_braking_ = state_ == State::Run;
      brake_left_ = options_.brake_seconds;
      state_ = State::Hold;
      return;
    case '~':
      if (is_braking_ || (state_ == State::Door && is_door_open_)) return;
      if (state_ == State::Door && spindle_ > 0)
        restore_left_ = options_.restore_seconds;
      else if (state_ == State::Hold || state_ == State::Door)
        state_ = moves_.empty() ? State::Idle : State::Run;
      return;
    case 0x18: {
      if (ignores_reset) return;
      const bool was_moving =
          state_ == State::Run || state_ == State::Jog || is_braking_ || homing_ > 0;
      soft_reset();
      if (was_moving) {
        say("ALARM:3");
        state_ = State::Alarm;
      } else if (state_ != State::Alarm) {
        state_ = State::Idle;
      }
      return greet();
    }
    case 0x84:
      // grblHAL takes it in no state of its door.
      if (options_.is_grbl_hal && state_ == State::Door) return;
      if (state_ == State::Jog) return cancel_jog();
      return begin_door();
    case 0x85:
      if (options_.is_grbl_hal) rx_.clear();
      if (!ignores_jog_cancel) cancel_jog();
      return;
    default:
      if (!ignores_overrides) override_bytes_.insert(static_cast<unsigned char>(byte));
      return;
  }
}

/// A byte is a flag: the firmware sees the same one twice as once, until it has looked.
void GrblBoard::take_override_bytes() {
  const auto step = [this](int byte) { return override_bytes_.contains(byte); };
  const auto change = [&](int& value, int first) {
    if (step(first)) value = 100;
    value += step(first + 1) ? 10 : 0;
    value -= step(first + 2) ? 10 : 0;
    value += step(first + 3) ? 1 : 0;
    value -= step(first + 4) ? 1 : 0;
    value = std::clamp(value, 10, 200);
  };
  change(feed_override_, 0x90);
  if (step(0x95)) rapid_override_ = 100;
  if (step(0x96)) rapid_override_ = 50;
  if (step(0x97)) rapid_override_ = 25;
  change(spindle_override_, 0x99);
  override_bytes_.clear();
}

// -- time ----------------------------------------------------------------------------------------

void GrblBoard::pass(double seconds) {
  constexpr double kStep = 0.001;
  for (; seconds > 0; seconds -= kStep) step(std::min(seconds, kStep));
}

void GrblBoard::step(double seconds) {
  if (homing_ > 0) {
    homing_ -= seconds;
    if (homing_ > 0) return;
    at_ = end_ = from_ = {};
    state_ = State::Idle;
  }
  if (!is_mute) take_lines();
  take_override_bytes();
  if (restore_left_ > 0) {
    restore_left_ -= seconds;
    if (restore_left_ <= 0) state_ = moves_.empty() ? State::Idle : State::Run;
  }
  if (is_braking_) {
    move_axes(seconds);
    brake_left_ -= seconds;
    if (brake_left_ <= 0 || moves_.empty()) is_braking_ = false;
    if (!is_braking_ && state_ == State::Jog) {
      moves_.clear();
      end_ = from_ = at_;
      state_ = State::Idle;
    }
  } else if (state_ == State::Run || state_ == State::Jog) {
    move_axes(seconds);
    if (moves_.empty() && waiting_.empty()) state_ = State::Idle;
  } else if (state_ == State::Idle && dwell_ > 0) {
    dwell_ -= seconds;
  }
}

void GrblBoard::move_axes(double seconds) {
  while (seconds > 0 && !moves_.empty() && !is_stuck) {
    Move& move = moves_.front();
    const double factor =
        move.is_jog ? 1 : (move.is_rapid ? rapid_override_ : feed_override_) / 100.0;
    const double speed = std::min(move.rate * factor, options_.max_rate) / 60;
    const double go = std::min(move.left, speed * seconds);
    seconds -= speed > 0 ? go / speed : seconds;
    move.left -= go;
    traveled_ += go;
    const double part = move.length > 0 ? 1 - move.left / move.length : 1;
    for (std::size_t i = 0; i < at_.size(); ++i) at_[i] = from_[i] + (move.to[i] - from_[i]) * part;
    if (move.is_probe && options_.surface_z && at_[2] <= *options_.surface_z)
      return end_probe(true);
    if (move.left <= 1e-12) finish_move();
  }
}

void GrblBoard::finish_move() {
  const Move move = moves_.front();
  at_ = move.to;
  if (move.is_probe) return end_probe(false);
  moves_.pop_front();
  from_ = at_;
  if (move.ends_line) {
    done.push_back({move.number, at_});
    at_[0] += drifts;
  }
}

/// At a contact the axes brake a little past it.
void GrblBoard::end_probe(bool tripped) {
  Point contact = at_;
  if (tripped) contact[2] = *options_.surface_z;
  done.push_back({moves_.front().number, contact});
  moves_.clear();
  if (tripped) at_[2] = *options_.surface_z - 0.05;
  end_ = from_ = at_;
  is_probing_ = false;
  contact[0] += contact_is_off;
  say(fmt::format("[PRB:{}:{}]", words_of(contact), tripped ? 1 : 0));
  state_ = State::Idle;
}

/// What the firmware has prepared for the axes is no longer in its planner.
std::size_t GrblBoard::first_in_planner() const {
  double time = 0;
  std::size_t i = 0;
  for (; i < moves_.size(); ++i) {
    const double rate =
        moves_[i].rate * (moves_[i].is_rapid ? rapid_override_ : feed_override_) / 100;
    time += moves_[i].left / rate * 60;
    if (time > kAhead) break;
  }
  return i;
}

// -- reports -------------------------------------------------------------------------------------

std::string GrblBoard::words_of(const Point& point) const {
  std::string text;
  for (std::size_t i = 0; i < (forgets_axes ? 1 : options_.axes); ++i) {
    const double value = std::round(point[i] * options_.steps) / options_.steps;
    const bool is_inch = reports_inches() && i < 3;
    text += fmt::format("{}{:.{}f}", i == 0 ? "" : ",", is_inch ? value / 25.4 : value,
                        is_inch ? 4 : 3);
  }
  return text;
}

void GrblBoard::report() {
  static constexpr std::array kNames{"Idle", "Run", "Hold", "Alarm", "Door", "Check", "Jog"};
  std::string text = "<" + std::string(kNames[static_cast<std::size_t>(state_)]);
  if (state_ == State::Hold) text += is_braking_ ? ":1" : ":0";
  if (state_ == State::Door)
    text += restore_left_ > 0 ? (options_.is_grbl_hal ? ":4" : ":3")
            : is_braking_     ? ":2"
            : is_door_open_   ? ":1"
                              : ":0";
  text += (options_.reports_work_position ? "|WPos:" : "|MPos:") + words_of(at_);
  // An override changes how far ahead blocks are prepared; what was prepared stays so.
  const int used = std::min(static_cast<int>(planned()), options_.planner_blocks - leaked_blocks) +
                   leaked_blocks;
  if (options_.reports_buffers)
    text +=
        fmt::format("|Bf:{},{}", options_.planner_blocks - used, options_.rx_bytes - rx_.size());
  const std::size_t first = first_in_planner();
  // Grbl names a block of the planner; grblHAL, without one, the line that was parsed last.
  std::uint32_t number = options_.is_grbl_hal ? parsed_number_ : 0;
  if (first < moves_.size()) number = moves_[first].number;
  if (number > 0) number += static_cast<std::uint32_t>(names_lines_ahead);
  if (options_.has_line_numbers && number > 0) text += fmt::format("|Ln:{}", number);
  const double rate =
      state_ == State::Run && !moves_.empty() ? moves_.front().rate * feed_override_ / 100 : 0;
  text += fmt::format("|FS:{:.0f},{:.0f}", rate, spindle_ * spindle_override_ / 100);
  if (reports_++ % 3 == 0)
    text += fmt::format("|WCO:{}", words_of({}));
  else if (reports_ % 3 == 2)
    text += fmt::format("|Ov:{},{},{}", feed_override_, rapid_override_, spindle_override_);
  say(text + ">");
}

}  // namespace dripline::test_support
