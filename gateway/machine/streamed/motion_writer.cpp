#include "gateway/machine/streamed/motion_writer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "gateway/machine/streamed/arc_path.hpp"
#include "protocol/base/decimal.hpp"

namespace dripline::machine::streamed {

using interpreter::Axis;

namespace {

/// Devices refuse an arc whose radii differ by 0.005 (and by more than a thousandth). Start, center
/// and end are rounded in between, by up to three of the last digits together.
double max_radius_change(int decimals) {
  return std::min(0.004, 0.005 - 3 * std::pow(10, -decimals));
}
/// Shorter arcs are written as lines: their ends are too close for the angle between them.
constexpr double kShortestArc = 0.005;
constexpr double kChordDeviation = 0.002;
constexpr std::size_t kMaxPieces = 4096;  ///< of one move
/// Of a move, where a device may have so many seconds ahead: several of them are always in
/// progress.
constexpr double kPieceSeconds = 0.25;

/// The length that a feed is for: that of X, Y and Z, if any moves, else of U, V and W, else of the
/// rotary axes.
double feed_distance(const Coordinates& from, const Coordinates& to) {
  std::array<double, 3> squares{};  // XYZ, ABC, UVW
  for (std::size_t i = 0; i < kMaxAxes; ++i)
    squares[i / 3] += (to[i] - from[i]) * (to[i] - from[i]);
  const auto& [first, rotary, second] = squares;
  return std::sqrt(first > 0 ? first : second > 0 ? second : rotary);
}

bool is_finite(const Coordinates& point) {
  return std::all_of(point.begin(), point.end(), [](double value) { return std::isfinite(value); });
}

}  // namespace

double distance(const Coordinates& from, const Coordinates& to) {
  double square = 0;
  for (std::size_t i = 0; i < kMaxAxes; ++i) square += (to[i] - from[i]) * (to[i] - from[i]);
  return std::sqrt(square);
}

/// Where soft limits are in force the device would stop in the middle of the program instead.
std::optional<Refusal> check_travel(const TextRules& rules, const Coordinates& from,
                                    const Coordinates& to,
                                    const interpreter::LengthDisplay& display) {
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    if (!rules.has(i) || !rules.axes[i]->travel || to[i] == from[i]) continue;
    const TextRules::Range travel = *rules.axes[i]->travel;
    const double slack = rules.axes[i]->travel_slack;
    if (to[i] >= travel.low - slack && to[i] <= travel.high + slack) continue;
    const auto axis = static_cast<Axis>(i);
    return Refusal{"MCH0001",
                   fmt::format("{} {} is outside the machine's travel of {} to {}{}",
                               interpreter::shown_axis(axis, to[i], display),
                               interpreter::shown_unit(axis, display.units),
                               interpreter::shown_axis_number(axis, travel.low, display),
                               interpreter::shown_axis_number(axis, travel.high, display),
                               rules.axes[i]->travel_setting)};
  }
  return std::nullopt;
}

interpreter::Position position_of(const Coordinates& point, const TextRules& rules) {
  interpreter::Position position;
  for (std::size_t i = 0; i < kMaxAxes; ++i)
    if (rules.has(i)) position.set_raw(static_cast<Axis>(i), point[i]);
  return position;
}

Coordinates coordinates_of(const interpreter::Position& position) {
  Coordinates point{};
  for (std::size_t i = 0; i < kMaxAxes; ++i) point[i] = position.raw(static_cast<Axis>(i));
  return point;
}

void MotionWriter::begin(const Coordinates& at) {
  at_ = at;
  feed_.clear();
  is_timed_ = false;
  rests_.reset();
}

std::string MotionWriter::number(double value) const {
  return decimal_text(value, rules_.decimals);
}

/// Of the number as it is written.
std::int64_t MotionWriter::step(std::size_t axis, double value) const {
  const double scale = std::pow(10, rules_.decimals);
  return std::llround(std::round(value * scale) / scale * rules_.axes[axis]->steps);
}

bool MotionWriter::is_same_step(const Coordinates& a, const Coordinates& b) const {
  for (std::size_t i = 0; i < kMaxAxes; ++i)
    if (rules_.has(i) && step(i, a[i]) != step(i, b[i])) return false;
  return true;
}

/// Every axis that changes. What was written before is what the device believes, digit for digit.
std::string MotionWriter::axis_words(const Coordinates& to) const {
  std::string words;
  for (std::size_t i = 0; i < kMaxAxes; ++i) {
    if (!rules_.has(i)) continue;
    const std::string text = number(to[i]);
    if (text != number(at_[i])) words += letter_of(i) + text;
  }
  return words;
}

std::optional<Refusal> MotionWriter::target_of(const interpreter::Position& to,
                                               Coordinates& target) const {
  target = at_;
  for (const Axis axis : interpreter::kAllAxes) {
    const auto i = static_cast<std::size_t>(axis);
    const double value = to.raw(axis);
    if (!to.has(axis) || (!rules_.has(i) && value == at_[i])) continue;
    if (!rules_.has(i))
      return Refusal{"MCH0002",
                     fmt::format("the machine has no {} axis", interpreter::letter(axis))};
    target[i] = value;
  }
  if (!is_finite(target)) return Refusal{"MCH0006", "a move without a finite length"};
  return check_travel(rules_, at_, target, display_);
}

MotionWriter::PathLength MotionWriter::straight_length(const Coordinates& to) const {
  const double program = feed_distance(at_, to);
  return {program, rules_.feeds_all_axes ? distance(at_, to) : program};
}

std::optional<Refusal> MotionWriter::feed_of(Feed feed, PathLength length,
                                             double& per_minute) const {
  if (feed.per() == Feed::Per::Revolution)
    return Refusal{"MCH0008", "this machine cannot feed per revolution"};
  per_minute = feed.length().mm();
  if (feed.per() == Feed::Per::Move)
    per_minute = feed.moves_per_minute() * length.device;
  else if (length.program > 0)
    per_minute *= length.device / length.program;
  if (!(per_minute >= 0.001)) return Refusal{"MCH0003", "the feed is zero"};
  if (!std::isfinite(per_minute)) return Refusal{"MCH0006", "the feed is not finite"};
  if (per_minute < rules_.min_feed * (1 - 1e-9))
    return Refusal{"MCH0003", fmt::format("a feed of {:.4g} mm/min, the machine's lowest is {:.4g}",
                                          per_minute, rules_.min_feed)};
  per_minute = std::min(per_minute, 99'999.0);  // beyond what any axis does
  return std::nullopt;
}

/// The mode of the feed and its word, where they change.
std::string MotionWriter::feed_words(const Motion& motion, const Coordinates& to) {
  if (!motion.feed) return {};
  const bool is_mixed = feed_distance(at_, to) < distance(at_, to);
  const bool was_timed = std::exchange(is_timed_, rules_.times_rotary_axes && is_mixed);
  if (is_timed_) {  // the word is needed in every line
    feed_.clear();
    return (was_timed ? "F" : "G93F") + decimal_text(*motion.feed / distance(at_, to), 4);
  }
  std::string text = decimal_text(*motion.feed, 3);
  if (std::exchange(feed_, text) == text) return {};
  return (was_timed ? "G94F" : "F") + text;
}

double MotionWriter::seconds_of(const Coordinates& to, std::optional<double> feed) const {
  const double length = rules_.feeds_all_axes ? distance(at_, to) : feed_distance(at_, to);
  double minutes = feed ? length / *feed : 0;
  for (std::size_t i = 0; i < kMaxAxes; ++i)
    if (rules_.has(i))
      minutes = std::max(minutes, std::fabs(to[i] - at_[i]) / rules_.axes[i]->max_rate);
  return minutes * 60;
}

std::optional<Refusal> MotionWriter::append(std::string line, MotionText& text) const {
  if (line.size() > rules_.line_limit)
    return Refusal{"MCH0005", fmt::format("a line of {} characters, the machine reads {}: {}",
                                          line.size(), rules_.line_limit, line)};
  text.lines.push_back(std::move(line));
  return std::nullopt;
}

/// At the rates of the axes: somewhere on an arc the slower one of its plane moves alone.
double MotionWriter::least_seconds(const ArcPath& path) const {
  const double rate =
      std::min(rules_.axes[path.first]->max_rate, rules_.axes[path.second]->max_rate);
  double minutes = path.plane_length() / rate;
  for (std::size_t i = 0; i < kMaxAxes; ++i)
    if (rules_.has(i) && i != path.first && i != path.second)
      minutes = std::max(minutes, std::fabs(path.to[i] - path.from[i]) / rules_.axes[i]->max_rate);
  return minutes * 60;
}

/// The word of the mode, where it changes.
std::string MotionWriter::stop_mode(bool rests) {
  if (!rules_.has_stop_mode || rests_ == rests) return {};
  rests_ = rests;
  return rests ? "G61.1" : "G61";
}

/// A dwell of no time lets the axes come to rest on a device that has no exact stop.
void MotionWriter::append_rest(bool rests, MotionText& text) const {
  if (rests && !rules_.has_stop_mode && !text.lines.empty()) text.lines.push_back(dwell(0));
}

double MotionWriter::pieces_of(double seconds) const {
  if (!rules_.seconds_ahead) return 1;
  return std::clamp(std::ceil(seconds / kPieceSeconds - 1e-6), 1.0, double{kMaxPieces});
}

std::optional<Refusal> MotionWriter::straight(const Motion& motion, const Coordinates& to,
                                              MotionText& text) {
  const Coordinates from = at_;
  const bool may_split = text.lines.size() < kMaxPieces;
  const double count = may_split ? pieces_of(seconds_of(to, motion.feed)) : 1;
  for (double i = 1; i < count; ++i) {
    Coordinates point;
    for (std::size_t k = 0; k < kMaxAxes; ++k) point[k] = from[k] + (to[k] - from[k]) * i / count;
    if (is_same_step(point, to)) break;
    if (auto refusal = straight_line({motion.code, motion.feed, false}, point, text))
      return refusal;
  }
  return straight_line(motion, to, text);
}

std::optional<Refusal> MotionWriter::straight_line(const Motion& motion, const Coordinates& to,
                                                   MotionText& text) {
  text.end = to;
  if (is_same_step(at_, to)) return std::nullopt;  // it is not lost: the next target is absolute
  const std::string words = axis_words(to);
  if (words.empty()) return std::nullopt;
  std::string line = stop_mode(motion.rests) + std::string(motion.code) + words;
  line += feed_words(motion, to);
  if (auto refusal = append(std::move(line), text)) return refusal;
  text.seconds += seconds_of(to, motion.feed);
  text.length += distance(at_, to);
  at_ = to;
  return std::nullopt;
}

std::optional<Refusal> MotionWriter::rapid(const interpreter::Rapid& event, MotionText& text) {
  Coordinates to;
  if (auto refusal = target_of(event.to, to)) return refusal;
  return straight({"G0", std::nullopt, event.rests}, to, text);
}

std::optional<Refusal> MotionWriter::line(const interpreter::Line& event, MotionText& text) {
  Coordinates to;
  if (auto refusal = target_of(event.to, to)) return refusal;
  text.end = to;
  if (is_same_step(at_, to)) return std::nullopt;
  double feed = 0;
  if (auto refusal = feed_of(event.feed, straight_length(to), feed)) return refusal;
  if (auto refusal = straight({"G1", feed, event.rests}, to, text)) return refusal;
  append_rest(event.rests, text);
  return std::nullopt;
}

std::optional<Refusal> MotionWriter::arc_line(const interpreter::Arc& event, const Coordinates& end,
                                              double feed, MotionText& text) {
  static constexpr std::array<char, 3> kOffsets{'I', 'J', 'K'};
  static constexpr std::array<std::string_view, 3> kPlanes{"G17", "G18", "G19"};
  const ArcPath path = arc_path(at_, end, event);
  std::string words = axis_words(end);
  // Both words of the plane, also where one does not change: an arc needs one at least.
  for (const std::size_t axis : {path.first, path.second})
    if (words.find(letter_of(axis)) == std::string::npos)
      words += letter_of(axis) + number(end[axis]);
  std::string line = fmt::format("{}{}G{}{}", stop_mode(event.rests),
                                 kPlanes[static_cast<std::size_t>(event.plane)],
                                 event.turn == interpreter::Turn::Counterclockwise ? 3 : 2, words);
  for (const std::size_t axis : {path.first, path.second}) {
    const double center = axis == path.first ? path.center_first : path.center_second;
    line += kOffsets[axis] + number(center - at_[axis]);
  }
  line += feed_words({"", feed}, at_);
  if (auto refusal = append(std::move(line), text)) return refusal;
  at_ = end;
  return std::nullopt;
}

/// Whether the device may find a point of the arc outside of the travel that touches its end.
bool MotionWriter::nears_limit(const ArcPath& path,
                               const std::vector<Coordinates>& extremes) const {
  const auto is_near = [&](const Coordinates& point) {
    return std::ranges::any_of(std::array{path.first, path.second}, [&](std::size_t axis) {
      const auto& travel = rules_.axes[axis]->travel;
      return travel &&
             std::min(point[axis] - travel->low, travel->high - point[axis]) < rules_.arc_margin;
    });
  };
  return rules_.arc_margin > 0 &&
         (is_near(path.from) || is_near(path.to) || std::ranges::any_of(extremes, is_near));
}

std::optional<Refusal> MotionWriter::arc(const interpreter::Arc& event, MotionText& text) {
  Coordinates to;
  if (auto refusal = target_of(event.to, to)) return refusal;
  const ArcPath path = arc_path(at_, to, event);
  const double length = path.length();
  if (!(path.start_radius > 0 && length > 0 && std::isfinite(length)))
    return Refusal{"MCH0006", "the arc has no radius or no length"};
  for (const std::size_t axis : {path.first, path.second})
    if (!rules_.has(axis))
      return Refusal{"MCH0002", fmt::format("the machine has no {} axis", letter_of(axis))};
  const auto farthest = extremes(path);
  for (const Coordinates& extreme : farthest)
    if (auto refusal = check_travel(rules_, at_, extreme, display_)) return refusal;
  const double program = path.feed_length();
  const PathLength measured{program, rules_.feeds_all_axes ? length : program};
  double feed = 0;
  if (auto refusal = feed_of(event.feed, measured, feed)) return refusal;
  bool has_rotary = false;
  for (std::size_t i = 3; i < kMaxAxes; ++i) has_rotary |= to[i] != at_[i];
  const bool is_spiral =
      std::fabs(path.end_radius - path.start_radius) > max_radius_change(rules_.decimals);
  const bool is_arc = !is_spiral && !has_rotary && length >= kShortestArc &&
                      path.start_radius <= rules_.max_arc_radius && !nears_limit(path, farthest);
  interpreter::Arc turned = event;  // in the direction of the path
  turned.turn = path.sweep > 0 ? interpreter::Turn::Counterclockwise : interpreter::Turn::Clockwise;
  const double seconds = std::max(measured.device / feed * 60, least_seconds(path));
  const double arc_count = std::min(pieces_of(seconds), length / kShortestArc);
  const auto ends = is_arc ? arcs(path, arc_count) : chords(path, kChordDeviation);
  if (ends.size() > kMaxPieces)
    return Refusal{"MCH0005", fmt::format("an arc of {} pieces, the machine gets at most {}",
                                          ends.size(), kMaxPieces)};
  for (const Coordinates& end : ends) {
    turned.rests = event.rests && &end == &ends.back();
    auto refusal = is_arc ? arc_line(turned, end, feed, text)
                          : straight({"G1", feed, turned.rests}, end, text);
    if (refusal) return refusal;
  }
  text.end = to;
  text.seconds = seconds;
  text.length = length;
  append_rest(event.rests, text);
  return std::nullopt;
}

std::optional<Refusal> MotionWriter::probe(const interpreter::Probe& event, MotionText& text) {
  Coordinates to;
  if (auto refusal = target_of(event.to, to)) return refusal;
  text.end = to;
  if (is_same_step(at_, to)) return std::nullopt;
  double feed = 0;
  if (auto refusal = feed_of(event.feed, straight_length(to), feed)) return refusal;
  const bool is_contact = event.until == interpreter::ProbeUntil::Contact;
  const std::string code = is_contact ? "G38.3" : "G38.5";
  text.seconds = seconds_of(to, feed);
  feed_ = decimal_text(feed, 3);
  const char* mode = std::exchange(is_timed_, false) ? "G94F" : "F";
  return append(code + axis_words(to) + mode + feed_, text);
}

std::string MotionWriter::dwell(double seconds) {
  return "G4P" + decimal_text(seconds, 3);
}

std::optional<Refusal> MotionWriter::dwell(double seconds, std::vector<std::string>& lines) const {
  if (!std::isfinite(seconds)) return Refusal{"MCH0006", "the dwell has no finite length"};
  const double count = std::ceil(seconds / rules_.max_dwell);
  if (count > double{kMaxPieces})
    return Refusal{"MCH0005", fmt::format("a dwell of {:.6g} s", seconds)};
  for (; seconds > rules_.max_dwell; seconds -= rules_.max_dwell)
    lines.push_back(dwell(rules_.max_dwell));
  if (seconds > 0) lines.push_back(dwell(seconds));
  return std::nullopt;
}

}  // namespace dripline::machine::streamed
