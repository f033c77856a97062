#include "server/paths/path_encoder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gateway/interpreter/core/geometry/plane_axes.hpp"

namespace dripline::paths {
namespace {

using interpreter::Axis;
using interpreter::kAllAxes;
using interpreter::Position;

constexpr double kGridPerMillimeter = 1000;
/// Longer coordinates than any machine's; beyond it a coordinate is at the bound.
constexpr double kMaxGrid = 1e15;
/// Points that wait at a time: what bounds the work for each.
constexpr std::size_t kMaxWaiting = 64;
/// An arc is drawn by chords that leave it by this part of its radius, or by the tolerance.
constexpr double kSagittaOfRadius = 1.0 / 2000;
constexpr int kMaxChords = 4096;
constexpr unsigned kMoveBits = 3;

void append_number(std::string& bytes, std::uint64_t number) {
  for (; number >= 0x80; number >>= 7) bytes += static_cast<char>((number & 0x7f) | 0x80);
  bytes += static_cast<char>(number);
}

/// Small numbers of either sign become small ones without.
std::uint64_t zigzag(std::int64_t number) {
  const auto twice = static_cast<std::uint64_t>(number) << 1;
  return number < 0 ? ~twice : twice;
}

std::int64_t on_grid(double millimeters) {
  const double steps = std::round(millimeters * kGridPerMillimeter);
  if (std::isnan(steps)) return 0;
  return static_cast<std::int64_t>(std::clamp(steps, -kMaxGrid, kMaxGrid));
}

std::int64_t difference(std::uint64_t to, std::uint64_t from) {
  return static_cast<std::int64_t>(to - from);
}

std::array<double, 3> vector_of(const Position& position) {
  return {position.raw(Axis::X), position.raw(Axis::Y), position.raw(Axis::Z)};
}

int chords_of(double radius, double sweep_radians, double tolerance) {
  const double sagitta = std::min(std::max(tolerance, radius * kSagittaOfRadius), radius);
  if (!(radius > 0) || !(sagitta > 0)) return 1;
  const double step = 2 * std::acos(1 - sagitta / radius);
  return static_cast<int>(std::clamp(std::ceil(sweep_radians / step), 1.0, double{kMaxChords}));
}

/// From the straight line between two points, squared.
double distance_squared(const std::array<double, 3>& point, const std::array<double, 3>& from,
                        const std::array<double, 3>& to) {
  double along = 0, length = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    along += (point[i] - from[i]) * (to[i] - from[i]);
    length += (to[i] - from[i]) * (to[i] - from[i]);
  }
  const double part = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0;
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double off = point[i] - from[i] - part * (to[i] - from[i]);
    sum += off * off;
  }
  return sum;
}

}  // namespace

PathEncoder::PathEncoder(const Position& start, double tolerance)
    : tolerance_(tolerance), at_(start) {
  write({.at = vector_of(start), .place = {}, .move = PathMove::Rapid});
}

std::string PathEncoder::take() {
  return std::exchange(bytes_, {});
}

void PathEncoder::finish() {
  if (!waiting_.empty()) write(waiting_.back());
  waiting_.clear();
}

/// A called program's moves belong to the block that calls it: the page has that text.
PathEncoder::Place PathEncoder::place_of(const interpreter::Origin& origin) {
  if (origin.program == interpreter::kMainProgram) place_ = {origin.line, origin.offset};
  return place_;
}

void PathEncoder::on_block_end(const interpreter::Origin& origin) {
  place_of(origin);
}

void PathEncoder::arrive(const interpreter::Origin& origin, const Position& to, PathMove move) {
  for (const Axis axis : kAllAxes) {
    if (axis > Axis::Z && to.raw(axis) != at_.raw(axis)) {
      ++other_axes_;
      break;
    }
  }
  add({.at = vector_of(to), .place = place_of(origin), .move = move});
  at_ = to;
}

void PathEncoder::on_rapid(const interpreter::Rapid& event) {
  arrive(event.origin, event.to, PathMove::Rapid);
}
void PathEncoder::on_line(const interpreter::Line& event) {
  arrive(event.origin, event.to, PathMove::Line);
}
void PathEncoder::on_arc(const interpreter::Arc& event) {
  follow(event, PathMove::Arc);
}
void PathEncoder::on_thread(const interpreter::Thread& event) {
  if (event.arc) follow(arc_of(event), PathMove::Thread);
  if (!event.arc) arrive(event.origin, event.to, PathMove::Thread);
}
void PathEncoder::on_probe(const interpreter::Probe& event) {
  if (!event.result) return;
  if (event.arc) return follow(arc_of(event), PathMove::Probe);
  arrive(event.origin, event.result->at, PathMove::Probe);
}

void PathEncoder::follow(const interpreter::Arc& arc, PathMove move) {
  const interpreter::PlaneAxes axes = axes_of(arc.plane);
  const double center[2] = {arc.center_first.mm(), arc.center_second.mm()};
  const double first = at_.raw(axes.first) - center[0], second = at_.raw(axes.second) - center[1];
  const double radius = std::hypot(first, second);
  const double sweep = arc.sweep.radians();
  const double begin = std::atan2(second, first);
  const double sense = arc.turn == interpreter::Turn::Counterclockwise ? 1 : -1;
  const double from = at_.raw(axes.normal), rise = arc.to.raw(axes.normal) - from;
  const int chords = chords_of(radius, sweep, tolerance_);
  for (int i = 1; i < chords; ++i) {
    const double part = static_cast<double>(i) / chords;
    const double angle = begin + sense * sweep * part;
    Position between = at_;
    between.set_raw(axes.first, center[0] + radius * std::cos(angle));
    between.set_raw(axes.second, center[1] + radius * std::sin(angle));
    between.set_raw(axes.normal, from + rise * part);
    add({.at = vector_of(between), .place = place_of(arc.origin), .move = move});
  }
  arrive(arc.origin, arc.to, move);
}

void PathEncoder::on_tool(const interpreter::ToolChange& event) {
  if (event.is_preselection || tools_.size() >= kMaxTools) return;
  finish();  // the tool's first point is the next one
  tools_.push_back({event.number, place_of(event.origin).line, points_});
}

/// All that waits is within the tolerance of the line to the next point, and of one kind.
bool PathEncoder::may_leave_out(const Point& next) const {
  if (waiting_.size() >= kMaxWaiting || waiting_.front().move != next.move) return false;
  return std::ranges::all_of(waiting_, [&](const Point& point) {
    return distance_squared(point.at, written_.at, next.at) <= tolerance_ * tolerance_;
  });
}

void PathEncoder::add(const Point& point) {
  if (tolerance_ <= 0) return write(point);
  if (!waiting_.empty() && !may_leave_out(point)) finish();
  waiting_.push_back(point);
}

void PathEncoder::write(const Point& point) {
  const std::int64_t lines = difference(point.place.line, written_.place.line);
  append_number(bytes_, zigzag(lines) << kMoveBits | static_cast<std::uint64_t>(point.move));
  append_number(bytes_, zigzag(difference(point.place.offset, written_.place.offset)));
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t grid = on_grid(point.at[i]);
    append_number(bytes_, zigzag(grid - grid_[i]));
    grid_[i] = grid;
  }
  written_ = point;
  ++points_;
}

}  // namespace dripline::paths
