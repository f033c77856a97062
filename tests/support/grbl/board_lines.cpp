#include <fmt/format.h>
#include <charconv>
#include <cmath>
#include <utility>

#include "tests/support/grbl/board.hpp"

/// The part of the board that takes lines: G-code and $ commands.
namespace dripline::test_support {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr char kAxisLetters[] = "XYZA";

double distance(const GrblBoard::Point& a, const GrblBoard::Point& b) {
  double square = 0;
  for (std::size_t i = 0; i < a.size(); ++i) square += (b[i] - a[i]) * (b[i] - a[i]);
  return std::sqrt(square);
}

}  // namespace

/// A parsed line: values by letter, and its G and M codes in tenths.
struct GrblBoard::Words {
  std::map<char, double> values;
  std::vector<int> g, m;
  std::uint32_t number = 0;
  bool is_good = true;

  explicit Words(std::string_view line) {
    for (std::size_t i = 0; i < line.size();) {
      const char letter = line[i++];
      double value = 0;
      const auto [end, error] = std::from_chars(line.data() + i, line.data() + line.size(), value);
      if (letter < 'A' || letter > 'Z' || error != std::errc()) {
        is_good = false;
        return;
      }
      i = static_cast<std::size_t>(end - line.data());
      if (letter == 'G')
        g.push_back(static_cast<int>(std::lround(value * 10)));
      else if (letter == 'M')
        m.push_back(static_cast<int>(std::lround(value)));
      else if (letter == 'N')
        number = static_cast<std::uint32_t>(value);
      else if (!values.emplace(letter, value).second)
        is_good = false;
    }
  }
  double value(char letter, double otherwise = 0) const {
    const auto found = values.find(letter);
    return found == values.end() ? otherwise : found->second;
  }
  bool has(char letter) const { return values.contains(letter); }
  bool has_axis() const { return has('X') || has('Y') || has('Z') || has('A'); }
};

void GrblBoard::take_lines() {
  for (;;) {
    while (!waiting_.empty() && planned() < static_cast<std::size_t>(options_.planner_blocks)) {
      if (moves_.empty()) from_ = at_;
      moves_.push_back(waiting_.front());
      waiting_.pop_front();
      if (state_ == State::Idle) state_ = State::Run;
    }
    if (!waiting_.empty()) return;
    if (pending_answer_) {
      if (waits_for_rest_ &&
          (!moves_.empty() || dwell_ > 0 || homing_ > 0 || state_ == State::Hold))
        return;
      say(*std::exchange(pending_answer_, std::nullopt));
      waits_for_rest_ = false;
    }
    const std::size_t end = rx_.find('\n');
    if (end == std::string::npos) return;
    const std::string line = rx_.substr(0, end);
    rx_.erase(0, end + 1);
    if (swallows_lines) continue;
    longest_line_ = std::max(longest_line_, line.size());
    if (!take_line(line)) return;
  }
}

/// False: the next line waits.
bool GrblBoard::take_line(const std::string& line) {
  if (line.empty()) {
    say("ok");
    return true;
  }
  int error = 0;
  if (refuses_line > 0 && --refuses_line == 0) {
    error = 20;
  } else if (line.front() == '$') {
    error = system_command(line);
  } else if (state_ == State::Alarm) {
    error = 9;
  } else {
    const Words words(line);
    const bool has_number = line.front() == 'N';
    const std::size_t after = has_number ? line.find_first_not_of("0123456789", 1) : 0;
    lines.push_back(after == std::string::npos ? "" : line.substr(after));
    error = words.is_good ? execute(words) : 2;
    parsed_number_ = words.number;
  }
  pending_answer_ = error == 0 ? "ok" : fmt::format("error:{}", error);
  return true;
}

GrblBoard::Point GrblBoard::target_of(const Words& words) const {
  Point to = end_;
  for (std::size_t i = 0; i < options_.axes && i < to.size(); ++i) {
    if (!words.has(kAxisLetters[i])) continue;
    const double value = words.value(kAxisLetters[i]) * (is_metric_ || i == 3 ? 1 : 25.4);
    to[i] = is_absolute_ ? value + (work_ == "G54" ? g54[i] : 0) : end_[i] + value;
  }
  return to;
}

void GrblBoard::add_line(const Point& to, double rate, bool is_rapid, std::uint32_t number) {
  Move move;
  move.number = number;
  move.to = to;
  move.length = move.left = distance(end_, to);
  move.rate = rate;
  move.is_rapid = is_rapid;
  move.ends_line = true;
  bool moves = false;  // whole steps only
  for (std::size_t i = 0; i < to.size(); ++i)
    moves |= std::lround(to[i] * options_.steps) != std::lround(end_[i] * options_.steps);
  end_ = to;
  if (moves) waiting_.push_back(move);
}

/// Into chords, as the firmware does; each is a block of the planner.
int GrblBoard::add_arc(const Words& words, const Point& to, bool is_clockwise) {
  static constexpr std::array<std::array<std::size_t, 2>, 3> kPlanes{{{0, 1}, {2, 0}, {1, 2}}};
  const auto [first, second] = kPlanes[static_cast<std::size_t>(plane_ - 17)];
  const double i = words.value("IJK"[first]), j = words.value("IJK"[second]);
  const Point from = end_;
  const double center_first = from[first] + i, center_second = from[second] + j;
  const double radius = std::hypot(i, j);
  const double end_radius = std::hypot(to[first] - center_first, to[second] - center_second);
  if (radius == 0) return 35;
  const double change = std::fabs(radius - end_radius);
  if (change > 0.005 && (change > 0.5 || change > 0.001 * radius)) return 33;
  const double start = std::atan2(-j, -i);
  double sweep = std::atan2(to[second] - center_second, to[first] - center_first) - start;
  if (is_clockwise && sweep >= -5e-7) sweep -= 2 * kPi;
  if (!is_clockwise && sweep <= 5e-7) sweep += 2 * kPi;
  const int count = std::max(1, static_cast<int>(std::fabs(sweep) / (kPi / 18)));
  for (int k = 1; k <= count; ++k) {
    Point point = to;
    if (k < count) {
      const double part = static_cast<double>(k) / count;
      for (std::size_t axis = 0; axis < point.size(); ++axis)
        point[axis] = from[axis] + (to[axis] - from[axis]) * part;
      point[first] = center_first + radius * std::cos(start + sweep * part);
      point[second] = center_second + radius * std::sin(start + sweep * part);
    }
    add_line(point, feed_, false, words.number);
    if (!waiting_.empty()) waiting_.back().ends_line = k == count;
  }
  return 0;
}

int GrblBoard::execute(const Words& words) {
  int probe = 0;
  bool is_dwell = false;
  for (const int code : words.g) {
    if (code == 0 || code == 10 || code == 20 || code == 30)
      motion_ = code / 10;
    else if (code == 383 || code == 385)
      probe = code;
    else if (code == 40)
      is_dwell = true;
    else if (code == 170 || code == 180 || code == 190)
      plane_ = code / 10;
    else if (code == 200 || code == 210)
      is_metric_ = code == 210;
    else if (code == 930 || code == 940)
      is_timed_ = code == 930;
    else if (code == 900 || code == 910)
      is_absolute_ = code == 900;
    else if (code >= 540 && code <= 590)
      work_ = fmt::format("G{}", code / 10);
    else if (code != 911 && code != 490 && code != 921)
      return 20;
  }
  for (const int code : words.m) {
    const bool is_coolant = code == 8 || code == 9 || (code == 7 && options_.has_mist);
    if (code == 3 || code == 4)
      spindle_ = words.value('S', spindle_);
    else if (code == 5)
      spindle_ = 0;
    else if (!is_coolant)
      return 20;
    waits_for_rest_ = true;
  }
  feed_ = words.value('F', feed_);
  if (is_dwell) {
    if (!words.has('P')) return 28;
    dwell_ = words.value('P');
    waits_for_rest_ = true;
    return 0;
  }
  if (!words.has_axis()) return 0;
  if (motion_ != 0 && feed_ <= 0) return 22;
  if (state_ == State::Check) return 0;
  const Point to = target_of(words);
  if (probe != 0 && is_probe_closed) {
    raise_alarm(4);
    return 0;
  }
  if (probe != 0) {
    add_line(to, feed_, false, words.number);
    if (waiting_.empty()) return 33;
    waiting_.back().is_probe = true;
    waits_for_rest_ = true;
    return 0;
  }
  if (motion_ >= 2) return add_arc(words, to, motion_ == 2);
  const double rate = is_timed_ ? feed_ * distance(end_, to) : feed_;
  add_line(to, motion_ == 0 ? options_.max_rate : rate, motion_ == 0, words.number);
  return 0;
}

/// As the firmware: within the soft limits of a homed board, at a feed that no override changes.
int GrblBoard::jog(const std::string& line) {
  const Words words(line.substr(3));
  if (state_ == State::Alarm) return 9;
  if (state_ != State::Idle) return 8;
  if (!words.is_good || !words.m.empty()) return 16;
  bool is_relative = !is_absolute_;
  for (const int code : words.g) {
    if (code != 200 && code != 210 && code != 900 && code != 910 && code != 530) return 16;
    if (code == 910) is_relative = true;
  }
  if (!words.has_axis()) return 26;
  if (!words.has('F')) return 22;
  const bool was_absolute = std::exchange(is_absolute_, !is_relative);
  const Point to = target_of(words);
  is_absolute_ = was_absolute;
  for (std::size_t i = 0; settings_[20] == "1" && i < options_.axes; ++i) {
    const double travel = std::stod(settings_[130 + static_cast<int>(i)]);
    const double low = options_.is_zero_at_low_end ? 0 : -travel;
    if (to[i] < low || to[i] > low + travel) return 15;
  }
  jogs.push_back(line);
  add_line(to, words.value('F'), false, 0);
  if (waiting_.empty()) return 0;
  waiting_.back().is_jog = true;
  waiting_.back().ends_line = false;
  from_ = at_;
  moves_.push_back(waiting_.back());
  waiting_.clear();
  state_ = State::Jog;
  return 0;
}

int GrblBoard::system_command(const std::string& line) {
  if (line.starts_with("$J=")) return jog(line);
  if (state_ == State::Jog) return 8;
  if (state_ == State::Run || state_ == State::Hold) return 8;
  if (line == "$I") {
    say("[VER:1.1f.20170801:]");
    std::string letters = "V";
    if (options_.has_line_numbers) letters += 'N';
    if (options_.has_mist) letters += 'M';
    if (options_.is_zero_at_low_end) letters += 'Z';
    say(fmt::format("[OPT:{},{},{}{}]", letters, options_.planner_blocks, options_.rx_bytes,
                    options_.is_grbl_hal ? ",3,0" : ""));
  } else if (line == "$$") {
    for (const auto& [number, value] : settings_) say(fmt::format("${}={}", number, value));
  } else if (line == "$#") {
    for (const char* name : {"G54", "G55", "G56", "G57", "G58", "G59", "G28", "G30", "G92"})
      say(fmt::format("[{}:{}]", name, words_of(std::string_view(name) == "G54" ? g54 : Point{})));
    say("[TLO:0.000]");
    say(fmt::format("[PRB:{}:0]", words_of({})));
  } else if (line == "$G") {
    say(fmt::format("[GC:G{} {} G{} G{} G{} G{} M5 M9 T0 F{:.0f} S{:.0f}]", motion_, work_, plane_,
                    is_metric_ ? 21 : 20, is_absolute_ ? 90 : 91, is_timed_ ? 93 : 94, feed_,
                    spindle_));
  } else if (line == "$X") {
    state_ = State::Idle;
  } else if (line == "$H") {
    if (settings_[22] == "0") return 5;
    homing_ = options_.homing_seconds;
    waits_for_rest_ = true;
  } else if (line == "$C") {
    state_ = state_ == State::Check ? State::Idle : State::Check;
  } else {
    return 3;
  }
  return 0;
}

}  // namespace dripline::test_support
