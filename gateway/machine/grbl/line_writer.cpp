#include "gateway/machine/grbl/line_writer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gateway/machine/grbl/arc_path.hpp"

namespace dripline::machine::grbl {

using interpreter::Axis;
using interpreter::SpindleState;

namespace {

/// Grbl refuses an arc whose radii differ by more than this (and by more than a thousandth).
constexpr double kMaxRadiusChange = 0.004;
/// Shorter arcs are written as lines: their ends are too close for the angle between them.
constexpr double kShortestArc = 0.005;
constexpr double kChordDeviation = 0.002;
constexpr std::size_t kMaxPieces = 4096;  ///< of one arc

double distance(const Coordinates& from, const Coordinates& to) {
  double square = 0;
  for (std::size_t i = 0; i < kMaxAxes; ++i) square += (to[i] - from[i]) * (to[i] - from[i]);
  return std::sqrt(square);
}

/// The length that a program's feed is for: that of the linear axes, if any moves.
double program_distance(const Coordinates& from, const Coordinates& to) {
  double linear = 0, rotary = 0;
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    const double change = to[i] - from[i];
    (interpreter::is_rotary(static_cast<Axis>(i)) ? rotary : linear) += change * change;
  }
  return std::sqrt(linear > 0 ? linear : rotary);
}

bool is_finite(const Coordinates& point) {
  return std::all_of(point.begin(), point.end(), [](double value) { return std::isfinite(value); });
}

/// Without trailing zeros and a minus before nothing: every byte is time on the line.
std::string trimmed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

}  // namespace

void LineWriter::begin(const Coordinates& at) {
  at_ = at;
  feed_.clear();
  flood_ = mist_ = false;
}

std::string LineWriter::number(double value) const {
  return trimmed(value, board_.decimals());
}

/// Of the number as it is written.
std::int64_t LineWriter::step(std::size_t axis, double value) const {
  const double scale = board_.decimals() == 4 ? 1e4 : 1e3;
  return std::llround(std::round(value * scale) / scale * board_.steps(axis));
}

bool LineWriter::is_same_step(const Coordinates& a, const Coordinates& b) const {
  for (std::size_t i = 0; i < board_.axes(); ++i)
    if (step(i, a[i]) != step(i, b[i])) return false;
  return true;
}

/// Every axis that changes. What was written before is what the board believes, digit for digit.
std::string LineWriter::axis_words(const Coordinates& to) const {
  std::string words;
  for (std::size_t i = 0; i < board_.axes(); ++i) {
    const std::string text = number(to[i]);
    if (text != number(at_[i])) words += letter_of(i) + text;
  }
  return words;
}

std::optional<Refusal> LineWriter::target_of(const interpreter::Position& to,
                                             Coordinates& target) const {
  target = at_;
  for (const Axis axis : interpreter::kAllAxes) {
    if (!to.has(axis)) continue;
    const auto i = static_cast<std::size_t>(axis);
    const double value = to.raw(axis);
    if (i >= board_.axes()) {
      const double before = i < kMaxAxes ? at_[i] : 0;
      if (value == before) continue;
      return Refusal{"MCH0002", fmt::format("the board has no {} axis", interpreter::letter(axis))};
    }
    target[i] = value;
  }
  if (!is_finite(target)) return Refusal{"MCH0006", "a move without a finite length"};
  return check_travel(target);
}

/// Where soft limits are in force the board would stop in the middle of the program instead.
std::optional<Refusal> LineWriter::check_travel(const Coordinates& target) const {
  for (std::size_t i = 0; i < board_.axes(); ++i) {
    const auto travel = board_.travel(i);
    if (!travel || target[i] == at_[i]) continue;
    const double slack = board_.tolerance(i);
    if (target[i] >= travel->low - slack && target[i] <= travel->high + slack) continue;
    return Refusal{"MCH0001",
                   fmt::format("{} {:.3f} is outside the board's travel of {} to {} ($20, ${})",
                               letter_of(i), target[i], travel->low, travel->high, 130 + i)};
  }
  return std::nullopt;
}

std::optional<Refusal> LineWriter::feed_of(Feed feed, double program_length, double board_length,
                                           double& per_minute) const {
  if (feed.per() == Feed::Per::Revolution)
    return Refusal{"MCH0008", "this machine cannot feed per revolution"};
  per_minute = feed.length().mm();
  if (feed.per() == Feed::Per::Move)
    per_minute = feed.moves_per_minute() * board_length;
  else if (program_length > 0)
    per_minute *= board_length / program_length;  // the board adds degrees to millimetres
  if (!(per_minute >= 0.001)) return Refusal{"MCH0003", "the feed is zero"};
  if (!std::isfinite(per_minute)) return Refusal{"MCH0006", "the feed is not finite"};
  per_minute = std::min(per_minute, 99'999.0);  // beyond what any axis does
  return std::nullopt;
}

double LineWriter::seconds_of(const Coordinates& from, const Coordinates& to,
                              std::optional<double> feed) const {
  double minutes = feed ? distance(from, to) / *feed : 0;
  for (std::size_t i = 0; i < board_.axes(); ++i)
    minutes = std::max(minutes, std::fabs(to[i] - from[i]) / board_.max_rate(i));
  return minutes * 60;
}

std::optional<Refusal> LineWriter::append(std::string line, MotionText& text) const {
  if (line.size() + kAdded > board_.line_limit())
    return Refusal{"GRB0009", fmt::format("a line of {} characters, the board reads {}: {}",
                                          line.size() + kAdded, board_.line_limit(), line)};
  text.lines.push_back(std::move(line));
  return std::nullopt;
}

std::optional<Refusal> LineWriter::straight(std::string_view code, const Coordinates& to,
                                            std::optional<double> feed, MotionText& text) {
  text.end = to;
  if (is_same_step(at_, to)) {
    // The rest is not lost: the next target is absolute.
    return std::nullopt;
  }
  const std::string words = axis_words(to);
  if (words.empty()) return std::nullopt;
  std::string line = std::string(code) + words;
  std::string feed_text;
  if (feed) {
    feed_text = trimmed(*feed, 3);
    if (feed_text != feed_) line += "F" + feed_text;
  }
  if (auto refusal = append(std::move(line), text)) return refusal;
  if (feed) feed_ = std::move(feed_text);
  text.seconds += seconds_of(at_, to, feed);
  at_ = to;
  return std::nullopt;
}

std::optional<Refusal> LineWriter::rapid(const interpreter::Rapid& event, MotionText& text) {
  Coordinates to;
  if (auto refusal = target_of(event.to, to)) return refusal;
  return straight("G0", to, std::nullopt, text);
}

std::optional<Refusal> LineWriter::line(const interpreter::Line& event, MotionText& text) {
  Coordinates to;
  if (auto refusal = target_of(event.to, to)) return refusal;
  text.end = to;
  if (is_same_step(at_, to)) return std::nullopt;
  double feed = 0;
  if (auto refusal = feed_of(event.feed, program_distance(at_, to), distance(at_, to), feed))
    return refusal;
  if (auto refusal = straight("G1", to, feed, text)) return refusal;
  // A dwell of no time lets the axes come to rest: the board has no exact stop.
  if (event.rests && !text.lines.empty()) text.lines.push_back(dwell(0));
  return std::nullopt;
}

std::optional<Refusal> LineWriter::arc_line(const interpreter::Arc& event, const Coordinates& end,
                                            double feed, MotionText& text) {
  static constexpr std::array<char, 3> kOffsets{'I', 'J', 'K'};
  static constexpr std::array<std::string_view, 3> kPlanes{"G17", "G18", "G19"};
  const ArcPath path = arc_path(at_, end, event);
  std::string words = axis_words(end);
  // Both words of the plane, also where one does not change: an arc needs one at least.
  for (const std::size_t axis : {path.first, path.second})
    if (words.find(letter_of(axis)) == std::string::npos)
      words += letter_of(axis) + number(end[axis]);
  std::string line = fmt::format("{}G{}{}", kPlanes[static_cast<std::size_t>(event.plane)],
                                 event.turn == interpreter::Turn::Counterclockwise ? 3 : 2, words);
  for (const std::size_t axis : {path.first, path.second}) {
    const double center = axis == path.first ? path.center_first : path.center_second;
    line += kOffsets[axis] + number(center - at_[axis]);
  }
  std::string feed_text = trimmed(feed, 3);
  if (feed_text != feed_) line += "F" + feed_text;
  if (auto refusal = append(std::move(line), text)) return refusal;
  feed_ = std::move(feed_text);
  at_ = end;
  return std::nullopt;
}

std::optional<Refusal> LineWriter::arc(const interpreter::Arc& event, MotionText& text) {
  Coordinates to;
  if (auto refusal = target_of(event.to, to)) return refusal;
  const ArcPath path = arc_path(at_, to, event);
  const double length = path.length();
  if (!(path.start_radius > 0 && length > 0 && std::isfinite(length)))
    return Refusal{"MCH0006", "the arc has no radius or no length"};
  if (std::max(path.first, path.second) >= board_.axes())
    return Refusal{"MCH0002", fmt::format("the board has no {} axis",
                                          letter_of(std::max(path.first, path.second)))};
  for (const Coordinates& extreme : extremes(path))
    if (auto refusal = check_travel(extreme)) return refusal;
  double feed = 0;
  if (auto refusal = feed_of(event.feed, length, length, feed)) return refusal;
  bool has_rotary = false;
  for (std::size_t i = 3; i < kMaxAxes; ++i) has_rotary |= to[i] != at_[i];
  const bool is_spiral = std::fabs(path.end_radius - path.start_radius) > kMaxRadiusChange;
  const bool is_arc = !is_spiral && !has_rotary && length >= kShortestArc;
  interpreter::Arc turned = event;  // in the direction of the path
  turned.turn = path.sweep > 0 ? interpreter::Turn::Counterclockwise : interpreter::Turn::Clockwise;
  const auto ends = is_arc ? half_circles(path) : chords(path, kChordDeviation);
  if (ends.size() > kMaxPieces)
    return Refusal{"MCH0005", fmt::format("an arc of {} pieces, the board gets at most {}",
                                          ends.size(), kMaxPieces)};
  for (const Coordinates& end : ends) {
    auto refusal = is_arc ? arc_line(turned, end, feed, text) : straight("G1", end, feed, text);
    if (refusal) return refusal;
  }
  text.end = to;
  text.seconds = length / feed * 60;
  if (event.rests && !text.lines.empty()) text.lines.push_back(dwell(0));
  return std::nullopt;
}

std::optional<Refusal> LineWriter::probe(const interpreter::Probe& event, MotionText& text) {
  Coordinates to;
  if (auto refusal = target_of(event.to, to)) return refusal;
  text.end = to;
  if (is_same_step(at_, to)) return std::nullopt;
  double feed = 0;
  if (auto refusal = feed_of(event.feed, program_distance(at_, to), distance(at_, to), feed))
    return refusal;
  const bool is_contact = event.until == interpreter::ProbeUntil::Contact;
  const std::string code = is_contact ? "G38.3" : "G38.5";
  text.seconds = seconds_of(at_, to, feed);
  feed_ = trimmed(feed, 3);
  return append(code + axis_words(to) + "F" + feed_, text);
}

std::optional<Refusal> LineWriter::spindle(const interpreter::Spindle& event,
                                           std::string& line) const {
  if (event.surface_speed)
    return Refusal{"MCH0008", "this machine cannot keep a constant surface speed"};
  switch (event.state) {
    case SpindleState::Off:
      line = "M5";
      return std::nullopt;
    case SpindleState::Oriented:
      return Refusal{"MCH0008", "this machine cannot orient the spindle"};
    case SpindleState::Clockwise:
    case SpindleState::Counterclockwise:
      break;
  }
  const double rpm = event.max_revolutions
                         ? std::min(event.revolutions_per_minute, *event.max_revolutions)
                         : event.revolutions_per_minute;
  if (!(rpm >= 0 && std::isfinite(rpm)))
    return Refusal{"MCH0006", "a spindle speed without a value"};
  if (board_.max_rpm() > 0 && rpm > board_.max_rpm())
    return Refusal{"GRB0010",
                   fmt::format("spindle speed {:.6g} is above the board's {:.6g} rpm ($30)", rpm,
                               board_.max_rpm())};
  if (rpm > 0 && rpm < board_.min_rpm())
    return Refusal{"GRB0010",
                   fmt::format("spindle speed {:.6g} is below the board's {:.6g} rpm ($31)", rpm,
                               board_.min_rpm())};
  line =
      fmt::format("{}S{}", event.state == SpindleState::Clockwise ? "M3" : "M4", trimmed(rpm, 1));
  return std::nullopt;
}

/// One command switches both off, and none both on.
std::optional<Refusal> LineWriter::coolant(const interpreter::Coolant& event,
                                           std::vector<std::string>& lines) {
  if (event.mist && !board_.has_mist())
    return Refusal{"MCH0008", "this machine cannot switch mist coolant"};
  const bool has_off = (flood_ && !event.flood) || (mist_ && !event.mist);
  if (has_off || (!event.flood && !event.mist)) lines.emplace_back("M9");
  if (event.mist) lines.emplace_back("M7");
  if (event.flood) lines.emplace_back("M8");
  flood_ = event.flood;
  mist_ = event.mist;
  return std::nullopt;
}

std::string LineWriter::dwell(double seconds) {
  return "G4P" + trimmed(seconds, 3);
}

std::vector<std::string> LineWriter::preamble() const {
  return {"G21G90G94G17G91.1G49" + board_.work_system(), "G92.1M5M9"};
}

std::vector<std::string> LineWriter::preamble_words() const {
  return {"G21", "G90", "G94", board_.work_system()};
}

}  // namespace dripline::machine::grbl
