#include "gateway/interpreter/core/geometry/profile.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/base/units.hpp"

namespace dripline::interpreter {
namespace {

constexpr double kRadians = Angle::kPi / 180;

bool is_below(double depth, double level) {
  return depth <= level + kSameLength;
}

ProfilePoint on_circle(const ProfileArc& arc, double radius, double degrees) {
  return {arc.center.depth + radius * std::sin(degrees * kRadians),
          arc.center.along + radius * std::cos(degrees * kRadians)};
}

}  // namespace

double depth_at(const ProfilePiece& piece, double along) {
  if (piece.is_arc) {
    const double off = along - piece.center.along;
    const double height = std::sqrt(std::max(0.0, piece.radius * piece.radius - off * off));
    return piece.center.depth + (piece.is_upper ? height : -height);
  }
  const double length = piece.to.along - piece.from.along;
  if (std::fabs(length) < kSameLength) return std::max(piece.from.depth, piece.to.depth);
  const double part = std::clamp((along - piece.from.along) / length, 0.0, 1.0);
  return piece.from.depth + (piece.to.depth - piece.from.depth) * part;
}

void add_line(ProfilePieces& profile, const ProfilePoint& from, const ProfilePoint& to) {
  ProfilePiece piece;
  piece.from = from;
  piece.to = to;
  profile.push_back(piece);
}

void add_arc(ProfilePieces& profile, const ProfileArc& arc) {
  const double radius =
      std::hypot(arc.from.depth - arc.center.depth, arc.from.along - arc.center.along);
  const double sense = arc.is_counterclockwise ? 1 : -1;
  const double begin =
      std::atan2(arc.from.depth - arc.center.depth, arc.from.along - arc.center.along) / kRadians;
  const double end = begin + sense * arc.sweep;
  double at = begin;
  ProfilePoint from = arc.from;
  // Within a quarter of the circle both directions are monotonic.
  constexpr double kSameAngle = 1e-9;
  for (int quarters = 0; quarters < 6; ++quarters) {
    double next =
        (sense > 0 ? std::floor(at / 90 + kSameAngle) + 1 : std::ceil(at / 90 - kSameAngle) - 1) *
        90;
    const bool is_last = sense * (next - end) >= -kSameAngle * 90;
    if (is_last) next = end;
    ProfilePiece piece;
    piece.is_arc = true;
    piece.is_counterclockwise = arc.is_counterclockwise;
    piece.center = arc.center;
    piece.radius = radius;
    piece.is_upper = std::sin((at + next) / 2 * kRadians) >= 0;
    piece.from = from;
    piece.to = is_last ? arc.to : on_circle(arc, radius, next);
    profile.push_back(piece);
    if (is_last) return;
    from = piece.to;
    at = next;
  }
}

void shift(ProfilePieces& profile, double depth, double along) {
  for (ProfilePiece& piece : profile) {
    for (ProfilePoint* point : {&piece.from, &piece.to, &piece.center}) {
      point->depth += depth;
      point->along += along;
    }
  }
}

double along_at(const ProfilePiece& piece, double level) {
  const double low = std::min(piece.from.along, piece.to.along);
  const double high = std::max(piece.from.along, piece.to.along);
  if (piece.is_arc) {
    const double off = level - piece.center.depth;
    const double width = std::sqrt(std::max(0.0, piece.radius * piece.radius - off * off));
    const bool is_right = (piece.from.along + piece.to.along) / 2 >= piece.center.along;
    return std::clamp(piece.center.along + (is_right ? width : -width), low, high);
  }
  const double height = piece.to.depth - piece.from.depth;
  if (std::fabs(height) < kSameLength) return piece.to.along;
  const double part = std::clamp((level - piece.from.depth) / height, 0.0, 1.0);
  return piece.from.along + (piece.to.along - piece.from.along) * part;
}

std::vector<OpenInterval> open_at(const ProfilePieces& profile, double level, double start) {
  std::vector<OpenInterval> found;
  if (profile.empty()) return found;
  bool is_open = is_below(profile.front().from.depth, level);
  OpenInterval interval;
  interval.from = start;
  const auto close = [&](double at, std::size_t piece) {
    interval.to = at;
    interval.closing_piece = piece;
    interval.is_open_at_start = interval.from <= start + kSameLength;
    interval.from = std::max(interval.from, start);
    if (interval.to > interval.from + kSameLength) found.push_back(interval);
    is_open = false;
  };
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const ProfilePiece& piece = profile[i];
    if (is_open && !is_below(piece.to.depth, level)) close(along_at(piece, level), i);
    if (!is_open && is_below(piece.to.depth, level) && !is_below(piece.from.depth, level)) {
      interval.from = along_at(piece, level);
      interval.opening_piece = i;
      is_open = true;
    }
  }
  if (is_open) close(profile.back().to.along, profile.size());
  return found;
}

std::optional<double> highest_between(const ProfilePieces& profile, double from, double to) {
  std::optional<double> highest;
  for (const ProfilePiece& piece : profile) {
    const double begin = std::max(from, std::min(piece.from.along, piece.to.along));
    const double end = std::min(to, std::max(piece.from.along, piece.to.along));
    if (end < begin - kSameLength) continue;
    const double depth = std::max(depth_at(piece, begin), depth_at(piece, std::max(begin, end)));
    highest = std::max(highest.value_or(depth), depth);
  }
  return highest;
}

}  // namespace dripline::interpreter
