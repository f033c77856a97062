#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "gateway/interpreter/stages/compensation/compensator.hpp"

/// Contours for tests: programmed in millimeters in the XY plane, one block per move.
namespace dripline::interpreter::compensation {

/// A move that came out, from where the one before it ended.
struct Move {
  enum class Kind { Rapid, Line, Arc } kind = Kind::Line;
  PlaneVector from, to, center;
  double sweep = 0;  ///< of an arc: radians, positive to the left
  double z = 0;
  Feed feed;
  Origin origin;
};

/// Keeps moves for geometry and a word for each other event, moves included, for order.
class PathLog final : public EventSink {
 public:
  explicit PathLog(Plane plane = Plane::XY) : axes_(axes_of(plane)) {}
  void on_rapid(const Rapid& event) override {
    add(Move::Kind::Rapid, event.origin, event.to, Feed{}, {}, 0);
  }
  void on_line(const Line& event) override {
    add(Move::Kind::Line, event.origin, event.to, event.feed, {}, 0);
  }
  void on_arc(const Arc& event) override {
    const double side = event.turn == Turn::Counterclockwise ? 1 : -1;
    add(Move::Kind::Arc, event.origin, event.to, event.feed,
        {event.center_first.mm(), event.center_second.mm()}, side * event.sweep.radians());
  }
  void on_miscellaneous(const Miscellaneous& event) override {
    words.push_back("M" + std::to_string(event.code));
  }
  void on_dwell(const Dwell&) override { words.push_back("dwell"); }
  void on_output(const Output& event) override { words.push_back(std::string(event.text)); }
  void on_end(const End&) override { words.push_back("end"); }
  void on_block_end(const Origin& event) override {
    words.push_back("/" + std::to_string(event.block));
  }

  std::vector<Move> moves;
  std::vector<std::string> words;
  PlaneVector at;

 private:
  void add(Move::Kind kind, const Origin& origin, const Position& to, Feed feed, PlaneVector center,
           double sweep) {
    const PlaneVector end = in_plane(to, axes_);
    moves.push_back({kind, at, end, center, sweep, to.linear(axes_.normal).mm(), feed, origin});
    at = end;
    words.push_back("move" + std::to_string(origin.block));
  }
  PlaneAxes axes_;
};

/// Programs one move after another.
class Contour {
 public:
  explicit Contour(const Policy& policy, PlaneVector start = {}, Plane plane = Plane::XY)
      : log(plane), compensator(policy, log), axes_(axes_of(plane)), plane_(plane) {
    set_in_plane(at_, axes_, start);
    compensator.reset(at_);
    log.at = start;
  }

  Contour& left(double radius) { return on(Side::Left, radius); }
  Contour& right(double radius) { return on(Side::Right, radius); }
  Contour& on(Side side, double radius) {
    compensator.turn_on({.plane = plane_,
                         .side = side,
                         .radius = Length::mm(radius),
                         .tip_first = {},
                         .tip_second = {}});
    return *this;
  }
  Contour& off() {
    compensator.turn_off();
    return *this;
  }
  Contour& line(double first, double second) {
    set_in_plane(at_, axes_, {first, second});
    compensator.on_line({next(), at_, feed});
    return end_block();
  }
  Contour& rapid(double first, double second) {
    set_in_plane(at_, axes_, {first, second});
    compensator.on_rapid({next(), at_});
    return end_block();
  }
  /// To the left with a positive sweep in degrees, about `center`.
  Contour& arc(PlaneVector center, double sweep_degrees) {
    const PlaneVector out = in_plane(at_, axes_) - center;
    const double turn = Angle::degrees(sweep_degrees).radians();
    set_in_plane(at_, axes_, center + std::cos(turn) * out + std::sin(turn) * left_of(out));
    compensator.on_arc({.origin = next(),
                        .to = at_,
                        .center_first = Length::mm(center.first),
                        .center_second = Length::mm(center.second),
                        .plane = plane_,
                        .turn = turn > 0 ? Turn::Counterclockwise : Turn::Clockwise,
                        .sweep = Angle::degrees(std::fabs(sweep_degrees)),
                        .feed = feed});
    return end_block();
  }
  /// Along the axis across the plane.
  Contour& aside(double to) {
    at_.set(axes_.normal, Length::mm(to));
    compensator.on_line({next(), at_, feed});
    return end_block();
  }
  /// Round the corner; false in `goes_round` when there was none.
  Contour& round(std::optional<PlaneVector> along = {}) {
    goes_round = compensator.round_outside_corner(next(), feed, along);
    return end_block();
  }
  Contour& misc(int code) {
    compensator.on_miscellaneous({next(), code});
    return end_block();
  }
  Contour& empty_block() {
    next();
    return end_block();
  }
  /// A block that the look-ahead passes over.
  Contour& statement() {
    compensator.on_uncounted_block_end(next());
    return *this;
  }
  std::optional<FaultKind> fault() const {
    const auto& fault = compensator.fault();
    return fault ? std::optional(fault->kind) : std::nullopt;
  }

  PathLog log;
  Compensator compensator;
  bool goes_round = true;
  Feed feed = Feed::per_minute(Length::mm(200));

 private:
  Origin next() {
    ++origin_.block;
    ++origin_.line;
    return origin_;
  }
  Contour& end_block() {
    compensator.on_block_end(origin_);
    return *this;
  }
  PlaneAxes axes_;
  Plane plane_;
  Position at_;
  Origin origin_;
};

}  // namespace dripline::interpreter::compensation
