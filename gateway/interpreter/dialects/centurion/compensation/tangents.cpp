#include "gateway/interpreter/dialects/centurion/compensation/tangents.hpp"

#include <array>
#include <cmath>

#include "gateway/interpreter/dialects/centurion/flow/statements.hpp"
#include "gateway/interpreter/dialects/centurion/reading/expression_reader.hpp"

namespace dripline::interpreter::centurion {

namespace {

/// Three points are on one line when the sine of the angle between them is no larger.
constexpr double kOneLine = 1e-12;

double sign(Beside side) {
  return static_cast<double>(side);
}

}  // namespace

std::optional<TangentPoints> tangent_points(const TangentLine& line) {
  const PlaneVector distance = line.second.center - line.first.center;
  const double apart = length(distance);
  if (apart == 0) return std::nullopt;
  const PlaneVector along = (1 / apart) * distance;
  const double first = sign(line.on_first) * line.first.radius;
  const double second = sign(line.on_second) * line.second.radius;
  const double cosine = (first - second) / apart;
  if (std::fabs(cosine) > 1) return std::nullopt;
  const PlaneVector normal =
      cosine * along + std::sqrt((1 - cosine) * (1 + cosine)) * left_of(along);
  return TangentPoints{
      line.first.center + first * normal, line.second.center + second * normal, {}};
}

std::optional<TangentPoints> tangent_points(const TangentArc& arc) {
  const PlaneVector distance = arc.second.center - arc.first.center;
  // a circle whose tangent point is on the side of the arc's center is outside the arc
  const double first = sign(arc.on_first) * sign(arc.center);
  const double second = sign(arc.on_second) * sign(arc.center);
  const PlaneCircle about_first{{}, arc.radius + first * arc.first.radius};
  const PlaneCircle about_second{distance, arc.radius + second * arc.second.radius};
  if (about_first.radius <= 0 || about_second.radius <= 0) return std::nullopt;
  const auto centers = meet(about_first, about_second);
  if (!centers) return std::nullopt;
  const bool is_left = cross(distance, centers->one) > 0;
  const PlaneVector center =
      is_left == (arc.center == Beside::Left) ? centers->one : centers->other;
  const PlaneVector to_second = center - distance;
  return TangentPoints{
      arc.first.center + (first * arc.first.radius / length(center)) * center,
      arc.second.center + (second * arc.second.radius / length(to_second)) * to_second,
      arc.first.center + center};
}

std::optional<CircleThrough> circle_through(const ThreePoints& points) {
  const PlaneVector a = points.second - points.first;
  const PlaneVector b = points.third - points.first;
  const double turn = cross(a, b);
  if (std::fabs(turn) <= kOneLine * length(a) * length(b)) return std::nullopt;
  const PlaneVector center = (0.5 / turn) * (dot(b, b) * left_of(a) - dot(a, a) * left_of(b));
  return CircleThrough{{points.first + center, length(center)}, turn > 0};
}

namespace {

constexpr int kFirstInput = 90;   ///< Z and X of points or centers in turn
constexpr int kFirstOutput = 80;  ///< the same
constexpr int kRadius = 82;       ///< of CGEN
constexpr int kDirection = 97;    ///< of CGEN: the G code of the arc, 2 or 3

struct TangentCase {
  Beside on_first, on_second, center;
};
constexpr Beside kLeft = Beside::Left;
constexpr Beside kRight = Beside::Right;
/// TANL takes the first four and has no center.
constexpr std::array<TangentCase, 8> kCases{{{kRight, kRight, kLeft},
                                             {kLeft, kRight, kLeft},
                                             {kRight, kLeft, kLeft},
                                             {kLeft, kLeft, kLeft},
                                             {kLeft, kLeft, kRight},
                                             {kRight, kLeft, kRight},
                                             {kLeft, kRight, kRight},
                                             {kRight, kRight, kRight}}};

/// X of a point in the parameters is a diameter unless the option `solver_x` makes it a radius.
double x_scale(const Run& run) {
  return run.options.solver_x_is_radius ? 1 : 2;
}

double input_at(Run& run, int number) {
  run.start.note_read(number);
  return run.parameters[number];
}
PlaneVector point_at(Run& run, int number) {
  return {input_at(run, number), input_at(run, number + 1) / x_scale(run)};
}
PlaneCircle circle_at(Run& run, int number) {
  return {point_at(run, number), input_at(run, number + 2)};
}
void store_point(Run& run, int number, PlaneVector point) {
  run.start.note_set(number);
  run.start.note_set(number + 1);
  run.parameters[number] = point.first;
  run.parameters[number + 1] = point.second * x_scale(run);
}

bool read_case(Run& run, std::uint32_t cases, const char* start, const char*& at,
               TangentCase& wanted) {
  if (!skip_gaps(run, at)) return false;
  if (!take_word(at, "C")) {
    return run.fail(ErrorCode::IllegalStatement, run.column(start), "C, the case, is expected");
  }
  std::uint32_t number = 0;
  if (!read_whole(run, at, cases - 1, number)) return false;
  wanted = kCases[number];
  return true;
}

bool refuse_radius(Run& run, double radius, const char* start) {
  return radius >= 0 || run.fail(ErrorCode::NegativeArcRadius, run.column(start));
}

bool tangent_line(Run& run, const char* start, const char*& at) {
  TangentCase wanted;
  if (!read_case(run, 4, start, at, wanted)) return false;
  const PlaneCircle first = circle_at(run, kFirstInput);
  const PlaneCircle second = circle_at(run, kFirstInput + 3);
  if (!refuse_radius(run, first.radius, start) || !refuse_radius(run, second.radius, start)) {
    return false;
  }
  const auto points = tangent_points(TangentLine{first, second, wanted.on_first, wanted.on_second});
  if (!points) {
    return run.fail(ErrorCode::TangentOverflow, run.column(start),
                    "no line of this case is tangent to both arcs");
  }
  store_point(run, kFirstOutput, points->on_first);
  store_point(run, kFirstOutput + 2, points->on_second);
  return true;
}

bool tangent_arc(Run& run, const char* start, const char*& at) {
  TangentCase wanted;
  if (!read_case(run, 8, start, at, wanted)) return false;
  const PlaneCircle first = circle_at(run, kFirstInput);
  const PlaneCircle second = circle_at(run, kFirstInput + 3);
  const double radius = input_at(run, kFirstInput + 6);
  for (double each : {first.radius, second.radius, radius}) {
    if (!refuse_radius(run, each, start)) return false;
  }
  const auto points = tangent_points(
      TangentArc{first, second, wanted.on_first, wanted.on_second, wanted.center, radius});
  if (!points) {
    return run.fail(ErrorCode::ArcsApart, run.column(start),
                    "no arc of this case is tangent to both arcs");
  }
  store_point(run, kFirstOutput, points->on_first);
  store_point(run, kFirstOutput + 2, points->on_second);
  store_point(run, kFirstOutput + 4, points->center);
  return true;
}

bool circle_of_points(Run& run, const char* start) {
  const auto found = circle_through(
      {point_at(run, kFirstInput), point_at(run, kFirstInput + 2), point_at(run, kFirstInput + 4)});
  if (!found) {
    return run.fail(ErrorCode::TangentOverflow, run.column(start),
                    "the three points are on one line");
  }
  store_point(run, kFirstOutput, found->circle.center);
  run.start.note_set(kRadius);
  run.start.note_set(kDirection);
  run.parameters[kRadius] = found->circle.radius;
  run.parameters[kDirection] = found->is_counterclockwise ? 3 : 2;
  return true;
}

}  // namespace

bool solve_geometry(Run& run, Keyword keyword, const char* start, const char*& at) {
  if (keyword == Keyword::Cgen) return circle_of_points(run, start);
  return keyword == Keyword::Tanl ? tangent_line(run, start, at) : tangent_arc(run, start, at);
}

}  // namespace dripline::interpreter::centurion
